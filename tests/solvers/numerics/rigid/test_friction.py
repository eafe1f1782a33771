"""Impulses with friction: closed forms, a tight integration, work and energy, extremes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pytest import approx
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from solvers.numerics.rigid.friction import NEWTON, Rubbed, felt_inverse, jamming_friction, rub, sliding_path
from solvers.numerics.rigid.impulses import Bodies, gained, inverse_inertia, kinetic_energy, point_velocity, strike
from solvers.numerics.rigid.sliding import POISSON, REVERSAL, SLIP, STICK, STRONGE
from tests.solvers.numerics.rigid.test_impulses import held, in_world, random_pairs, rotations

LAWS = {"stronge": STRONGE, "poisson": POISSON, "newton": NEWTON}
WALL = Bodies(np.array(np.inf), np.zeros((3, 3)), np.zeros(3), np.zeros(3), np.zeros(3))
UP = np.array([0.0, 1.0, 0.0])  # away from a floor: the normal of a body that falls on it points down


def created(before: tuple[Bodies, Bodies], found: Rubbed) -> np.ndarray:
    """What the impacts add to the kinetic energy, relative."""
    first = sum(kinetic_energy(body) for body in before)
    return (kinetic_energy(found.first) + kinetic_energy(found.second)) / first - 1.0


def on_floor(felt: tuple[float, float, float], velocity: tuple[float, float], friction: float, e: float, law: int):
    """A body in a plane with n W n, n W t and t W t of 1/m + y^2/I and so on: c = (x, y) from the floor, m = I = 1."""
    x, y = felt[0], felt[1]
    body = Bodies(np.array(1.0), np.eye(3), np.array([x, y, 0.0]), np.array([*velocity, 0.0]), np.zeros(3))
    return rub(body, WALL, -UP, friction, e, law)


# --- closed forms in a plane ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_without_friction_it_is_the_impulse_without_friction(law):
    first, second, normal, restitution = random_pairs(1)
    found, plain = rub(first, second, normal, 0.0, restitution, law), strike(first, second, normal, restitution)
    assert np.abs(found.impulse - plain.impulse[:, None] * normal).max() <= 1e-12 * plain.impulse.max()
    assert np.vecdot(found.impulse, normal) == approx(plain.impulse, rel=1e-12)
    assert found.first.spin == approx(plain.first.spin, rel=1e-12, abs=1e-12)
    assert found.effective_mass == approx(plain.effective_mass, rel=1e-12)


@pytest.mark.parametrize("friction, sticks", [(0.1, False), (0.5, True)])
def test_a_ball_on_the_floor_slides_or_grips(friction, sticks):
    """W is 1/m along the normal and 7 / (2 m) across, so that sliding at u stops after an impulse of 2/7 m u."""
    mass, radius, spin = 0.1, 0.03, 120.0
    ball = Bodies(
        np.array(mass),
        0.4 * mass * radius**2 * np.eye(3),
        radius * UP,
        np.array([1.0, -3.0, 0.0]),
        np.array([0, 0, spin]),
    )
    found = rub(ball, WALL, -UP, friction, 0.8)
    slides, pressed = 1.0 + radius * spin, 1.8 * mass * 3.0
    assert found.impulse[1] == approx(-pressed, rel=1e-14)
    stops = 2.0 / 7.0 * mass * slides
    assert found.impulse[0] == approx(stops if sticks else friction * pressed, rel=1e-13)
    assert found.follows == (STICK if sticks else SLIP)
    assert found.stopped == (approx(stops / friction, rel=1e-13) if sticks else np.inf)
    assert found.rubbed == approx(
        0.5 * stops * slides if sticks else friction * pressed * (slides - 3.5 / mass * 0.5 * friction * pressed),
        rel=1e-12,
    )


PLANE = [  # x and y of the centre from the floor (m = I = 1), velocity of the contact, friction: what it does
    ((0.9, 0.3), (0.1, -1.0), 0.15, REVERSAL, False),
    ((0.9, 0.3), (-0.1, -1.0), 0.9, STICK, False),
    ((0.9, 0.3), (0.4, -1.0), 0.1, SLIP, False),
    ((0.5, 2.0), (-1.0, -1.0), 1.6, STICK, True),  # jams
]


@pytest.mark.parametrize("place, velocity, friction, follows, jams", PLANE)
@pytest.mark.parametrize("law", [STRONGE, POISSON])
def test_in_a_plane_it_is_the_piecewise_linear_solution(place, velocity, friction, follows, jams, law):
    """Written out: w(p) is linear up to where sliding stops, and from there on; work is its integral."""
    e, (x, y) = 0.6, place
    a, b, c = 1.0 + x * x, -x * y, 1.0 + y * y  # n W n, n W t, t W t of the body's own point
    s = np.sign(velocity[0])
    slopes = a - friction * s * b, b - friction * s * c  # of the point's velocity up and along, per impulse up
    stops = -velocity[0] / slopes[1] if slopes[1] * s < 0.0 else np.inf
    if abs(b) <= friction * c:
        then, push = (a - b * b / c, 0.0), -b / c
    else:
        push = -friction * np.sign(b)
        then = a + push * b, b + push * c
    points = [(0.0, velocity[1], 0.0)]  # p, velocity up, work so far

    def reach(p, f):
        p0, w, work = points[-1]
        return p, w + f * (p - p0), work + (w + 0.5 * f * (p - p0)) * (p - p0)

    def run_to(goal):  # goal(p, w, work) grows through zero
        for f, end in ((slopes[0], stops), (then[0], 1e3)):
            if end <= points[-1][0]:
                continue
            if goal(*reach(end if np.isfinite(end) else 1e3, f)) >= 0.0:
                points.append(
                    reach(brentq(lambda p, f=f: goal(*reach(p, f)), points[-1][0], min(end, 1e3), xtol=1e-15), f)
                )
                return
            points.append(reach(end, f))

    run_to(lambda p, w, work: w)
    bottom, _, compressed = points[-1]
    run_to(
        (lambda p, w, work: work - compressed * (1.0 - e * e))
        if law == STRONGE
        else (lambda p, w, work: p - bottom * (1 + e))
    )
    p = points[-1][0]
    found = on_floor(place, velocity, friction, e, law)
    along = -friction * s * min(p, stops) + push * max(p - stops, 0.0)
    assert found.impulse == approx([-along, -p, 0.0], rel=1e-12, abs=1e-12)
    assert found.compression == approx(bottom, rel=1e-12)
    assert (found.follows, bool(found.jams)) == (follows, jams)
    assert found.stopped == approx(stops if stops < p else np.inf, rel=1e-12)


def painleves_rod(angle: float, falls: float) -> Bodies:
    """A thin rod, 1 kg and 1 m, its lower end sliding to the left at 1 m/s."""
    along = np.array([np.cos(angle), np.sin(angle), 0.0])
    inertia = (np.eye(3) - np.outer(along, along)) / 12.0
    return Bodies(np.array(1.0), inertia, 0.5 * along, np.array([-1.0, -falls, 0.0]), np.zeros(3))


def test_a_rod_jams_where_painleve_says():
    """A thin rod at tan a = 2: friction above (1 + 3 cos^2 a) / (3 sin a cos a) = 4/3 presses the sliding end down."""
    rod, friction = painleves_rod(np.arctan(2.0), 0.5), np.array([1.333, 1.334])
    assert jamming_friction(rod, WALL, -UP) == approx(4.0 / 3.0, rel=1e-14)
    found = rub(rod, WALL, -UP, friction, 0.5)
    assert list(found.jams) == [False, True]
    assert found.stopped == approx(
        1.0 / (friction * 3.4 - 1.2), rel=1e-10
    )  # t W t = 1 + 3 sin^2 a, n W t = 3 sin a cos a


@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("angle", [0.6, np.arctan(2.0), 1.4])
def test_a_rod_that_only_slides_is_thrown_up_where_it_jams(angle, e):
    """Painlevé's impact without approach, in closed form; without a jam nothing happens.

    Up to p_s, where sliding stops, the end is pressed down at f < 0; then it sticks and comes up at f'. The work
    until it is deepest is f p_s^2 / 2 - (f p_s)^2 / (2 f'), of which e^2 is given back.
    """
    rod, s, c = painleves_rod(angle, 0.0), np.sin(angle), np.cos(angle)
    normal, coupled, across = 1.0 + 3.0 * c * c, 3.0 * s * c, 1.0 + 3.0 * s * s  # n W n, n W t, t W t of a thin rod
    least = normal / coupled
    assert jamming_friction(rod, WALL, -UP) == approx(least, rel=1e-14)
    found = rub(rod, WALL, -UP, np.array([0.0, 0.999 * least]), e)
    assert not found.impulse.any() and not found.jams.any()
    friction = 1.2 * least
    f, sticks = normal - friction * coupled, normal - coupled**2 / across
    stops = 1.0 / (friction * across - coupled)
    deepest = stops - f * stops / sticks
    work = 0.5 * (f * stops) ** 2 / sticks - 0.5 * f * stops**2
    ends = {STRONGE: deepest + e * np.sqrt(2.0 * work / sticks), POISSON: (1.0 + e) * deepest}
    for law, end in ends.items():
        found = rub(rod, WALL, -UP, friction, e, law)
        assert found.jams and found.follows == STICK
        assert (found.stopped, found.compression, -found.impulse[1]) == approx((stops, deepest, end), rel=1e-12)
        assert found.impulse[0] == approx(-friction * stops - coupled / across * (end - stops), rel=1e-12)
        assert found.compressed == approx(work, rel=1e-12)
        assert created((rod, WALL), found) < 0.0
        if law == STRONGE:
            assert found.restored == approx(e * e * work, rel=1e-12, abs=1e-16)
    clamped = rub(rod, WALL, -UP, friction, e, NEWTON)  # knows no course: it sticks, and does not part
    assert np.abs(point_velocity(clamped.first)).max() < 1e-14 and created((rod, WALL), clamped) < 0.0


def test_an_impact_without_approach_is_the_limit_of_slow_ones():
    """First order in the approach; and it is found in axes in which the approach is a rounding error."""
    friction, limit = 1.6, rub(painleves_rod(np.arctan(2.0), 0.0), WALL, -UP, 1.6, 0.5)
    errors = [
        np.linalg.norm(rub(painleves_rod(np.arctan(2.0), falls), WALL, -UP, friction, 0.5).impulse - limit.impulse)
        for falls in (1e-3, 1e-4, 1e-5)
    ]
    assert np.diff(np.log10(errors)) == approx([-1.0, -1.0], abs=0.01)
    rod = painleves_rod(np.arctan(2.0), 0.0)
    for turn in rotations(np.random.default_rng(51), 30):
        drift = turn @ np.array([7.0, 0.0, 3.0])  # of both bodies: the floor moves along
        turned = rod._replace(
            inertia=turn @ rod.inertia @ turn.T, centre=turn @ rod.centre, velocity=turn @ rod.velocity + drift
        )
        found = rub(turned, WALL._replace(velocity=drift), -turn @ UP, friction, 0.5)
        assert turn.T @ found.impulse == approx(limit.impulse, rel=1e-10, abs=1e-12)


# --- in space, against a tight integration ----------------------------------------------------------------------------


def integrated(matrix, velocity, friction, restitution, law):
    """P by DOP853 over p, on axes with the normal first; what follows the end of sliding by a plain root."""
    a, b = matrix[0, 1:], matrix[1:, 1:]

    def rates(_, state):
        push = -friction * state[1:3] / np.hypot(*state[1:3])
        return [*(matrix @ [1.0, *push]), state[0]]

    if np.linalg.norm(np.linalg.solve(b, a)) <= friction:
        push = -np.linalg.solve(b, a)
    else:

        def way(g):
            return np.linalg.solve(friction * b + g * np.eye(2), a)

        push = -friction * way(brentq(lambda g: np.linalg.norm(way(g)) - 1.0, 0.0, 2.0 * np.linalg.norm(a), xtol=1e-16))
    straight = matrix @ [1.0, *push]
    p, state, slides, goal = 0.0, np.array([*velocity, 0.0]), True, None

    def done(p, state):
        if goal is None:
            return state[0]
        return state[3] - goal if law == STRONGE else p - goal

    while True:
        if slides:
            ends = [lambda p, y: done(p, y), lambda p, y: np.hypot(y[1], y[2]) - 1e-11]
            for each in ends:
                each.terminal = True
            found = solve_ivp(rates, (p, p + 1e4), state, "DOP853", rtol=1e-13, atol=1e-15, events=ends)
            p, state = found.t[-1], found.y[:, -1].copy()
            if found.t_events[1].size:
                slides, state[1:3] = False, 0.0
                continue
        else:
            if goal is None:
                q = -state[0] / straight[0]
            elif law == POISSON:
                q = goal - p
            else:
                q = (np.sqrt(state[0] ** 2 + 2.0 * straight[0] * (goal - state[3])) - state[0]) / straight[0]
            state[3] += q * (state[0] + 0.5 * straight[0] * q)
            state[:3] += q * straight
            p += q
        if goal is not None:
            return np.linalg.solve(matrix, state[:3] - velocity)
        goal = state[3] * (1.0 - restitution**2) if law == STRONGE else p * (1.0 + restitution)


@pytest.mark.parametrize("law", [STRONGE, POISSON])
def test_against_a_tight_integration(law):
    first, second, normal, restitution = random_pairs(11, 40)
    restitution, friction = 0.05 + 0.95 * restitution, 10.0 ** np.random.default_rng(12).uniform(-1.5, 0.5, 40)
    found = rub(first, second, normal, friction, restitution, law)
    assert {int(each) for each in found.follows} == {SLIP, STICK, REVERSAL}
    for k in range(40):
        pair = [Bodies(*(part[k] for part in bodies)) for bodies in (first, second)]
        matrix = sum(felt_inverse(body, inverse_inertia(body)) for body in pair)
        frame = np.linalg.svd(normal[k][None])[2] * np.sign(normal[k] @ np.linalg.svd(normal[k][None])[2][0])
        velocity = frame @ (point_velocity(pair[1]) - point_velocity(pair[0]))
        expected = integrated(frame @ matrix @ frame.T, velocity, friction[k], restitution[k], law) @ frame
        assert np.linalg.norm(found.impulse[k] - expected) <= 1e-8 * np.linalg.norm(expected)


@pytest.mark.parametrize("law", [STRONGE, POISSON])
def test_sliding_in_space_that_jams_against_a_tight_integration(law):
    """Pairs whose approach is taken away: above the friction of `jamming_friction` they have an impact all the same."""
    first, second, normal, _ = random_pairs(13, 60)
    approach = np.vecdot(normal, point_velocity(first) - point_velocity(second))
    first = first._replace(velocity=first.velocity - approach[:, None] * normal)
    least = jamming_friction(first, second, normal)
    jams = np.flatnonzero(least < 10.0)[:5]
    below, found = (rub(first, second, normal, times * np.minimum(least, 10.0), 0.5, law) for times in (0.999, 1.3))
    assert not below.impulse.any() and len(jams) == 5
    assert np.all((found.steps > 0) == (1.3 * np.minimum(least, 10.0) > least))
    assert created((first, second), found).max() <= 1e-12
    for k in jams:
        pair = [Bodies(*(part[k] for part in bodies)) for bodies in (first, second)]
        matrix = sum(felt_inverse(body, inverse_inertia(body)) for body in pair)
        frame = np.linalg.svd(normal[k][None])[2] * np.sign(normal[k] @ np.linalg.svd(normal[k][None])[2][0])
        velocity = frame @ (point_velocity(pair[1]) - point_velocity(pair[0]))
        velocity[0] = -1e-9  # what the integration needs to set out
        expected = integrated(frame @ matrix @ frame.T, velocity, 1.3 * least[k], 0.5, law) @ frame
        assert np.linalg.norm(found.impulse[k] - expected) <= 1e-7 * np.linalg.norm(expected)


# --- work, energy, cone -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_balances_of_momentum_and_energy(law):
    first, second, normal, restitution = random_pairs(21)
    friction = np.random.default_rng(22).uniform(0.0, 1.5, len(normal))
    found = rub(first, second, normal, friction, restitution, law)
    both = held(first) + held(second)
    for residual in gained((first, second), (found.first, found.second), found.impulse):
        assert np.max(np.linalg.norm(residual, axis=1) / both) < 1e-12
    assert created((first, second), found) == approx(
        -(found.lost + found.rubbed) / (kinetic_energy(first) + kinetic_energy(second)), abs=1e-12
    )
    pressed = np.vecdot(found.impulse, normal)
    across = np.linalg.norm(found.impulse - pressed[:, None] * normal, axis=1)
    assert np.all(across <= friction * pressed * (1.0 + 1e-9))
    parting = np.vecdot(normal, point_velocity(found.second) - point_velocity(found.first))
    assert np.all(parting >= -1e-12 * found.approach)
    stuck = found.follows == STICK
    sliding = point_velocity(found.second) - point_velocity(found.first) - parting[:, None] * normal
    assert stuck.sum() > 50 and np.abs(sliding[stuck]).max() < 1e-9
    if law == STRONGE:
        assert found.restored == approx(restitution**2 * found.compressed, rel=1e-12)
    if law == POISSON:
        assert pressed == approx((1.0 + restitution) * found.compression, rel=1e-12)
    if law == NEWTON:
        assert parting == approx(restitution * found.approach, rel=1e-9)
        assert created((first, second), found).max() > 0.1  # what is wrong with it
    else:
        assert np.all(found.rubbed >= 0.0) and np.all(found.steps > 0)


def extreme_bodies(random: np.random.Generator, count: int) -> Bodies:
    """Twelve decades of mass; from balls to needles, of which one moment is a millionth of the others."""
    mass, spread = 10.0 ** random.uniform(-6.0, 6.0, count), 100.0 ** random.uniform(-3.0, 0.0, (count, 3))
    moments = mass[:, None] * (spread.sum(axis=1, keepdims=True) - spread)
    return Bodies(mass, in_world(moments, rotations(random, count)), *random.standard_normal((3, count, 3)))


@given(
    seed=st.integers(0, 2**32 - 1),
    friction=st.one_of(st.just(0.0), st.floats(0.0, 2.0), st.floats(0.0, 1e6)),
    restitution=st.one_of(st.just(0.0), st.just(1.0), st.floats(0.0, 1.0)),
)
@settings(max_examples=60, deadline=None)
def test_restitution_of_energy_makes_none(seed, friction, restitution):
    random = np.random.default_rng(seed)
    first, second = extreme_bodies(random, 50), extreme_bodies(random, 50)
    normal = rotations(random, 50)[:, 0]
    approach = np.vecdot(normal, point_velocity(first) - point_velocity(second))
    approach[25:] = 0.0  # the others only slide
    for each in (first, second):
        each.velocity[25:] -= np.vecdot(normal, point_velocity(each))[25:, None] * normal[25:]
    found = rub(first, second, normal, friction, restitution)
    assert created((first, second), found).max() <= 1e-12
    assert np.all(found.steps >= 0) and np.isfinite(found.impulse).all()
    assert np.all(found.approach[25:] == 0.0)
    starts = np.where(np.arange(50) < 25, approach > 0.0, friction > jamming_friction(first, second, normal))
    assert np.all((found.steps > 0) == starts)


def test_rest_starts_and_ends():
    """Nothing slides at first: it sticks, or sets out on the isoclinic; with e = 0 it ends where it is deepest."""
    body = Bodies(np.array(1.0), np.eye(3), np.array([0.9, 0.3, 0.2]), np.array([0.0, -1.0, 0.0]), np.zeros(3))
    rough, smooth = rub(body, WALL, -UP, 0.5, 0.5), rub(body, WALL, -UP, 0.05, 0.0)
    assert (rough.follows, rough.stopped) == (STICK, 0.0)
    assert np.linalg.norm(np.cross(point_velocity(rough.first), UP)) < 1e-15
    assert (smooth.follows, smooth.stopped) == (REVERSAL, 0.0)
    slid = point_velocity(smooth.first)
    assert abs(slid[1]) < 1e-15
    across = smooth.impulse + smooth.compression * UP
    assert across == approx(0.05 * smooth.compression * slid / np.linalg.norm(slid), rel=1e-12)


def test_bodies_that_part_are_left_alone():
    first, second, normal, restitution = random_pairs(31, 10)
    found = rub(first, second, -normal, 0.5, restitution)
    assert not found.impulse.any() and not found.rubbed.any()
    assert np.array_equal(found.first.spin, first.spin)


def test_nothing_that_moves_is_refused():
    with pytest.raises(ValueError, match="immovable"):
        rub(WALL, WALL, UP, 0.5, 0.5)


def test_the_path_of_sliding_leads_from_the_first_velocity_to_the_last():
    first, second, normal, restitution = random_pairs(41, 8)
    for k in range(8):
        pair = [Bodies(*(part[k] for part in bodies)) for bodies in (first, second)]
        found = rub(*pair, normal[k], 0.3, restitution[k])
        path, frame = sliding_path(*pair, normal[k], 0.3, float(restitution[k]), STRONGE, 600)
        ends = (pair, (found.first, found.second))
        for row, (one, other) in zip((path[0], path[-1]), ends, strict=True):
            assert row[1:] @ frame == approx(point_velocity(other) - point_velocity(one), rel=1e-9, abs=1e-9)
        assert np.all(np.diff(path[:, 0]) >= 0.0) and path[-1, 0] == approx(found.impulse @ normal[k], rel=1e-12)
