"""Spectra as the page shows them."""

import json

import numpy as np
import pytest
from pytest import approx

from app.choices.scene_of import own_choices
from app.views.spectrum import FORCE, spectrum_data
from solvers import load, solve


def found(scene, **more):
    asked = {"spectrum_of": FORCE, "spectrum_place": 1.0} | more
    return json.loads(spectrum_data(own_choices(scene) | asked))


@pytest.mark.parametrize("scene", ["fixed-rod", "two-balls", "hammer-on-cantilever"])
def test_a_force_holds_its_impulse_at_no_frequency(scene):
    answer = found(scene)
    assert (answer["what"], answer["unit"], answer["window"], answer["place"]) == (FORCE, "N s", "none", None)
    impulse = solve(load(scene)).impulse
    for line in answer["lines"]:
        assert line["values"][0] == approx(impulse, rel=0.02) and len(line["values"]) == len(answer["frequency"])


def test_a_place_is_read_by_both_solutions_beside_the_frequencies_of_the_rod():
    """Odd quarters of c / L of a fixed one; waves and modes say the same but for what is left out."""
    answer = found("fixed-rod", spectrum_of="displacement", spectrum_place=0.5)
    rod = load("fixed-rod").target
    assert answer["natural"][:3] == approx(np.array([1, 3, 5]) * rod.wave_speed / (4.0 * rod.length), rel=1e-4)
    assert (answer["unit"], answer["window"], answer["place"]) == ("m", "hann", 0.15)
    assert [line["name"] for line in answer["lines"]] == ["waves", "modal"]
    exact, modes = (np.array(line["values"]) for line in answer["lines"])
    assert np.abs(exact - modes).max() < 0.02 * exact.max()


def test_a_struck_link_is_read_beside_the_frequencies_of_the_mechanism_as_it_stands():
    """A clamped bar at constant speed; at its axis the shear force is what that bears."""
    answer = found("rotating-bar", spectrum_of="shear_force", spectrum_place=0.0)
    frequencies = load("rotating-bar").target.frozen.modes.excited().frequencies / (2.0 * np.pi)
    assert answer["what"] == "shear_force" and answer["place"] == 0.0
    assert answer["natural"] == approx(frequencies[: len(answer["natural"])], rel=1e-4) and answer["natural"]
    values, frequency = np.array(answer["lines"][0]["values"]), np.array(answer["frequency"])
    strongest = frequency[int(np.argmax(values))]
    assert np.abs(frequencies - strongest).min() < 2.0 / answer["duration"]  # the width of a line under the window
    assert found("four-bar-moves", spectrum_of="bending_moment")["natural"] == []  # they change as it turns


def test_a_method_without_a_force_over_time_does_not_take_that_of_the_other():
    answer = found("fixed-rod", method="rigid")
    assert answer["what"] == FORCE and [line["name"] for line in answer["lines"]] == ["waves"]


def test_what_a_scene_lacks_is_not_asked():
    assert "bending_moment" in found("hammer-on-cantilever")["kinds"]
    answer = found("two-balls", spectrum_of="stress")
    assert answer["what"] == FORCE and answer["kinds"] == [FORCE, "impactor_velocity"] and answer["natural"] == []
