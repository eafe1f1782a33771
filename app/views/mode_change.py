"""A mass joins a link of finite elements on a node: by projection from its modes to those of both, for the page."""

from collections.abc import Hashable
from typing import Any

import numpy as np

from solvers.bodies import Mechanism

from ..choices.built_in import struck_body
from ..choices.opened import opening_of
from ..choices.request import Request
from ..text.refusals import Refused
from .answering import answering

PARTS = ("along", "across", "turn")  # of each node, in this order
ROUNDING = 1e-12  # of the largest value before, as much as comes of rounding


def of_struck_nodes(asked: dict[str, Any]) -> Hashable:
    """What decides the projections, if a link is struck on one of its nodes; else None."""
    target = struck_body(asked)
    if not isinstance(target, Mechanism) or not target.struck_link.nodes:
        return None
    return tuple(asked[name] for name in ("scene", "bodies", "mass_ratio", "speed", "place", "modes"))


@answering
def mode_change_data(request: Request) -> dict[str, Any]:
    """`nodes` from the first end on [mm] and which is `struck`, from 1; how many `modes`, `lost` of
    the energy [%], the `speed` of approach [m/s]; `velocities` [m/s, rad/s] and `coordinates` [m, rad], by projection
    and part at every node, and which of both is shown `first`.
    """
    scene = request.scene
    target = scene.target.known_as(Mechanism)
    change = target.mode_change(scene.impactor.mass, scene.speed)
    if change is None:
        raise Refused("mode_change.no-node")
    link = target.struck_link
    nodes = np.array(link.nodes)
    answer: dict[str, Any] = {
        "nodes": (1e3 * nodes).tolist(),
        "struck": 1 + int(np.abs(nodes - target.struck.at * link.length).argmin()),
        "modes": link.modes,
        "lost": 100.0 * change.lost,
        "speed": scene.speed,
        "first": "coordinates" if "coordinates" in opening_of(request.chosen["scene"]).charts else "velocities",
    }
    for name in ("velocities", "coordinates"):
        fields = getattr(change, name)._asdict()
        least = ROUNDING * float(np.abs(fields["before"]).max())
        answer[name] = {by: {part: _listed(f[k::3], least) for k, part in enumerate(PARTS)} for by, f in fields.items()}
    return answer


def _listed(values: np.ndarray, least: float) -> list[float]:
    """As the page writes them; what is `least` or less is nought."""
    return [float(f"{value:.6g}") if abs(value) > least else 0.0 for value in values.tolist()]
