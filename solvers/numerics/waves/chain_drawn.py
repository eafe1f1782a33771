"""An impact on rods one behind the other, rigid faces, as a picture needs it: see `drawn`.

A mass or a rod strikes; the far end is free, fixed, with a mass on it, or leads on for ever; joints are bonded, touch,
or have a gap. Units: times T, velocities v, forces Z v of the struck rod, lengths v T, masses Z T.
"""

import numpy as np

from ...jit.kernels import inner_kernel, kernel
from ...jit.reference import refer
from .drawn import NO_ROOM, SOLVED, instant, samples_of
from .energies import first_energy, inside, rod_energy
from .followed import follow
from .law_drawn import END as PARTING
from .law_drawn import JUST_AFTER, LEFT, force_jumps, kept_history, sent_jumps
from .law_drawn import PEAK as PEAK_OF
from .law_drawn import PUSH as PUSH_OF
from .law_drawn import START as TOUCHING
from .network import PARTED, STOPPED
from .parts import ABSORBING, BONDED
from .periods import end_of, periods
from .record import (
    FORCE,
    IMPULSE,
    OUT_LEFT,
    OUT_RIGHT,
    PLACE,
    SPEED,
    TOTAL_LEFT,
    TOTAL_RIGHT,
    highest,
    sample_at,
    square_integral,
)

# what `answer` writes into `out`: velocity of the target as a whole, and with which the faces part; impulse to the end
# of compression; energies Z v v T: at first, then of the striker, of the target, and of its parts that nothing holds as
# wholes; whether before a rod without end nothing is left; smooth stretches of all nodes; gaps that have been closed
IMPULSE_IN, FINAL, TARGET, APART, COMPRESSING, FIRST, STRIKER, STRUCK, WHOLES, FADED, STEPS = range(11)
CLOSED, CONTACTS, SHOWN, FORCE_POINTS = range(11, 15)
COLUMNS = 15
GAP_COLUMNS = 3  # number of the rod behind a gap, and from when to when that is closed
MOST_RODS = 4  # of a picture
WAVE_NUMBERS = 4_800  # of the histories of all waves together


@inner_kernel
def place(links, knots, mass, end, contact, chain, masses):
    """Write a chain for `network`: links (3, rods) impedance, transit, drift; knots (2, nodes): what holds, and gap.

    mass: of what strikes, 0 if that is a rod; end: on the far end. A far end that is bonded, to no mass, is fixed.
    """
    rods = links.shape[1]
    for rod in range(rods):
        chain.impedance[rod], chain.transit[rod], chain.drift[rod] = links[0, rod], links[1, rod], links[2, rod]
    for node in range(rods + 1):
        chain.kind[node], chain.gap[node] = int(knots[0, node]), knots[1, node]
        chain.mass_left[node] = chain.mass_right[node] = chain.mass_drift[node] = 0.0
    striker = links[0, 0] * links[1, 0]
    if contact == 0:
        chain.mass_left[0], chain.mass_drift[0], striker = mass, chain.drift[0] + 1.0, mass
    fixed = chain.kind[rods] == BONDED and end == 0.0
    chain.mass_right[rods] = np.inf if fixed else end
    chain.mass_drift[rods] = 0.0 if fixed else chain.drift[rods - 1]
    part = contact
    for node in range(rods + 1):
        masses[node] = np.inf
    for rod in range(contact, rods):
        if rod == contact or chain.kind[rod] != BONDED:
            part = rod
            masses[part] = 0.0
        masses[part] += chain.impedance[rod] * chain.transit[rod]
    masses[part] += chain.mass_right[rods] if chain.kind[rods] != ABSORBING else np.inf
    masses[rods + 1] = striker


@inner_kernel
def _face(chain, record, rod, at_left, t):
    """Displacement of an end of a rod."""
    lag, after = chain.transit[rod], np.bool_(True)
    f, g = (t, t - lag) if at_left else (t - lag, t)
    sent = sample_at(record, rod, TOTAL_RIGHT, f, after) - sample_at(record, rod + 1, TOTAL_LEFT, g, after)
    return chain.drift[rod] * t + sent / chain.impedance[rod]


@inner_kernel
def _face_speed(chain, record, rod, at_left, t):
    lag, after = chain.transit[rod], np.bool_(True)
    f, g = (t, t - lag) if at_left else (t - lag, t)
    sent = sample_at(record, rod, OUT_RIGHT, f, after) - sample_at(record, rod + 1, OUT_LEFT, g, after)
    return chain.drift[rod] + sent / chain.impedance[rod]


@inner_kernel
def _striker_speed(chain, record, masses, t):
    """Of its mass centre."""
    if chain.contact == 0:
        return sample_at(record, 0, SPEED, t, np.bool_(True)) if t > 0.0 else chain.mass_drift[0]
    return chain.drift[0] - sample_at(record, chain.contact, IMPULSE, t, np.bool_(True)) / masses[-1]


@inner_kernel
def _momentum(chain, record, rod, t):
    """Of a rod of the target, and of what is fixed to its end."""
    found = chain.impedance[rod] * chain.transit[rod] * chain.drift[rod] + inside(chain, record, rod, t)
    last = chain.kind.size - 1
    if rod == last - 1 and 0.0 < chain.mass_right[last] < np.inf:
        speed = sample_at(record, last, SPEED, t, np.bool_(True)) if t > 0.0 else chain.mass_drift[last]
        found += chain.mass_right[last] * speed
    return found


@inner_kernel
def _mass(chain, rod):
    last = chain.kind.size - 1
    on_it = rod == last - 1 and chain.mass_right[last] < np.inf
    return chain.impedance[rod] * chain.transit[rod] + (chain.mass_right[last] if on_it else 0.0)


@inner_kernel
def _whole_speed(chain, record, t):
    """Velocity of the mass centre of the target, (4.29)."""
    momentum = mass = 0.0
    for rod in range(chain.contact, chain.transit.size):
        momentum += _momentum(chain, record, rod, t)
        mass += _mass(chain, rod)
    return momentum / mass


@inner_kernel
def _held(chain):
    return chain.kind[-1] == ABSORBING or chain.mass_right[-1] == np.inf


@inner_kernel
def _wholes(chain, record, t):
    """Kinetic energy of the mean motion of each part of the target that nothing holds and no joint divides."""
    energy = momentum = mass = 0.0
    for rod in range(chain.contact, chain.transit.size):
        momentum += _momentum(chain, record, rod, t)
        mass += _mass(chain, rod)
        last = rod == chain.transit.size - 1
        if last or chain.kind[rod + 1] != BONDED:
            if not (last and _held(chain)):
                energy += 0.5 * momentum**2 / mass
            momentum = mass = 0.0
    return energy


@inner_kernel
def _struck(chain, record, t):
    """Energy of the target, and what has gone on for ever."""
    energy, last = 0.0, chain.transit.size
    for rod in range(chain.contact, last):
        energy += rod_energy(chain, record, rod, t)
    if 0.0 < chain.mass_right[last] < np.inf:
        energy += 0.5 * chain.mass_right[last] * sample_at(record, last, SPEED, t, np.bool_(True)) ** 2
    if chain.kind[last] == ABSORBING:
        gone = square_integral(record, last - 1, OUT_RIGHT, 0.0, max(t - chain.transit[last - 1], 0.0))
        energy += gone / chain.impedance[last - 1]
    return energy


@inner_kernel
def _compressed(chain, record, masses, common, last):
    """Impulse when the striker has come down to the `common` velocity, (4.38), (4.41); NaN if it never does."""
    if _striker_speed(chain, record, masses, last) > common:
        return np.nan
    low, high = 0.0, last  # its velocity only falls
    while True:
        middle = 0.5 * (low + high)
        if middle <= low or middle >= high:
            return sample_at(record, chain.contact, IMPULSE, high, np.bool_(True))
        if _striker_speed(chain, record, masses, middle) <= common:
            high = middle
        else:
            low = middle


@inner_kernel
def _figures(chain, record, masses, parted, last, out):
    contact, striker = chain.contact, masses[-1]
    out[IMPULSE_IN] = sample_at(record, contact, IMPULSE, last, np.bool_(True))
    out[FINAL] = _striker_speed(chain, record, masses, last)
    out[TARGET] = 0.0 if _held(chain) else _whole_speed(chain, record, last)
    t = parted + JUST_AFTER
    out[APART] = _face_speed(chain, record, contact, True, t)
    out[APART] -= _face_speed(chain, record, 0, False, t) if contact else _striker_speed(chain, record, masses, t)
    common, whole = 0.0, 0.0
    if not _held(chain):
        for rod in range(contact, chain.transit.size):
            whole += _mass(chain, rod)
        first = _striker_speed(chain, record, masses, 0.0)
        common = (striker * first + whole * _whole_speed(chain, record, 0.0)) / (striker + whole)
    out[COMPRESSING] = _compressed(chain, record, masses, common, last)
    out[FIRST] = first_energy(chain)
    out[STRIKER] = rod_energy(chain, record, 0, last) if contact else 0.5 * striker * out[FINAL] ** 2
    out[STRUCK], out[WHOLES] = _struck(chain, record, last), _wholes(chain, record, last)


@inner_kernel
def _motions(chain, record, last, mass, end, whole):
    """Write the paths of the striker's face, of the struck end and of the target as a whole."""
    contact, moved, before = chain.contact, 0.0, _whole_speed(chain, record, 0.0)
    for i in range(mass.size):
        t = instant(i, mass.size, last)
        speed = _whole_speed(chain, record, t)
        moved += 0.5 * last / (mass.size - 1) * (before + speed) if i else 0.0
        whole[i], before = moved, speed
        mass[i] = _face(chain, record, 0, False, t) if contact else sample_at(record, 0, PLACE, t, np.bool_(True))
        end[i] = _face(chain, record, contact, True, t)


@inner_kernel
def _waves(chain, record, last, drawn, sent):
    """Write what both ends of every rod send, one history behind the other, from where to where into `sent`."""
    waves = 2 * chain.transit.size
    even, sent[0] = WAVE_NUMBERS // (2 * waves), 0
    for wave in range(waves):
        node, quantity = (wave + 1) // 2, OUT_LEFT if wave % 2 else OUT_RIGHT
        jumps = drawn.jumps[: min(sent_jumps(record, node, quantity, drawn.jumps), even // 3)]
        known, begin = (record, np.int64(node), np.int64(quantity), last), sent[wave]
        count = kept_history(even, last, jumps, known, drawn.wave_time[begin:], drawn.wave[begin:])
        sent[wave + 1] = begin + count


@inner_kernel
def _closed(chain, record, law, of_law, slopes, pressing, closed):
    """Write when each gap is closed; how many times, and when the last of them first was. -1: no room."""
    count, latest = 0, 0.0
    for node in range(chain.contact + 1, chain.transit.size):
        if chain.gap[node] <= 0.0:
            continue
        constants, remembers = of_law[0][node], of_law[1][node]
        found = periods(record, node, np.bool_(False), law, constants, remembers, 0.0, slopes, pressing)
        if found < 0 or count + found > closed.shape[0]:
            return -1, latest
        for k in range(found):
            start, end = record.start[node, pressing[k, 0]], end_of(record, node, pressing[k, 1])
            latest = max(latest, start) if k == 0 else latest
            closed[count, 0], closed[count, 1], closed[count, 2] = node - chain.contact + 1, start, end
            count += 1
    return count, latest


@inner_kernel
def _table(chain, record, masses, pressing, count, contacts):
    node = chain.contact
    for k in range(count):
        first, beyond = pressing[k, 0], pressing[k, 1]
        contacts[k, TOUCHING], contacts[k, PARTING] = record.start[node, first], end_of(record, node, beyond)
        contacts[k, PUSH_OF] = record.values[node, beyond, IMPULSE, -1] - record.values[node, first, IMPULSE, 0]
        contacts[k, PEAK_OF] = highest(record, node, FORCE, first, beyond)


@kernel
def answer(chain, record, state, work, law, of_law, ends, pressing, contacts, closed, sent, drawn, out):
    """Solve an impact until the bodies part for good, or for as long as is asked, and write what is drawn of it.

    chain, record, state, work: rooms, the chain as it is; law: any, as `network.solve` takes one; of_law: what that
    takes besides, (constants, remembers, loses, pulse, masses); ends: (tolerance, most, afterglow, asked): for how long
    at most, and how much longer than the last parting is shown, or exactly how long, if not 0 [T]; pressing (room, 2),
    contacts (room, CONTACT_COLUMNS), closed (room, GAP_COLUMNS); sent (waves + 1,): where in `drawn`, a `Drawn`, the
    wave of each end of each rod begins; out (COLUMNS,). Returns SOLVED, or NO_ROOM, also where they have not parted.
    """
    chain, record, state, work = refer(chain), refer(record), refer(state), refer(work)
    tolerance, most, afterglow, asked = ends
    masses, node = of_law[4], chain.contact
    until = asked if asked > 0.0 else np.inf
    status, faded, doubtful = follow(chain, record, state, work, law, law, of_law, until, most, tolerance)
    if doubtful or (status != PARTED and not faded and not (status == STOPPED and asked > 0.0)):
        return NO_ROOM
    own, remembers = of_law[0][node], of_law[1][node]
    gaps, latest = _closed(chain, record, law, of_law, work.slopes, pressing, closed)
    count = periods(record, node, np.bool_(False), law, own, remembers, 0.0, work.slopes, pressing)
    jumps = force_jumps(record, state, node, drawn.jumps)
    if gaps < 0 or count < 1 or jumps < 0 or count > contacts.shape[0]:
        return NO_ROOM
    _table(chain, record, masses, pressing, count, contacts)
    reach, steps = np.inf, 0
    for each in range(chain.kind.size):
        reach, steps = min(reach, state.time[each]), steps + record.count[each]
    parted = contacts[count - 1, PARTING]
    last = min(asked if asked > 0.0 else max(parted, latest) + afterglow, reach)
    for k in range(count):
        contacts[k, LEFT] = _striker_speed(chain, record, masses, min(contacts[k, PARTING], last))
    force, number = (record, np.int64(node), np.int64(FORCE), last), samples_of(last)
    out[FORCE_POINTS] = kept_history(number, last, drawn.jumps[:jumps], force, drawn.force_time, drawn.force)
    _waves(chain, record, last, drawn, sent)
    _motions(chain, record, last, drawn.mass, drawn.end, drawn.whole)
    _figures(chain, record, masses, parted, last, out)
    out[FADED], out[STEPS], out[CLOSED], out[CONTACTS], out[SHOWN] = faded, steps, gaps, count, last
    return SOLVED
