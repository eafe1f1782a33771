"""How far to trust a blow on a beam: the same many times with tiny changes, and with more and more modes."""

import json
from typing import Any

import numpy as np

from solvers import Modal, Scene, ensemble
from solvers.convergence import convergence

from .beam_frame import MS, chosen_method
from .state import chosen_scene

RUNS = 200
COUNTS = (3, 5, 10, 20, 40)  # of modes, or of elements where finite elements are chosen
COUNTED = ("modal", "mode-switch", "fe-nodal", "fe-modal")
MOST_POINTS = 400  # of a band


def trust_data(chosen: dict[str, Any]) -> str:
    """The ensemble for these choices as JSON: `chosen`, bands over time [ms], table and words; or `error`."""
    answer: dict[str, Any] = {"chosen": chosen}
    try:
        answer |= _ensemble(chosen_scene(chosen), chosen)
    except ValueError as refusal:  # SceneError
        answer["error"] = str(refusal)
    return json.dumps(answer, allow_nan=False)


def _ensemble(scene: Scene, chosen: dict[str, Any]) -> dict[str, Any]:
    found = ensemble(scene, method=chosen_method(scene, chosen)[0], runs=RUNS)
    rows = np.unique(np.linspace(0, found.time.size - 1, MOST_POINTS).round().astype(int))

    def band(given: Any) -> dict[str, list[float]]:
        return {name: _listed(getattr(given, name)[rows]) for name in ("lowest", "low", "high", "highest")}

    table = found.table()
    return {
        "time": _listed(MS * found.time[rows]),
        "force": band(found.force),
        "displacement": band(found.struck_position),
        "velocity": band(found.impactor_velocity),
        "runs": RUNS,
        "key": found.key,
        "largest": float(np.abs(found.perturbations).max()),
        "spread": table["spread"],
        "ill": found.ill_conditioned,
        "told": found.told,
        "notes": found.notes,
        "took": found.wall_time,
    }


def convergence_data(chosen: dict[str, Any]) -> str:
    """The blow with more and more modes as JSON: `chosen` and the table of the study, or `error`, a sentence."""
    answer: dict[str, Any] = {"chosen": chosen}
    try:
        scene = chosen_scene(chosen)
        method, _ = chosen_method(scene, chosen)
        answer |= convergence(scene, COUNTS, method if method.NAME in COUNTED else Modal()).table()
    except ValueError as refusal:  # SceneError
        answer["error"] = str(refusal)
    return json.dumps(answer, allow_nan=False)


def _listed(values: np.ndarray) -> list[float]:
    return [float(f"{value:.5g}") for value in values.tolist()]
