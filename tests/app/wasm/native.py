"""The same answers by the kernels of this machine, to hold those of a browser against."""

import numpy as np

from app.wasm.entries import INSTANTS, JUMPS, PIECES, POINTS, TERMS
from solvers.methods.base import AFTERGLOW
from solvers.numerics.waves import rigid_drawn
from solvers.numerics.waves.rigid import Pieces
from solvers.numerics.waves.rigid_drawn import Drawn

HISTORIES = ("wave_time", "wave", "force_time", "force", "mass", "end", "whole")


def rod(beta: float, reflection: float) -> dict[str, list[float]] | None:
    """Figures, contacts and histories, as flat lists; None where there is no room."""
    sent, drawn = Pieces.of(PIECES, TERMS, PIECES), Drawn.of(POINTS, INSTANTS, JUMPS)
    out = np.empty(rigid_drawn.COLUMNS)
    if rigid_drawn.answer(beta, reflection, AFTERGLOW, POINTS, sent, drawn, out) != rigid_drawn.SOLVED:
        return None
    points = {"wave": int(out[rigid_drawn.WAVE_POINTS]), "force": int(out[rigid_drawn.FORCE_POINTS])}
    found = {name: getattr(drawn, name)[: points.get(name.split("_")[0])].tolist() for name in HISTORIES}
    contacts = sent.contacts[: int(out[rigid_drawn.CONTACTS])]
    figures = np.delete(out, [rigid_drawn.PIECES, rigid_drawn.REACH])
    return found | {"out": figures.tolist(), "contacts": np.delete(contacts, 5, axis=1).ravel().tolist()}
