"""Choices: bounds that hold, addresses that are read with care."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.choices.built_in import keyed
from app.choices.choices import Choices, accepts, refusal
from app.choices.request import Request
from app.choices.scene_of import acting_choices, choices_of, chosen_scene, own_choices
from app.messages.solutions import beside
from app.page.address import from_address
from solvers.accuracy.reference import exact_solution


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, -1.0, 0.0, 1e-4, 1e4, 10**40, "1", None, True, [1.0]])
def test_a_mass_ratio_out_of_bounds_is_not_accepted(value):
    assert not accepts("mass_ratio", value)
    sentence = str(refusal("mass_ratio", value))
    assert sentence.startswith("Mass ratio: ")
    assert sentence.endswith(" is not possible. Choose a number from 0.001 to 1000.")


@pytest.mark.parametrize("value", [1.5, 0, 201, "50", True, None])
def test_modes_are_whole_numbers(value):
    assert not accepts("modes", value)


def test_an_address_sets_a_scene_first_and_then_the_rest():
    kept, refused = from_address({"modes": [b"20"], "speed": [b"3"], "scene": [b"bronze-rod-steel-ball"]})
    assert refused == []
    assert kept["law"] == "hertz"
    assert kept["speed"] == 3.0
    assert kept["modes"] == 20


def test_another_support_in_an_address_moves_the_impact_to_where_the_beam_is_free():
    kept, _ = from_address({"scene": [b"hammer-on-cantilever"], "support": [b"pinned-pinned"]})
    assert kept["place"] == 0.5
    kept, _ = from_address({"scene": [b"hammer-on-cantilever"], "support": [b"pinned-pinned"], "place": [b"1"]})
    assert kept["place"] == 1.0  # asked for, and so refused where it is solved


@given(
    st.dictionaries(st.sampled_from([*Choices.CHOSEN, "x"]), st.lists(st.binary(max_size=60), min_size=1, max_size=2))
)
def test_no_address_breaks_anything_or_is_echoed(arguments):
    kept, refused = from_address(arguments)
    Choices(**kept)
    for sentence in map(str, refused):
        assert "<" not in sentence
        assert "\n" not in sentence


def test_of_a_beam_only_the_resolution_that_the_method_goes_by_is_shown():
    scene = "hammer-on-cantilever"
    for method, shown in (("balance", ["elements"]), ("fe-nodal", ["elements"]), ("modal", ["modes"]), ("rigid", [])):
        acting = acting_choices(Choices(scene=scene, **choices_of(scene) | {"method": method}).chosen())
        assert [name for name in ("modes", "elements") if name in acting] == shown


def test_a_value_of_scene_files_acts_where_a_body_takes_it():
    chosen = own_choices("figure-5.24") | {"damping": 0.05}
    assert "damping" in acting_choices(chosen)
    assert chosen_scene(chosen).target.damping == 0.05
    assert "damping" not in acting_choices(own_choices("fixed-rod"))


def answered(scene: str, **changed) -> float:
    """Velocity of the impactor by the method beside the exact solution [m/s]."""
    request = Request.of(own_choices(scene) | changed)
    found = beside(request, exact_solution(request.scene, request.restitution))
    assert found is not None and found.impactor_velocity is not None
    return found.impactor_velocity


def test_frame_and_shapes_are_chosen_where_modes_are_shown():
    """Thesis 10.2: -1.018 m/s by clamped and -1.009 m/s by free modes; 10.3: 6.282 and 6.302 rad/s, see figure 10.9."""
    assert own_choices("figure-10.2")["floating_frame"] == "attached"
    assert answered("figure-10.2") == pytest.approx(-1.0195, abs=1e-4)
    assert answered("figure-10.2", floating_frame="mean-axis") == pytest.approx(-1.0089, abs=1e-4)
    assert answered("figure-10.8") / 0.19 == pytest.approx(-6.282, abs=1e-3)
    assert answered("figure-10.8", shapes="clamped-free") == pytest.approx(answered("figure-10.9"), rel=1e-9)
    for scene, name in (("figure-10.2", "floating_frame"), ("figure-10.8", "shapes")):
        assert name in acting_choices(own_choices(scene))
        assert name not in acting_choices(own_choices(scene) | {"method": "fe-nodal"})
    for scene in ("fixed-rod", "stepped-rod", "rigid-pendulum", "figure-8.15"):
        assert not {"floating_frame", "shapes"} & set(acting_choices(own_choices(scene)))


def test_a_mass_that_is_set_at_an_end_counts_in_the_mass_ratio(monkeypatch):
    """And it acts where the support allows it, not in every scene with such a body."""
    monkeypatch.setattr(Choices, "KEYS", {"slenderness": "target.end_mass"})
    keyed.cache_clear()
    try:
        assert not keyed("fixed-rod", "")
        chosen = own_choices("free-rod") | {"slenderness": 2.0, "mass_ratio": 3.0}
        scene = chosen_scene(chosen)
    finally:
        keyed.cache_clear()
    assert scene.target.end_mass == 2.0
    assert scene.mass_ratio == pytest.approx(3.0, rel=1e-12)
