"""Exact waves against an independent integration of the delay equation, which is good for 1e-9."""

import math

import numpy as np
import pytest
from pytest import approx
from scipy.integrate import solve_ivp

from solvers import Scene, Waves
from tests.catalog import T, bronze_rod, contact_table, struck_rod


def reference_impact_on_a_fixed_rod(
    beta: float, fall: float = 0.0, until: float = math.inf
) -> tuple[list[list[float]], float]:
    """Contacts (start, end) / T and final velocity / v, by the method of steps with DOP853.

    Touching: v1' = g - 2 beta (v1 + 2 s_in), s = v1 + s_in; apart: gap' = v1 + 2 s_in, s = -s_in; s_in(t) = s(t - 1);
    g: `fall` [v / T].
    """
    pieces = []  # (start, end, s)

    def sent(t):
        for start, end, wave in reversed(pieces):
            if start <= t <= end:
                return wave(t)
        return 0.0

    def integrate(rate, begin, end, state, event):
        event.terminal = True
        inside = np.nextafter(begin, end), np.nextafter(end, begin)  # the delayed wave must not be read past a jump
        return solve_ivp(
            lambda t, y: rate(min(max(t, inside[0]), inside[1]), y), (begin, end), state,
            method="DOP853", rtol=1e-13, atol=1e-15, max_step=0.025, dense_output=True, events=event,
        )  # fmt: skip

    t, v1, gap, touching = 0.0, 1.0, 0.0, True
    contacts, breaks = [[0.0, math.nan]], {1.0}
    while t < until and (until < math.inf or touching or v1 > 0.0 or t < contacts[-1][1] + 2.0):
        following = min(until, *(b for b in breaks if b > t + 1e-13))
        breaks.add(following + 1.0)
        if touching:

            def pressure(t, y):
                return y[0] + 2.0 * sent(t - 1.0)

            pressure.direction = -1
            run = integrate(lambda t, y: [fall - 2.0 * beta * pressure(t, y)], t, following, [v1], pressure)
            end, v1 = float(run.t[-1]), float(run.y[0, -1])
            pieces.append((t, end, lambda t, mass=run.sol: float(mass(t)[0]) + sent(t - 1.0)))
        else:

            def gap_closes(t, y):
                return y[0]

            gap_closes.direction = 1
            run = integrate(lambda t, y: [y[1] + 2.0 * sent(t - 1.0), fall], t, following, [gap, v1], gap_closes)
            end, (gap, v1) = float(run.t[-1]), run.y[:, -1].tolist()
            pieces.append((t, end, lambda t: -sent(t - 1.0)))
        t = end
        if run.status == 1:  # an event, and it will return
            breaks.add(t + 1.0)
            if touching:
                contacts[-1][1] = t
            else:
                contacts.append([t, math.nan])
            touching, gap = not touching, 0.0
    return contacts, v1


@pytest.mark.slow
@pytest.mark.parametrize("beta", [0.1, 0.4, 0.75, 1.0, 1.3, 2.0, 3.0, 4.5, 6.0])
def test_fixed_rod_against_an_independent_integration(beta):
    contacts, final = reference_impact_on_a_fixed_rod(beta)
    solution = Waves().solve(struck_rod(beta, "fixed"))
    found = [(contact.start / T, contact.end / T) for contact in solution.contacts]
    assert np.array(found) == approx(np.array(contacts), abs=1e-9)
    assert solution.impactor_velocity == approx(final, abs=1e-9)


def test_the_independent_integration_sees_second_contacts():
    """Else the comparison above would say nothing about them."""
    assert {len(reference_impact_on_a_fixed_rod(beta)[0]) for beta in (0.4, 1.0)} == {1, 2}


def reference_first_contact(scene: Scene) -> tuple[float, float, float]:
    """End of the first contact [s], velocity then [m/s] and peak force [N], of an elastic law.

    x1' = v1, v1' = g - F / m1, u' = (F + 2 sum_k r^k F(t - k T)) / Z with r = +1 free, -1 fixed: the whole rod.
    """
    law, rod, m1 = scene.contact, scene.target, scene.impactor.mass
    trip, r = rod.round_trip_time, -1.0 if rod.fixed else 1.0
    runs = []

    def force_at(t):
        run = runs[min(int(t / trip), len(runs) - 1)]
        x, _, u = run.sol(t)
        return law.force(x - u, 0.0, 0.0)

    def rate(t, y):
        force = law.force(y[0] - y[2], 0.0, 0.0)
        echoes = sum(r**k * force_at(t - k * trip) for k in range(1, len(runs) + 1) if t > k * trip)
        return [y[1], scene.weight_acceleration - force / m1, (force + 2.0 * echoes) / rod.impedance]

    def parting(t, y):
        return y[0] - y[2]

    parting.terminal, parting.direction = True, -1
    state, k = [0.0, scene.impactor.velocity, 0.0], 0
    depth = scene.impactor.velocity * trip
    while True:
        run = solve_ivp(
            rate, (k * trip, (k + 1) * trip), state, method="DOP853", rtol=1e-13,
            atol=[1e-16 * depth, 1e-16, 1e-16 * depth], max_step=trip / 400, dense_output=True, events=parting,
        )  # fmt: skip
        runs.append(run)
        state, k = run.y[:, -1], k + 1
        if run.status == 1:
            times = np.concatenate([np.linspace(r.t[0], r.t[-1], 4001) for r in runs])
            return float(run.t[-1]), float(state[1]), max(force_at(float(t)) for t in times)


@pytest.mark.slow
@pytest.mark.parametrize(
    "scene",
    [
        bronze_rod(),
        struck_rod(1.0, "fixed", contact_table("hertz", softness=1.0)),  # the echo comes back while they touch
        struck_rod(0.5, "free", contact_table("hertz", softness=4.0)),
        struck_rod(2.0, "fixed", contact_table("linear", softness=2.0)),
    ],
    ids=["bronze", "hertz-fixed", "hertz-free", "linear-fixed"],
)
def test_first_contact_with_a_law_against_an_independent_integration(scene):
    end, velocity, peak = reference_first_contact(scene)
    solution = Waves(tolerance=1e-12).solve(scene)
    first, speed = solution.contacts[0], scene.impactor.velocity
    assert first.end == approx(end, rel=1e-9)
    assert first.impulse == approx(scene.impactor.mass * (speed - velocity), rel=1e-9)
    assert first.peak_force == approx(peak, rel=1e-6)  # the reference is sampled: (pi / 4000)^2
