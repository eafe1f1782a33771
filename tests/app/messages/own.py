"""What the page draws of a scene as it is when it is chosen, solved once in a process; and a message taken apart."""

from functools import cache

from app.choices.scene_of import own_choices
from app.messages.encoding import arrays_of as arrays
from app.messages.solve import solve_frame

__all__ = ["arrays", "own_message"]


@cache
def own_message(name: str) -> bytes:
    return solve_frame(own_choices(name))
