"""Figures alone of an impact on a rod by exact waves, or across a beam by its modes, for the browser: the same as those
beside its histories."""

import numba
import numpy as np
from numba import carray

from solvers.methods.base import AFTERGLOW, MAX_ROUND_TRIPS
from solvers.numerics import modal_contacts, modal_figures
from solvers.numerics.flights import Flights
from solvers.numerics.law_functions import CONSTANTS
from solvers.numerics.polynomials import MAX_INTERVALS, RootWork, roots, shift, value
from solvers.numerics.waves import law_drawn, rigid, rigid_figures
from solvers.numerics.waves.collocation import NODES, SLOPE_AT_END, SLOPE_AT_START, STAGES, interpolate
from solvers.numerics.waves.drawn import NO_ROOM, SOLVED
from solvers.numerics.waves.events import NO_PULL
from solvers.numerics.waves.laws import STORED
from solvers.numerics.waves.laws import Work as LawWork
from solvers.numerics.waves.network import PARTED, STOPPED, solve
from solvers.numerics.waves.nodes import State, rewind
from solvers.numerics.waves.parts import Chain
from solvers.numerics.waves.periods import SILENT, end_of, periods
from solvers.numerics.waves.record import (
    DEPTH,
    FLAT,
    FORCE,
    GOLDEN,
    LOST,
    OUT_LEFT,
    OUT_RIGHT,
    POINTS,
    QUANTITIES,
    SPEED,
    TOTAL_LEFT,
    TOTAL_RIGHT,
    Record,
    sample_at,
    square_integral,
)
from solvers.numerics.waves.rigid import Pieces, Work

from .entry import ANY_LAW, FLAGS, INTEGERS, JUMPING, LOSES, REMEMBERS, Entry
from .modal_entries import BEAM_MODES, law_of, march_room, room_of
from .wave_entries import CONTACTS, PIECES, STRETCHES, TERMS, TOLERANCE, T, record_room

# in T, v and Z v; energies in Z v v T. PEAK, STRESS: largest force, and largest stress along the rod, times its area;
# TOUCHING: all times in contact together; SHOWN: the end of the time that is followed
FINAL, TARGET, ENERGY, DISSIPATED, DEEPEST, PEAK, STRESS, TOUCHING, PARTING, TOUCHES, SHOWN = range(11)
COLUMNS = 11
TURNS = PIECES * (T + 2)  # of the wave that the struck end sends
LAW_TURNS = 4 * STRETCHES
# of an impact across: as many as the library takes of any; rigid faces, which never fly, take 1 to 2 s for them
BENT_STEPS = 4_000_000
BENT_STRIDE = 32  # from one checkpoint to the next: flights take whole ones
WINDOW = 512  # steps that are kept of it: what a step needs of those before it lies within a stride
RESOLVED = 2**17  # of rigid faces: steps of the highest mode's period; by two modes or more there are hardly as many
CHATTER = 500  # contacts of these that may be one: those within such a period are at once
NEAR = 0.9  # of the highest so far: between nodes that are lower is nothing higher


@numba.njit(error_model="numpy")
def _went_through(t, wave, at, sent, count):
    """Take a point of a wave into those where it turns, in place of one on the way to it; how many they are."""
    if count > 1 and np.sign(wave - sent[count - 1]) == np.sign(sent[count - 1] - sent[count - 2]):
        count -= 1
    at[count], sent[count] = t, wave
    return count + 1


@numba.njit(error_model="numpy")
def _highest_stress(held, peak, at, sent, count):
    """Of a rod, from the points where the wave turns that its struck end sends.

    Stress is the sum of two waves. From a fixed end the same one comes back, and beside that end it is doubled; while
    bodies press no wave is lower than what came before is high. From a free one its opposite does, and any two points
    of it meet that are no further than T from each other; just so far are those at the struck end, where `peak` is.
    """
    found = 0.0 if held else peak
    first = 0
    for k in range(count):
        if held:
            found = max(found, 2.0 * sent[k])
            continue
        while at[k] - at[first] > 1.0:
            first += 1
        for other in range(first, k):
            found = max(found, abs(sent[k] - sent[other]))
    return found


@numba.njit(error_model="numpy")
def _turns_of_pieces(pieces, last, kappa, sent, at, waves):
    """Write when a wave in pieces turns, and how high it is then, up to `last`; how often."""
    work, count = sent.work, _went_through(0.0, 0.0, at, waves, 0)
    slope, found = work.slope, work.found
    for n in range(pieces):
        begin, p, degree = sent.start[n], sent.coefficients[n], sent.degrees[n]
        length = kappa * (min(sent.start[n + 1], last) - begin)
        if length <= 0.0:
            break
        for k in range(degree):
            slope[k] = (k + 1) * p[k + 1] - p[k]
        slope[degree] = -p[degree]
        count = _went_through(begin, p[0], at, waves, count)
        a = 0.0
        while a < length:
            b = min(length, a + rigid.WINDOW) if a < rigid.HORIZON else length
            shift(slope, degree, a, work.shifted)
            for k in range(roots(work.shifted, degree, b - a, found, work.roots)):
                x = a + found[k]
                count = _went_through(begin + x / kappa, np.exp(-x) * value(p, degree, x), at, waves, count)
            a = b
        end = np.exp(-length) * value(p, degree, length)
        count = _went_through(begin + length / kappa, end, at, waves, count)
    return count


def rod_figures(beta, reflection, line, rows, coefficients, degrees, contacts, at, waves, out):
    """A rigid mass on a uniform rod, followed as by `rod`."""
    m = carray(line, (2 * (PIECES + 1) + 7 * T + 1 + 2 * MAX_INTERVALS + rigid_figures.FIGURES,))
    start, integral, w = m[: PIECES + 1], m[PIECES + 1 : 2 * (PIECES + 1)], m[2 * (PIECES + 1) :]
    halves, kept = w[7 * T + 1 :], w[7 * T + 1 + 2 * MAX_INTERVALS :]
    left, width = halves[:MAX_INTERVALS], halves[MAX_INTERVALS : 2 * MAX_INTERVALS]
    searched = RootWork(carray(rows, (MAX_INTERVALS, T)), left, width, w[5 * T : 6 * T])
    work = Work(
        w[:T], w[T : 2 * T], w[2 * T : 3 * T], w[3 * T : 4 * T], w[4 * T : 5 * T], w[6 * T : 7 * T + 1], searched
    )
    waves_sent = carray(coefficients, (PIECES, TERMS)), carray(degrees, (PIECES,))
    sent = Pieces(start, *waves_sent, integral, carray(contacts, (PIECES, 7)), work)
    status, pieces, count = rigid.strike(beta, reflection, rigid.FOREVER, sent)
    if status != rigid.PARTED:
        return NO_ROOM
    table, o = sent.contacts[:count], carray(out, (COLUMNS,))
    last = min(table[count - 1, 1] + AFTERGLOW, start[pieces])
    wave = start[: pieces + 1], sent.coefficients[:pieces], sent.degrees[:pieces], integral[: pieces + 1]
    rigid_figures.figures(last, beta, reflection, *wave, table, kept)
    o[FINAL], o[TARGET], o[ENERGY] = table[count - 1, 3], kept[rigid_figures.TARGET], kept[rigid_figures.ROD]
    o[DISSIPATED] = o[DEEPEST] = o[PEAK] = o[TOUCHING] = 0.0
    for k in range(count):
        o[PEAK] = max(o[PEAK], table[k, 4])
        o[TOUCHING] += table[k, 1] - table[k, 0]
    o[PARTING], o[TOUCHES], o[SHOWN] = table[count - 1, 1], count, last
    turned, high = carray(at, (TURNS,)), carray(waves, (TURNS,))
    turns = _turns_of_pieces(pieces, last, 2.0 * beta, sent, turned, high)
    o[STRESS] = _highest_stress(reflection > 0.0, o[PEAK], turned, high, turns)
    return SOLVED


@numba.njit(error_model="numpy")
def _turn_within(values, low, high, way):
    """Where what a stretch keeps is highest (way 1) or lowest (-1) between two places in [0, 1], by golden section."""
    p, q = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_p, at_q = way * interpolate(values, p), way * interpolate(values, q)
    while high - low > FLAT:
        if at_p > at_q:
            high, q, at_q = q, p, at_p
            p = high - GOLDEN * (high - low)
            at_p = way * interpolate(values, p)
        else:
            low, p, at_p = p, q, at_q
            q = low + GOLDEN * (high - low)
            at_q = way * interpolate(values, q)
    return 0.5 * (low + high)


@numba.njit(error_model="numpy")
def _turn_of(values, way):
    """The highest (way 1) or lowest (-1) node of what a stretch keeps, and where that turns beside it; -1: nowhere."""
    top = 0
    for k in range(1, POINTS):
        top = k if way * values[k] > way * values[top] else top
    beyond = 1.0
    if top == 0 or top == STAGES:
        beyond = 0.0
        for k in range(POINTS):
            beyond += (SLOPE_AT_START[k] if top == 0 else -SLOPE_AT_END[k]) * way * values[k]
    if beyond <= 0.0:
        return top, -1.0
    return top, _turn_within(values, NODES[max(top - 1, 0)], NODES[min(top + 1, STAGES)], way)


@numba.njit(error_model="numpy")
def _highest(record, quantity, first, last):
    """The largest value in these stretches of the struck end, between nodes only where it turns there."""
    best = 0.0
    for n in range(first, last + 1):
        values = record.values[0, n, quantity]
        largest = values[0]
        for k in range(1, POINTS):
            largest = max(largest, values[k])
        if largest <= NEAR * best:
            continue
        best = max(best, largest)
        _, place = _turn_of(values, 1.0)
        if place >= 0.0:
            best = max(best, interpolate(values, place))
    return best


@numba.njit(error_model="numpy")
def _turns_of_record(record, last, at, waves):
    """The same of a wave that is kept in stretches."""
    count = _went_through(0.0, 0.0, at, waves, 0)
    for n in range(record.count[0]):
        begin, values = record.start[0, n], record.values[0, n, OUT_RIGHT]
        width = record.start[0, n + 1] - begin
        if begin >= last:
            break
        count = _went_through(begin, values[0], at, waves, count)
        highest, lowest = _turn_of(values, 1.0), _turn_of(values, -1.0)
        for upper in (highest[0] <= lowest[0], highest[0] > lowest[0]):  # of both turns the earlier one first
            place = highest[1] if upper else lowest[1]
            if place >= 0.0 and begin + place * width <= last:
                count = _went_through(begin + place * width, interpolate(values, place), at, waves, count)
        place = min((last - begin) / width, 1.0)
        count = _went_through(begin + place * width, interpolate(values, place), at, waves, count)
    return count


@numba.njit(error_model="numpy")
def _law_figures(record, free, own, slopes, last, pressed, count, o):
    """Write those of an impact through a law from its record and its contacts."""
    after, lag = np.bool_(True), law_drawn.LAG
    o[PEAK] = o[TOUCHING] = 0.0
    for k in range(count):
        first, beyond = pressed[k, 0], pressed[k, 1]
        o[PEAK] = max(o[PEAK], _highest(record, FORCE, first, beyond))
        o[PARTING] = end_of(record, 0, beyond)
        o[TOUCHING] += o[PARTING] - record.start[0, first]
    o[FINAL] = sample_at(record, 0, SPEED, last, after)
    right = sample_at(record, 0, TOTAL_RIGHT, last, after) - sample_at(record, 0, TOTAL_RIGHT, last - lag, after)
    left = sample_at(record, 1, TOTAL_LEFT, last, after) - sample_at(record, 1, TOTAL_LEFT, last - lag, after)
    o[TARGET] = 2.0 * (right - left) if free else 0.0
    since = max(last - lag, 0.0)
    o[ENERGY] = square_integral(record, 0, OUT_RIGHT, since, last) + square_integral(record, 1, OUT_LEFT, since, last)
    o[DEEPEST] = _highest(record, DEPTH, 0, record.count[0] - 1)
    depth = sample_at(record, 0, DEPTH, o[PARTING], np.bool_(False))
    o[DISSIPATED] = sample_at(record, 0, LOST, o[PARTING], np.bool_(False))
    o[DISSIPATED] += ANY_LAW(STORED, own, depth, 0.0, o[DEEPEST], slopes)
    o[TOUCHES], o[SHOWN] = count, last


def law_figures(
    beta, reflection, asked, tolerance, constants, beside, nodes, counts, flags, rows, nothing, pressing, at, waves,
     out, start, values, closed, breaks,
):  # fmt: skip
    """One that strikes through a contact law, followed as by `law`; of one for as long as is asked no stress.

    tolerance: of a step, or 0: that of `law`.
    """
    b, f = carray(beside, (8, 3)), carray(nodes, (8, 2))
    n, yes = carray(counts, (6, 2)), carray(flags, (6, 2))
    chain = Chain(b[0][:1], b[1][:1], b[2][:1], n[0], b[3][:2], b[4][:2], b[5][:2], f[7], 0, 0.0, 0.0)
    law_drawn.place(beta, reflection, chain, b[6])
    r, pulse = carray(rows, (8 + 3 * STAGES, POINTS)), carray(nothing, (1, 2 + POINTS))
    laws = carray(constants, (2, CONSTANTS + 1))
    record = Record(
        carray(start, (2, STRETCHES + 1)),
        carray(values, (2, STRETCHES, QUANTITIES, POINTS)),
        carray(closed, (2, STRETCHES)),
        n[1],
    )
    state = State(
        f[0], f[1], f[2], f[3], f[4], f[5], f[6], yes[2], yes[3], yes[4], n[2], n[3],
        carray(breaks, (2, STRETCHES)), n[4], n[5], yes[5], b[7], b[2][1:2],
    )  # fmt: skip
    for node in range(2):
        number = int(laws[node, CONSTANTS])
        yes[0][node], yes[1][node] = REMEMBERS[number], LOSES[number]
        record.start[node, 0], record.count[node] = 0.0, 0
    rewind(chain, state)
    work = LawWork(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8:], r[8 + STAGES :], r[8 + 2 * STAGES :])
    most, close = MAX_ROUND_TRIPS * 1.0, tolerance if tolerance > 0.0 else TOLERANCE
    wait, until = (np.inf, min(asked, most)) if asked > 0.0 else (law_drawn.WAIT, most)
    of_law = laws, yes[0], yes[1], pulse, b[6]
    status = solve(chain, record, state, work, ANY_LAW, ANY_LAW, *of_law, wait, NO_PULL, until, close)
    silent = SILENT * close if yes[1][0] else 0.0
    pressed = carray(pressing, (CONTACTS, 2))
    count = periods(record, 0, np.bool_(False), ANY_LAW, laws[0], yes[0][0], silent, work.slopes, pressed)
    if status != (STOPPED if asked > 0.0 else PARTED) or count < 1:
        return NO_ROOM
    parted = end_of(record, 0, pressed[count - 1, 1])
    last = min(asked if asked > 0.0 else parted + AFTERGLOW, state.time[0], state.time[1])
    o = carray(out, (COLUMNS,))
    _law_figures(record, reflection < 0.0, laws[0], work.slopes, last, pressed, count, o)
    o[STRESS] = np.nan
    if not asked > 0.0:
        turned, high = carray(at, (LAW_TURNS,)), carray(waves, (LAW_TURNS,))
        turns = _turns_of_record(record, last, turned, high)
        o[STRESS] = _highest_stress(reflection > 0.0, o[PEAK], turned, high, turns)
    return SOLVED


def beam_figures(
    mass, rigid_mass, whole, mean, count, compliance, longest, duration, constants, shapes, oscillators, saved,
    saved_rates, slopes, histories, runs, turning, impulses, chatter, contact, known, out,
):  # fmt: skip
    """A mass across what bends, by its modes, as by `beam`; but without histories, and flights are taken at once."""
    n = int(count)
    if n > BEAM_MODES:
        return NO_ROOM
    frequencies, at_contact, damping = carray(shapes, (3, n))
    w, s, checkpoints = carray(turning, (5, n)), carray(known, (modal_figures.COLUMNS,)), WINDOW // BENT_STRIDE + 1
    room = modal_figures.Windowed(
        march_room(n, WINDOW, checkpoints, saved, saved_rates, oscillators, slopes, histories, runs),
        Flights(w[0], w[1], w[2]), w[3], w[4], carray(impulses, (RESOLVED,)),
        carray(chatter, (CHATTER, modal_figures.CHATTERS)), carray(contact, (1, modal_contacts.COLUMNS)), s,
    )  # fmt: skip
    c = carray(constants, (CONSTANTS + 1,))
    law, number, rigid = law_of(c, compliance)
    status, step = modal_figures.figures_of_beam(
        law, ANY_LAW, (c, LOSES[number], rigid), (mass, rigid_mass, whole, mean), (frequencies, at_contact, damping),
        compliance, (JUMPING[number], REMEMBERS[number]), longest, duration, (MAX_ROUND_TRIPS, AFTERGLOW),
        BENT_STEPS, BENT_STRIDE, room,
    )  # fmt: skip
    if status != SOLVED:
        return status
    o = carray(out, (COLUMNS,))
    o[FINAL], o[TARGET], o[ENERGY] = s[modal_figures.FINAL], mean * s[modal_figures.TARGET], s[modal_figures.STRUCK]
    o[DISSIPATED], o[DEEPEST], o[PEAK] = s[modal_figures.DISSIPATED], s[modal_figures.DEEPEST], s[modal_figures.PEAK]
    o[TOUCHING], o[PARTING], o[STRESS] = s[modal_figures.TOUCHING], s[modal_figures.PARTING], np.nan
    o[TOUCHES], o[SHOWN] = s[modal_figures.COUNT], step * s[modal_figures.SHOWN]
    return SOLVED


FOUND = {
    "final": FINAL,
    "target": TARGET,
    "energy": ENERGY,
    "dissipated": DISSIPATED,
    "deepest": DEEPEST,
    "peak": PEAK,
    "stress": STRESS,
    "touching": TOUCHING,
    "parting": PARTING,
    "contacts": TOUCHES,
    "duration": SHOWN,
}
FIGURE_ENTRIES = {
    "rod_figures": Entry(
        rod_figures,
        2,
        {
            "line": 2 * (PIECES + 1) + 7 * T + 1 + 2 * MAX_INTERVALS + rigid_figures.FIGURES,
            "rows": MAX_INTERVALS * T,
            "coefficients": PIECES * TERMS,
            "degrees": PIECES,
            "contacts": 7 * PIECES,
            "at": TURNS,
            "waves": TURNS,
            "out": COLUMNS,
        },
        {"degrees": INTEGERS},
        FOUND,
    ),
    "law_figures": Entry(
        law_figures,
        4,
        {
            "constants": 2 * (CONSTANTS + 1),
            "beside": 8 * 3,
            "nodes": 8 * 2,
            "counts": 6 * 2,
            "flags": 6 * 2,
            "rows": (8 + 3 * STAGES) * POINTS,
            "nothing": 2 + POINTS,
            "pressing": 2 * CONTACTS,
            "at": LAW_TURNS,
            "waves": LAW_TURNS,
            "out": COLUMNS,
            **record_room(2, STRETCHES),
        },
        {"counts": INTEGERS, "pressing": INTEGERS, "flags": FLAGS, "closed": FLAGS},
        FOUND,
    ),
    "beam_figures": Entry(
        beam_figures,
        8,
        {
            **room_of(BEAM_MODES, WINDOW, WINDOW // BENT_STRIDE + 1),
            "turning": 5 * BEAM_MODES,
            "impulses": RESOLVED,
            "chatter": CHATTER * modal_figures.CHATTERS,
            "contact": modal_contacts.COLUMNS,
            "known": modal_figures.COLUMNS,
            "out": COLUMNS,
        },
        {"runs": INTEGERS},
        FOUND,
    ),
}
