"""A mass that strikes a spring as a picture needs it, in one call: figures, motions and fields of a rod that bends so.

As in `waves.drawn`, so that it can be compiled ahead of time for where there is no Python.
"""

from typing import NamedTuple

import numpy as np

from ..jit.kernels import inner_kernel, kernel
from .balance_histories import between
from .single_degree import SAMPLES, energy_of_spring, on_spring, spread, straight
from .waves.drawn import SOLVED, instant

# what `answer` writes into `out`, in the units of its arguments; STRUCK: energy of the spring; AT_ONCE: impulse of the
# first instant; ROOT: largest force on what holds the spring
IMPULSE, FINAL, APART, COMPRESSING, STRUCK, DISSIPATED, END, PEAK, AT_ONCE, ROOT, STEPS = range(11)
COLUMNS = 11


class Drawn(NamedTuple):
    """What is drawn, at even times and places."""

    impactor: np.ndarray  # (instants,), displacement; and of the struck end
    end: np.ndarray
    force_time: np.ndarray  # (SAMPLES + 3,), of the contact, and the end of it and of all
    force: np.ndarray
    stress: np.ndarray  # (few instants, places): as the force, over the area
    velocity: np.ndarray
    displacement: np.ndarray


@inner_kernel
def _fields(stiffness, duration, response, drawn):
    """Of a uniform rod, from its struck end to that which is held."""
    instants, places = drawn.stress.shape
    for i in range(instants):
        t = instant(i, instants, duration)
        bent = between(response.time, response.bent, t)
        rate = between(response.time, response.bent_rate, t)
        for k in range(places):
            share = straight(k / (places - 1.0))
            drawn.stress[i, k] = stiffness * bent
            drawn.velocity[i, k], drawn.displacement[i, k] = share * rate, share * bent


@kernel
def answer(mass, carried, stiffness, parting, duration, response, drawn, out):
    """Write what is drawn of a mass that strikes a held spring at a speed of one, and parts before the `duration` ends.

    parting: `single_degree.half_swing`; response: room for `single_degree.instants_of` them; out (COLUMNS,). Returns
    SOLVED.
    """
    spread(parting, duration, response.time)
    on_spring(mass, carried, stiffness, 1.0, response)
    last = response.time.size - 1
    out[IMPULSE], out[END], out[STEPS] = response.impulse[last], parting, last
    out[FINAL] = 1.0 - out[IMPULSE] / mass
    out[APART] = response.bent_rate[SAMPLES + 1] - out[FINAL]
    out[COMPRESSING] = mass if out[FINAL] <= 0.0 else np.nan
    out[STRUCK] = energy_of_spring(stiffness, carried, response.bent[last], response.bent_rate[last])
    out[DISSIPATED] = 0.5 * response.impulse[0]  # as two bodies become one
    out[PEAK], out[AT_ONCE], out[ROOT] = 0.0, response.impulse[0], 0.0
    for k in range(SAMPLES + 1):
        drawn.force_time[k], drawn.force[k] = response.time[k], response.force[k]
        out[PEAK] = max(out[PEAK], response.force[k])
        out[ROOT] = max(out[ROOT], stiffness * response.bent[k])
    for k in range(2):
        drawn.force_time[SAMPLES + 1 + k], drawn.force[SAMPLES + 1 + k] = (parting, duration)[k], 0.0
    for k in range(drawn.impactor.size):
        t = instant(k, drawn.impactor.size, duration)
        drawn.impactor[k] = between(response.time, response.position, t)
        drawn.end[k] = between(response.time, response.bent, t)
    _fields(stiffness, duration, response, drawn)
    return SOLVED
