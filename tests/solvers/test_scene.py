"""Scenes: read, written back, changed; and every bad input refused with its key, its value and what is allowed."""

import copy
import dataclasses
import math
import tomllib
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pytest import approx

import solvers
from solvers import LAWS, METHODS, Material, Modal, RigidMass, Rod, Scene, SceneError, Waves
from solvers.bodies import MATERIALS
from solvers.contact import Hertz, HuntCrossley
from solvers.methods.options import options_of
from tests.catalog import RIGID, SCENES, STEEL_ROD, WITH_INDENTATION, contact_table, struck_rod

PLAIN = {
    "title": "A test",
    "impactor": {"kind": "mass", "mass": 2.133, "velocity": 1.0},
    "target": STEEL_ROD,
    "contact": RIGID,
}
NOT_NUMBERS = [True, "1.0", [1.0], {"value": 1.0}, math.nan, math.inf, -math.inf, 10**400]


def with_value(key: str, value: object) -> dict:
    """The plain scene with another value at a dotted key."""
    tables = copy.deepcopy(PLAIN)
    *path, last = key.split(".")
    table = tables
    for name in path:
        table = table[name]
    table[last] = value
    return tables


def refusal(tables: object) -> SceneError:
    with pytest.raises(SceneError) as refused:
        Scene.from_table(tables)
    said = refused.value
    assert str(said).startswith(f"{said.key}: got ")
    assert said.allowed in str(said)
    assert "\n" not in str(said)
    assert len(str(said)) < 400
    return said


# --- reading ----------------------------------------------------------------------------------------------------------


def test_the_built_in_scenes():
    names = solvers.scene_names()
    plain = [name for name in names if not name.startswith(("figure-", "table-"))]
    assert names[0] == "fixed-rod" and names[: len(plain)] == plain and plain[1:] == sorted(plain[1:])
    assert (
        names.index("figure-4.9") < names.index("figure-4.10") < names.index("table-6.2") < names.index("figure-10.2")
    )
    for scene in SCENES.values():
        assert scene.title and scene.source
    # thesis 4.5 and 5.3: equal masses
    assert SCENES["fixed-rod"].mass_ratio == approx(1.0, rel=1e-15)
    assert SCENES["free-rod"].mass_ratio == approx(1.0, rel=1e-15)
    assert SCENES["fixed-rod"].target.round_trip_time == approx(1.1637378202523601e-4, rel=1e-15)  # (4.10)


@pytest.mark.parametrize("name", ["fixed-rod", "free-rod", "bronze-rod-steel-ball"])
def test_both_methods_for_a_struck_rod_agree(name):
    answers = [solvers.solve(SCENES[name], method=method).impactor_velocity for method in ("waves", "modal")]
    # rigid contact with the default 50 modes: 0.45 %
    assert answers[0] == approx(answers[1], abs=0.005 * SCENES[name].impactor.velocity)


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


# --- refusals ---------------------------------------------------------------------------------------------------------

NUMBERS = [
    ("impactor.mass", -1.0, 0.0, 1e13, "1e-12 to 1e+12 kg"),
    ("impactor.velocity", -1.0, 0.0, 1e7, "1e-09 to 1e+06 m/s"),
    ("impactor.radius", -1.0, 0.0, 1e7, "1e-06 to 1e+06 m"),
    ("target.length", -0.3, 0.0, 1e7, "1e-06 to 1e+06 m"),
    ("target.section.width", -1.0, 0.0, 1e5, "1e-07 to 10000 m"),
    ("target.at", -1.0, 0.5, 1.5, "1 to 1"),
]


@pytest.mark.parametrize(
    "key, value, allowed", [(key, value, allowed) for key, *values, allowed in NUMBERS for value in values]
)
def test_numbers_out_of_range(key, value, allowed):
    said = refusal(with_value(key, value))
    assert (said.key, said.value) == (key, value)
    assert repr(value) in str(said)
    assert allowed in said.allowed


@pytest.mark.parametrize("key", [key for key, *_ in NUMBERS])
@pytest.mark.parametrize("value", NOT_NUMBERS, ids=lambda value: repr(value)[:20])
def test_what_is_not_a_number(key, value):
    said = refusal(with_value(key, value))
    assert said.key == key
    assert "a number from" in said.allowed


@pytest.mark.parametrize("law", WITH_INDENTATION)
@pytest.mark.parametrize("value", [*NOT_NUMBERS, 0, -1.0, 1e21], ids=lambda value: repr(value)[:20])
def test_stiffness(law, value):
    said = refusal(with_value("contact", contact_table(law) | {"stiffness": value}))
    assert said.key == "contact.stiffness"


@pytest.mark.parametrize("value", [*NOT_NUMBERS, 0.0, 0.009, 1.0001, -0.5], ids=lambda value: repr(value)[:20])
def test_restitution(value):
    said = refusal(with_value("contact", contact_table("hunt-crossley") | {"restitution": value}))
    assert said.key == "contact.restitution"
    assert "0.01 to 1" in said.allowed


@pytest.mark.parametrize(
    "key, value, allowed",
    [
        ("impactor.kind", "anvil", "'mass', 'sphere'"),
        ("impactor.kind", 3, "'mass', 'sphere'"),
        ("target.kind", "plate", "'rod'"),
        ("target.support", "glued", "'fixed', 'free'"),
        ("target.support", ["fixed"], "'fixed', 'free'"),
        ("target.material", "cheese", "'steel', 'bronze', 'aluminium'"),
        ("target.material", 5, "young, density"),
        ("contact.law", "magic", "'rigid', 'linear', 'hertz', 'power', 'kelvin-voigt'"),
        ("contact.law", None, "'rigid'"),
        ("contact", "rigid", "a table"),
        ("target.section", "round", "a table"),
        ("target.section", {}, "{ width, height }, { radius } or { area }"),
        ("target.section", {"width": 0.1}, "exactly one of"),
        ("target.section", {"width": 0.1, "height": 0.1, "radius": 0.1}, "exactly one of"),
        ("target", [], "a table"),
        ("impactor", None, "a table"),
        ("method", "waves", "a table"),
        ("title", 5, "text"),
        ("title", "x" * 301, "at most 300 characters"),
        ("note", ["x"], "text"),
        ("note", "x" * 601, "at most 600 characters"),
        ("source", ["a"], "text"),
    ],
)
def test_words_and_tables(key, value, allowed):
    said = refusal(with_value(key, value))
    assert (said.key, said.value) == (key, value)
    assert allowed in said.allowed


@pytest.mark.parametrize(
    "key, value, keys",
    [
        ("colour", "red", "title, source, note, impactor, target, contact, method"),
        ("impactor.weight", 1.0, "kind, mass, velocity, radius, material"),
        ("target.lenght", 1.0, "kind, length, section, material, support, at, velocity, end_mass, radius"),
        ("target.section.depth", 1.0, "width, height, radius, area, second_moment, shear_coefficient"),
        ("contact.stiffness", 1e9, "law"),  # rigid has no constants
    ],
)
def test_keys_that_do_not_exist(key, value, keys):
    tables = copy.deepcopy(PLAIN)
    *path, last = key.split(".")
    table = tables
    for name in path:
        table = table[name]
    table[last] = value
    said = refusal(tables)
    assert said.key == key
    assert said.allowed == f"no such key; the keys are {keys}"


@pytest.mark.parametrize(
    "key",
    ["impactor", "target", "impactor.mass", "impactor.velocity", "target.length", "target.section", "target.material"],
)
def test_missing_keys(key):
    tables = copy.deepcopy(PLAIN)
    *path, last = key.split(".")
    table = tables
    for name in path:
        table = table[name]
    del table[last]
    said = refusal(tables)
    assert said.key == key
    assert "got nothing" in str(said)
    assert "the key is missing" in said.allowed


def test_missing_constants():
    assert refusal(with_value("target.material", {"young": 2e11})).key == "target.material.density"
    assert refusal(with_value("contact", {"law": "linear"})).key == "contact.stiffness"
    assert refusal(with_value("contact", {"law": "hunt-crossley", "stiffness": 1e9})).key == "contact.restitution"
    without_radius = refusal(with_value("contact", {"law": "hertz"}))
    assert without_radius.key == "contact.stiffness"
    assert "impactor.radius" in without_radius.allowed
    assert refusal(with_value("impactor", {"kind": "sphere", "velocity": 1.0})).key == "impactor.radius"


@pytest.mark.parametrize("tables", [None, [], "scene", 5, {}, {1: 2}, {("a", "b"): 1}])
def test_what_is_no_scene_at_all(tables):
    refusal(tables)


@pytest.mark.parametrize(
    "value",
    [10**5000, -(10**5000), [10**5000], {"value": 10**5000}],
    ids=["huge", "negative", "in a list", "in a table"],
)
@pytest.mark.parametrize("key", ["impactor.mass", "nothing"])
def test_integers_too_long_to_print(key, value):
    """Python refuses to print integers of more than 4300 digits; the refusal must not fail over that."""
    refusal(with_value(key, value))


@pytest.mark.parametrize("depth", [500, 960, 5000])
@pytest.mark.parametrize("key", ["impactor.mass", "contact"])
def test_deep_nesting(key, depth):
    value: object = 1.0
    for _ in range(depth):
        value = {"deeper": value} if key == "contact" else [value]
    refusal(with_value(key, value))
    with pytest.raises(SceneError):
        SCENES["fixed-rod"].replace({key: value}).replace({"target.length": 1.0})


# --- solving what a scene says ----------------------------------------------------------------------------------------


def test_the_method_of_the_scene_is_used_unless_asked_otherwise():
    scene = SCENES["fixed-rod"].replace({"method": {"name": "modal", "modes": 5, "duration": 1e-4}})
    solution = solvers.solve(scene)
    assert solution.method["name"] == "modal" and solution.method["modes"] == 5
    assert solution.duration == approx(1e-4, rel=1e-15)
    assert solvers.solve(scene, modes=6).method["modes"] == 6
    assert solvers.solve(scene, "waves").method["name"] == "waves"
    assert solvers.solve(scene, duration=2e-4).duration == approx(2e-4, rel=1e-15)
    assert solvers.solve(scene, Waves()).method["name"] == "waves"
    assert solvers.solve(scene, Modal(modes=3)).method["modes"] == 3


@pytest.mark.parametrize(
    "arguments, key",
    [
        ({"method": "guess"}, "method.name"),
        ({"method": "waves", "modes": 5}, "method.modes"),
        ({"method": "modal", "tolerance": 1e-3}, "method.tolerance"),
        ({"method": "waves", "tolerance": 0.0}, "method.tolerance"),
        ({"method": "waves", "steps": 5}, "method.steps"),
        ({"method": "waves", "steps": 1e3}, "method.steps"),
        ({"duration": -1.0}, "method.duration"),
        ({"duration": 0.0}, "method.duration"),
        ({"duration": math.nan}, "method.duration"),
        ({"duration": math.inf}, "method.duration"),
        ({"duration": "long"}, "method.duration"),
        ({"duration": True}, "method.duration"),
        ({"duration": 1e9}, "method.duration"),
        ({"method": Modal(modes=3), "modes": 5}, "method"),
        ({"velocity": 3.0}, "method.velocity"),
    ],
)
def test_solve_refuses(arguments, key):
    with pytest.raises(SceneError) as refused:
        solvers.solve(SCENES["fixed-rod"], **arguments)
    assert refused.value.key == key


# --- files ------------------------------------------------------------------------------------------------------------

TOML = """
title = "From a file"
[impactor]
mass = 1.0
velocity = 2.0
[target]
length = 1.0
section = { radius = 0.01 }
material = "steel"
"""


def test_load_a_file(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(TOML)
    assert solvers.load(path) == solvers.load(str(path)) == Scene.from_table(tomllib.loads(TOML))


@pytest.mark.parametrize(
    "content",
    [
        TOML[:-3].encode(),  # truncated inside a word
        TOML[:60].encode(),
        b"",
        b"\x00\x01\x02\xff\xfe",
        b"title = 'caf\xe9'",
        b"\x89PNG\r\n\x1a\n" + bytes(range(256)),
        TOML.encode() + b"[impactor]\n",  # a table given twice
        b"a = " + b"[" * 50_000,
        b"a = " + b"[" * 300 + b"]" * 300,
        b"a" + b".a" * 10_000 + b" = 1",  # tables in tables, which the reader of TOML does not refuse
        b"contact" + b".a" * 10_000 + b" = 1",
        b"a = " + b"9" * 5_000,
        b"[impactor]\nmass = 0x" + b"f" * 10_000,
        b"title = '" + b"x" * 200_000 + b"'",
        b"a = 1979-05-27T07:32:00Z",
        TOML.replace("1.0", "nan", 1).encode(),
        TOML.replace("1.0", "1e999", 1).encode(),
    ],
    ids=lambda content: repr(content[:18]),
)
def test_files_that_cannot_be_used(tmp_path, content):
    path = tmp_path / "scene.toml"
    path.write_bytes(content)
    with pytest.raises(SceneError) as refused:
        solvers.load(path)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    "name", ["", ".", "..", "no-such-scene", "fixed-rod.toml", "a\0b", "x" * 300, "y/" * 3000, "/", "~"]
)
def test_files_that_do_not_exist(name):
    with pytest.raises(SceneError) as refused:
        solvers.load(name)
    assert refused.value.key == "scene"
    assert "fixed-rod" in refused.value.allowed or "file" in refused.value.allowed


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


def test_every_method_takes_the_options_among_its_fields_and_no_other():
    for name, method in {**METHODS, "auto": solvers.Auto}.items():
        known = set(method.read({}).table()) - {"name"}
        assert known == set(options_of(method))
        with pytest.raises(SceneError) as said:
            solvers.read_method({"name": name, "mode": 5}, SCENES["fixed-rod"])
        assert said.value.key == "method.mode"
        assert said.value.allowed == f"no such key; the keys are {', '.join(options_of(method))}"


def test_another_method_leaves_the_options_of_the_one_before():
    scene = SCENES["figure-8.1"]
    assert dict(scene.replace({"method.name": "modal"}).method) == {"name": "modal", "duration": 0.0003}
    named = scene.replace({"method.name": "modal", "method.modes": 7}).method
    assert dict(named) == {"name": "modal", "modes": 7, "duration": 0.0003}
    assert scene.replace({"method.name": "fe-nodal"}).method == scene.method
    assert scene.replace({"impactor.mass": 1.0}).method == scene.method
