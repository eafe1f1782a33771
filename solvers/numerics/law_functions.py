"""Contact laws by the address of a few functions: these are compiled for every law, the kernels that call them once.

Where a step costs much more than a call, as of lines of elements and chains of rods on a grid.
"""

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numba import types

from ..jit.kernels import address, addressed_kernel, inner_kernel, kernel

CONSTANTS = 6  # room for those of any law
MEMORY = 5  # room for what a law answers: end, energy lost, two numbers of its way back; largest force
STEP_SIGNATURE = types.float64(
    types.Array(types.float64, 1, "C"), *[types.float64] * 6, types.Array(types.float64, 1, "C")
)
FORCE, STORED = range(2)  # what a law is asked for
STEP, MEAN, UNLOADING = range(3)  # what one of several laws is asked for by a march
ASK_SIGNATURE = types.float64(types.int64, types.Array(types.float64, 1, "C"), *[types.float64] * 4)


def constants_of(laws: Sequence[NamedTuple]) -> np.ndarray:
    """Those of each law, (laws, CONSTANTS), as its functions take them."""
    return np.array([[*law, *[0.0] * (CONSTANTS - len(law))] for law in laws])


@lru_cache
def step_function(kind: type) -> Callable:
    """`mean_force` of a contact law by its address.

    Takes (CONSTANTS,), start, free, compliance, rate, expected, deepest and the memory (MEMORY,) of the contact, where
    it leaves indentation, energy lost and the way back; returns the force. A compliance of zero asks for the way back
    alone.
    """
    count = len(kind._fields)

    @addressed_kernel
    def step(constants, start, free, compliance, rate, expected, deepest, memory):
        c = constants
        law = kind(*(c[0], c[1], c[2], c[3], c[4], c[5])[:count])
        if compliance == 0.0:
            memory[2], memory[3] = law.unloading(deepest)
            return 0.0
        known = memory[2], memory[3]
        force, memory[0], memory[1], known = law.mean_force(start, free, compliance, rate, expected, deepest, known)
        memory[2], memory[3] = known[0], known[1]
        return force

    return address(step, STEP_SIGNATURE)


@lru_cache
def ask_function(kind: type) -> Callable:
    """Of a contact law by its address: `centred` force, or the energy stored.

    Takes the question, (CONSTANTS,), indentation, rate, slowing and deepest.
    """
    count = len(kind._fields)

    @addressed_kernel
    def ask(question, constants, indentation, rate, slowing, deepest):
        c = constants
        law = kind(*(c[0], c[1], c[2], c[3], c[4], c[5])[:count])
        if question == STORED:
            return law.stored(indentation, deepest)
        return centred(law, indentation, rate, slowing, deepest)

    return address(ask, ASK_SIGNATURE)


def one_of(kernels: Sequence[Callable]) -> Callable:
    """Several kernels that take and return alike as one: by the number of one among them, which comes first."""

    def choice(number: int) -> Callable:
        own = kernels[number]
        others = choice(number + 1) if number + 1 < len(kernels) else None

        @inner_kernel
        def own_or_others(which, *given):
            if others is None or which == number:
                return own(*given)
            return others(which, *given)

        return own_or_others

    return choice(0)


def any_stepped(kinds: Sequence[type]) -> type:
    """Several sorts of contact laws as one, for a march: the number of one among `kinds`, and its constants."""

    def of(kind: type) -> Callable:
        count = len(kind._fields)

        @inner_kernel
        def step(question, c, start, free, compliance, rate, expected, deepest, memory):
            law = kind(*c[:count])
            if question == UNLOADING:
                return 0.0, 0.0, 0.0, law.unloading(deepest)
            if question == MEAN:
                mean, lost = law.mean(start, free, rate, deepest)
                return mean, 0.0, lost, memory
            return law.mean_force(start, free, compliance, rate, expected, deepest, memory)

        return step

    chosen = one_of([of(kind) for kind in kinds])

    class AnyStepped(NamedTuple):
        number: int
        c0: float
        c1: float
        c2: float
        c3: float
        c4: float
        c5: float

        def unloading(self, deepest):
            return chosen(self.number, UNLOADING, self[1:], 0.0, 0.0, 0.0, 0.0, 0.0, deepest, (0.0, 0.0))[3]

        def mean(self, start, end, rate, deepest):
            found = chosen(self.number, MEAN, self[1:], start, end, 0.0, rate, 0.0, deepest, (0.0, 0.0))
            return found[0], found[2]

        def mean_force(self, start, free, compliance, rate, expected, deepest, memory):
            return chosen(self.number, STEP, self[1:], start, free, compliance, rate, expected, deepest, memory)

    return AnyStepped


def asked(law: NamedTuple) -> tuple[Callable, np.ndarray]:
    """What an explicit step takes of a law: its `ask_function` and constants."""
    return ask_function(type(law)), constants_of([law])[0]


def stepped(law: NamedTuple) -> tuple[Any, ...]:
    """What an implicit step takes of a law: its `step_function`, `ask_function` and constants."""
    return step_function(type(law)), *asked(law)


@kernel
def centred(law, indentation, rate, slowing, deepest):
    """The force F at a rate that F itself slows by slowing * F: one increasing equation, Newton kept in brackets."""
    high = law.force(indentation, rate, deepest)
    if slowing == 0.0 or high <= 0.0:
        return high
    low, force = 0.0, high
    for _ in range(60):
        slowed = rate - slowing * force
        miss = force - law.force(indentation, slowed, deepest)
        if miss > 0.0:
            high = force
        else:
            low = force
        _, by_rate = law.slopes(indentation, slowed, deepest)
        following = force - miss / (1.0 + slowing * by_rate)
        if not low < following < high:
            following = 0.5 * (low + high)
        if abs(following - force) <= 1e-15 * high:
            break
        force = following
    return force
