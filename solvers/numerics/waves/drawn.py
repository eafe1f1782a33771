"""What a picture needs of an impact on a rod: figures, and histories with every jump twice.

A kernel solves and draws in one call, so that it can be compiled ahead of time for where there is no Python:
`rigid_drawn` of a rigid mass on a uniform rod, `law_drawn` of one that strikes through a contact law.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from ...jit.clock import check_time
from ...jit.kernels import inner_kernel

SOLVED, NO_ROOM = 0, 1  # what such a kernel returns
FORCE_SAMPLES, MOST_SAMPLES = 200.0, 1_000.0  # of the force, in a round trip and in all
BEYOND = 1.02  # times the parting, up to which indentation and force are drawn over each other
LEAST_JUMP = 1e-6  # of the impact speed; smaller ones are drawn as none


class Drawn(NamedTuple):
    """Room for the histories, in the units of the kernel: times T; a jump has two rows of the same time."""

    jumps: np.ndarray  # (events and their returns,)
    wave_time: np.ndarray  # (points + jumps,): the wave that the struck end sends
    wave: np.ndarray
    force_time: np.ndarray  # (samples + jumps,): contact force, in Z v
    force: np.ndarray
    # (instants,), evenly spread: displacements of the mass, of the struck end and of the centre of the rod [v T]
    mass: np.ndarray
    end: np.ndarray
    whole: np.ndarray

    @classmethod
    def of(cls, points: int, instants: int, jumps: int = 400) -> "Drawn":
        samples = int(MOST_SAMPLES) + 1
        sizes = (jumps, points + 2 * jumps, points + 2 * jumps, samples + 2 * jumps, samples + 2 * jumps)
        return cls(*(np.empty(size) for size in (*sizes, instants, instants, instants)))


@inner_kernel
def instant(k, even, reach):
    """The k-th of so many times spread evenly up to `reach`."""
    return reach if k == even - 1 else k * (reach / (even - 1))


@inner_kernel
def samples_of(last):
    """How many even times a contact force is drawn at, up to `last`."""
    return int(min(FORCE_SAMPLES * last, MOST_SAMPLES)) + 1


def history_of(either_side: Callable) -> Callable:
    """A kernel that writes a history at even times up to `last` and at the jumps between them, and returns how many
    rows. `either_side(t, *known)` gives the values before and after an instant.
    """

    @inner_kernel
    def history(even, last, jumps, known, time, value):
        count = following = k = 0
        while k < even or following < jumps.size:
            if k % 64 == 0:
                check_time()
            t = instant(k, even, last) if k < even else np.inf
            if following < jumps.size and jumps[following] <= t:
                k += 1 if jumps[following] == t else 0
                t = jumps[following]
                following += 1
            else:
                k += 1
            if t > last:
                break
            before, after = either_side(t, *known)
            if abs(after - before) > LEAST_JUMP:
                time[count], value[count] = t, before
                count += 1
            time[count], value[count] = t, after
            count += 1
        return count

    return history
