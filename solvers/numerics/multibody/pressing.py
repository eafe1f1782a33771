"""A contact law between a point mass and links while they move: steps that keep the account of energy to rounding.

Each step moves everything freely for half of it, lets the contact act at once, and moves everything freely for the
other half. Within it the force is constant, the mean of the law along the way from indentation to indentation, and the
way is the step times the mean rate of approach before and after: so the work of the force is what the law stores and
loses. Free motion is of sixth order, so that nothing else is lost; joints stay closed in positions and rates, as the
impulse acts within them.
Error: second order in the step. Higher ones would need steps back in time, on which a lossy law gains energy.
"""

from typing import NamedTuple

import numpy as np

from ...jit.kernels import inner_kernel
from .flight import GIVING, INDENTATION, LOST, advance, copy_state, feel, overlap, push, write

END, LOSS, OPENING, UNLOADING = range(4)  # in what a law remembers, see `numerics.law_functions`
CLOSE = 1e-15  # of the deepest indentation, by which faces that part may be off where they open
MAX_SEARCHES = 60  # of the instant at which they do; six do
# Of a step: that soon faces part that are open as soon as what gives way besides swings back. They part with the step.
SHORTEST = 1e-3


class Surface(NamedTuple):
    """A contact law by its constants (CONSTANTS,), what it remembers (MEMORY,), largest indentation (1,) [m], and the
    length of a step [s]; without a length there is no law, and impacts are impulses. A step may be `growth` times as
    long as the contact has lasted if that is more, up to `longest` [s]: what lasts hardly changes any more.

    In series with the law stands a spring of a `compliance` [m/N], of the modes left out. Of what the mean force of a
    step is above the spring's at its start the spring gets `weight` more: 2, and nothing is lost; with less it settles.
    In the first two steps of a contact it gets 1 where the law `jumps` as they meet.
    """

    constants: np.ndarray
    memory: np.ndarray
    deepest: np.ndarray
    step: float
    growth: float
    longest: float
    compliance: float
    weight: float
    jumps: bool


@inner_kernel
def _pressed(linkage, w, contact, law, surface, stages, state, time, step, weight, expected):
    """One step in place. Returns the force and by how much the mass is then in the link [m]."""
    memory, gives, half, found = surface.memory, surface.compliance, 0.5 * step, state.contact
    advance(linkage, w, contact, stages, state, time, half)
    closing, mobility, nx, ny = feel(linkage, w, contact, state, time + half)
    free = found[INDENTATION] + step * closing + gives * weight * found[GIVING]
    compliance = half * step * mobility + gives * weight
    start, deepest = found[INDENTATION], surface.deepest[0]
    force = law(surface.constants, start, free, compliance, 1.0 / step, expected, deepest, memory)
    push(w, contact, state, step * force, nx, ny)
    beyond = force - found[GIVING]
    found[INDENTATION] = memory[END]
    found[LOST] += memory[LOSS] + gives * (1.0 - 0.5 * weight) * weight * beyond**2
    found[GIVING] += weight * beyond
    depth, _, _ = advance(linkage, w, contact, stages, state, time + half, half)
    return force, depth


@inner_kernel
def _until_parting(linkage, w, contact, law, surface, stages, state, later, time, longest, weight, expected):
    """A step of `later` from `state`, as long as it takes until the faces open, which is no longer than `longest` [s],
    or that long if they do so at once. Returns its length, and by how much the mass is then in the link."""
    memory = surface.memory
    opening, unloading = memory[OPENING], memory[UNLOADING]
    low, high, length, depth = 0.0, longest, longest, 0.0
    above, below, side = state.contact[INDENTATION] - opening, later.contact[INDENTATION] - opening, 0
    for _ in range(MAX_SEARCHES):  # false position, with half of what is stuck
        length = high - (high - low) * below / (below - above)
        if not low < length < high:
            length = 0.5 * (low + high)
        memory[OPENING], memory[UNLOADING] = opening, unloading
        copy_state(later, state)
        _, depth = _pressed(linkage, w, contact, law, surface, stages, later, time, length, weight, expected)
        missed = later.contact[INDENTATION] - opening
        if abs(missed) <= CLOSE * surface.deepest[0] or high - low <= 2e-16 * (time + longest):
            break
        if missed > 0.0:
            below *= 0.5 if side > 0 else 1.0
            low, above, side = length, missed, 1
        elif length < SHORTEST * longest:
            memory[OPENING], memory[UNLOADING] = opening, unloading
            copy_state(later, state)
            _, depth = _pressed(linkage, w, contact, law, surface, stages, later, time, longest, weight, expected)
            return longest, depth
        else:
            above *= 0.5 if side < 0 else 1.0
            high, below, side = length, missed, -1
    later.contact[INDENTATION] = opening
    return length, depth


@inner_kernel
def press(linkage, w, contact, law, surface, stages, state, later, kept, row, time, until):
    """From where the faces meet until they part, or until a time [s], or `kept` is full, which gets a row first and
    after every step. Returns the time, the next row, and how deep the mass is in the link where they meet again [m]."""
    memory, begun, force, before, count = surface.memory, time, 0.0, 0.0, 0
    state.contact[INDENTATION] = memory[OPENING]
    depth, _, _ = overlap(linkage, w, contact, state)
    apart = depth - memory[OPENING]  # of the ways of both and of the indentation, by the error of the steps
    write(kept, row, time, state)
    row += 1
    while time < until and row < kept.time.size:
        length, left = min(max(surface.step, surface.growth * (time - begun)), surface.longest), until - time
        length = left if left < (1.0 + SHORTEST) * length else length
        start, expected = state.contact[INDENTATION], 2.0 * force - before
        opening, unloading, before = memory[OPENING], memory[UNLOADING], force
        weight = 1.0 if surface.jumps and count < 2 else surface.weight
        copy_state(later, state)
        force, depth = _pressed(linkage, w, contact, law, surface, stages, later, time, length, weight, expected)
        if start > opening and memory[END] < memory[OPENING]:
            memory[OPENING], memory[UNLOADING] = opening, unloading
            length, depth = _until_parting(
                linkage, w, contact, law, surface, stages, state, later, time, length, weight, expected
            )
        copy_state(state, later)
        time, count, found = until if length == left else time + length, count + 1, state.contact
        surface.deepest[0] = max(surface.deepest[0], found[INDENTATION])
        apart = depth - found[INDENTATION] - surface.compliance * found[GIVING]
        parted = found[INDENTATION] <= memory[OPENING]
        if parted:
            found[LOST] += 0.5 * surface.compliance * found[GIVING] ** 2
            found[GIVING] = 0.0
        write(kept, row, time, state)
        row += 1
        if parted:
            break
    return time, row, apart + memory[OPENING]
