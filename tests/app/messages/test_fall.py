"""What a message says of a body that is dropped: its bounces, and its height over time."""

import numpy as np
import pytest

import solvers
from app.messages.encoding import read_header
from app.messages.solve import solve_frame

from ..strangers import named
from .own import arrays, own_choices


@pytest.mark.parametrize("restitution", [0.5, 0.8, 0.95])
def test_the_ball_bounces_by_the_series_and_rests(restitution):
    message = solve_frame(own_choices("bouncing-ball") | {"restitution": restitution})
    fall, found = read_header(message)["fall"], arrays(message)
    time, impulse, height, each = found["bounces"].T
    mass = solvers.load("bouncing-ball").impactor.mass
    first = np.sqrt(2.0 * fall["height"] / fall["gravity"])
    count = np.arange(time.size)
    assert fall["rest"] == pytest.approx(first * (1 + restitution) / (1 - restitution), rel=1e-4)
    assert height == pytest.approx(restitution ** (2 * (count + 1)), rel=1e-4)
    speed = fall["gravity"] * first * restitution**count
    assert impulse == pytest.approx(mass * (1 + restitution) * speed, rel=1e-4)
    assert each == pytest.approx(restitution, rel=1e-4)
    assert found["fallHeight"].max() == pytest.approx(fall["height"], rel=1e-6)
    assert np.interp(time, found["fallTime"], found["fallHeight"]) == pytest.approx(0.0, abs=1e-3)


def test_a_ball_that_yields_rises_less_the_harder_it_falls():
    *_, restitution = arrays(solve_frame(own_choices("drop-test")))["bounces"].T
    assert np.all(np.diff(restitution) > 0.0)


def test_every_impact_has_its_own_force():
    message = solve_frame(own_choices("drop-test"))
    found = arrays(message)
    assert len(message) < 100_000
    for (_, peak), force in zip(found["touches"].tolist(), found["touchForce"], strict=True):
        assert force.max() == pytest.approx(peak, rel=1e-3) and force[[0, -1]] == pytest.approx(
            [0.0, 0.0], abs=2e-3 * peak
        )
    impulse = np.trapezoid(found["touchForce"], axis=1) * found["touches"][:, 0] / (found["touchForce"].shape[1] - 1)
    assert impulse == pytest.approx(found["bounces"][:, 1], rel=2e-3)
    alone = solvers.solve(solvers.load("drop-test"))
    assert found["touches"][0] == pytest.approx((alone.contacts[-1].end, alone.peak_force), rel=1e-3)


def test_impacts_without_duration_have_no_force():
    assert "touchForce" not in arrays(solve_frame(own_choices("bouncing-ball")))


def test_a_rod_that_is_dropped_is_shown_without_bounces():
    rod = 'kind = "rod"\nlength = 0.2\nmaterial = "steel"\nsection = { width = 0.02, height = 0.02 }'
    text = f'[impactor]\n{rod}\nheight = 0.1\n[target]\n{rod}\nsupport = "fixed"\n'
    header = read_header(solve_frame(own_choices(named(text))))
    assert header["exact"]["contacts"] and "fall" not in header


def test_what_is_not_dropped_has_no_fall():
    assert "fall" not in read_header(solve_frame(own_choices("sphere-on-half-space")))
