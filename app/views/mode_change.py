"""A mass joins a link of finite elements on a node: by projection from its modes to those of both, for the page."""

import json
from collections.abc import Hashable
from typing import Any

import numpy as np

from solvers.bodies import Mechanism

from ..choices.built_in import struck_body
from ..choices.opened import opening_of
from ..choices.request import Request
from ..text.refusals import note, reason_of

PARTS = ("along", "across", "turn")  # of each node, in this order
ROUNDING = 1e-12  # of the largest value before, as much as comes of rounding


def of_struck_nodes(asked: dict[str, Any]) -> Hashable:
    """What decides the projections, if a link is struck on one of its nodes; else None."""
    target = struck_body(asked)
    if not isinstance(target, Mechanism) or not target.struck_link.nodes:
        return None
    return tuple(asked[name] for name in ("scene", "bodies", "mass_ratio", "speed", "place", "modes"))


def mode_change_data(chosen: dict[str, Any]) -> str:
    """As JSON: `chosen`; `nodes` from the first end on [mm] and which is `struck`, from 1; how many `modes`, `lost` of
    the energy [%], the `speed` of approach [m/s]; `velocities` [m/s, rad/s] and `coordinates` [m, rad], by projection
    and part at every node, and which of both is shown `first`; or `error`, a note why there is none.
    """
    answer: dict[str, Any] = {"chosen": chosen}
    try:
        scene = Request.of(chosen).scene
        target = scene.target.known_as(Mechanism)
        change = target.mode_change(scene.impactor.mass, scene.speed)
    except ValueError as refusal:
        return json.dumps(answer | {"error": reason_of(refusal)})
    if change is None:
        return json.dumps(answer | {"error": note("mode_change.no-node").table()})
    link = target.struck_link
    nodes = np.array(link.nodes)
    answer |= {
        "nodes": (1e3 * nodes).tolist(),
        "struck": 1 + int(np.abs(nodes - target.struck.at * link.length).argmin()),
        "modes": link.modes,
        "lost": 100.0 * change.lost,
        "speed": scene.speed,
        "first": next((name for name in opening_of(chosen["scene"]).charts if name == "coordinates"), "velocities"),
    }
    for name in ("velocities", "coordinates"):
        fields = getattr(change, name)._asdict()
        least = ROUNDING * float(np.abs(fields["before"]).max())
        answer[name] = {by: {part: _listed(f[k::3], least) for k, part in enumerate(PARTS)} for by, f in fields.items()}
    return json.dumps(answer, allow_nan=False)


def _listed(values: np.ndarray, least: float) -> list[float]:
    """As the page writes them; what is `least` or less is nought."""
    return [float(f"{value:.6g}") if abs(value) > least else 0.0 for value in values.tolist()]
