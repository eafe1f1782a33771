"""Records of a specimen of known law give that law back."""

import math

import numpy as np
import pytest
from pytest import approx

import solvers
from solvers import SceneError
from solvers.records import Record
from tests.solvers.studies.hopkinson.bench import AREA, BARS, LENGTH, SPEED, STEEL, law_stress, measured

YIELDS = 10e-6  # s, by which the specimen yields
IMPEDANCE = STEEL.density * SPEED * math.pi * 0.01**2
CURVES = ("stress_one_wave", "stress_two_waves", "stress_three_waves")


def noisy(records, peak=2e-3, bits=16, noise=0.0, seed=0):
    """With white noise, a zero of its own, and so many bits over twice +-peak."""
    bit = 4.0 * peak / 2**bits
    random = np.random.default_rng(seed)
    found = []
    for record, zero in zip(records, (3e-5, -2e-5), strict=True):
        values = record.values + zero + random.normal(0.0, noise, record.values.size)
        found.append(Record(record.time, bit * np.round(values / bit), record.kind))
    return tuple(found)


@pytest.mark.parametrize("step", [1e-7, 1e-6])
def test_the_law_that_was_put_in_comes_back(step):
    """A jump is blurred over one step, in which the specimen is strained by rate times step."""
    found = solvers.hopkinson(measured(step), BARS)
    inner = (found.time > YIELDS) & (found.time < 98e-6)
    slope = 2e9 * 1050.0 * step  # of stress, in one step
    for name in CURVES:
        stress = getattr(found, name)[inner]
        assert np.abs(stress - law_stress(found.strain[inner])).max() < 1.5 * slope
    assert found.notes == () and found.equilibrium < 0.01 and abs(found.momentum) < 0.01
    assert found.peak_stress == approx(found.stress_one_wave.max())


def test_the_rate_is_what_the_striker_leaves_after_pressing_both_bars():
    """v = rate L + 2 F / Z, as both bars are alike and the striker is as thick as they are."""
    found = solvers.hopkinson(measured(1e-7), BARS)
    inner = (found.time > YIELDS) & (found.time < 98e-6)
    force = law_stress(found.strain) * AREA
    rate = (15.4 - 2.0 * force / IMPEDANCE) / LENGTH
    assert found.strain_rate_history[inner] == approx(rate[inner], rel=2e-4)
    plateau = found.strain_rate_history[found.plateau]
    assert found.strain_rate == approx(plateau.mean()) and plateau.min() < found.strain_rate < plateau.max()
    # of the law alone: strain over time by its own equation
    strain, own = 0.0, []
    for _ in range(10_000):  # 100 us
        rate = (15.4 - 2.0 * float(law_stress(np.array(strain))) * AREA / IMPEDANCE) / LENGTH
        strain += 1e-8 * rate
        own.append(strain)
    begins = 0.75 / SPEED - found.windows.start
    assert np.interp(begins + 99e-6, found.time, found.strain) == approx(own[9899], abs=2.0 * 1050.0 * 1e-7)


def test_the_striker_and_where_the_pulses_are():
    found = solvers.hopkinson(measured(1e-7), BARS)
    striker = found.striker()
    assert striker is not None
    assert striker["expected_strain"] == approx(15.4 / (2.0 * SPEED)) == approx(striker["strain"], rel=1e-6)
    assert striker["expected_duration"] == approx(2.0 * 0.258 / SPEED) == approx(striker["duration"], abs=2e-7)
    first, second, third = found.windows.starts(found.bars)
    assert first == approx(0.75 / SPEED - 0.05 * 0.1e-3, abs=2e-7)
    assert (second - first, third - first) == approx((1.5 / SPEED, 1.25 / SPEED))
    off = solvers.hopkinson(measured(1e-6), BARS | {"striker": {"length": 0.29, "velocity": 17.0}})
    assert [note.values["what"] for note in off.notes if note.code == "hopkinson.striker"] == ["strain", "duration"]


def test_a_thicker_striker_sends_more():
    bars = BARS | {"striker": {"length": 0.2, "velocity": 10.0, "diameter": 0.04, "material": "bronze"}}
    striker = solvers.hopkinson(measured(1e-6), bars).striker()
    bronze = solvers.MATERIALS["bronze"]
    own = math.sqrt(bronze.young * bronze.density) * 0.04**2
    other = math.sqrt(STEEL.young * STEEL.density) * 0.02**2
    assert striker is not None
    assert striker["expected_strain"] == approx(10.0 * own / (own + other) / SPEED)


@pytest.mark.parametrize("waves", [1, 2, 3])
def test_bits_and_noise_leave_what_they_are_said_to(waves):
    clean = solvers.hopkinson(measured(1e-6), BARS, waves=waves)
    noise = 1e-5
    spread = []
    for seed in range(12):
        found = solvers.hopkinson(noisy(measured(1e-6), noise=noise, seed=seed), BARS, waves=waves)
        inner = slice(5, 90)
        unsure = found.uncertainty()
        spread.append(found.stress[inner] - np.interp(found.time, clean.time, clean.stress)[inner])
        assert found.windows.incident.noise == approx(noise, rel=0.35)
        assert found.windows.incident.offset == approx(3e-5, abs=4e-6)
        assert found.strain[90] == approx(clean.strain[90], abs=4.0 * unsure["strain"] + 2.0 * 1050.0 * 1e-6)
    name = CURVES[waves - 1]
    assert np.std(spread) == approx(unsure[name], rel=0.35)
    assert ("hopkinson.noisy" in [note.code for note in found.notes]) == (unsure[name] > 0.05 * 4.1e8)


def test_bits_alone_are_noise():
    coarse = noisy(measured(1e-6), bits=8)
    found = solvers.hopkinson(coarse, BARS)
    assert found.windows.incident.noise == approx(4.0 * 2e-3 / 2**8 / math.sqrt(12.0))
    assert found.strain_rate == approx(solvers.hopkinson(measured(1e-6), BARS).strain_rate, rel=0.01)


def test_a_record_of_stress_or_force_is_one_of_strain():
    one, two = measured(1e-6)
    area = math.pi * 0.01**2
    stress = tuple(Record(each.time, -STEEL.young * each.values, "stress") for each in (one, two))
    force = tuple(Record(each.time, -STEEL.young * area * each.values, "force") for each in (one, two))
    own = solvers.hopkinson((one, two), BARS)
    for records in (stress, force):
        assert solvers.hopkinson(records, BARS).strain == approx(own.strain, abs=1e-12)


def test_tension_is_compression_with_the_other_sign():
    turned = tuple(Record(each.time, -each.values, "strain") for each in measured(1e-6))
    own, found = solvers.hopkinson(measured(1e-6), BARS), solvers.hopkinson(turned, BARS)
    assert found.stress == approx(own.stress) and found.strain == approx(own.strain)
    assert [note.code for note in found.notes] == ["hopkinson.tension"]
    assert found.true_strain == approx(np.log(1.0 + own.strain))
    assert own.true_strain == approx(-np.log(1.0 - own.strain))
    assert own.true_stress == approx(own.stress * (1.0 - own.strain))


def test_bars_of_other_material_and_size_take_their_own_impedance():
    """The same forces and velocities of the faces, as another pair of bars would show them."""
    time = np.arange(0.0, 1.2e-3, 1e-7)
    shape = np.clip((time - 1e-4) / 20e-6, 0.0, 1.0) * np.clip((2.2e-4 - time) / 20e-6, 0.0, 1.0)
    bronze = solvers.MATERIALS["bronze"]
    slow = math.sqrt(bronze.young / bronze.density)
    bars = {
        "incident": {"length": 2.0, "diameter": 0.02, "material": "steel", "gauge": 1.0},
        "transmitted": {"length": 1.6, "diameter": 0.016, "material": "bronze", "gauge": 0.3},
        "specimen": {"length": 0.005, "diameter": 0.008},
    }
    force = 2e4 * shape  # the same at both faces
    areas = math.pi * 0.01**2, math.pi * 0.008**2
    incident = 1e-3 * shape
    reflected = force / (STEEL.young * areas[0]) - incident
    transmitted = force / (bronze.young * areas[1])
    rate = (SPEED * (incident - reflected) - slow * transmitted) / 0.005
    # at the specimen at time + 1 m / SPEED
    one = incident + np.interp(time - 2.0 / SPEED, time, reflected)
    two = np.interp(time - 1.0 / SPEED - 0.3 / slow, time, transmitted)
    found = solvers.hopkinson((Record(time, -one, "strain"), Record(time, -two, "strain")), bars)
    middle = np.searchsorted(found.time, 60e-6)
    for name in CURVES:
        assert getattr(found, name)[middle] == approx(2e4 / (math.pi * 0.004**2), rel=1e-9)
    assert found.strain_rate_history[middle] == approx(rate.max(), rel=1e-9)
    own = np.interp(found.time + found.windows.start, time, rate)
    assert found.strain_rate_history == approx(own, abs=1e-3 * rate.max())  # corners are blurred over a step


def test_windows_may_be_given():
    found = solvers.hopkinson(measured(1e-6), BARS, start=140e-6, window=60e-6)
    assert (found.windows.start, found.windows.length) == (140e-6, 60e-6)
    assert found.time[-1] == approx(60e-6)
    assert np.interp(50e-6, found.time, found.strain) == approx(1050.0 * 44e-6, rel=0.05)


def test_what_is_off_is_said():
    one, two = measured(1e-6)
    weak = Record(two.time, 0.9 * two.values, "strain")
    found = solvers.hopkinson((one, weak), BARS)
    assert [note.code for note in found.notes] == ["hopkinson.no-equilibrium", "hopkinson.momentum"]
    assert found.momentum == approx(1.0 / 0.9 - 1.0, abs=0.01) and found.equilibrium == approx(0.1 / 0.95, abs=0.01)
    slow = BARS | {"incident": BARS["incident"] | {"wave_speed": 0.95 * SPEED}}
    (note,) = [each for each in solvers.hopkinson((one, two), slow).notes if each.code == "hopkinson.arrival"]
    assert note.values["speed"] == approx(SPEED, rel=0.01) and note.values["late"] is False


def test_an_echo_from_the_end_of_a_bar_cuts_the_windows():
    bars = BARS | {"transmitted": BARS["transmitted"] | {"gauge": 1.3}}
    one, two = measured(1e-6)
    found = solvers.hopkinson((one, two), bars)
    (note,) = [each for each in found.notes if each.code == "hopkinson.cut"]
    assert note.values["why"] == "transmitted" and found.windows.length == approx(0.4 / SPEED)
    short = tuple(Record(each.time[:500], each.values[:500], "strain") for each in (one, two))
    (note,) = [each for each in solvers.hopkinson(short, BARS).notes if each.code == "hopkinson.cut"]
    assert note.values["why"] == "record"


def refused(records, bars, **how):
    with pytest.raises(SceneError) as error:
        solvers.hopkinson(records, bars, **how)
    assert "\n" not in str(error.value) and len(str(error.value)) < 400
    return error.value


def test_pulses_that_overlap_are_refused_with_what_would_do():
    bars = BARS | {"incident": BARS["incident"] | {"gauge": 0.2}}
    time = measured(1e-6)[0].time
    stress = solvers_stress(time, 1.3)
    error = refused((Record(time, stress, "strain"), measured(1e-6)[1]), bars)
    assert (error.key, error.value) == ("incident.gauge", 0.2)
    values = error.reason.values
    assert values["needed"] == approx(0.258) and values["striker"] == approx(0.2) and values["known"] is True
    bare = {name: table for name, table in bars.items() if name != "striker"}
    assert refused((Record(time, stress, "strain"), measured(1e-6)[1]), bare).reason.values["known"] is False


def solvers_stress(time, x):
    from tests.solvers.studies.hopkinson.bench import solution

    return -solution().known_motion.stress(time, np.array([x]))[:, 0] / STEEL.young


def test_records_that_show_too_little_are_refused():
    one, two = measured(1e-6)

    def cut(first, last):
        return tuple(Record(each.time[first:last], each.values[first:last], "strain") for each in (one, two))

    assert refused(cut(0, 430), BARS).reason.code == "record.refused.hopkinson-short"
    assert refused(cut(140, 800), BARS).reason.code == "record.refused.hopkinson-quiet"
    assert refused(cut(0, 100), BARS).reason.code == "record.refused.constant"
    loud = noisy((one, two), noise=3e-4)
    assert refused(loud, BARS).reason.code == "record.refused.hopkinson-noise"
    short = BARS | {"specimen": {"length": 1e-4, "diameter": 0.01}}
    assert refused((one, two), short).reason.code == "record.refused.hopkinson-gone"
    assert refused((one, two), BARS, start=400e-6).key == "start"
    assert refused((one, two), BARS, window=1.0).key == "window"
    assert refused((one, two), BARS, waves=4).key == "waves"
    far = BARS | {"transmitted": BARS["transmitted"] | {"gauge": 1.5}}
    assert refused((one, two), far).reason.values["why"] == "transmitted"
    at_face = BARS | {"incident": BARS["incident"] | {"gauge": 0.0}}
    assert refused((one, two), at_face).key == "incident.gauge"
    coarse = tuple(Record(each.time[::10], each.values[::10], "strain") for each in (one, two))
    assert refused(coarse, BARS).reason.code == "record.refused.hopkinson-steps"


@pytest.mark.parametrize("seed", range(40))
@pytest.mark.parametrize("dispersion", ["none", "pochhammer"])
def test_any_record_is_reduced_or_refused(seed, dispersion):
    random = np.random.default_rng(seed)
    count = int(random.integers(8, 2000))
    time = np.cumsum(random.uniform(0.1e-6, 1.5e-6) * random.uniform(0.5, 1.5, count))
    steps = random.normal(0.0, 1e-3, (2, count)) * (random.random((2, count)) < random.choice([0.002, 0.02, 1.0]))
    values = np.cumsum(steps, axis=1) * (time > random.uniform(-1.0, 1.0) * time[-1])
    bars = BARS | {"dispersion": dispersion}
    bars |= {"incident": BARS["incident"] | {"gauge": random.uniform(0.0, 1.5)}}
    try:
        found = solvers.hopkinson(tuple(Record(time, each, "strain") for each in values), bars)
    except SceneError as error:
        assert "\n" not in str(error) and "nan" not in str(error)
    else:
        table = found.table()
        assert all(np.isfinite(curve).all() for curve in table["stress_strain"].values())
        assert all(str(note) for note in found.notes)
