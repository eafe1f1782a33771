"""Contact laws as kernels of the browser take them: constants without units, and how they grow."""

import pytest

from app.choices.choices import Choices
from app.choices.laws import law_choices
from app.choices.scene_of import chosen_scene, own_choices
from app.messages.laws import Units, law_fields, laws_of_a_rod
from solvers.contact import LAWS
from solvers.contact.damping import OF_KERNELS
from solvers.scenes.library import scene_of

BEAMS = ("hammer-on-cantilever", "xylophone-bar")


def chosen(name: str, **other) -> dict:
    return Choices(**own_choices(name) | {"scene": name} | other).chosen()


def laws_of(choices: dict) -> dict[str, dict]:
    scene = chosen_scene(choices)
    found = law_fields(scene, choices, Units(1.0, 1.0)) if scene.bends else laws_of_a_rod(scene, choices)
    return {law["name"]: law for law in found}


@pytest.mark.parametrize("name", ["fixed-rod", "free-rod", "bronze-rod-steel-ball", *BEAMS])
@pytest.mark.parametrize("law", [law for law in LAWS if law not in ("rigid", "lee-wang")])
def test_a_message_tells_the_constants_of_laws_at_other_choices(name, law):
    before = chosen(name)
    after = before | {"law": law, "speed": 3.7 * before["speed"], "mass_ratio": 0.31, "restitution": 0.37}
    known = laws_of(before)[law]
    stiffness = known["stiffness"]
    if stiffness:
        after[stiffness] = 1.9 * before[stiffness]
    scene, other = chosen_scene(before), chosen_scene(after)
    felt = other.reduced_mass / scene.reduced_mass
    harder = 1.9 if stiffness else 1.0
    found = [
        value * 3.7**by_speed * felt**by_mass * harder**by_stiffness
        for value, by_speed, by_mass, by_stiffness in zip(
            *(known[part] for part in ("constants", "bySpeed", "byMass", "byStiffness")), strict=True
        )
    ]
    if known["damps"]:
        place, unit = known["damping"]
        number_for, nominal = OF_KERNELS[law]
        powers = 3.7 ** known["bySpeed"][place] * felt ** known["byMass"][place] * harder ** known["byStiffness"][place]
        found[place] = number_for(0.37) * unit * powers
        known["nominal"] = nominal(number_for(0.37))
    expected = laws_of(after)[law]
    assert found == pytest.approx(expected["constants"], rel=1e-9)
    for part in ("damps", "yields", "exponent", "choices"):
        assert known[part] == expected[part]
    assert known["nominal"] == pytest.approx(expected["nominal"])
    assert known["choices"] == law_choices(law)


def test_a_law_whose_damping_takes_an_integration_is_told_where_it_acts():
    assert "lee-wang" not in laws_of(chosen("fixed-rod"))
    assert laws_of(chosen("fixed-rod", law="lee-wang"))["lee-wang"]["damps"]


def test_a_law_of_the_scene_itself_has_no_stiffness_that_would_change_more():
    scene = scene_of("fixed-rod").replace(
        {"contact": {"law": "plastic-power", "stiffness": 1e10, "yield_indentation": 1e-6, "full_indentation": 1e-4}}
    )
    law = next(law for law in laws_of_a_rod(scene, chosen("fixed-rod")) if law["name"] == "plastic-power")
    assert law["stiffness"] is None
    assert len(law["constants"]) == 5


def test_what_is_no_mass_on_one_rod_has_none():
    for name in ("hammer-on-cantilever", "stepped-rod", "two-equal-rods"):
        assert laws_of_a_rod(scene_of(name), chosen(name)) == []
