"""Waves in a chain of rods on a grid of times: every step costs the same, however many echoes there are.

Nodes and rods are those of `network`; the transit time of every rod is a whole number of steps. What is kept of a
step is its mean: of the waves sent, and of the force. A wave arrives as it was sent, so that fronts stay sharp, and
what a node does to means conserves momentum and energy to rounding: a mass moves by the midpoint rule, a contact law
answers with the mean force whose work is what it takes up. Only where rigid faces meet within a step is energy lost, as
the mean of a force that sets in within it holds less than the force.

Error: second order in the step, of velocities and impulses; first order, of the energy that such fronts hold.
"""

from ...jit.kernels import inner_kernel, kernel
from .parts import ABSORBING, BONDED, LAW, PRESSED, RIGID_FACES, mobility

FAINT_FRONT = 1e-3  # of a front: less of it in a step is rather a bend


@inner_kernel
def _free_closing(chain, node, from_left, from_right, speed, middle):
    """Mean closing speed of the faces in a step about `middle`, if they did not press on each other."""
    left = right = 0.0
    if node > 0:
        left = chain.drift[node - 1] + 2.0 * from_left / chain.impedance[node - 1]
    elif chain.mass_left[node] > 0.0:
        left = speed
    if node < chain.kind.size - 1:
        right = chain.drift[node] - 2.0 * from_right / chain.impedance[node]
    elif chain.mass_right[node] > 0.0:
        right = speed
    return left - right + (chain.fall * middle if node == chain.contact else 0.0)


@inner_kernel
def _arriving(lags, left, right, node, n):
    """Means of the waves that arrive at a node in step n."""
    from_left = from_right = 0.0
    if node > 0 and n >= lags[node - 1]:
        from_left = right[node - 1, n - lags[node - 1]]
    if node < lags.size and n >= lags[node]:
        from_right = left[node + 1, n - lags[node]]
    return from_left, from_right


@inner_kernel
def _parting_front(chain, lags, step, left, right, force, node, n, speed, give, mean):
    """Mean force of rigid faces that a front of tension parts within step n, known by the steps before and after it.

    `mean`: of the force that would hold them together: part of the step the force of the step before, then that of the
    step after, which pulls. Where no front comes, the mean itself if it pushes.
    """
    plain = max(mean, 0.0)
    near = lags.size == 0 or (node > 0 and lags[node - 1] < 2) or (node < lags.size and lags[node] < 2)
    if near or n < 2 or n + 1 >= force.shape[1]:
        return plain
    from_left, from_right = _arriving(lags, left, right, node, n + 1)
    after = _free_closing(chain, node, from_left, from_right, speed, step * (n + 1.5)) / give
    before, bend = force[node, n - 1], force[node, n - 1] - force[node, n - 2]
    pressed = before + bend  # as it would go on
    drop = pressed - after
    if not (after < 0.0 and after < mean < pressed - FAINT_FRONT * drop) or abs(bend) > 0.1 * drop:
        return plain
    return pressed * (mean - after) / drop


@kernel
def march(
    chain, lags, step, first, last, contact, joint, constants, pulse, speed, deepest, memory, left, right, force, depth,
    lost,
):  # fmt: skip
    """Follow every node from step `first` to step `last`.

    lags (rods,): transit times in steps; contact, joint: laws, see `law_functions.step_function`, with constants
    (nodes, CONSTANTS); pulse (steps,): mean force on a PRESSED node; speed (nodes,), deepest (nodes,), memory (nodes,
    MEMORY): as they are, of the mass beside a node and of its law. Written: left, right, force (nodes, steps): means of
    the waves sent and of the force; depth, lost (nodes, steps + 1): indentation, and energy lost by the law, at the
    ends of the steps.
    """
    nodes = chain.kind.size
    for n in range(first, last):
        for node in range(nodes):
            from_left, from_right = _arriving(lags, left, right, node, n)
            kind, start = chain.kind[node], depth[node, n]
            rods, masses = mobility(chain, node)
            give = rods + 0.5 * step * masses
            closing = _free_closing(chain, node, from_left, from_right, speed[node], step * (n + 0.5))
            end, push, gone = start + step * closing, 0.0, 0.0
            if kind == ABSORBING:
                push = from_left
            elif kind == PRESSED:
                push = pulse[n]
            elif kind == BONDED:
                push, end = closing / give, start
            elif kind == RIGID_FACES:
                push = max(end, 0.0) / (step * give)
                if start == 0.0:
                    known = chain, lags, step, left, right, force
                    push = _parting_front(*known, node, n, speed[node], give, closing / give)
                held = step * give * push
                end = end - held if end < held * (1.0 - 1e-12) else 0.0
            elif kind == LAW:
                law = contact if node == chain.contact else joint
                before = force[node, n - 1] if n > 0 else 0.0
                push = law(constants[node], start, end, step * give, 1.0 / step, before, deepest[node], memory[node])
                end, gone = memory[node, 0], memory[node, 1]
                deepest[node] = max(deepest[node], end)
            left[node, n], right[node, n], force[node, n] = push - from_left, push - from_right, push
            depth[node, n + 1], lost[node, n + 1] = end, lost[node, n] + gone
            if chain.mass_left[node] > 0.0:
                speed[node] -= step * push / chain.mass_left[node]
            elif chain.mass_right[node] > 0.0:
                speed[node] += step * push / chain.mass_right[node]
