"""Dry friction at one point of contact: how it slides as the normal impulse p grows, and where the impact ends.

The points part at w (that of the second body less that of the first) with dw/dp = W (n - mu s): W is the inverse of the
inertia felt at the contact, s the direction of sliding. Here velocities are in units of the first one and W in units of
n . W n; the first axis is n, the others are tangents along which the tangential part of W is diagonal:

    W = [[1, a1, a2], [a1, b1, 0], [a2, 0, b2]].

With dp = S dt, where S is the speed of sliding, nothing is singular: s turns at h(s), S' = g(s) S, w_n' = f(s) S.
Sliding ends, S = 0, only for t without end, as s settles on a root of h. On a root (an isoclinic) sliding is straight
and all is linear in p, so that the end of sliding is never stepped to.
Source: Stronge, Impact Mechanics (2000), chapters 4 and 8; Bhatt and Koechling (1995). Differs: the time t.
"""

import math
from typing import NamedTuple

from ...jit.kernels import inner_kernel

ORDER = 18  # of the power series of a step
TRUNCATION = 1e-14  # of a step, of the first velocity: the slower it slides, the less the direction matters
SETTLED = 1e-12  # likewise, of the angle to a root of h that attracts, below which sliding is straight
COARSEST = 1e-5  # of a step, relative, and of that angle [rad]
ON_ROOT = 1e-14  # of the rates: so small an h is rounding; where a root repels, sliding stops before that has grown
STOPPED_SPEED = 1e-17  # of the first velocity: so slow is no sliding
MAX_STEPS = 2_000  # of one impact; the random ones of the tests need less than 100
C, D, H, G, F, S, WN, P, E, CC, CD = range(11)  # rows of a table of series: see `_series`
ROWS = 11

# columns of what is found: the impulse (3), p at the end of compression and where sliding first ends, the works of
# compression, restitution and friction, what follows the first sliding, whether it jams, steps
IMPULSE, COMPRESSION, STOPPED, COMPRESSED, RESTORED, RUBBED, FOLLOWS, JAMS, STEPS = 0, 3, 4, 5, 6, 7, 8, 9, 10
FOUND = 11

COMPRESSES, RESTORES, OVER = range(3)  # phases of an impact
GOES_ON, REACHED, TURNS = range(3)  # of a phase at the end of a step; it turns where restitution becomes compression
SLIP, STICK, REVERSAL = range(3)
STRONGE, POISSON = range(2)  # what is restored: energy, or impulse


class Felt(NamedTuple):
    """W and the coefficients at one contact, scaled; and the law of restitution."""

    a1: float
    a2: float
    b1: float
    b2: float
    friction: float
    restitution: float
    law: int


@inner_kernel
def starts(felt, velocity):
    """Whether there is an impact: the points approach, or they only slide and friction presses them closer, f < 0.

    The latter is Painlevé's impact without approach: a force as small as may be brings them closer, and so grows.
    """
    if velocity[0] != 0.0:
        return velocity[0] < 0.0
    speed = math.hypot(velocity[1], velocity[2])
    return speed > 0.0 and _rates(felt, velocity[1] / speed, velocity[2] / speed, SLIP)[0] < 0.0


@inner_kernel
def slide(felt, velocity, series, path, found):
    """One impact that `starts`, from the velocity (3,) of parting until it is over.

    series (ROWS, ORDER + 1): room for the steps. path (points, 4): takes p and w along the way, as far as it goes.
    found (FOUND,): takes what its columns are named for, works positive as a rule; where sliding first ends is infinite
    if it does not, and the number of steps negative if they did not suffice. Returns the points of the path.
    """
    normal, along, across = velocity[0], velocity[1], velocity[2]
    speed = math.hypot(along, across)
    c, d = (along / speed, across / speed) if speed > 0.0 else (1.0, 0.0)
    phase, left, work, start = COMPRESSES, 0.0, 0.0, 0.0  # of the phase: what is to be restored, the work, its first p
    found[:] = 0.0
    found[STOPPED], found[FOLLOWS] = math.inf, SLIP
    slides, points = speed > 0.0, _recorded(path, 0, 0.0, normal, along, across)
    if not slides:
        found[STOPPED] = 0.0
        found[FOLLOWS], c, d = _after_rest(felt)
    while phase != OVER and found[STEPS] < MAX_STEPS:
        found[STEPS] += 1
        follows = found[FOLLOWS]
        f, g, h = _rates(felt, c, d, follows)
        if f <= 0.0 and phase == COMPRESSES:
            found[JAMS] = 1.0
        before1, before2 = speed * c, speed * d
        if follows != SLIP or felt.friction == 0.0 or _is_straight(felt, c, d, g, h, speed):
            dp, event = _straight_end(felt, phase, left, normal, f)
            if slides and felt.friction > 0.0 and speed < -g * dp:
                dp, event = -speed / g, GOES_ON
            if dp == math.inf:
                break
            done = dp * (normal + 0.5 * f * dp)
            normal += f * dp
            c, d, speed = _straight_on(felt, c, d, speed, g, dp, event)
            push1, push2 = _straight_push(felt, c, d, dp, follows)
        else:
            t, event = _curved_end(felt, phase, left, series, _series(felt, c, d, speed, normal, series))
            points = _curve_recorded(path, points, found[IMPULSE], t, series)
            dp, done, normal = _at(series, P, t), _at(series, E, t), _at(series, WN, t)
            c, d, speed = _direction(series, t)
            push1 = (speed * c - before1 - felt.a1 * dp) / felt.b1  # from dw = W dP
            push2 = (speed * d - before2 - felt.a2 * dp) / felt.b2
        found[IMPULSE] += dp
        found[IMPULSE + 1] += push1
        found[IMPULSE + 2] += push2
        work += done
        if phase == RESTORES:
            left -= done if felt.law == STRONGE else dp
        if event != GOES_ON:
            phase, left = _next_phase(felt, phase, left, event, work, start, found)
            normal = normal if phase == OVER and found[IMPULSE] > found[COMPRESSION] else 0.0
            work, start = 0.0, found[IMPULSE]
        points = _recorded(path, points, found[IMPULSE], normal, speed * c, speed * d)
        if slides and speed == 0.0:
            slides = False
            found[STOPPED] = found[IMPULSE]
            found[FOLLOWS], c, d = _after_rest(felt)
    _conclude(felt, velocity, phase, found)
    return points


@inner_kernel
def _next_phase(felt, phase, left, event, work, start, found):
    """What comes after a phase in which the normal force did this work, and what is then to be restored."""
    if phase == COMPRESSES:
        found[COMPRESSION] = found[IMPULSE]
        found[COMPRESSED] -= work
        left -= felt.restitution**2 * work if felt.law == STRONGE else felt.restitution * (start - found[IMPULSE])
        return (RESTORES if left > 0.0 else OVER), left
    found[RESTORED] += work
    return (OVER if event == REACHED else COMPRESSES), left


@inner_kernel
def _conclude(felt, velocity, phase, found):
    """What is left to say at the end."""
    if felt.law == STRONGE:
        found[RESTORED] = felt.restitution**2 * found[COMPRESSED]  # as the impact ended, but for rounding
    worked = _worked(felt, velocity, found[IMPULSE], found[IMPULSE + 1], found[IMPULSE + 2])
    found[RUBBED] = max(found[RESTORED] - found[COMPRESSED] - worked, 0.0)
    if phase != OVER:
        found[STEPS] = -found[STEPS]


@inner_kernel
def clamp(felt, velocity, found):
    """The same by Newton's law: w_n turns to -e w_n, and the impulse sticks, or is cut off at the cone of friction.

    The direction is that of the impulse of sticking, (p, q): there 1 + |q| a . q / (p |q|) > 0 by sticking, so that the
    sum stays positive with any smaller friction, and an impulse exists where along the first sliding there may be none.
    """
    normal, along, across = velocity[0], velocity[1], velocity[2]
    rebound = -(1.0 + felt.restitution) * normal
    p = (rebound + felt.a1 / felt.b1 * along + felt.a2 / felt.b2 * across) / _sticking(felt)
    push1, push2 = -(along + felt.a1 * max(p, 0.0)) / felt.b1, -(across + felt.a2 * max(p, 0.0)) / felt.b2
    push = math.hypot(push1, push2)
    slips = push > felt.friction * p
    if slips:
        c, d = push1 / push, push2 / push
        p = rebound / (1.0 + felt.friction * (felt.a1 * c + felt.a2 * d))
        push1, push2 = felt.friction * c * p, felt.friction * d * p
    found[IMPULSE], found[IMPULSE + 1], found[IMPULSE + 2] = p, push1, push2
    found[COMPRESSION], found[STOPPED], found[FOLLOWS] = math.nan, math.inf if slips else 0.0, SLIP if slips else STICK
    found[COMPRESSED] = -0.5 * p * normal
    found[RESTORED] = felt.restitution * found[COMPRESSED]
    found[RUBBED] = found[RESTORED] - found[COMPRESSED] - _worked(felt, velocity, p, push1, push2)
    found[JAMS], found[STEPS] = 0.0, 1.0


@inner_kernel
def _worked(felt, velocity, p, push1, push2):
    """What an impulse adds to the kinetic energy: P . (w + W P / 2)."""
    w = velocity[0] + 0.5 * (p + felt.a1 * push1 + felt.a2 * push2)
    w1 = velocity[1] + 0.5 * (felt.a1 * p + felt.b1 * push1)
    w2 = velocity[2] + 0.5 * (felt.a2 * p + felt.b2 * push2)
    return p * w + push1 * w1 + push2 * w2


@inner_kernel
def _rates(felt, c, d, follows):
    """f, g and h for sliding along (c, d), or sticking."""
    if follows == STICK:
        return _sticking(felt), 0.0, 0.0
    mu, difference = felt.friction, felt.friction * (felt.b1 - felt.b2)
    f = 1.0 - mu * (felt.a1 * c + felt.a2 * d)
    g = felt.a1 * c + felt.a2 * d - mu * (felt.b1 * c * c + felt.b2 * d * d)
    h = felt.a2 * c - felt.a1 * d + difference * c * d
    return f, g, h


@inner_kernel
def _sticking(felt):
    """dw_n/dp without sliding, a Schur complement of W, and positive like W."""
    left = 1.0 - felt.a1**2 / felt.b1 - felt.a2**2 / felt.b2
    return max(left, 1e-15)


@inner_kernel
def _is_straight(felt, c, d, g, h, speed):
    """Whether the direction does not turn any more."""
    mu = felt.friction
    largest = abs(felt.a1) + abs(felt.a2) + mu * max(felt.b1, felt.b2)
    draws = g + mu * (felt.b1 * d * d + felt.b2 * c * c)  # -h' on a root
    return abs(h) <= max(ON_ROOT * largest, min(SETTLED / speed, COARSEST) * draws)


@inner_kernel
def _after_rest(felt):
    """What follows where sliding has stopped, and in which direction: it sticks if friction can hold it, or slides anew
    in the one direction along which it gains speed.

    That is s = (mu B + g)^-1 a of length 1 with g > 0, B being diag(b1, b2): the length falls as g grows, and
    1 / length is concave, so that Newton's method comes to the root from below without passing it.
    """
    mu = felt.friction
    if math.hypot(felt.a1 / felt.b1, felt.a2 / felt.b2) <= mu:
        return STICK, 1.0, 0.0
    c1, c2 = mu * felt.b1, mu * felt.b2
    g = max(abs(felt.a1) - c1, abs(felt.a2) - c2, 0.0)
    for _ in range(60):
        x, y = felt.a1 / (c1 + g), felt.a2 / (c2 + g)
        length = math.hypot(x, y)
        further = (length - 1.0) * length**2 / (x * x / (c1 + g) + y * y / (c2 + g))
        g += further
        if further <= 1e-16 * g:
            break
    x, y = felt.a1 / (c1 + g), felt.a2 / (c2 + g)
    length = math.hypot(x, y)
    return REVERSAL, x / length, y / length


@inner_kernel
def _straight_end(felt, phase, left, normal, f):
    """How much normal impulse is left of the phase where w_n changes at f, and what happens then."""
    if phase == COMPRESSES:
        return (-normal / f if f > 0.0 else math.inf), REACHED
    turns = -normal / f if f < 0.0 else math.inf
    if felt.law == POISSON:
        return (left, REACHED) if left <= turns else (turns, TURNS)
    square = normal * normal + 2.0 * f * left
    return (turns, TURNS) if square < 0.0 else (2.0 * left / (normal + math.sqrt(square)), REACHED)


@inner_kernel
def _straight_on(felt, c, d, speed, g, dp, event):
    """Direction and speed of sliding after dp; without friction it need not keep its direction."""
    if felt.friction == 0.0:
        along, across = speed * c + felt.a1 * dp, speed * d + felt.a2 * dp
        speed = math.hypot(along, across)
        return (along / speed, across / speed, speed) if speed > 0.0 else (c, d, 0.0)
    stops = event == GOES_ON or (speed == 0.0 and g == 0.0)
    return c, d, 0.0 if stops else max(speed + g * dp, 0.0)


@inner_kernel
def _straight_push(felt, c, d, dp, follows):
    """The tangential impulse beside dp."""
    if follows == STICK:
        return -felt.a1 / felt.b1 * dp, -felt.a2 / felt.b2 * dp
    return -felt.friction * c * dp, -felt.friction * d * dp


@inner_kernel
def _direction(x, t):
    """Direction and speed of sliding from the series; so slow is none."""
    c, d, speed = _at(x, C, t), _at(x, D, t), _at(x, S, t)
    size = math.hypot(c, d)
    return c / size, d / size, 0.0 if speed < STOPPED_SPEED else speed


@inner_kernel
def _series(felt, c, d, speed, normal, x):
    """Power series in t of all that sliding changes, and for how long they hold.

    Rows: direction (C, D), h, g, f, the speed S, w_n, p and the work E since now; CC and CD are products.
    """
    mu, difference = felt.friction, felt.friction * (felt.b1 - felt.b2)
    x[C, 0], x[D, 0], x[S, 0], x[WN, 0], x[P, 0], x[E, 0] = c, d, speed, normal, 0.0, 0.0
    for k in range(ORDER):
        cc = cd = 0.0
        for i in range(k + 1):
            cc += x[C, i] * x[C, k - i]
            cd += x[C, i] * x[D, k - i]
        driven = felt.a1 * x[C, k] + felt.a2 * x[D, k]
        x[H, k] = felt.a2 * x[C, k] - felt.a1 * x[D, k] + difference * cd
        x[G, k] = driven - difference * cc
        x[F, k] = -mu * driven
        if k == 0:
            x[G, 0] -= mu * felt.b2
            x[F, 0] += 1.0
        turn_c = turn_d = slows = parts = works = 0.0
        for i in range(k + 1):
            turn_c -= x[D, i] * x[H, k - i]
            turn_d += x[C, i] * x[H, k - i]
            slows += x[S, i] * x[G, k - i]
            parts += x[S, i] * x[F, k - i]
            works += x[S, i] * x[WN, k - i]
        n = k + 1.0
        x[C, k + 1], x[D, k + 1], x[S, k + 1] = turn_c / n, turn_d / n, slows / n
        x[WN, k + 1], x[P, k + 1], x[E, k + 1] = parts / n, x[S, k] / n, works / n
    x[F, ORDER] = 0.0
    holds, allowed = math.inf, min(TRUNCATION / speed, COARSEST)
    for k in (ORDER - 1, ORDER):
        last = max(abs(x[C, k]), abs(x[D, k]), abs(x[S, k]) / speed, abs(x[WN, k]) / speed)
        if last > 0.0:
            holds = min(holds, (allowed / last) ** (1.0 / k))
    return holds


@inner_kernel
def _at(x, row, t):
    """A series at t."""
    value = x[row, ORDER]
    for k in range(ORDER - 1, -1, -1):
        value = value * t + x[row, k]
    return value


@inner_kernel
def _crossing(x, row, level, low, high):
    """Where a series passes a level between `low` and `high`, on either side of it: Newton's method, kept inside."""
    rising = _at(x, row, high) > level
    t = 0.5 * (low + high)
    for _ in range(80):
        value, slope = x[row, ORDER], 0.0
        for k in range(ORDER - 1, -1, -1):
            slope = slope * t + value
            value = value * t + x[row, k]
        if (value > level) == rising:
            high = t
        else:
            low = t
        new = t - (value - level) / slope if slope != 0.0 else low
        if not low < new < high:
            new = 0.5 * (low + high)
        if abs(new - t) <= 1e-16 * high:
            return new
        t = new
    return t


@inner_kernel
def _curved_end(felt, phase, left, x, t):
    """The end of a step, or of the phase within it, and what happens then.

    w_n may rise and fall within a step: where it has an extremum, f = 0, that is looked at, too.
    """
    way = 1.0 if phase == COMPRESSES else -1.0  # a phase of compression ends as w_n rises, else it may as it falls
    first, last, middle, event = way * x[F, 0], way * _at(x, F, t), t, GOES_ON
    if first * last < 0.0:
        middle = _crossing(x, F, 0.0, 0.0, t)
    if first > 0.0 and way * _at(x, WN, middle) >= 0.0:
        t, event = _crossing(x, WN, 0.0, 0.0, middle), TURNS
    elif way * _at(x, WN, t) >= 0.0 and last > 0.0:
        t, event = _crossing(x, WN, 0.0, middle if first < 0.0 else 0.0, t), TURNS
    row = E if felt.law == STRONGE else P
    if phase == RESTORES and _at(x, row, t) >= left:
        return _crossing(x, row, left, 0.0, t), REACHED
    return t, event


@inner_kernel
def _recorded(path, points, p, normal, along, across):
    if points < len(path):
        path[points, 0], path[points, 1], path[points, 2], path[points, 3] = p, normal, along, across
    return min(points + 1, len(path))


@inner_kernel
def _curve_recorded(path, points, p, t, x):
    """Points within a step, as it is curved."""
    for k in range(1, 4):
        at = 0.25 * k * t
        speed = _at(x, S, at)
        points = _recorded(
            path, points, p + _at(x, P, at), _at(x, WN, at), speed * _at(x, C, at), speed * _at(x, D, at)
        )
    return points
