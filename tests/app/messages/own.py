"""What the page draws of a scene as it is when it is chosen, solved once in a process; and a message taken apart."""

import math
from functools import cache

import numpy as np

from app.choices.scene_of import own_choices
from app.messages.encoding import read_header
from app.messages.solve import solve_frame


@cache
def own_message(name: str) -> bytes:
    return solve_frame(own_choices(name))


def arrays(message: bytes) -> dict[str, np.ndarray]:
    header = read_header(message)
    offset, found = 4 + int.from_bytes(message[:4], "little"), {}
    for name, shape, *unit in header["arrays"]:
        size = math.prod(shape)
        if unit:
            found[name] = unit[0] * np.frombuffer(message, "<i2", size, offset).reshape(shape)
            offset += 2 * (size + size % 2)
        else:
            found[name] = np.frombuffer(message, "<f4", size, offset).reshape(shape)
            offset += 4 * size
    assert offset == len(message)
    return found
