"""How many steps a march of modes takes: in plain Python and in kernels alike."""

import math

from numba.extending import register_jitable

# Of the highest mode kept. Its motion is exact at any step: with fewer the contact force is, within a step, of a lower
# order; `tests/solvers/methods/test_orders.py`.
STEPS_PER_PERIOD = 20
STEPS_PER_CONTACT = 200  # of the shortest contact there can be; with fewer its peak and its loss are off
# Unless more are asked for; what a step costs is measured by `python -m bench --only kernels`. Fewer, and long impacts
# are solved more coarsely, at which the energy is kept all the same.
MAX_USUAL_STEPS = 60_000
# Times as many where a beam is struck: a contact there may be over long before the beam has swung once.
BEAM_STEPS_FACTOR = 8
LEAST_STEPS = 10  # of a given time
STEPS_OF_TOUCH, LEAST_DRAWN, MOST_DRAWN = 500.0, 1_000.0, 10_000.0  # of the time in which they touch; of all


@register_jitable
def usual_step(law, residual, reduced, speed, longest, trips, felt, give, highest, bends):
    """Fine enough for the highest mode and for the shortest contact; never a longer run than is worth it [s].

    residual: compliance of the modes left out; reduced: mass of both as far as they move at once as wholes; felt: as
    rigid bodies; longest: the slowest period; trips: those of both bodies together; give: static compliance of what
    bends; highest: angular frequency that is kept, 0 if none is; bends: whether a beam is struck.
    """
    depth, stiffness = speed * longest, 0.0  # the law's secant stiffness at the depth of a free collision
    for _ in range(60):
        stiffness = 2.0 * law.mean(0.0, depth, 0.0, 0.0)[0] / depth
        before, depth = depth, 0.5 * (depth + speed * math.sqrt(reduced / stiffness))
        if abs(depth - before) <= 1e-6 * depth:
            break
    fine = math.pi * math.sqrt(reduced * (1.0 / stiffness + residual)) / STEPS_PER_CONTACT
    if highest > 0.0:
        fine = min(fine, 2.0 * math.pi / highest / STEPS_PER_PERIOD)
    usual = (trips + math.pi * math.sqrt(felt * (1.0 / stiffness + give))) / MAX_USUAL_STEPS
    if bends:  # few modes, many contacts, each of which starts and ends in a step
        return max(min(fine, usual), usual / BEAM_STEPS_FACTOR)
    return max(fine, usual)


@register_jitable
def steps_drawn(period, touching, duration):
    """In how many steps modes are marched for a picture: shortest kept period, time until the last parting, and all."""
    steps = max(STEPS_PER_PERIOD * duration / period, STEPS_OF_TOUCH * duration / touching, LEAST_DRAWN)
    return int(min(steps, MOST_DRAWN) + 1e-6)  # as many whatever rounding makes of it
