"""Every bad input is refused with its key, its value and what is allowed."""

import copy
import math
import pickle
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from solvers import Scene, SceneError, validation
from solvers.validation import shown
from tests.catalog import SCENES, WITH_INDENTATION, contact_table
from tests.solvers.plain_scene import PLAIN, with_value

NOT_NUMBERS = [True, "1.0", [1.0], {"value": 1.0}, math.nan, math.inf, -math.inf, 10**400]


def refusal(tables: object) -> SceneError:
    with pytest.raises(SceneError) as refused:
        Scene.from_table(tables)
    said = refused.value
    assert str(said).startswith(f"{said.key}: got ")
    assert said.allowed in str(said)
    assert "\n" not in str(said)
    assert len(str(said)) < 400
    return said


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
        ("colour", "red", "title, source, note, impactor, target, contact, method, view"),
        ("impactor.weight", 1.0, "kind, mass, velocity, radius, material, height, gravity"),
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


@pytest.mark.parametrize("key", ["chosen", "settled", "terms.pair", "constructor"])
def test_a_key_is_never_taken_for_the_code_of_a_sentence(key):
    """Whole tables were refused with a trace, as some sentence has such a code."""
    with pytest.raises(SceneError) as refused:
        Scene.from_table(PLAIN | {key: 1})
    assert str(refused.value).startswith(f"{key}: got 1; allowed: no such key")


def test_a_refusal_passes_from_process_to_process_and_shows_itself():
    with pytest.raises(SceneError) as refused:
        Scene.from_table(PLAIN | {"colour": "red"})
    again = pickle.loads(pickle.dumps(refused.value))
    assert type(again) is SceneError and str(again) == str(refused.value) and again.value == "red"
    assert repr(again) == f"SceneError({str(again)!r})"


def test_what_is_too_long_to_write_is_shown_without_a_word_of_any_language():
    huge = 10**5000
    assert [shown(value) for value in (huge, [huge], {"a": huge})] == ["...", "[...]", "{...}"]


@pytest.mark.parametrize("kind", ["mass", "sphere", "rod", "beam"])
def test_the_keys_of_a_fall_are_among_those_that_are_listed(kind):
    assert "velocity" in refusal(PLAIN | {"impactor": {"kind": kind, "hight": 1.0}}).allowed
    for key in ("height", "gravity"):
        assert key in refusal(PLAIN | {"impactor": {"kind": kind, "hight": 1.0}}).allowed


@settings(max_examples=300, deadline=None)
@given(st.floats(1e-12, 1e12), st.floats(-15.0, 1.0), st.booleans())
def test_a_refused_number_is_not_among_those_that_are_said_to_be_allowed(bound, by, low):
    """However near the bound it is."""
    value = bound * (1.0 - 10.0**by) if low else bound * (1.0 + 10.0**by)
    ends = (bound, 2.0 * bound) if low else (-1.0, bound)
    if ends[0] <= value <= ends[1]:
        return
    with pytest.raises(SceneError) as refused:
        validation.number("mass", value, *ends, "kg")
    first, last = re.search(r"a number from (\S+) to (\S+) kg", str(refused.value)).groups()
    assert not float(first) <= value <= float(last), str(refused.value)


@pytest.mark.parametrize("mass", [1.0 / 3.0, 1.0, 123.456789, 7.7e-2])
@pytest.mark.parametrize("by", [1.0 + 1e-3, 1.0 + 1e-6, 1.0 + 1e-12])
def test_nor_is_a_mass_that_the_other_body_does_not_feel(mass, by):
    for other in (mass * 1e9 * by, mass / 1e9 / by):
        tables = with_value("impactor.mass", mass) | {"target": {"kind": "mass", "mass": other}}
        value, low, high = re.search(r"got (\S+); allowed: (\S+) to (\S+) kg", str(refusal(tables))).groups()
        assert not float(low) <= float(value) <= float(high)
