"""St. Venant's problem on a grid of times: some nanoseconds a step, for sweeps and sliders.

Error: second order in velocities and event times; first order in the field, where a later contact starts within a step.

Units and the delay equation are those of `rigid`. The grid divides the round trip, so that every return of the
first front falls on it and is kept as a jump; events between grid times are located on straight lines.
"""

import numpy as np

from ...jit.kernels import allocating_kernel


@allocating_kernel
def strike(beta, reflection, per_trip, limit, forever, max_contacts):
    """Step until the bodies part for good or, if `forever`, to the last of `limit` steps of 1 / per_trip.

    Returns steps done; (steps + 1,) wave before and after each time, position and velocity of the mass; contacts as in
    `rigid.strike`; whether they parted for good.
    """
    h = 1.0 / per_trip
    kappa = 2.0 * beta
    decay = np.exp(-kappa * h)
    late = 1.0 + np.expm1(-kappa * h) / (kappa * h)
    early = 1.0 - decay - late
    before, after = np.zeros(limit + 1), np.zeros(limit + 1)
    position, velocity = np.zeros(limit + 1), np.zeros(limit + 1)
    contacts = np.zeros((max_contacts, 7))
    count, touching, v, x, gap = 1, True, 1.0, 0.0, 0.0
    contacts[0, 2] = 1.0
    velocity[0], after[0] = 1.0, 1.0
    wait = 2 * per_trip if reflection > 0.0 else per_trip
    steps, since, parted = 0, 0, False
    for k in range(limit):
        arriving0 = reflection * after[k - per_trip] if k >= per_trip else 0.0
        arriving1 = reflection * before[k + 1 - per_trip] if k + 1 >= per_trip else 0.0
        v0, part = v, 0.0  # part of the step before an event
        if touching:
            pressure0 = v + 2.0 * arriving0
            v = decay * v - 2.0 * (early * arriving0 + late * arriving1)
            pressure1 = v + 2.0 * arriving1
            contacts[count - 1, 4] = max(contacts[count - 1, 4], pressure0, pressure1)
            part = 1.0
            if pressure1 < 0.0:
                part = pressure0 / (pressure0 - pressure1)
                v = v0 + part * (v - v0) - 0.5 * kappa * h * part * (1.0 - part) * pressure0
            if part < 1.0:  # the pressure is used up: they part
                touching, since = False, 0
                turn = arriving0 + part * (arriving1 - arriving0)
                gap = (1.0 - part) * h * (v + turn + arriving1)
                contacts[count - 1, 1], contacts[count - 1, 3] = (k + part) * h, v
                contacts[count - 1, 6] = -2.0 * turn
        else:
            closing = h * (v + arriving0 + arriving1)
            since += 1
            if gap + closing > 0.0 and count < max_contacts:
                part = -gap / closing if closing > 0.0 else 1.0
                rest = (1.0 - part) * h
                v -= kappa * rest * (v + 2.0 * (arriving0 + 0.5 * (1.0 + part) * (arriving1 - arriving0)))
                contacts[count, 0], contacts[count, 2] = (k + part) * h, v0
                touching, gap = True, 0.0
                count += 1
            else:
                gap += closing
        steps = k + 1
        x += 0.5 * h * (v0 + v)
        position[steps], velocity[steps] = x, v
        before[steps] = v + arriving1 if touching else -arriving1
        arriving = arriving1
        if steps >= per_trip:
            arriving = reflection * after[steps - per_trip]
        if touching and v + 2.0 * arriving < 0.0:  # a front that returns as tension parts them at once
            touching, since, gap = False, 0, 0.0
            contacts[count - 1, 1], contacts[count - 1, 3] = steps * h, v
            contacts[count - 1, 6] = -2.0 * arriving
        after[steps] = v + arriving if touching else -arriving
        drift = -v if reflection > 0.0 else (1.0 - v) / beta - v
        if not touching and since >= wait and drift > 0.0:
            parted = True
            if not forever:
                break
    if touching:
        contacts[count - 1, 1], contacts[count - 1, 3], contacts[count - 1, 6] = steps * h, v, v
    n = steps + 1
    return before[:n], after[:n], position[:n], velocity[:n], contacts[:count], parted
