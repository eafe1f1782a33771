"""The message for whatever is chosen."""

from typing import Any

from solvers import RigidImpulse

from ..choices.request import Request
from .axial import pack
from .beam import beam_frame
from .mechanism.frame import mechanism_frame
from .solutions import both
from .space import bodies_frame


def solve_frame(chosen: dict[str, Any]) -> bytes:
    """Solve what is chosen, exactly and by the method shown beside it, and pack what the page draws."""
    request = Request.of(chosen)
    if request.kind == "bodies":
        method = RigidImpulse(restitution=request.restitution, model=request.chosen["restitution_model"])
        return bodies_frame(method.solve(request.scene), request)
    if request.kind == "beam":
        return beam_frame(request)
    if request.kind == "mechanism":
        return mechanism_frame(request)
    return pack(request, *both(request))
