"""How a rod stretches as it turns, for the page."""

import json

import numpy as np
from pytest import approx

from app.choices.scene_of import own_choices
from app.views.stretch import PLACES, SPEEDS, of_turning_rods, stretch_data


def test_figures_5_23_and_5_24():
    """u(x) = sin(k x) / (k cos k L) - x, and of the end L (tan a / a - 1)."""
    slow, fast = (json.loads(stretch_data(own_choices(f"figure-5.{k}"))) for k in (23, 24))
    assert (slow["own"][1], fast["own"][1]) == approx((0.830666, 27.3239545), rel=1e-5)
    assert slow["half"] == approx(0.6877, abs=5e-5)
    assert len(slow["place"]) == len(slow["moved"]) == PLACES and slow["moved"][-1] == approx(2.492, rel=1e-3)
    angles = 0.5 * np.pi * SPEEDS[1:]
    assert fast["end"][1:] == approx((100.0 * (np.tan(angles) / angles - 1.0)).tolist(), rel=1e-5)
    assert fast["own"][0] / fast["critical"] == approx(0.5, rel=1e-4)


def test_it_is_asked_of_rods_that_turn_and_are_struck_along():
    assert of_turning_rods(own_choices("figure-5.24")) == ("figure-5.24", "")
    for scene in ("figure-5.22", "fixed-rod"):
        assert of_turning_rods(own_choices(scene)) is None
