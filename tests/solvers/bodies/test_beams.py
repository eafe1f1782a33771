"""Beams as bodies of a scene: what is read, what follows, what is refused."""

import math

import pytest
from pytest import approx

import solvers
from solvers import Beam, Scene, SceneError
from solvers.bodies.beams import SAME_SUPPORTS, SUPPORTS
from tests.catalog import STEEL_BEAM, struck_beam

STEEL = {"young": 210e9, "density": 7900.0, "poisson": 0.3}


def beam(**changes) -> Beam:
    return Beam.read("target", STEEL_BEAM | changes)


def refusal(**changes) -> SceneError:
    with pytest.raises(SceneError) as caught:
        beam(**changes)
    return caught.value


def test_what_follows_from_a_rectangle():
    found = beam()
    assert found.area == approx(9e-4, rel=1e-15)
    assert found.second_moment == approx(0.03**4 / 12.0, rel=1e-15)
    assert (found.half_depth, found.mass) == (0.015, approx(2.133, rel=1e-15))
    assert found.shear_coefficient == approx(10.0 * 1.3 / (12.0 + 11.0 * 0.3), rel=1e-15)  # Cowper 1966
    assert found.line.bending_stiffness == approx(210e9 * 6.75e-8, rel=1e-15)
    assert found.line.shear_stiffness == math.inf
    assert found.line.rotary_inertia == 0.0


def test_height_is_along_the_impact():
    flat, high = (beam(section={"width": w, "height": h}) for w, h in ((0.03, 0.01), (0.01, 0.03)))
    assert high.second_moment == approx(9.0 * flat.second_moment, rel=1e-14)


def test_timoshenko_theory_knows_shear_and_rotary_inertia():
    line = beam(theory="timoshenko", section={"radius": 0.01}).line
    area, inertia = math.pi * 1e-4, 0.25 * math.pi * 1e-8
    assert line.shear_stiffness == approx(6.0 * 1.3 / (7.0 + 1.8) * 210e9 / 2.6 * area, rel=1e-14)
    assert line.rotary_inertia == approx(7900.0 * inertia, rel=1e-14)
    given = beam(theory="timoshenko", section={"area": area, "second_moment": inertia, "shear_coefficient": 0.9})
    assert given.line.shear_stiffness == approx(0.9 * 210e9 / 2.6 * area, rel=1e-14)
    assert given.half_depth == approx(math.sqrt(3.0 * inertia / area), rel=1e-14)


@pytest.mark.parametrize(
    ("support", "held", "fixed", "at"),
    [
        ("cantilever", True, True, 1.0),
        ("pinned-pinned", True, True, 0.5),
        ("clamped-clamped", True, True, 0.5),
        ("free-free", False, False, 0.5),
        ("pinned-free", True, False, 1.0),
    ],
)
def test_supports(support, held, fixed, at):
    found = beam(support=support)
    assert (found.held, found.fixed, found.at) == (held, fixed, at)
    assert Beam.read("target", found.table()) == found


def test_the_unit_of_time_is_the_slowest_period():
    # z1 = 1.8751040687119611 of the cantilever, (8.8)
    frequency = 1.8751040687119611**2 * math.sqrt(210e9 * 6.75e-8 / (7900.0 * 9e-4)) / 0.09
    assert beam().time_unit == approx(2.0 * math.pi / frequency, rel=1e-13)
    assert struck_beam().time_unit == beam().time_unit


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"support": "fixed"}, "target.support"),
        ({"theory": "rayleigh"}, "target.theory"),
        ({"at": 0.0}, "target.at"),
        ({"at": 1.0, "support": "pinned-pinned"}, "target.at"),
        ({"at": 1.5}, "target.at"),
        ({"at": math.nan}, "target.at"),
        ({"damping": -0.1}, "target.damping"),
        ({"damping": 0.5}, "target.damping"),
        ({"velocity": 1.0}, "target.velocity"),
        ({"end_mass": 1.0, "support": "free-free"}, "target.end_mass"),
        ({"end_mass": 0.0}, "target.end_mass"),
        ({"section": {"area": 1e-4}}, "target.section.second_moment"),
        ({"section": {"radius": 0.01, "second_moment": 1e-8}}, "target.section.second_moment"),
        ({"section": {"radius": 0.01, "shear_coefficient": 2.0}}, "target.section.shear_coefficient"),
        ({"length": 0.0}, "target.length"),
        ({"thickness": 0.1}, "target.thickness"),
    ],
)
def test_refusals_name_the_key(changes, key):
    assert refusal(**changes).key == key


def test_a_beam_that_strikes_is_free():
    table = {"kind": "beam", "length": 0.3, "section": {"radius": 0.01}, "material": STEEL, "velocity": 1.0}
    scene = Scene.from_table({"impactor": table, "target": STEEL_BEAM, "contact": {"law": "linear", "stiffness": 1e8}})
    assert scene.impactor.support == "free-free"
    with pytest.raises(SceneError, match=r"impactor.support"):
        Scene.from_table({"impactor": table | {"support": "cantilever"}, "target": STEEL_BEAM})


def test_a_law_that_needs_a_radius_asks_for_it():
    scene = {"impactor": {"mass": 1.0, "velocity": 1.0}, "target": STEEL_BEAM, "contact": {"law": "hertz"}}
    with pytest.raises(SceneError, match="radius"):
        Scene.from_table(scene)


def test_what_a_theory_does_not_cover_is_said():
    short = struck_beam(length=0.1)
    assert any("3.33 times as long as deep" in str(note) for note in solvers.solve(short, modes=5).notes)
    assert not beam().notes()
    assert not beam(theory="timoshenko", length=0.1).notes()
    assert beam(theory="timoshenko", length=0.05).notes()


def test_modes_faster_than_any_wave_are_counted():
    # k r = 1 at z = L / r = 34.64: (i - 1/2) pi below it up to i = 11
    assert beam().modes_within_reach(40) == 11
    assert beam(theory="timoshenko").modes_within_reach(40) == 40
    assert any("keep at most 11" in str(note) for note in solvers.solve(struck_beam(), modes=20).notes)


@pytest.mark.parametrize(
    "word", ["simply-supported", "simply supported", "Simply_Supported", "hinged-hinged", "pinned pinned"]
)
def test_other_words_for_a_support_are_read_and_the_usual_one_is_written(word):
    target = STEEL_BEAM | {"support": word, "at": 0.5}
    scene = Scene.from_table({"impactor": {"mass": 1.0, "velocity": 1.0}, "target": target})
    assert scene.target.support == scene.table()["target"]["support"] == "pinned-pinned"
    assert scene == Scene.from_table(scene.table())
    assert scene == scene.replace({"target.support": "pinned-pinned"})


@pytest.mark.parametrize("word, support", SAME_SUPPORTS.items())
def test_words_are_those_of_supports_that_are_there(word, support):
    assert support in SUPPORTS and word not in SUPPORTS
    assert beam(support=word).support == support


@pytest.mark.parametrize("word", ["simply", "glued", "", 5, None, ["free-free"]])
def test_an_unknown_support_is_told_which_there_are(word):
    refused = refusal(support=word)
    assert (refused.key, refused.value) == ("target.support", word)
    assert all(repr(support) in refused.allowed for support in SUPPORTS)
