"""What a contact law does over one step of the modal kernel: means along a straight path, and the force of the step."""

import math

from ..jit.kernels import inlined_kernel, kernel


@kernel
def hertz_mean(start, end):
    """Mean of max(a, 0)^(3/2) over [start, end], without the differences that cancel."""
    if start > end:
        start, end = end, start
    if end <= 0.0:
        return 0.0
    if start <= 0.0:
        return 0.4 * end * end * math.sqrt(end) / (end - start)
    root0, root1 = math.sqrt(start), math.sqrt(end)
    cross, square = root0 * root1, start + end
    return 0.4 * (square * (square + cross) - cross * cross) / (root0 + root1)


@kernel
def linear_mean(start, end):
    """Mean of max(a, 0) over [start, end]."""
    if start > end:
        start, end = end, start
    if start >= 0.0:
        return 0.5 * (start + end)
    return 0.5 * end * end / (end - start) if end > 0.0 else 0.0


@kernel
def power_mean(start, end, exponent):
    """Mean of max(a, 0)^exponent over [start, end], to rounding however close they are."""
    if exponent == 1.5:
        return hertz_mean(start, end)
    if start > end:
        start, end = end, start
    if end <= 0.0:
        return 0.0
    whole, relative = exponent + 1.0, (end - start) / end
    if relative >= 1.0:
        return end**exponent / (whole * relative)
    if relative < 1e-2:  # about the middle, to the sixth power of the relative width
        middle = 0.5 * (start + end)
        square, bend = ((end - start) / middle) ** 2, exponent * (exponent - 1.0)
        farther = (exponent - 2.0) * (exponent - 3.0) / 80.0 * square
        return middle**exponent * (1.0 + bend / 24.0 * square * (1.0 + farther))
    return end**exponent * (-math.expm1(whole * math.log1p(-relative)) / (whole * relative))


def no_memory(self, deepest):
    """As a method: of a law whose way back is its way in, and which opens at 0."""
    return 0.0, 0.0


@kernel
def step_force(law, start, free, compliance, rate, expected, deepest, memory):
    """The constant force of one step whose work is exactly what the law takes up along the way.

    `start` is the indentation at the start (negative: the gap), `free` at the end if there were no force; a force F
    makes it free - compliance * F. `rate` is 1 / step, `expected` a guess of the force, `memory` what the law's
    `unloading` gives for `deepest`, the indentation at which it opens first. The law's mean force grows with the
    indentation at the end, so there is one solution; it is found to rounding. Returns the force, the indentation at the
    end, the energy lost, and the memory then.
    """
    opening = memory[0]
    if start <= opening and free <= opening:
        return 0.0, free, 0.0, memory
    high = free
    low = opening if start <= opening else min(start, free - compliance * law.force(start, 0.0, deepest))
    end = free - compliance * expected
    if not low < end < high:
        end = 0.5 * (low + high)
    force, lost, before, miss_before = 0.0, 0.0, end, 0.0
    close_enough = 2.0e-16 * (abs(free) + abs(start))
    for iteration in range(200):
        force, lost = law.mean(start, end, rate, deepest)
        miss = end - free + compliance * force
        if miss > 0.0:
            high = end
        else:
            low = end
        if abs(miss) <= close_enough or high - low <= 2.0e-16 * max(abs(high), abs(low)):
            break
        if iteration == 0:
            by_depth, by_rate = law.slopes(0.5 * (start + end), (end - start) * rate, deepest)
            following = end - miss / (1.0 + compliance * (0.5 * by_depth + by_rate * rate))
        else:
            difference = miss - miss_before
            following = end - miss * (end - before) / difference if difference != 0.0 else low
        if iteration % 5 == 4 or not low < following < high:
            following = 0.5 * (low + high)
        before, miss_before = end, miss
        if following == end:
            break
        end = following
    return force, end, lost, law.unloading(end) if end > deepest else memory


@inlined_kernel
def hertz_spring_step(stiffness, start, free, compliance, expected):
    """`step_force` of F = stiffness * a^(3/2), and the indentation at the end.

    While in contact the root of the end's indentation solves a quartic that is convex, so Newton needs no root, power
    or bound; where the bodies part the equation is quadratic.
    """
    if start <= 0.0 and free <= 0.0:
        return 0.0, free
    if start <= 0.0:
        force, end, _ = hertz_step_force(stiffness, 0.0, start, free, compliance, 0.0, expected)
        return force, end
    root0 = math.sqrt(start)
    pull = 0.4 * stiffness * compliance
    square0 = root0 * root0
    if free * start < pull * square0 * square0 * root0:  # leaves within the step
        spread = pull * square0 * square0 * root0
        half = 0.5 * (start - free)
        root = math.sqrt(half * half + spread)
        travel = half + root if half > 0.0 else spread / (root - half)
        force = 0.4 * stiffness * square0 * square0 * root0 / travel
        return force, min(free - compliance * force, 0.0)
    guess = free - compliance * expected
    r = math.sqrt(guess) if guess > 0.0 else root0
    for _ in range(60):
        # (a - free) (r0 + r) + pull (r^4 + r^3 r0 + r^2 r0^2 + r r0^3 + r0^4) with a = r^2
        a = r * r
        sums = (((r + root0) * r + square0) * r + square0 * root0) * r + square0 * square0
        rise = ((4.0 * r + 3.0 * root0) * r + 2.0 * square0) * r + square0 * root0
        bend = (6.0 * r + 3.0 * root0) * r + square0
        value = (a - free) * (root0 + r) + pull * sums
        slope = 2.0 * r * (root0 + r) + (a - free) + pull * rise
        if slope <= 0.0:
            r = math.sqrt(max(free, start))  # right of the root, from where every step comes closer
            continue
        inverse, divided = 1.0 / slope, 1.0 / (root0 + r)
        change = value * inverse
        if abs(change) <= 4e-6 * r:  # with the square of it (Chebyshev's step) the rest is below rounding
            change += change * change * inverse * (3.0 * r + root0 + pull * bend)
            sums += change * (change * bend - rise)
            shift = change * divided
            end = r - change
            return 0.4 * stiffness * sums * divided * (1.0 + shift + shift * shift), end * end
        r -= change
        if r <= 0.0:
            r = math.sqrt(max(free, start))
    force, end, _ = hertz_step_force(stiffness, 0.0, start, free, compliance, 0.0, expected)
    return force, end


@kernel
def hertz_step_force(stiffness, loss, start, free, compliance, rate, expected):
    """`step_force` of F = stiffness * a^(3/2) * (1 + loss * da/dt), in closed form where the bodies part."""
    if start <= 0.0 and free <= 0.0:
        return 0.0, free, 0.0
    root0 = math.sqrt(max(start, 0.0))
    stored = 0.4 * stiffness * root0**5
    if start > 0.0 and free * start < compliance * stored:  # leaves within the step, if damping lets it
        spread = compliance * stored
        half = 0.5 * (start - free - spread * loss * rate)
        root = math.sqrt(half * half + spread)
        travel = half + root if half > 0.0 else spread / (root - half)
        force = stored / travel * max(1.0 - loss * travel * rate, 0.0)
        end = free - compliance * force
        if end <= 0.0:
            return force, end, (stored + force * (end - start) if loss > 0.0 else 0.0)
    end = free - compliance * expected
    low, high = 0.0, free
    if not low < end < high:
        end = 0.5 * high
    before, miss_before, force, lost = end, 0.0, 0.0, 0.0
    close_enough = 2.0e-16 * (abs(free) + abs(start))
    for iteration in range(200):
        elastic = stiffness * hertz_mean(start, end)
        factor = max(1.0 + loss * (end - start) * rate, 0.0)
        force = elastic * factor
        lost = (force - elastic) * (end - start)
        miss = end - free + compliance * force
        if miss > 0.0:
            high = end
        else:
            low = end
        if abs(miss) <= close_enough or high - low <= 2.0e-16 * high:
            break
        slope = 1.5 * stiffness * math.sqrt(end)
        following = end - miss / (1.0 + compliance * (0.5 * slope * factor + elastic * loss * rate))
        if iteration > 3:  # the tangent is only nearly right; when that is not enough, the secant and halving are
            difference = miss - miss_before
            following = end - miss * (end - before) / difference if difference != 0.0 else low
            if iteration % 4 == 0:
                following = 0.5 * (low + high)
        if not low < following < high:
            following = 0.5 * (low + high)
        before, miss_before = end, miss
        if following == end:
            break
        end = following
    return force, end, lost
