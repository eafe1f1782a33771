"""Scenes of visitors' own: the same as built-in ones, refused by line and key, and bounded."""

import pytest

from app.choices import built_in
from app.choices.built_in import base_of
from app.choices.choices import SCENES, SOLVED_BY, Choices, accepts, refusal, strikes
from app.choices.mechanism import mechanism_changes
from app.choices.own import KEPT, LONGEST, LONGEST_TEXT, check_modes, line_of, own_scene
from app.choices.scene_of import acting_choices, chosen_scene, kind_name, own_choices
from app.messages.encoding import read_header
from app.messages.solve import solve_frame
from app.page.address import from_address
from app.text.refusals import Refused
from solvers import Mechanism
from solvers.scenes.library import SCENES as FOLDER
from tests.app.strangers import dotted, linkage, named

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


@pytest.mark.parametrize(
    "table, key, refused", [(10, 10, False), (10, 11, True), (1, 19, False), (400, 1, True), (1, 400, True)]
)
def test_parts_of_a_key_count_with_those_of_its_table(table, key, refused):
    """Of 195 letters it was 0.3 s."""
    name = named(dotted(table, key))
    assert not accepts("scene", name)
    assert (refusal("scene", name).note.code == "refused.own-line") is refused


def test_points_of_numbers_and_sentences_are_none_of_keys():
    """Rows of numbers, and texts of many sentences, are of honest scenes."""
    rows = "weights = [" + ", ".join(["[0.5, 1.25]"] * 30) + "]\n"
    name = named(ROD.replace("[impactor]", 'note = "' + "One. two.three. " * 30 + '"\n' + rows + "[impactor]"))
    assert refusal("scene", name).note.code == "refused.own-scene"  # for the key, which no scene has


@pytest.mark.parametrize("links, modes, more", [(13, 50, ""), (50, 200, ""), (10, 0, "axial = 200\n")])
def test_modes_of_all_links_are_bounded_before_anything_is_assembled(monkeypatch, links, modes, more):
    """50 links of 200 modes took 442 s and 6.6 GB."""
    monkeypatch.setattr(Mechanism, "read", None)
    name = named(linkage(links, modes, more))
    assert not accepts("scene", name) and refusal("scene", name).note.code == "refused.modes"


def test_a_slider_sets_no_more_modes_than_a_scene_may_have():
    name = named(linkage(20, 2))
    chosen = own_choices(name)
    assert chosen_scene(chosen | {"modes": 30}).target.most_modes == 30
    with pytest.raises(Refused) as refused:
        chosen_scene(chosen | {"modes": 31})
    assert refused.value.note.code == "refused.modes"


def test_every_built_in_mechanism_takes_its_slider_to_the_end():
    for name in FOLDER.glob("*.toml"):
        chosen = own_choices(name.stem)
        if kind_name(name.stem) == "mechanism" and "modes" in acting_choices(chosen):
            check_modes({"target": mechanism_changes(base_of(name.stem), chosen | {"modes": 200})["target"]})


def test_few_scenes_of_visitors_are_kept():
    """512 of them were, of up to 16 MB each."""
    for number in range(20):
        base_of(named(ROD.replace("0.5", f"0.5{number}1")), "target.length=0.7")
    assert own_scene.cache_info().currsize <= KEPT and built_in._of_visitor.cache_info().currsize <= 2 * KEPT


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


STEPPED = """\
[impactor]
kind = "rods"
velocity = 10.0
end_mass = 0.5
rods = [
    { length = 0.4, section = { radius = 0.008 }, material = "steel" },
    { length = 0.38, section = { radius = 0.012 }, material = "steel" },
]
[target]
"""
STRUCK = {
    "rod": 'length = 1.0\nsection = { radius = 0.01 }\nmaterial = "steel"\nsupport = "free"',
    "stop": "",
    "mass": "mass = 3.0",
    "spring-mass": "mass = 1.0\nstiffness = 1e7",
}


@pytest.mark.parametrize("kind", STRUCK)
def test_a_striker_of_sections_is_drawn_and_its_sections_can_be_changed(kind):
    text = STEPPED + f'kind = "{kind}"\n{STRUCK[kind]}\n'
    chosen = own_choices(named(text))
    message = solve_frame(chosen)
    header = read_header(message)
    assert header["exact"]["name"] == "waves" and header["impactor"]["kind"] == "rod"
    if kind == "rod":
        sections = [(each["from"], each["to"]) for each in header["rods"]]
        assert sections == [(pytest.approx(-0.78), pytest.approx(-0.4)), (pytest.approx(-0.4), 0.0), (0.0, 1.0)]
        assert [each["joint"] for each in header["rods"]] == [None, "bonded", None]
    keys = [part["key"] for part in header["parts"]]
    assert keys[:4] == ["impactor", "target", "impactor.rods.1", "impactor.rods.2"]
    longer = read_header(solve_frame(chosen | {"bodies": "impactor.rods.1.length=0.6"}))
    assert longer["trip"] >= header["trip"] and longer["impactor"]["mass"] > header["impactor"]["mass"]
