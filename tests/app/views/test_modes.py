"""The modes of what is struck, as the page shows them."""

import json
import math

import pytest
from pytest import approx

from app.choices.scene_of import own_choices
from app.views.modes import MOST, modes_data, of_modes
from tests.app.sentences import sentence


def found(scene, **more):
    return json.loads(modes_data(own_choices(scene) | more))


@pytest.mark.parametrize("scene", ["fixed-rod", "free-rod", "hammer-on-cantilever", "figure-8.15", "xylophone-bar"])
def test_every_mode_has_a_shape_a_frequency_a_mass_and_a_share(scene):
    answer = found(scene)
    alone = answer["sets"]["alone"]
    count = min(MOST, answer["kept"])
    assert [len(alone[key]) for key in ("number", "frequency", "mass", "shape")] == [count] * 4
    assert len(answer["share"]) == len(answer["amplitude"]) == count
    assert len(alone["shape"][0]) == len(answer["place"]) and len(answer["amplitude"][0]) == len(answer["time"])
    assert alone["frequency"] == sorted(alone["frequency"]) and 0.0 <= sum(answer["share"]) < 100.001
    for shape in alone["shape"]:
        assert max(map(abs, shape)) == approx(1.0, abs=0.02)  # at the places that are sent


def test_all_modes_kept_have_all_of_the_vibration():
    assert sum(found("fixed-rod", modes=6)["share"]) == approx(100.0, abs=1e-3)


def test_a_mass_that_stays_on_the_rod_slows_its_modes():
    for scene in ("fixed-rod", "free-rod", "figure-8.15"):
        sets = found(scene, law="rigid")["sets"]
        pairs = list(zip(sets["together"]["frequency"], sets["alone"]["frequency"], strict=True))
        assert all(both < alone for both, alone in pairs)
    assert found("fixed-rod", law="hertz")["sets"]["together"] is None


def test_a_free_rod_in_another_frame_has_other_modes():
    """Those of shapes clamped at the struck end, by so many: they tend to the same."""
    own = found("free-rod", modes=5)["sets"]["alone"]
    other = found("free-rod", modes=5, floating_frame="attached")["sets"]["alone"]
    assert own["frequency"][0] == approx(other["frequency"][0], rel=1e-2)
    assert abs(own["frequency"][4] / other["frequency"][4] - 1.0) > 1e-2


def test_a_rod_that_turns_has_the_frequencies_of_its_speed():
    frequencies = [2.0 * math.pi * each for each in found("figure-5.21")["sets"]["alone"]["frequency"][:3]]
    assert frequencies == approx([26860.0, 80942.0, 134952.0], rel=1e-4)  # (5.48), at a tenth of the critical speed
    across = found("figure-5.22")
    assert across["sets"]["alone"]["frequency"][0] * 2.0 * math.pi > 1744.0  # that at rest: the tension outweighs


def test_a_beam_has_the_frequencies_of_the_other_theory_beside_its_own():
    """Thesis table 8.3, whose headings are exchanged: its sixth mode, 148495 and 105040 rad/s; shapes of one sign."""
    timoshenko, bernoulli = found("figure-8.12"), found("figure-8.12", theory="euler-bernoulli")
    for own, other, theory in ((timoshenko, bernoulli, "euler-bernoulli"), (bernoulli, timoshenko, "timoshenko")):
        beside = own["beside"]
        assert beside["theory"] == theory
        assert beside["frequency"] == approx(other["sets"]["alone"]["frequency"], rel=1e-5)
        for shape, known in zip(beside["shape"], other["sets"]["alone"]["shape"], strict=True):
            assert shape == approx(known, abs=1e-4)
    assert 2.0 * math.pi * timoshenko["beside"]["frequency"][5] == approx(148495.0, rel=1e-4)
    assert 2.0 * math.pi * timoshenko["sets"]["alone"]["frequency"][5] == approx(105040.0, rel=1e-4)


def test_modes_beside_have_the_numbers_of_those_shown_and_rods_have_none():
    bar = found("xylophone-bar")  # struck in its middle: every other mode rests there
    ratios = [b / a for a, b in zip(bar["sets"]["alone"]["frequency"], bar["beside"]["frequency"], strict=True)]
    assert ratios == sorted(ratios, reverse=True) and ratios[0] > 0.98  # shear lowers the shorter waves the more
    assert found("fixed-rod")["beside"] is None and found("figure-5.22")["beside"] is None


def test_what_has_no_modes_says_so():
    assert "no modes with a shape" in sentence(found("two-balls")["error"])
    assert found("stepped-rod")["error"]["code"] == "refusals.chain-of-rods"
    assert found("rod-with-end-mass")["error"]["code"] == "refusals.open-rod"


def test_it_does_not_depend_on_the_method_that_solves_the_impact():
    own = own_choices("fixed-rod")
    assert of_modes(own) == of_modes(own | {"method": "fe-nodal", "elements": 9})
    assert of_modes(own) != of_modes(own | {"modes": 9})
