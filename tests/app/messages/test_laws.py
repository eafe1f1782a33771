"""Contact laws as kernels of the browser take them: constants without units, and how they grow."""

import pytest

from app.messages.laws import law_fields
from solvers.contact import LAWS, Rigid
from solvers.scenes.library import scene_of


@pytest.mark.parametrize("name", ["fixed-rod", "free-rod"])
@pytest.mark.parametrize("kind", [kind for kind in LAWS.values() if kind is not Rigid], ids=lambda kind: kind.NAME)
def test_the_powers_tell_the_constants_of_another_impact(name, kind):
    contact = {"law": kind.NAME} | dict(kind.EXAMPLE)
    scene = scene_of(name).replace({"contact": contact})
    faster, ratio = scene.replace({"impactor.velocity": 3.7 * scene.speed}), 0.31
    other = faster.with_impactor_mass(scene.target.mass / ratio).replace({"contact": contact})
    felt = other.reduced_mass / scene.reduced_mass
    law, expected = law_fields(scene), law_fields(other)
    assert law and expected and law["name"] == kind.NAME
    found = [
        value * 3.7**by_speed * felt**by_mass
        for value, by_speed, by_mass in zip(law["constants"], law["bySpeed"], law["byMass"], strict=True)
    ]
    assert found == pytest.approx(expected["constants"], rel=1e-9)


def test_what_is_rigid_or_no_mass_on_a_rod_has_none():
    assert law_fields(scene_of("fixed-rod")) is None
    assert law_fields(scene_of("hammer-on-cantilever")) is None
