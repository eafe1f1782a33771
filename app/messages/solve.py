"""The message for whatever is chosen."""

from typing import Any

from ..choices.request import Request
from .axial import axial_frame
from .beam import beam_frame
from .mechanism.frame import mechanism_frame
from .space import space_frame

FRAMES = {"axial": axial_frame, "beam": beam_frame, "mechanism": mechanism_frame, "bodies": space_frame}  # by kind


def solve_frame(chosen: dict[str, Any]) -> bytes:
    """Solve what is chosen, and pack what the page draws."""
    request = Request.of(chosen)
    return FRAMES[request.kind](request)
