"""Scenes: read, written back, changed; and whatever is in them, read or refused."""

import dataclasses
import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pytest import approx

import solvers
from solvers import LAWS, Material, RigidMass, Rod, Scene, SceneError
from solvers.bodies import MATERIALS
from solvers.contact import Hertz, HuntCrossley
from tests.catalog import SCENES, contact_table, struck_rod
from tests.solvers.plain_scene import with_value

# --- reading ----------------------------------------------------------------------------------------------------------


def test_a_rod_by_its_figures():
    rod = struck_rod().target
    assert rod.mass == approx(2.133, rel=1e-15)
    assert rod.wave_speed == approx(math.sqrt(210e9 / 7900.0), rel=1e-15)
    assert rod.impedance == approx(rod.mass / rod.length * rod.wave_speed, rel=1e-15)
    assert rod.stiffness == approx(210e9 * 9e-4 / 0.3, rel=1e-15)
    assert rod.round_trip_time == approx(0.6 / rod.wave_speed, rel=1e-15)


@pytest.mark.parametrize(
    "section, area",
    [({"width": 0.03, "height": 0.02}, 6e-4), ({"radius": 0.01}, math.pi * 1e-4), ({"area": 3.142e-4}, 3.142e-4)],
)
def test_sections(section, area):
    assert Scene.from_table(with_value("target.section", section)).target.area == approx(area, rel=1e-15)


def test_materials_by_name_and_by_constants():
    assert Scene.from_table(with_value("target.material", "bronze")).target.material == MATERIALS["bronze"]
    given_constants = {"young": 1e9, "density": 1000, "poisson": 0.4}
    assert Scene.from_table(with_value("target.material", given_constants)).target.material == Material(1e9, 1e3, 0.4)


def test_a_sphere_weighs_what_its_radius_says():
    scene = Scene.from_table(with_value("impactor", {"kind": "sphere", "radius": 0.02, "velocity": 1}))
    assert scene.impactor.mass == approx(4.0 / 3.0 * math.pi * 0.02**3 * 7900.0, rel=1e-15)
    own = Scene.from_table(with_value("impactor", {"kind": "sphere", "radius": 0.02, "velocity": 1, "mass": 0.5}))
    assert own.impactor.mass == 0.5


def test_defaults():
    scene = Scene.from_table(
        {
            "impactor": {"mass": 1, "velocity": 2},
            "target": {"length": 1, "section": {"area": 1e-4}, "material": "steel"},
        }
    )
    assert scene.contact.NAME == "rigid"
    assert scene.target.fixed
    assert scene.title == scene.source == ""
    assert isinstance(scene.impactor.mass, float)


def test_a_scene_cannot_be_changed():
    with pytest.raises(dataclasses.FrozenInstanceError):
        SCENES["fixed-rod"].target = None
    with pytest.raises(dataclasses.FrozenInstanceError):
        SCENES["fixed-rod"].target.length = 1.0


def test_what_beams_will_need_is_checked_and_does_not_disturb_a_rod():
    base = solvers.load("fixed-rod")
    section = {"area": 9e-4, "second_moment": 6.75e-8, "shear_coefficient": 5 / 6}
    material = {"young": 210e9, "density": 7900.0, "poisson": 0.3, "yield": 250e6}
    changed = base.replace({"target.section": section, "target.material": material}).target
    assert changed == replace(base.target, material=replace(base.target.material, yield_strength=250e6))
    with pytest.raises(SceneError, match=r"target.material.yield: got -1"):
        base.replace({"target.material": material | {"yield": -1}})
    with pytest.raises(SceneError, match=r"target.section.second_moment: got 0"):
        base.replace({"target.section": section | {"second_moment": 0}})


# --- written back and changed -----------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS)
@given(
    mass_ratio=st.floats(-3.0, 3.0).map(lambda p: 10.0**p),
    velocity=st.floats(1e-9, 1e6),
    radius=st.none() | st.floats(1e-6, 1e6),
    length=st.floats(1e-3, 1e3),
    area=st.floats(1e-8, 1e2),
    young=st.floats(1e3, 1e13),
    poisson=st.floats(-0.99, 0.499),
    restitution=st.floats(0.01, 1.0),
    support=st.sampled_from(["fixed", "free"]),
    title=st.text(max_size=300),
)
@settings(max_examples=50)
def test_a_scene_is_written_back_without_loss(
    law, mass_ratio, velocity, radius, length, area, young, poisson, restitution, support, title
):
    mass = 1234.5 * area * length / mass_ratio
    impactor = {"mass": mass, "velocity": velocity} | ({} if radius is None else {"radius": radius})
    tables = {
        "title": title,
        "source": "somewhere",
        "impactor": impactor,
        "target": {
            "length": length,
            "section": {"area": area},
            "material": {"young": young, "density": 1234.5, "poisson": poisson},
            "support": support,
        },
        "contact": contact_table(law, restitution=restitution),
        "method": {"name": "modal", "modes": 7},
    }
    scene = Scene.from_table(tables)
    again = Scene.from_table(scene.table())
    assert again == scene
    assert again.table() == scene.table()


@pytest.mark.parametrize("law", LAWS)
def test_a_scene_built_from_objects_is_written_back(law):
    """`Scene(impactor, target, contact)` is public; what can be done with it must not depend on how it was made."""
    read = struck_rod(1.0, "fixed", contact_table(law))
    written = Scene.from_table(Scene(read.impactor, read.target, read.contact).table())
    assert (written.impactor, written.target) == (read.impactor, read.target)
    assert tuple(written.contact) == approx(tuple(read.contact), rel=1e-9)


def test_bodies_and_scenes_are_built_from_what_they_need():
    built = Scene(RigidMass(mass=1.0, velocity=2.0), Rod(length=0.3, area=9e-4))
    tables = {"impactor": {"mass": 1.0, "velocity": 2.0}, "target": {"length": 0.3, "section": {"area": 9e-4}}}
    tables["target"]["material"] = "steel"
    read = Scene.from_table(tables)
    assert (built.impactor, built.target, built.contact) == (read.impactor, read.target, read.contact)
    assert solvers.solve(built).impulse == solvers.solve(read).impulse
    assert RigidMass(1.0).velocity == 0.0 and RigidMass(1.0, radius=0.01, kind="sphere").table()["kind"] == "sphere"
    assert Rod(0.3, 9e-4, solvers.MATERIALS["bronze"]).support == "fixed"


def test_objects_in_the_wrong_place_are_refused_by_key():
    with pytest.raises(SceneError, match=r"^mass: got 'mass'; allowed: a number .* kg"):
        RigidMass("mass", 1.0, 2.0)
    with pytest.raises(SceneError, match=r"^impactor.support: got 'fixed'; allowed: 'free'"):
        Scene(Rod(0.3, 9e-4, velocity=1.0), Rod(0.3, 9e-4))
    free = Scene(Rod(0.3, 9e-4, support="free", velocity=1.0), Rod(0.3, 9e-4))
    assert solvers.solve(free).restitution["newton"] == approx(
        1.0, abs=1e-9
    )  # thesis 4.6: the shorter leaves as it came


def test_a_scene_built_from_objects_is_changed():
    read = struck_rod(1.0, "fixed", contact_table("linear"))
    built = Scene(read.impactor, read.target, read.contact)
    assert built.replace({"target.length": 0.5}).target.length == 0.5


def test_replace():
    scene = SCENES["fixed-rod"]
    changed = scene.replace({"target.length": 0.5, "contact": {"law": "hertz", "stiffness": 1e9}, "method.modes": 12})
    assert changed.target.length == 0.5
    assert changed.contact == Hertz(1e9)
    assert changed.method == {"modes": 12}
    assert scene.target.length == 0.3  # the scene itself stays
    assert scene.method == {}
    assert changed.impactor == scene.impactor
    assert scene.replace({}) == scene


def test_replacing_in_a_list():
    scene = solvers.load("table-6.6")
    changed = scene.replace({"target.links.1.modes": 8, "target.links.1.section.width": 0.05})
    assert (changed.target.links[0].modes, scene.target.links[0].modes) == (8, 5)
    assert changed.table()["target"]["links"][0]["section"]["width"] == 0.05
    for key in ("target.links.2.modes", "target.links.0.modes", "target.links.bar.modes", "target.links.1"):
        with pytest.raises(SceneError, match="by its number from 1 to 1") as refused:
            scene.replace({key: 8})
        assert refused.value.key == key


def test_replacing_the_speed_keeps_the_restitution_of_hunt_crossley():
    scene = struck_rod(1.0, "free", contact_table("hunt-crossley", restitution=0.5))
    faster = scene.replace({"impactor.velocity": 4.0})
    assert isinstance(faster.contact, HuntCrossley)
    assert faster.contact.damping == approx(scene.contact.damping / 4.0, rel=1e-12)


@pytest.mark.parametrize(
    "changes, key",
    [
        ({"target.lenght": 1.0}, "target.lenght"),
        ({"nothing": 1.0}, "nothing"),
        ({"nothing.at.all": 1.0}, "nothing"),
        ({"impactor.mass.value": 1.0}, "impactor.mass.value"),
        ({"target.section.area": 1e-4}, "target.section"),  # beside width and height: contradictory
        ({"target.length": -1.0}, "target.length"),
        ({"": 1.0}, ""),
        ({".": 1.0}, ""),
        ({"target.": 1.0}, "target."),
        ({"target": 1.0}, "target"),
    ],
)
def test_replace_refuses(changes, key):
    with pytest.raises(SceneError) as refused:
        SCENES["fixed-rod"].replace(changes)
    assert refused.value.key == key


# --- anything at all --------------------------------------------------------------------------------------------------

WORDS = st.sampled_from(
    ["title", "source", "impactor", "target", "contact", "method", "kind", "mass", "velocity", "radius", "material",
     "length", "section", "support", "at", "width", "height", "area", "young", "density", "poisson", "law", "stiffness",
     "restitution", "name", "modes", "steps", "tolerance", "duration", "rigid", "linear", "hertz", "hunt-crossley",
     "sphere", "rod", "fixed", "free", "steel", "waves", "modal", "nonsense"]
)  # fmt: skip
LEAVES = st.none() | st.booleans() | st.integers() | st.floats() | WORDS | st.text(max_size=5) | st.just(10**400)
JSON = st.recursive(
    LEAVES, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(WORDS | st.text(max_size=3), inner, max_size=5)
)


@settings(max_examples=300)
@given(JSON)
def test_arbitrary_tables_raise_nothing_but_scene_errors(tables):
    with pytest.raises(SceneError):
        Scene.from_table(tables)


@settings(max_examples=300)
@given(
    st.sampled_from(
        ["impactor", "target", "contact", "method", "target.section", "target.material", "impactor.mass", "contact.law"]
    ),
    JSON,
)
def test_a_scene_with_anything_in_it_is_read_or_refused(key, value):
    try:
        scene = Scene.from_table(with_value(key, value))
    except SceneError:
        return
    assert isinstance(scene.impactor, RigidMass) and isinstance(scene.target, Rod)
    assert Scene.from_table(scene.table()) == scene


@settings(max_examples=100)
@given(st.dictionaries(WORDS, LEAVES | WORDS, max_size=4))
def test_arbitrary_method_tables_are_read_or_refused(table):
    try:
        method, _ = solvers.read_method(table)
    except SceneError:
        return
    assert isinstance(method, solvers.Method)
