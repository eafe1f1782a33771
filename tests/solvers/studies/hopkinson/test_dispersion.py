"""Pulses that have been spread by dispersion, by a root search of the tests' own, are gathered again."""

import math

import numpy as np
import pytest
from pytest import approx
from scipy.integrate import solve_ivp
from scipy.ndimage import gaussian_filter1d

import solvers
from solvers import SceneError
from solvers.records import Record
from tests.solvers.numerics.test_pochhammer import surface
from tests.solvers.studies.hopkinson.bench import BARS as BENCH
from tests.solvers.studies.hopkinson.bench import SPEED, STEEL, measured

DIAMETER, POISSON, STEP = 0.03, 0.3, 2e-7
AREA, LENGTH = math.pi * 0.006**2, 0.008
BARS = {
    "incident": {"length": 3.0, "diameter": DIAMETER, "material": "steel", "gauge": 1.5},
    "transmitted": {"length": 3.0, "diameter": DIAMETER, "material": "steel", "gauge": 1.0},
    "specimen": {"length": LENGTH, "diameter": 0.012},
    "dispersion": "pochhammer",
}
TIME = np.arange(0.0, 1.6384e-3, STEP)
BEGIN = 0.1e-3  # s, at the incident gauge
ARRIVAL = BEGIN + 1.5 / SPEED


def slowness(frequency):
    """c0 / c of the first mode at omega a / c0, by halving on the stresses of the surface."""
    found, kappas = [1.0], np.linspace(0.0, 4.0, 401)
    for kappa in kappas[1:]:
        low, high = 0.55, found[-1] + 1e-9
        sign = surface(low, kappa, POISSON) > 0.0
        for _ in range(48):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if (surface(middle, kappa, POISSON) > 0.0) == sign else (low, middle)
        found.append(low)
    speed = np.array(found)
    return 1.0 / np.interp(frequency, kappas * speed, speed)


def moved(pulse, distance):
    """A pulse after so long a way [m]."""
    omega = 2.0 * np.pi * np.fft.rfftfreq(pulse.size, STEP)
    lag = slowness(0.5 * omega * DIAMETER / SPEED) * distance / SPEED
    return np.fft.irfft(np.fft.rfft(pulse) * np.exp(-1j * omega * lag), pulse.size)


def law(strain):
    """Elastic, then flowing [Pa]."""
    return 500e6 * np.tanh(strain / 0.006) + 1.5e9 * strain


@pytest.fixture(scope="module")
def test():
    """Strain over time of the specimen, and the records of both gauges."""
    sent = gaussian_filter1d(np.where((TIME > BEGIN) & (TIME < BEGIN + 1.2e-4), 1.2e-3, 0.0), 3e-6 / STEP)
    pulse = moved(sent, 1.5)  # at the specimen
    bar = math.pi * (0.5 * DIAMETER) ** 2

    def rate(time, strain):  # both bars are alike: reflected is transmitted less incident
        return 2.0 * SPEED * (np.interp(time, TIME, pulse) - law(strain) * AREA / (STEEL.young * bar)) / LENGTH

    solved = solve_ivp(rate, (0.0, TIME[-1]), [0.0], t_eval=TIME, max_step=1e-6, rtol=1e-9, atol=1e-12)
    strain = solved.y[0]
    through = law(strain) * AREA / (STEEL.young * bar)
    # windows end before the specimen would be let go
    fade = np.clip((ARRIVAL + 1.7e-4 - TIME) / 3e-5, 0.0, 1.0)
    through = through * np.sin(0.5 * np.pi * fade) ** 2
    one = sent + moved(through - pulse, 1.5)
    two = moved(through, 1.0)
    return strain, (Record(TIME, -one, "strain"), Record(TIME, -two, "strain"))


def error(found, strain):
    """Largest of the stresses by one, two and three waves, as shares of the peak."""
    inner = found.time < 1.1e-4
    true = law(np.interp(found.windows.start + 1.5 / SPEED + found.time[inner], TIME, strain))
    names = ("stress_one_wave", "stress_two_waves", "stress_three_waves")
    return [float(np.abs(getattr(found, name)[inner] - true).max() / true.max()) for name in names]


def test_spread_pulses_are_gathered(test):
    strain, records = test
    plain = error(solvers.hopkinson(records, BARS | {"dispersion": "none"}), strain)
    found = solvers.hopkinson(records, BARS)
    corrected = error(found, strain)
    print(plain, corrected)
    assert max(corrected) < 0.01 < 0.1 * max(plain)
    assert found.equilibrium < 0.005
    own = np.interp(found.windows.start + 1.5 / SPEED + found.time, TIME, strain)
    inner = found.time < 1.1e-4
    assert found.strain[inner] == approx(own[inner], abs=2e-4)


def test_a_pulse_with_waves_of_higher_modes_is_refused():
    thick = {name: BENCH[name] | {"diameter": 0.08} for name in ("incident", "transmitted")}
    bars = BENCH | thick | {"dispersion": "pochhammer"}
    with pytest.raises(SceneError) as error:
        solvers.hopkinson(measured(1e-7), bars)
    assert (error.value.key, error.value.reason.code) == ("dispersion", "allowed.first-mode")
    assert error.value.reason.values["frequency"] == approx(2.376 * SPEED / (math.pi * 0.08) / 1e3, rel=1e-3)
    assert solvers.hopkinson(measured(1e-7), BENCH | {"dispersion": "pochhammer"}).bars.dispersion == "pochhammer"
