"""The contact force from gauges: what the exact waves put on the rod comes back out."""

import math

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import SceneError
from solvers.records.gauges import from_one_gauge, from_two_gauges
from solvers.records.record import Record, expected
from tests.catalog import SCENES, struck_rod

BALL = SCENES["bronze-rod-steel-ball"]
TRIP = BALL.target.round_trip_time
LONG = 4.0 * TRIP  # four passages of every echo
IMPACTS = {
    support: solvers.solve(BALL.replace({"target.support": support}), duration=LONG) for support in ("free", "fixed")
}
RIGID_IMPACT = solvers.solve(struck_rod(1.0, "fixed"), duration=4.0 * struck_rod().target.round_trip_time)


def gauge(solution, x, step, kind="strain", until=None):
    time = np.arange(0.0, until or solution.duration, step)
    return Record(time, expected(solution, kind, time, x), kind)


def error(waves, solution):
    """Relative L2 of the force."""
    true = solution.motion.force(waves.time)
    return np.linalg.norm(waves.force - true) / np.linalg.norm(true)


def smooth(t):
    """A wave of 200 us with four continuous derivatives [Pa]."""
    inside = (t > 0.0) & (t < 2e-4)
    return np.where(inside, 1e7 * np.sin(np.pi * t / 2e-4) ** 5, 0.0)


def echoing(rod, x, step):
    """Record at x of the smooth wave sent once and returned once, whatever the struck end does to it later."""
    reflection = {"free": -1.0, "fixed": 1.0, "anechoic": 0.0}[rod.support]
    lag = x / rod.wave_speed
    time = np.arange(0.0, 1.9 * TRIP, step)
    return Record(time, smooth(time - lag) + reflection * smooth(time - TRIP + lag), "stress")


# a corner of a Hertz pulse, F = K (v t)^1.5, is met to K (v h)^1.5 / 10 = 4 N of 5.6 kN; two in a wave, and again in
# every echo taken away, of which there are at most 24 in these records
CORNERS = 2e-3


@pytest.mark.parametrize("support", list(IMPACTS))
@pytest.mark.parametrize("x", [0.5, 1.0])
@pytest.mark.parametrize("kind", ["strain", "stress", "force"])
def test_one_gauge_gives_the_force_through_all_echoes(support, x, kind):
    found = from_one_gauge(gauge(IMPACTS[support], x, 1e-6, kind), IMPACTS[support].scene.target, x)
    assert error(found, IMPACTS[support]) < CORNERS
    assert found.time[-1] == approx(LONG - x / BALL.target.wave_speed, abs=2e-6)


def test_until_the_echo_comes_it_is_the_pulse_shifted_back():
    x, rod = 1.0, BALL.target
    record = gauge(IMPACTS["free"], x, 1e-6)
    found = from_one_gauge(record, rod, x)
    until_echo = found.time < 2.0 * (rod.length - x) / rod.wave_speed
    shifted = -rod.material.young * rod.area * np.interp(found.time + x / rod.wave_speed, record.time, record.values)
    assert found.force[until_echo] == approx(shifted[until_echo], rel=1e-12, abs=1e-9)


@pytest.mark.parametrize("support", list(IMPACTS))
@pytest.mark.parametrize("places", [(0.5, 1.0), (0.1, 1.3), (0.0, 0.7), (0.4, 1.48)])
def test_two_gauges_need_no_word_of_the_far_end(support, places):
    records = [gauge(IMPACTS[support], x, 1e-6) for x in places]
    found = from_two_gauges(*records, IMPACTS[support].scene.target, *places)
    assert error(found, IMPACTS[support]) < CORNERS


def test_two_gauges_find_any_wave_that_comes_back():
    rod, places, step = BALL.target, (0.3, 0.9), 1e-6
    time = np.arange(0.0, 3.0 * TRIP, step)

    def sent(t):
        return smooth(t) + 0.5 * smooth(t - 0.31 * TRIP)

    def returned(t):  # as from a mass on the far end, or a change of section, with echoes of its own
        return 0.7 * smooth(t - TRIP) - 0.4 * smooth(t - 1.13 * TRIP) + 0.2 * smooth(t - 1.9 * TRIP)

    records = [
        Record(time, sent(time - x / rod.wave_speed) + returned(time + x / rod.wave_speed), "stress") for x in places
    ]
    found = from_two_gauges(*records, rod, *places)
    true = sent(found.time) + returned(found.time)
    assert np.linalg.norm(found.force / rod.area - true) < 1e-3 * np.linalg.norm(true)
    assert np.abs(found.returned - returned(found.time)).max() < 2e-3 * true.max()


def test_gauges_need_not_be_sampled_alike():
    records = gauge(IMPACTS["free"], 0.5, 1e-6), gauge(IMPACTS["free"], 1.0, 1.7e-6)
    assert error(from_two_gauges(*records, BALL.target, 0.5, 1.0), IMPACTS["free"]) < 2 * CORNERS  # 1.7^1.5


@pytest.mark.parametrize("support", ["free", "fixed", "anechoic"])
@pytest.mark.parametrize("gauges", [1, 2])
def test_second_order_in_the_step_of_the_record(gauges, support):
    rod = BALL.replace({"target.support": support}).target
    reflection = {"free": -1.0, "fixed": 1.0, "anechoic": 0.0}[support]

    def miss(step):
        first, second = (echoing(rod, x, step) for x in (0.5, 1.0))
        waves = from_one_gauge(first, rod, 0.5) if gauges == 1 else from_two_gauges(first, second, rod, 0.5, 1.0)
        true = rod.area * (smooth(waves.time) + reflection * smooth(waves.time - TRIP))
        return np.linalg.norm(waves.force - true) / np.linalg.norm(true)

    # steps in the ratio 8, so that where the lags fall between samples (up to a factor 2 in the error) weighs little
    steps = 8e-6 / 8.0 ** np.arange(4)
    order = np.polyfit(np.log(steps), np.log([miss(step) for step in steps]), 1)[0]
    assert order == approx(2.0, abs=0.2)


def test_jumps_of_rigid_contact_are_blurred_by_a_step_only():
    rod, x = RIGID_IMPACT.scene.target, 0.1
    step = rod.round_trip_time / 2000.3
    found = from_one_gauge(gauge(RIGID_IMPACT, x, step), rod, x)
    true = RIGID_IMPACT.motion.force(found.time)
    wrong = np.abs(found.force - true) > 1e-3 * true.max()
    # jumps: start, return of the front, and what they leave behind; each within a step on either side
    assert wrong.sum() < 40 and wrong.mean() < 0.01


@pytest.mark.parametrize("gauges", [1, 2])
def test_force_and_motion_at_any_section(gauges):
    solution, rod = IMPACTS["free"], BALL.target
    records = [gauge(solution, x, 1e-6) for x in (0.5, 1.0)]
    found = from_one_gauge(records[0], rod, 0.5) if gauges == 1 else from_two_gauges(*records, rod, 0.5, 1.0)
    for x in (0.0, 0.3, 1.2):
        times, stress = found.stress(x)
        true = solution.motion.stress(times, np.array([x]))[:, 0]
        assert np.linalg.norm(stress - true) < 1e-3 * np.linalg.norm(true)
    true = solution.motion.end_velocity(found.time)
    assert np.linalg.norm(found.velocity - true) < 1e-3 * np.linalg.norm(true)


@pytest.mark.parametrize("gauges", [1, 2])
def test_white_noise_and_twelve_bits_stay_bounded(gauges):
    solution, rod = IMPACTS["free"], BALL.target
    places = (0.5, 1.0)
    random = np.random.default_rng(1)
    records, peak = [], 0.0
    for x in places:
        clean = gauge(solution, x, 1e-6)
        peak = float(np.abs(clean.values).max())
        bit = 2.0 * 1.2 * peak / 4096  # a range of +-1.2 of the peak
        noisy = clean.values + random.normal(0.0, 0.005 * peak, clean.values.size)
        records.append(Record(clean.time, bit * np.round(noisy / bit), "strain"))
    found = from_one_gauge(records[0], rod, 0.5) if gauges == 1 else from_two_gauges(*records, rod, *places)
    miss = found.force - solution.motion.force(found.time)
    level = 0.005 * peak * rod.material.young * rod.area
    apart = 2.0 * (rod.length - 0.5) if gauges == 1 else 0.5
    terms = found.time[-1] * rod.wave_speed / apart
    most = math.sqrt(2.0 * terms + (2.0 if gauges == 1 else 5.0))
    assert 0.3 * level < miss.std() < most * level  # the bound of the docstring; interpolation only damps noise
    assert np.abs(miss).max() < 6.0 * most * level


@pytest.mark.parametrize("support, factor", [("free", 2.0), ("fixed", 4.0)])
def test_white_noise_where_readings_coincide(support, factor):
    # at half the length D = T / 2: the waves that add up to the force are sums of the same readings
    rod = BALL.replace({"target.support": support}).target
    time = np.arange(4_000) * rod.round_trip_time / 1_000
    noise = np.random.default_rng(3).normal(size=time.size)
    found = from_one_gauge(Record(time, noise, "stress"), rod, 0.5 * rod.length)
    late = found.time > 3.0 * rod.round_trip_time
    terms = found.time[-1] / (0.5 * rod.round_trip_time) + 1.0
    spread = found.force[late].std() / rod.area
    assert spread < math.sqrt(factor * terms)
    if support == "fixed":  # the bound of the free end would not hold: most readings count twice
        assert spread > math.sqrt(2.0 * terms)


@pytest.mark.parametrize("bits, most", [(12, 2e-3), (8, 3e-2)])
def test_quantised_records_give_the_peak_and_the_impulse(bits, most):
    clean = gauge(IMPACTS["free"], 1.0, 1e-6)
    bit = 2.0 * np.abs(clean.values).max() / 2**bits
    found = from_one_gauge(Record(clean.time, bit * np.round(clean.values / bit), "strain"), BALL.target, 1.0)
    early = found.time < TRIP
    assert found.force[early].max() == approx(IMPACTS["free"].peak_force, rel=most)
    assert np.trapezoid(found.force[early], found.time[early]) == approx(IMPACTS["free"].impulse, rel=2 * most)


@pytest.mark.parametrize("gauges", [1, 2])
def test_an_offset_of_zero_does_not_run_away(gauges):
    solution, rod = IMPACTS["free"], BALL.target
    clean = [gauge(solution, x, 1e-6) for x in (0.5, 1.0)]
    off = Record(clean[0].time, clean[0].values + 1e-6, "strain")
    if gauges == 1:
        found, exact = from_one_gauge(off, rod, 0.5), from_one_gauge(clean[0], rod, 0.5)
        most = rod.length / (rod.length - 0.5) + 1.0  # T / D + 1
    else:
        found, exact = from_two_gauges(off, clean[1], rod, 0.5, 1.0), from_two_gauges(*clean, rod, 0.5, 1.0)
        most = 2.0 * 0.5 / 0.5 + 2.0
    level = 1e-6 * rod.material.young * rod.area
    assert np.abs(found.force - exact.force).max() <= most * level * (1.0 + 1e-9)


def test_what_is_measured_before_the_wave_can_come_is_noise():
    clean = gauge(IMPACTS["free"], 1.0, 1e-6)
    time = np.concatenate((np.arange(-100e-6, -0.5e-6, 1e-6), clean.time))
    values = np.concatenate((np.full(100, 1e-5), clean.values))
    values[(time >= 0.0) & (time < 0.99 / BALL.target.wave_speed)] = 1e-5
    found = from_one_gauge(Record(time, values, "strain"), BALL.target, 1.0)
    assert found.force == approx(from_one_gauge(clean, BALL.target, 1.0).force, abs=1e-6)


@pytest.mark.parametrize(
    "change, x, said",
    [
        ({}, -0.1, "at: got -0.1"),
        ({}, 1.6, "at: got 1.6"),
        ({}, 1.48, "at: got 1.48; allowed: at most 1.478"),
        ({"target.end_mass": 1.0}, 0.5, "two gauges"),
    ],
)
def test_one_gauge_that_does_not_cover_is_refused(change, x, said):
    record = gauge(IMPACTS["free"], 0.5, 1e-6)
    with pytest.raises(SceneError, match=said):
        from_one_gauge(record, BALL.replace(change).target, x)


def test_two_gauges_must_be_apart():
    record = gauge(IMPACTS["free"], 0.5, 1e-6)
    for x2 in (0.5, 0.4, 0.502):
        with pytest.raises(SceneError, match="one step of the records"):
            from_two_gauges(record, record, BALL.target, 0.5, x2)


def test_records_that_miss_the_wave_are_refused():
    clean = gauge(IMPACTS["free"], 1.0, 1e-6)
    late, early = clean.time > 350e-6, clean.time < 250e-6
    with pytest.raises(SceneError, match="The record begins at"):
        from_one_gauge(Record(clean.time[late], clean.values[late], "strain"), BALL.target, 1.0)
    with pytest.raises(SceneError, match="The record ends at"):
        from_one_gauge(Record(clean.time[early], clean.values[early], "strain"), BALL.target, 1.0)


def test_records_too_long_for_the_echoes_in_them_are_refused():
    rod, step = BALL.target, 2.5e-8
    time = np.arange(150_000) * step
    with pytest.raises(SceneError, match=r"rows; where 1.* echoes must be distinguished"):
        from_one_gauge(Record(time, np.sin(time), "strain"), rod, rod.length - 0.6 * step * rod.wave_speed)
