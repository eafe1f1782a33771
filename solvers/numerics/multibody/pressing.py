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
    length of a step [s]. A step may be `growth` times as long as the contact has lasted if that is more, up to
    `longest` [s]: what lasts hardly changes any more.

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
def _step(linkage, w, contact, law, surface, stages, state, later, time, whole, weight, expected):
    """A step of `later` from `state`: the `whole` of it [s], or as long as it takes until the faces open, or the whole
    if they do so at once. Returns its length, the force, and by how much the mass is then in the link."""
    memory, start = surface.memory, state.contact[INDENTATION]
    opening, unloading = memory[OPENING], memory[UNLOADING]
    low, high, above, below, side, tries, length = 0.0, whole, start - opening, 0.0, 0, 0, whole
    while True:  # false position, with half of what is stuck
        tries, memory[OPENING], memory[UNLOADING] = tries + 1, opening, unloading
        copy_state(later, state)
        force, depth = _pressed(linkage, w, contact, law, surface, stages, later, time, length, weight, expected)
        missed = later.contact[INDENTATION] - memory[OPENING]
        if start <= opening or (tries == 1 and missed >= 0.0) or tries > MAX_SEARCHES:
            return length, force, depth
        if abs(missed) <= CLOSE * surface.deepest[0] or high - low <= 2e-16 * (time + whole):
            later.contact[INDENTATION] = opening
            return length, force, depth
        if missed < 0.0 and length < SHORTEST * whole:
            length, tries = whole, MAX_SEARCHES
            continue
        if missed > 0.0:
            below *= 0.5 if side > 0 else 1.0
            low, above, side = length, missed, 1
        else:
            above *= 0.5 if side < 0 else 1.0
            high, below, side = length, missed, -1 if tries > 1 else 0
        length = high - (high - low) * below / (below - above)
        if not low < length < high:
            length = 0.5 * (low + high)


@inner_kernel
def press(linkage, w, contact, law, surface, stages, state, later, kept, row, time, until):
    """From where the faces meet until they part, or until a time [s], or `kept` is full, which gets a row first and
    after every step. Returns the time, the next row, and how deep the mass is in the link where they meet again [m]."""
    memory, found, begun, force, before, count = surface.memory, state.contact, time, 0.0, 0.0, 0
    found[INDENTATION] = memory[OPENING]
    depth, _, _ = overlap(linkage, w, contact, state)
    apart = depth - memory[OPENING]  # of the ways of both and of the indentation, by the error of the steps
    write(kept, row, time, state)
    row += 1
    while time < until and row < kept.time.size:
        whole, left = min(max(surface.step, surface.growth * (time - begun)), surface.longest), until - time
        whole = left if left < (1.0 + SHORTEST) * whole else whole
        expected, before = 2.0 * force - before, force
        weight = 1.0 if surface.jumps and count < 2 else surface.weight
        length, force, depth = _step(
            linkage, w, contact, law, surface, stages, state, later, time, whole, weight, expected
        )
        copy_state(state, later)
        time, count = until if length == left else time + length, count + 1
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
