"""Amplitude over frequency for the page: of the contact force, of the impactor, or of a place of what is struck."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import param

from solvers import Beam, Modal, Rod, SceneError, Solution
from solvers.bodies import Mechanism
from solvers.notebook.figures import fields_of, histories_of
from solvers.solution.motion import KnowsModes

from ..choices.questions import Question
from ..choices.request import Request
from ..messages.axial import known_as
from ..messages.solutions import both
from ..messages.transverse import main_solution
from .answering import answering

FORCE = "contact_force"
OF_PLACES = ("displacement", "velocity", "stress", "bending_moment", "shear_force")
SHOWN = (FORCE, "impactor_velocity", *OF_PLACES)
MOST = 60  # modes that are marked
QUESTIONS = {
    "spectrum_of": Question(param.Selector(default=FORCE, objects=[*SHOWN], doc="the history"), "of"),
    "spectrum_place": Question(
        param.Number(default=0.5, bounds=(0.0, 1.0), doc="of it, over the length of what is struck"), "where"
    ),
}


@answering
def spectrum_data(request: Request) -> dict[str, Any]:
    """`lines`, for each solution its `name`, `modes` as it has them and its `values` at every `frequency` [Hz], in
    `unit`: of the contact force the density, of all else the amplitude under a Hann window. `what` it is of, and which
    `kinds` there are; `place` [m] or None, `window`, `duration` [s] and `natural` frequencies [Hz] of what is struck.
    """
    solutions = dict(_solutions(request))
    first = next(iter(solutions.values()))
    target = request.scene.target
    fields = fields_of(request.scene) if target.length else {}
    kinds = [name for name in SHOWN if name in histories_of(request.scene) | fields]
    if first.contacts and first.peak_force is None:
        kinds.remove(FORCE)
    wanted = request.chosen["spectrum_of"]
    what = wanted if wanted in kinds else kinds[0]
    place = request.chosen["spectrum_place"] * target.length if what in fields else None
    window = "none" if what == FORCE else "hann"
    frequency = first.spectrum(what, place, window).frequency
    lines, natural = [], _natural(request, first)
    for name, solution in solutions.items():
        try:
            found = solution.spectrum(what, place, window, frequency)
        except SceneError:
            if solution is first:
                raise
            continue  # one that is all impulse has no force over time
        values = found.density if what == FORCE else found.amplitude
        lines.append({"name": name, "modes": solution.method.get("modes"), "values": _listed(values)})
        natural = found.modes if found.modes.size else natural
    return {
        **{"what": what, "kinds": kinds, "place": place, "window": window, "duration": first.duration},
        "unit": f"{found.unit} s" if what == FORCE else found.unit,
        "frequency": _listed(frequency),
        "lines": lines,
        "natural": _listed(natural[natural <= frequency[-1]][:MOST]),
    }


def _solutions(request: Request) -> Iterator[tuple[str, Solution]]:
    """Those that the page shows, by what it calls them; of two only as far as both tell places apart."""
    if not request.exact:
        main = main_solution(request)[0]
        yield main.method["name"], main
        return
    exact, other = both(request)
    yield known_as(exact), exact
    if other is not None:
        yield other.method["name"], other


def _natural(request: Request, solution: Solution) -> np.ndarray:
    """Frequencies of what is struck [Hz], where it has modes of its own; those of a mechanism that moves on change."""
    target = request.scene.target
    if isinstance(target, Mechanism):
        modes = target.frozen.modes.excited()
        return modes.frequencies / (2.0 * np.pi) if isinstance(solution.motion, KnowsModes) else np.empty(0)
    if not isinstance(target, Rod | Beam) or Modal(modes=request.modes).refusal(request.scene):
        return np.empty(0)
    return target.modes(request.modes).frequencies / (2.0 * np.pi)


def _listed(values: np.ndarray) -> list[float]:
    return [float(f"{value:.5g}") for value in values.tolist()]
