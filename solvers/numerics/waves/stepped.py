"""St. Venant's problem on a grid of times: some nanoseconds a step, for sweeps and sliders.

Error: second order in velocities and event times; first order in the field, where a later contact starts within a step.

Units and the delay equation are those of `rigid`. The grid divides the round trip, so that every return of the
first front falls on it and is kept as a jump; events between grid times are located on straight lines.
"""

import numpy as np

from ...jit.kernels import allocating_kernel, inner_kernel


@inner_kernel
def _pressed(v, arriving0, arriving1, decay, shares, change):
    """A step in touch: velocity of the mass at its end or as the pressure ends, part of the step, peak stress.

    shares: of the wave at the beginning and at the end of the step; change: 2 beta h.
    """
    pressure0, v0, part = v + 2.0 * arriving0, v, 1.0
    v = decay * v - 2.0 * (shares[0] * arriving0 + shares[1] * arriving1)
    pressure1 = v + 2.0 * arriving1
    if pressure1 < 0.0:
        part = pressure0 / (pressure0 - pressure1)
        v = v0 + part * (v - v0) - 0.5 * change * part * (1.0 - part) * pressure0
    return v, part, max(pressure0, pressure1)


@inner_kernel
def _end(contact, t, v, end_velocity):
    """Write the end of a contact."""
    contact[1], contact[3], contact[6] = t, v, end_velocity


@allocating_kernel
def strike(beta, reflection, per_trip, limit, forever, max_contacts):
    """Step until the bodies part for good or, if `forever`, to the last of `limit` steps of 1 / per_trip.

    Returns steps done; (steps + 1,) wave before and after each time, position and velocity of the mass; contacts as in
    `rigid.strike`; whether they parted for good.
    """
    h = 1.0 / per_trip
    change = 2.0 * beta * h
    decay = np.exp(-change)
    late = 1.0 + np.expm1(-change) / change
    shares = (1.0 - decay - late, late)
    before, after = np.zeros(limit + 1), np.zeros(limit + 1)
    position, velocity = np.zeros(limit + 1), np.zeros(limit + 1)
    contacts = np.zeros((max_contacts, 7))
    count, touching, v, gap = 1, True, 1.0, 0.0
    contacts[0, 2] = velocity[0] = after[0] = 1.0
    wait = 2 * per_trip if reflection > 0.0 else per_trip
    steps, since, parted = 0, 0, False
    for k in range(limit):
        arriving0 = reflection * after[k - per_trip] if k >= per_trip else 0.0
        arriving1 = reflection * before[k + 1 - per_trip] if k + 1 >= per_trip else 0.0
        v0, steps = v, k + 1
        if touching:
            v, part, peak = _pressed(v, arriving0, arriving1, decay, shares, change)
            contacts[count - 1, 4] = max(contacts[count - 1, 4], peak)
            if part < 1.0:  # the pressure is used up: they part
                touching, since = False, 0
                turn = arriving0 + part * (arriving1 - arriving0)
                gap = (1.0 - part) * h * (v + turn + arriving1)
                _end(contacts[count - 1], (k + part) * h, v, -2.0 * turn)
        else:
            closing = h * (v + arriving0 + arriving1)
            since += 1
            if gap + closing > 0.0 and count < max_contacts:
                part = -gap / closing if closing > 0.0 else 1.0
                middle = arriving0 + 0.5 * (1.0 + part) * (arriving1 - arriving0)  # of the rest of the step
                v -= change * (1.0 - part) * (v + 2.0 * middle)
                contacts[count, 0], contacts[count, 2] = (k + part) * h, v0
                touching, gap = True, 0.0
                count += 1
            else:
                gap += closing
        position[steps], velocity[steps] = position[k] + 0.5 * h * (v0 + v), v
        before[steps] = v + arriving1 if touching else -arriving1
        arriving = reflection * after[steps - per_trip] if steps >= per_trip else arriving1
        if touching and v + 2.0 * arriving < 0.0:  # a front that returns as tension parts them at once
            touching, since, gap = False, 0, 0.0
            _end(contacts[count - 1], steps * h, v, -2.0 * arriving)
        after[steps] = v + arriving if touching else -arriving
        drift = -v if reflection > 0.0 else (1.0 - v) / beta - v
        if not touching and since >= wait and drift > 0.0:
            parted = True
            if not forever:
                break
    if touching:
        _end(contacts[count - 1], steps * h, v, v)
    n = steps + 1
    return before[:n], after[:n], position[:n], velocity[:n], contacts[:count], parted
