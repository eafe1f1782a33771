"""Waves in a rod struck through a contact law: a delay equation, integrated to high order between located events.

Units: time in round trips T, velocity in the impact speed v, force in Z v, displacement in v T. The struck end sends
the force wave f(t) into the rod and receives r f(t - 1); it moves at f(t) - r f(t - 1), so that the indentation a obeys

    a' = v1 - F + 2 r f(t - 1),    v1' = -2 beta F,    f = F - r f(t - 1),    F = law(a, a')

Segments between events, and between the returns of events, are smooth: a collocation polynomial each.
"""

import numpy as np

from ..jit import kernel
from .collocation import (
    BACK_TO_START,
    INTEGRATE,
    INTEGRATE_TWICE,
    NODES,
    STAGE_NODES,
    STAGES,
    interpolate,
    solve_in_place,
)

PARTED, STOPPED, FULL, FAILED = 0, 1, 2, 3
FOREVER = 20_000.0  # asked for that long, a blow is followed only until the bodies part for good
LONG_STEP, SHORT_STEP = 1e-2, 1e-7


@kernel
def _solve_step(law, beta, h, indentation, velocity, incoming, guess, force, depth, speed, rate, matrix, right):
    """One step in contact: fills force, depth, speed, rate (STAGES,). incoming (STAGES + 1,) from the start on."""
    for i in range(STAGES):
        force[i] = guess[i]
    settled, before = False, np.inf
    for _ in range(40):
        for i in range(STAGES):
            a = indentation + h * STAGE_NODES[i] * velocity
            w = velocity + 2.0 * incoming[i + 1] - force[i]
            u = velocity
            for j in range(STAGES):
                a += h * INTEGRATE[i, j] * (2.0 * incoming[j + 1] - force[j])
                a -= 2.0 * beta * h * h * INTEGRATE_TWICE[i, j] * force[j]
                u -= 2.0 * beta * h * INTEGRATE[i, j] * force[j]
            depth[i], speed[i], rate[i] = a, u, w + u - velocity
        if settled:
            return True
        for i in range(STAGES):
            by_depth, by_rate = law.slopes(depth[i], rate[i], 0.0)
            right[i] = law.force(depth[i], rate[i], 0.0) - force[i]
            for j in range(STAGES):
                drop = h * INTEGRATE[i, j] + 2.0 * beta * h * h * INTEGRATE_TWICE[i, j]
                matrix[i, j] = by_depth * drop + by_rate * 2.0 * beta * h * INTEGRATE[i, j]
            matrix[i, i] += 1.0 + by_rate
        if not solve_in_place(matrix, right, STAGES):
            return False
        largest, change = 0.0, 0.0
        for i in range(STAGES):
            force[i] += right[i]
            largest = max(largest, abs(force[i]))
            change = max(change, abs(right[i]))
        if not change < np.inf:
            return False
        # rounding in a' is magnified by strong damping: then the corrections stop falling before they vanish
        settled = change <= 1e-14 * largest + 1e-300 or (change <= 1e-9 * largest + 1e-12 and change > 0.25 * before)
        before = change
    return False


@kernel
def strike(law, beta, reflection, until, tolerance, capacity, max_contacts):
    """The blow of a mass at unit speed through a (scaled) contact law, up to `until` or until the bodies part for good.

    Returns status, number of segments; start (segments + 1,), then (segments, STAGES + 1) at NODES: wave f sent, its
    integral, indentation, velocity of the mass, and whether in contact (segments,); number of contacts and, for each,
    (start, end, velocity of the mass before and after, peak force, position of the mass at the end, velocity of the
    struck end at the end); energy lost to the law so far (segments, STAGES + 1), in Z v^2 T.
    """
    m = STAGES + 1
    start, lost, losses = np.empty(capacity + 1), np.zeros((capacity, m)), 0.0
    wave, total = np.zeros((capacity, m)), np.zeros((capacity, m))
    depths, speeds = np.zeros((capacity, m)), np.zeros((capacity, m))
    in_contact = np.zeros(capacity, np.bool_)
    contacts = np.zeros((max_contacts, 7))
    breaks = np.empty(capacity)
    next_break, break_count = 0, 0
    incoming, guess = np.zeros(m), np.zeros(STAGES)
    force, depth, speed, rate = np.zeros(STAGES), np.zeros(STAGES), np.zeros(STAGES), np.zeros(STAGES)
    matrix, right = np.zeros((STAGES, STAGES)), np.zeros(STAGES)
    t, a, v1, force_now, largest, sent = 0.0, 0.0, 1.0, 0.0, 0.0, 0.0
    touching, n, j, count, presses, pressed = True, 0, 0, 1, True, 0.0
    h, status, failures, parting = 1e-3, FULL, 0, 0.0
    period = 2.0 if reflection > 0.0 else 1.0
    contacts[0, 2] = 1.0
    lossy = law.force(1.0, 1.0, 0.0) != law.force(1.0, 0.0, 0.0)
    start[0] = 0.0
    breaks[0], break_count = 1.0, 1  # the first return; every event adds its own
    while n < capacity - 1 and break_count < capacity - 1 and count < max_contacts:
        if t >= until:
            status = STOPPED
            break
        limit = min(until, breaks[next_break] if next_break < break_count else t + 1.0)
        tiny = 2e-15 * max(t, 1.0)  # two times that only rounding tells apart
        if t >= 1.0:
            while j < n - 1 and start[j + 1] <= t - 1.0 + tiny:
                j += 1
        if not touching and t >= 1.0:  # one arriving segment at a time: an exact copy
            limit = min(limit, max(start[j + 1] + 1.0, t))
        span = limit - t
        if next_break < break_count and breaks[next_break] - t <= tiny:  # a break: it will return once more
            breaks[break_count] = breaks[next_break] + 1.0
            next_break += 1
            break_count += 1
            continue
        step = min(h, span) if touching else span
        if touching and step > 0.5 * span:
            step = span if step > 0.9 * span else 0.5 * span
        seek, event = j, False
        located = False
        for attempt in range(60):
            seek = j
            for i in range(m):
                incoming[i] = 0.0
                back = t + step * NODES[i] - 1.0
                if t >= 1.0:
                    while seek < n - 1 and start[seek + 1] < back:
                        seek += 1
                    place = (back - start[seek]) / (start[seek + 1] - start[seek])
                    incoming[i] = reflection * interpolate(wave[seek], min(max(place, 0.0), 1.0))
            if not touching:
                break
            for i in range(STAGES):
                guess[i] = force[i] if attempt > 0 and located else force_now
            good = _solve_step(law, beta, step, a, v1, incoming, guess, force, depth, speed, rate, matrix, right)
            if good:
                # the force must be a polynomial to within the tolerance, and so must the wave sent; of that only the
                # area counts, or the rounding of t would be taken for detail where a stiff contact sends steep fronts
                miss, miss_sent, peak = -force_now, incoming[0] - force_now, largest
                for i in range(STAGES):
                    miss += BACK_TO_START[i] * force[i]
                    miss_sent += BACK_TO_START[i] * (force[i] - incoming[i + 1])
                    peak = max(peak, abs(force[i]))
                miss = max(abs(miss), abs(miss_sent) * min(1.0, step / LONG_STEP))
                error = miss / (tolerance * peak) if peak > 0.0 else 0.0
                # where damping stops the surface from pressing, the force has a corner: step up to it, not across it
                corner = a > 0.0 and (force[STAGES - 1] > 0.0) != (force_now > 0.0) and depth[STAGES - 1] > 0.0
                if corner and step > SHORT_STEP and not located:
                    step *= 0.25
                    continue
                if error > 1.0 and step > 1e-13 and not located:
                    step *= max(0.1, 0.8 * error ** (-1.0 / STAGES))
                    continue
                if depth[STAGES - 1] < 0.0 or located:  # the bodies part within this step: make it end there
                    correction = depth[STAGES - 1] / min(rate[STAGES - 1], -1e-300)
                    if abs(correction) <= 2e-15 * max(step, t) or attempt > 50:
                        if error > 1.0 and step > 1e-13 and attempt < 50:  # too long a step to end with
                            located = False
                            step *= max(0.1, 0.8 * error ** (-1.0 / STAGES))
                            continue
                        event = True
                        break
                    located = True
                    step = min(max(step - correction, 0.1 * step), min(1.5 * step, span))
                    continue
                h = step * min(4.0, 0.8 * max(error, 1e-9) ** (-1.0 / STAGES))
                break
            located = False
            step *= 0.25
            if step < 1e-15 * (t + 1e-3):
                failures = 1
                break
        if failures > 0:
            status = FAILED
            break
        if not touching:
            for i in range(STAGES):
                force[i], speed[i] = 0.0, v1
                depth[i] = a + step * STAGE_NODES[i] * v1
                for k in range(STAGES):
                    depth[i] += 2.0 * step * INTEGRATE[i, k] * incoming[k + 1]
        wave[n, 0], total[n, 0], depths[n, 0], speeds[n, 0] = force_now - incoming[0], sent, a, v1
        for i in range(STAGES):
            wave[n, i + 1], depths[n, i + 1], speeds[n, i + 1] = force[i] - incoming[i + 1], depth[i], speed[i]
            total[n, i + 1] = sent
            for k in range(STAGES):
                total[n, i + 1] += step * INTEGRATE[i, k] * (force[k] - incoming[k + 1])
        in_contact[n] = touching
        end = t + step
        for i in range(m):
            lost[n, i] = losses
        if touching:
            presses = False
            for i in range(STAGES):
                largest = max(largest, abs(force[i]))
                presses = presses or force[i] > 0.0
                if lossy:  # what the force took from the bodies less what the law keeps
                    for k in range(STAGES):
                        lost[n, k + 1] += step * INTEGRATE[k, i] * force[i] * rate[i]
                    lost[n, i + 1] -= law.stored(depth[i], 0.0) - law.stored(depths[n, 0], 0.0)
            losses = lost[n, STAGES]
            if presses:
                pressed = end
            if step == span:
                end = limit
        else:
            # touch again? look for the first upward zero of the indentation inside this piece
            samples = 24
            before, touch = 0.0, -1.0
            for i in range(1, samples + 1):
                place = i / samples
                here = interpolate(depths[n], place)
                if here > 0.0 and not (i == 1 and a == 0.0 and here < 1e-14):
                    low, high = before, place
                    for _ in range(80):
                        middle = 0.5 * (low + high)
                        if interpolate(depths[n], middle) > 0.0:
                            high = middle
                        else:
                            low = middle
                    touch = high
                    break
                before = place
            if touch >= 0.0 and touch < 1.0 - 1e-13:
                # keep the part before the touch
                for row in (wave[n], total[n], depths[n]):
                    for i in range(m):
                        incoming[i] = interpolate(row, touch * NODES[i])
                    for i in range(m):
                        row[i] = incoming[i]
                step *= touch
                end, event = t + step, True
            else:
                end, event = limit, touch >= 0.0
        n += 1
        t = end
        start[n] = t
        a, v1, sent = depths[n - 1, STAGES], speeds[n - 1, STAGES], total[n - 1, STAGES]
        force_now = force[STAGES - 1] if touching else 0.0
        if event:
            parting = t
            if touching:
                # a strongly damped surface comes back too slowly to press: its contact ended when the force did
                contacts[count - 1, 1], contacts[count - 1, 3] = (t if presses else pressed), v1
                contacts[count - 1, 6] = v1 - rate[STAGES - 1]
                force_now = 0.0
            else:
                contacts[count, 0], contacts[count, 2] = t, v1
                count += 1
                h = 1e-3
            touching = not touching
            a = 0.0
            breaks[break_count] = t + 1.0
            break_count += 1
        elif not touching:
            drift = -v1 if reflection > 0.0 else (1.0 - v1) / beta - v1
            if until >= FOREVER and drift > 0.0 and t >= parting + period:
                status = PARTED
                break
    if touching:
        contacts[count - 1, 1], contacts[count - 1, 3] = t, v1
        contacts[count - 1, 6] = v1 - rate[STAGES - 1]
    _peaks(n, start, wave, in_contact, reflection, contacts, count)
    return (
        status,
        n,
        start[: n + 1],
        wave[:n],
        total[:n],
        depths[:n],
        speeds[:n],
        contacts[:count],
        lost[:n],
    )


@kernel
def wave_at(t, n, start, values):
    """A history at one time; zero before the blow."""
    if t <= 0.0:
        return 0.0
    low, high = 0, n
    while high - low > 1:
        middle = (low + high) // 2
        if start[middle] <= t:
            low = middle
        else:
            high = middle
    return interpolate(values[low], min((t - start[low]) / (start[low + 1] - start[low]), 1.0))


@kernel
def sample(times, start, values, out):
    """Write a history (segments, STAGES + 1) at `times`."""
    for i in range(times.size):
        out[i] = wave_at(times[i], values.shape[0], start, values)


@kernel
def _peaks(n, start, wave, in_contact, reflection, contacts, count):
    """Peak force of each contact period, refined by golden section between the samples."""
    row = 0
    for k in range(n):
        while row < count - 1 and start[k] >= contacts[row, 1]:
            row += 1
        if not in_contact[k]:
            continue
        width = start[k + 1] - start[k]
        best, place = 0.0, 0.0
        for i in range(13):
            t = start[k] + width * i / 12
            here = wave_at(t, n, start, wave) + reflection * wave_at(t - 1.0, n, start, wave)
            if here > best:
                best, place = here, i / 12
        if best <= 0.9 * contacts[row, 4]:
            continue
        low, high = max(place - 1 / 12, 0.0), min(place + 1 / 12, 1.0)
        for _ in range(60):
            third = (high - low) * 0.3819660112501051
            p, q = low + third, high - third
            tp, tq = start[k] + width * p, start[k] + width * q
            at_p = wave_at(tp, n, start, wave) + reflection * wave_at(tp - 1.0, n, start, wave)
            at_q = wave_at(tq, n, start, wave) + reflection * wave_at(tq - 1.0, n, start, wave)
            best = max(best, at_p, at_q)
            if at_p > at_q:
                high = q
            else:
                low = p
        contacts[row, 4] = max(contacts[row, 4], best)


@kernel
def stored_energy(begin, end, start, wave):
    """Integral of f(t)^2 over [begin, end]."""
    total = 0.0
    for k in range(wave.shape[0]):
        a, b = max(begin, start[k]), min(end, start[k + 1])
        if b <= a:
            continue
        width = start[k + 1] - start[k]
        for i in range(STAGES):
            weight, place = INTEGRATE[STAGES - 1, i] * (b - a), (a - start[k] + STAGE_NODES[i] * (b - a)) / width
            total += weight * interpolate(wave[k], place) ** 2
    return total
