"""Scenes of visitors' own: the same as built-in ones, refused by line and key, and bounded."""

import base64
import zlib

import pytest

from app.choices.choices import SCENES, SOLVED_BY, Choices, accepts, refusal, strikes
from app.choices.own import LONGEST, LONGEST_TEXT, line_of, own_scene
from app.choices.scene_of import own_choices
from app.messages.solve import solve_frame
from app.page.address import from_address
from solvers.scenes.library import SCENES as FOLDER

ROD = """\
title = "Mine"

[impactor]
kind = "mass"
mass = 1.0
velocity = 1.0

[target]
kind = "rod"
length = 0.5
section = { width = 0.03, height = 0.03 }
material = "steel"
support = "fixed"

[contact]
law = "rigid"
"""


def named(text: str | bytes) -> str:
    """As app/static/wire/own.js does."""
    packer = zlib.compressobj(9, wbits=-zlib.MAX_WBITS)
    packed = packer.compress(text if isinstance(text, bytes) else text.encode()) + packer.flush()
    return "own." + base64.urlsafe_b64encode(packed).decode().rstrip("=")


def test_every_built_in_scene_is_the_same_as_ones_own():
    for path in FOLDER.glob("*.toml"):
        name = named(path.read_text("utf-8"))
        assert accepts("scene", name) and len(name) < LONGEST, path.stem
        assert own_choices(name) | {"scene": ""} == own_choices(path.stem) | {"scene": ""}, path.stem
        assert strikes(name) == strikes(path.stem), path.stem


def test_it_is_solved_and_drawn_as_a_built_in_one():
    message = solve_frame(own_choices(named(ROD)))
    assert b'"title":"Mine"' in message


@pytest.mark.parametrize(
    "old, new, code, line, key",
    [
        ("length = 0.5", "length = -0.5", "refused.own-scene", 10, "target.length"),
        ("length = 0.5\n", "", "refused.own-scene", 8, "target.length"),
        ("width = 0.03", "width = 0", "refused.own-scene", 10 + 1, "target.section.width"),
        ('law = "rigid"', 'law = "soft"', "refused.own-scene", 16, "contact.law"),
        ("[target]", "[goal]", "refused.own-scene", 8, "goal"),
        ('kind = "rod"', "kind = rod", "refused.own-toml", 9, ""),
    ],
)
def test_what_cannot_be_is_refused_by_line_and_key(old, new, code, line, key):
    assert old in ROD
    name = named(ROD.replace(old, new))
    assert not accepts("scene", name)
    note = refusal("scene", name).note
    assert (note.code, note.values["line"]) == (code, line)
    if key:
        assert note.values["why"]["values"]["key"] == key


@pytest.mark.parametrize(
    "name",
    [
        "own.",
        "own.!",
        named(ROD)[:-9],
        "own." + "A" * LONGEST,
        named(b"\xff\xfe"),
        named("#" * (LONGEST_TEXT + 1)),  # a small name for a long text
        named('title = "' + "x" * 10_000_000 + '"')[:LONGEST],
    ],
    ids=str,
)
def test_what_is_no_packed_text_is_refused(name):
    assert not accepts("scene", name) and refusal("scene", name).note.code in ("refused.own-cut", "refused.own-scene")


def test_what_the_page_has_no_slider_for_is_refused_and_not_changed():
    for old, new, code in (
        ("velocity = 1.0", "velocity = 200.0", "refused.own-beyond"),
        ("mass = 1.0", "mass = 1e-6", "refused.own-beyond"),
    ):
        name = named(ROD.replace(old, new))
        assert not accepts("scene", name) and refusal("scene", name).note.code == code
    assert accepts("scene", named(ROD.replace("velocity = 1.0", "velocity = 100.0")))


@pytest.mark.parametrize("method", ["name = []", "name = { a = 1 }", 'name = "none"', "modes = []"])
def test_a_method_that_is_none_ends_nothing(method):
    name = named(ROD + f"\n[method]\n{method}\n")
    if accepts("scene", name):
        assert own_choices(name)["method"] in SOLVED_BY
    else:
        assert refusal("scene", name).note.code.startswith("refused.own-")


def test_a_key_of_thousands_of_parts_costs_nothing():
    """What reads TOML keeps each beginning of a key: 400 MB of this one, whose name has 60 letters."""
    name = named("a" + ".a" * 9_000 + " = 1")
    assert not accepts("scene", name) and refusal("scene", name).note.code == "refused.own-line"


def test_an_address_brings_one_with_what_is_changed_in_it():
    name = named(ROD)
    kept, refused = from_address({"scene": [name.encode()], "mass_ratio": [b"3"]})
    assert not refused and kept["scene"] == name and kept["mass_ratio"] == 3.0
    assert Choices(**kept).scene == name and SCENES[name] is own_scene(name).struck
    kept, [why] = from_address({"scene": [named(ROD.replace("0.5", "-1")).encode()]})
    assert "scene" not in kept and "target.length" in str(why)


def test_a_view_that_cannot_be_is_no_reason_to_refuse_it():
    name = named(ROD + '\n[view]\nviews = ["energy"]\ncharts = ["no"]\n')
    assert accepts("scene", name) and own_choices(name)["scene"] == name


def test_lines_of_keys():
    text = "a = 1\n[target]\nkind = 'rods'\n[[target.rods]]\nlength = 1\n[[target.rods]]\nlength = 2\n"
    keys = ("a", "target.kind", "target.rods[1].length", "target.rods[2].length", "target.none", "b")
    assert [line_of(text, key) for key in keys] == [1, 3, 5, 7, 2, 0]
