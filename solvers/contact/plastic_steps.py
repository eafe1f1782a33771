"""What a plastic law whose way back is Hertz's from a dent does over one step of the modal kernel."""

import math

from ..jit.kernels import inlined_kernel, inner_kernel
from .discrete_gradient import hertz_spring_step, step_force


@inner_kernel
def force_from(indentation, memory):
    """On the way back with this memory: dent and stiffness; 0.4 of it by the way from the dent is stored."""
    depth = indentation - memory[0]
    return memory[1] * depth * math.sqrt(depth)


@inlined_kernel
def plastic_step(law, start, free, compliance, rate, expected, deepest, memory):
    """`step_force` of a law that unloads along Hertz's curve from a dent: its `unloading` is that dent and stiffness.

    It is steeper than the virgin curve, which a step follows from `deepest` on if it goes beyond.
    """
    dent, stiffness = memory
    if start <= dent and free <= dent:
        return 0.0, free, 0.0, memory
    top = max(deepest, law.yield_indentation)
    if start >= top and free - compliance * law.force(start, 0.0, deepest) > start:
        return flow_step(law, start, free, compliance, rate, expected, deepest, memory)
    force, end = hertz_spring_step(stiffness, start - dent, free - dent, compliance, expected)
    if end + dent <= top or start >= top:
        return force, end + dent, 0.0, memory
    return step_force(law, start, free, compliance, rate, expected, deepest, memory)


@inlined_kernel
def flow_step(law, start, free, compliance, rate, expected, deepest, memory):
    """`plastic_step` that begins and stays on the virgin curve beyond yield, whose slope hardly changes within it."""
    end = max(free - compliance * expected, start)
    slope = 1.0 + 0.5 * compliance * law.slopes(end, 0.0, 0.0)[0]
    for _ in range(12):
        force = law.loading_mean(start, end)
        miss = free - compliance * force - end
        end = max(end + miss / slope, start)
        if abs(miss) <= 4e-16 * (abs(free) + compliance * force):
            stored, then = 0.4 * force_from(start, memory) * (start - memory[0]), law.unloading(end)
            return force, end, force * (end - start) - (0.4 * force_from(end, then) * (end - then[0]) - stored), then
    return step_force(law, start, free, compliance, rate, expected, deepest, memory)
