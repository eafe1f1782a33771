"""What all functions that the browser calls have in common: how they are declared, and the contact laws they know."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numba
import numpy as np
from numba import types

from solvers.contact import LAWS, Linear, Rigid
from solvers.numerics.waves.laws import any_law

CYCLE, DEPTHS = 300, 60  # of a contact law: instants of the impact, depths
INSTANTS = 301  # of the motions along an axis
KINDS = [kind for kind in LAWS.values() if kind is not Rigid]
REMEMBERS, LOSES = np.array([kind.PLASTIC for kind in KINDS]), np.array([kind.LOSSY for kind in KINDS])
JUMPING, SPRING = np.array([kind.JUMPS for kind in KINDS]), KINDS.index(Linear)
FLOATS, INTEGERS, FLAGS = (types.CPointer(kind) for kind in (types.float64, types.int64, types.boolean))
ANY_LAW = any_law(KINDS)


class Entry(NamedTuple):
    """One function: how many numbers it takes, and then how much room by argument, in numbers of eight bytes. What
    needs more is refused; pages of memory that are never used cost nothing."""

    function: Callable
    numbers: int
    room: dict[str, int]
    kinds: dict[str, Any]  # of pointer, where they are not of numbers
    out: dict[str, int]  # places in `out`

    @property
    def signature(self) -> numba.core.typing.Signature:
        pointers = (self.kinds.get(name, FLOATS) for name in self.room)
        return types.int32(*self.numbers * [types.float64], *pointers)
