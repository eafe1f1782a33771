"""The same answers by the kernels of this machine, to hold those of a browser against."""

import numpy as np

from app.wasm.entry import CYCLE, DEPTHS, INSTANTS
from app.wasm.wave_entries import CONTACTS, JUMPS, PIECES, POINTS, STRETCHES, TERMS, TOLERANCE
from solvers import Scene
from solvers.methods.base import AFTERGLOW, MAX_ROUND_TRIPS
from solvers.methods.waves.chain_scene import ChainScene
from solvers.numerics.waves import drawn as histories
from solvers.numerics.waves import law_drawn, rigid_drawn
from solvers.numerics.waves.drawn import Drawn
from solvers.numerics.waves.laws import law_function, new_work
from solvers.numerics.waves.nodes import new_state
from solvers.numerics.waves.record import new_record
from solvers.numerics.waves.rigid import Pieces

HISTORIES = ("wave_time", "wave", "force_time", "force", "mass", "end", "whole")


def rod(beta: float, reflection: float) -> dict[str, list[float]] | None:
    """Figures, contacts and histories, as flat lists; None where there is no room."""
    sent, drawn = Pieces.of(PIECES, TERMS, PIECES), Drawn.of(POINTS, INSTANTS, JUMPS)
    out = np.empty(rigid_drawn.COLUMNS)
    if rigid_drawn.answer(beta, reflection, AFTERGLOW, POINTS, sent, drawn, out) != histories.SOLVED:
        return None
    points = {"wave": int(out[rigid_drawn.WAVE_POINTS]), "force": int(out[rigid_drawn.FORCE_POINTS])}
    found = {name: getattr(drawn, name)[: points.get(name.split("_")[0])].tolist() for name in HISTORIES}
    start, end, before, after, peak, _, face = sent.contacts[: int(out[rigid_drawn.CONTACTS])].T
    contacts = np.column_stack((start, end, 0.5 / beta * (before - after), after, peak))
    figures = [*out[:4], after[-1], face[-1] - after[-1], out[rigid_drawn.SHOWN]]
    return found | {"out": figures, "contacts": contacts.ravel().tolist()}


def law(scene: Scene, asked: float = 0.0) -> dict[str, list[float]] | None:
    """The same of an impact through a contact law."""
    given = ChainScene(scene)
    struck, _, constants = given.kernel_laws()
    drawn, out, contacts = Drawn.of(POINTS, INSTANTS, JUMPS), np.empty(law_drawn.COLUMNS), np.empty((CONTACTS, 5))
    cycle = tuple(np.empty(size) for size in (CYCLE, CYCLE, DEPTHS, DEPTHS))
    of_law = constants, given.plastic, given.lossy, given.pulse, given.masses
    record = new_record(2, STRETCHES)
    rooms = record, new_state(given.chain, STRETCHES), new_work()
    status = law_drawn.answer(
        given.chain, *rooms, law_function(struck), of_law, (TOLERANCE, MAX_ROUND_TRIPS, AFTERGLOW, asked), POINTS,
        np.empty((CONTACTS, 2), np.int64), contacts, drawn, cycle, out,
    )  # fmt: skip
    if status != histories.SOLVED:
        return None
    points = {"wave": int(out[law_drawn.WAVE_POINTS]), "force": int(out[law_drawn.FORCE_POINTS])}
    found = {name: getattr(drawn, name)[: points.get(name.split("_")[0])].tolist() for name in HISTORIES}
    found |= dict(zip(("depths", "presses", "loading", "unloading"), (each.tolist() for each in cycle), strict=True))
    count = int(out[law_drawn.CONTACTS])
    figures = {"out": out[: law_drawn.CONTACTS].tolist(), "contacts": contacts[:count].ravel().tolist()}
    return found | figures | {"filled": [float(record.count.max() / STRETCHES)]}
