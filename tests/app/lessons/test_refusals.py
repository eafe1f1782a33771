"""What cannot be is refused by line, key, value and what is allowed, and all of a file at once."""

import re
from pathlib import Path

import pytest

import app.lessons
from app.lessons.checking import check
from app.lessons.problems import LessonError
from app.lessons.reading import read
from app.text.catalogues import lessons
from solvers.text.catalogue import SOURCE, library

from .written import CHOICE, HEAD, SUMMARY, fence, refused

SET = """\
slider = "mass_ratio"
start = 0.8
range = [0.5, 2]
goal = "contacts = 1"
not-yet = "Two."
[[found]]
range = [1.1, 2]
say = "One."
"""
SKETCH = 'track = "force"\nuntil = 2\naxis = [0, 100]\n[[judge]]\n'
NUMBER = 'answer = 1\nunit = "s"\nwithin = "2 %"\nyes = "Yes."\nno = "No."\n'
ORDER = 'yes = "Yes."\nno = "No."\n[[item]]\ntext = "a"\nat = 0\n[[item]]\ntext = "b"\n'


@pytest.mark.parametrize(
    "old, new, line, said",
    [
        ("version: 1", "version: 2", 3, "version: got 2; allowed: 1, as this program knows no later one"),
        ("version: 1", "version: one", 3, "version: got 'one'; allowed: 1"),
        ("version: 1\n", "", 1, "version: got nothing; allowed: 1"),
        ("scene: fixed-rod", "scene: fixed-rood", 6, "scene: got 'fixed-rood'; allowed: the name of a built-in scene"),
        ("lesson: tried", "lesson: Tried It", 2, "lesson: got 'Tried It'; allowed: small letters"),
        ("language: en", "language: english", 4, "language: got 'english'; allowed: a tag such as en"),
        ("title: Tried", "title: ''", 5, "title: got nothing; allowed: a sentence"),
        ("title: Tried", "title: Tried\nminutes: soon", 6, "minutes: got 'soon'; allowed: a whole number"),
        (
            "title: Tried",
            "title: Tried\ncolour: red",
            6,
            "colour: got 'red'; allowed: no such key; the keys are lesson,",
        ),
        ("title: Tried", "title: Tried\ntitle: Again", 6, "title: the key is here for the second time"),
        (
            "title: Tried",
            "title: One: two",
            5,
            "the head is no YAML (mapping values are not allowed here); allowed: lines",
        ),
        ("title: Tried", "title: [a, b]", 5, "the head is no YAML"),
        ("title: Tried", "title: 'Tried", 6, "the head is no YAML"),
        ("---\nlesson", "lesson", 1, "the file has no head"),
    ],
)
def test_heads(old, new, line, said):
    assert any(at == line and each.startswith(said) for at, each in refused(SUMMARY, HEAD.replace(old, new, 1)))


@pytest.mark.parametrize(
    "text, line, said",
    [
        ("", 1, "the lesson has no step"),
        ("Words.\n" + SUMMARY, 8, "this is before the first step"),
        ("## \n", 8, "the step has no title"),
        ("## Step\n### Below\n", 9, "a heading that is not ## is not possible"),
        ("## Step\n> said\n", 9, "a quotation is not possible"),
        ("## Step\n![picture](https://example.org/a.png)\n", 9, "an image is not possible"),
        ("## Step\n```\ncode\n```\n", 9, "a block of code is not possible"),
        ("## Step\n[here](javascript:alert(1))\n", 9, "link: got 'javascript:alert(1)'; allowed: an address"),
        ("## Step\n[here](other.md)\n", 9, "link: got 'other.md'; allowed: an address"),
        ("## Step\n" + CHOICE.replace("\n:::\n", "\n"), 9, ":::{choice} first is not closed: write ::: on a line"),
        ("## Step\n:::{scene}\n" + CHOICE, 9, ":::{scene} is not closed"),
        ("## Step\n:::{quiz} first\n:::\n", 9, ":::{quiz} first is not known; allowed: scene, after, summary, choice"),
        ("## Step\n:::choice\n:::\n", 9, ":::choice is not read; a fence begins so: :::{choice} first"),
        ("## Step\n" + CHOICE.replace(" first", ""), 9, ":::{choice} needs a name"),
        ("## Step\n- :::{scene}\n  :::\n", 9, ":::{scene} is in a list or a quotation"),
        ("## Step\n:::{scene} first\n:::\n", 9, ":::{scene} first takes no name"),
        (f"## Step\n{CHOICE}{CHOICE.replace('first', 'other')}", 18, ":::{choice} other is the second question"),
        (f"## Step\n{CHOICE}## Other\n{CHOICE}", 19, "the name first is used for the second time"),
        ("## Step\n:::{after}\nWords.\n:::\n", 9, ":::{after} belongs behind a question"),
        (f"## Step\n{CHOICE}:::{{after}}\nplay = [2, 1]\n:::\n", 19, "play: got [2, 1]; allowed: two times"),
        (fence("scene", "play = "), 10, "the line cannot be read: it is no KEY = VALUE of TOML (Invalid value"),
        (fence("number", NUMBER.replace("= 1\n", "= 0,989\n")), 10, "the line cannot be read: a number has a decimal"),
        ("## Step\n" + CHOICE.replace('"This"', "This one"), 11, "the line cannot be read: text stands in straight"),
        ("## Step\n" + CHOICE.replace('"This"', "“This”"), 11, "the line cannot be read: text stands in straight"),
        ("## Step\n" + CHOICE.replace("= true", "= True"), 13, "the line cannot be read: allowed: true or false"),
        ("## Step\n" + CHOICE.replace("Yes.", "$\\alpha$"), 12, "the line cannot be read: in text a backslash is wr"),
        (fence("number", NUMBER + "answer = 2"), 15, "the line cannot be read: the key is here for the second time"),
        (fence("number", NUMBER.replace('within = "2 %"\n', "")), 9, "within: got nothing; allowed: a number"),
        (fence("scene", "a" + ".a" * 500 + " = 1"), 10, "the line has more than 400 points"),
        (fence("scene", "\ncolour = 1"), 11, "colour: got 1; allowed: no such key; the keys are scene, changes"),
        (fence("scene", 'scene = "two-bals"'), 10, "scene: got 'two-bals'; allowed: the name of a built-in scene"),
        (fence("scene", "changes = 1"), 10, "changes: got 1; allowed: a table"),
        (fence("scene", "changes = { mass = 1 }"), 10, "changes.mass: got 1; allowed: no such setting in this scene"),
        (fence("scene", "changes = { slenderness = 9.0 }"), 10, "changes.slenderness: got 9.0; allowed: no such setti"),
        (fence("scene", "changes = { mass_ratio = 1e5 }"), 10, "changes.mass_ratio: got 100000.0; allowed: a number"),
        (fence("scene", "changes = { mass_ratio = nan }"), 10, "changes.mass_ratio: got nan; allowed: a number"),
        (fence("scene", 'changes = { law = "glue" }'), 10, "changes.law: got 'glue'; allowed: 'rigid'"),
        (fence("scene", 'show = ["walls"]'), 10, "show[1]: got 'walls'; allowed: 'bodies'"),
        (fence("scene", 'at = "noon"'), 10, "at: got 'noon'; allowed: a time in T from -10 to 1000, or an event: touc"),
        (fence("scene", "play = [0, 1, 2]"), 10, "play: got [0, 1, 2]; allowed: two times"),
        (fence("scene", 'sliders = ["law"]'), 10, "sliders[1]: got 'law'; allowed: 'speed'"),
        ("## Step\n" + CHOICE.replace("right = true\n", ""), 9, "no option has right = true"),
        ("## Step\n" + CHOICE.replace("right = true", "right = 1"), 13, "option[1].right: got 1; allowed: true or fal"),
        ("## Step\n" + CHOICE.replace('say = "Yes."\n', ""), 10, "option[1].say: got nothing; allowed: a sentence"),
        ("## Step\n" + CHOICE.replace("No.", "No {why}."), 16, "option[2].say: got why in braces; allowed: no braces"),
        ("## Step\n:::{choice} first\n:::\n", 9, "option: got nothing; allowed: 2 to 8 tables [[option]]"),
        (fence("number", NUMBER.replace('"s"', '"h"')), 11, "unit: got 'h'; allowed: units of one quantity"),
        (fence("number", NUMBER + 'units = ["s", "kg"]'), 15, "units[2]: got 'kg'; allowed: 's', 'ms', 'µs'"),
        (fence("number", NUMBER.replace('"2 %"', '"2"')), 12, "within: got '2'; allowed: a number in the answer's uni"),
        (fence("number", NUMBER.replace("answer = 1", "")), 9, "answer: got nothing; allowed: a number"),
        (fence("number", NUMBER + '[[mistake]]\nsay = "No."'), 16, "mistake[1].say: got nothing; allowed: one of answ"),
        (fence("number", NUMBER + '[[mistake]]\nnumbers = []\nsay = "No."'), 16, "mistake[1].numbers: got []; allowed"),
        (fence("order", ORDER + 'at = 0'), 17, "item[2].at: 0.0 is not later"),
        (fence("order", ORDER.replace("No.", "{left}")), 11, "no: got left in braces; allowed: right, all"),
        (fence("set", SET.replace("mass_ratio", "law")), 10, "slider: got 'law'; allowed: a slider: one of speed"),
        (fence("set", SET.replace("0.8", "1e9")), 11, "start: got 1000000000.0; allowed: a number from 0.001 to 1000"),
        (fence("set", SET.replace("[0.5, 2]", "[2, 0.5]")), 12, "range: got [2, 0.5]; allowed: two numbers that rise"),
        (fence("set", SET.replace("contacts =", "bounces =")), 13, "goal: got 'bounces = 1'; allowed: contacts, peak"),
        (fence("set", SET.replace("[1.1, 2]", "[1.1, 3]")), 16, "found[1].range: got [1.1, 3]; allowed: two numbers"),
        (fence("sketch", SKETCH + 'yes = "Yes."'), 13, "judge[1]: got nothing; allowed: one of falls, rises"),
        (fence("sketch", SKETCH + 'falls = [0, 1]\nyes = "Yes."'), 13, "judge[1].no: got nothing; allowed: a sentence"),
        (fence("sketch", SKETCH + 'jump = [0, 1]\nyes = "Yes."'), 14, "judge[1].jump: got [0, 1]; allowed: a time in"),
        (fence("scene", 'show = ["map"]\nmap = ["peak", "speed", "mass_ratio"]'), 11, "map: got ['peak', 'spe"),
        (fence("scene", 'show = ["map"]\nmap = ["contacts", "speed", "law"]'), 11, "map: got ['contacts', 's"),
        (fence("scene", 'show = ["map"]\nmap = ["contacts", "speed", "restitution"]'), 11, "map: got ['contacts', 's"),
        (fence("scene", 'show = ["map"]\nmap = ["contacts", "speed", "speed"]'), 11, "map: got ['contacts', 'speed'"),
        (fence("scene", 'show = ["map"]\nmap = ["contacts", "speed"]'), 11, "map: got ['contacts', 'speed']; a"),
        (fence("scene", 'show = ["map"]\nmap = "contacts"'), 11, "map: got 'contacts'; allowed: result, across a"),
        (fence("scene", 'show = ["map", "force", "moved"]'), 10, "show: rows and charts have one place"),
        (fence("scene", 'show = ["rows", "force"]'), 10, "show: rows and charts have one place; show either rows, or"),
        (fence("scene", 'show = ["force", "moved", "energy"]'), 10, "show: rows and charts have one place"),
        (fence("scene", 'show = ["dispersion"]'), 10, "show[1]: got 'dispersion'; allowed: 'bodies', 'rows', 'forces'"),
        (fence("scene", 'beside = { friction = 1.0 }'), 10, "beside.friction: got 1.0; allowed: no such setting in"),
        (fence("scene", 'beside = 1'), 10, "beside: got 1; allowed: a table"),
        (fence("set", SET).replace("##", "## Beam\n:::{scene}\nscene = 'spinning-ball'\n:::\n##").replace(
            "mass_ratio", "friction"), 17, "goal: got 'contacts = 1'; allowed: impulse, impactor_spin"),
        (fence("sketch", SKETCH).replace("##", "## Beam\n:::{scene}\nscene = 'xylophone-bar'\n:::\n##"), 13,
         ":::{sketch} first is of bodies on a line"),
        (fence("sketch", SKETCH.replace("force", "heat")), 10, "track: got 'heat'; allowed: 'force'"),
        (fence("sketch", SKETCH.replace("[0, 100]", "[1, 1]")), 12, "axis: got [1, 1]; allowed: two numbers that rise"),
    ],
)  # fmt: skip
def test_files(text, line, said):
    found = refused(text)
    assert any(at == line and each.startswith(said) for at, each in found), found


def test_a_question_that_cannot_be_read_is_still_one():
    step = "## Step\n" + CHOICE.replace('"This"', "This") + ":::{after}\nWords.\n:::\n"
    assert [line for line, _ in refused(step)] == [11]


def test_all_errors_of_a_file_are_found():
    text = (
        fence("scene", "changes = { mass_ratio = -1 }\nshow = 3\ncolour = 1")
        + "## Other\n"
        + CHOICE.replace("right", "left")
    )
    assert [line for line, _ in refused(text, HEAD.replace("version: 1", "version: 7"))] == [3, 10, 11, 12, 15, 19]


def test_a_refusal_is_one_sentence():
    for _, said in refused(fence("scene", "changes = { mass_ratio = -1 }\nshow = 3")):
        assert "\n" not in said and "⟦" not in said


def checked(tmp_path, text):
    file = tmp_path / "tried.md"
    file.write_text(HEAD + text, encoding="utf-8")
    return [(each.line, each.said()) for each in check(file).problems]


def test_a_right_one_is_not_refused(tmp_path):
    assert checked(tmp_path, fence("set", SET)) == []


@pytest.mark.parametrize(
    "text, line, said",
    [
        (fence("set", SET.replace("[1.1, 2]", "[0.9, 2]")), 16, "found[1].range: at mass_ratio = 0.9 the goal contact"),
        (fence("set", SET.replace("contacts = 1", "contacts = 7")), 13, "goal: no place of mass_ratio from 0.5 to 2 m"),
        (fence("set", SET.replace("0.8", "1.5")), 11, "start: at mass_ratio = 1.5 the goal contacts = 1 is met alread"),
        (fence("scene", 'at = "touch-3"'), 10, "at: got touch-3, which does not happen in the scene of this step"),
        (fence("scene", 'play = ["back", "wall"]'), 9, "play: the span ends before it begins"),
        (fence("order", ORDER.replace("at = 0", 'at = "part"') + 'at = "wall"'), 17, "item[2].at: wall is not later"),
        (fence("scene", 'scene = "spinning-ball"\nbeside = { friction = 1.0 }'), 9, "beside: the scene of this step"),
        (fence("scene", 'beside = { method = "waves" }'), 9, "beside: the same as this step shows; allowed: settings"),
        (fence("scene", 'show = ["indentation"]'), 9, "show: indentation has nothing to show in the scene of this"),
        (fence("scene", 'scene = "note-rod"\nshow = ["course"]'), 9, "show: course has nothing to show in"),
        (fence("scene", 'scene = "newtons-cradle"\nbeside = { law = "rigid" }'), 9, "the scene of this step cannot"),
        (fence("sketch", SKETCH + 'falls = ["part", "wall"]\nyes = "Yes."\nno = "No."'), 14, "falls: the span ends"),
        (fence("sketch", SKETCH + 'rises = ["touch", "back"]\nyes = "Yes."\nno = "No."'), 14, "rises: got a criterion"),
        (fence("scene", 'scene = "newtons-cradle"\nchanges = { law = "rigid" }'), 8, "the scene of this step cannot"),
    ],
)  # fmt: skip
def test_what_the_scene_does_not_do(tmp_path, text, line, said):
    found = checked(tmp_path, text)
    assert any(at == line and each.startswith(said) for at, each in found), found


@pytest.mark.parametrize(
    "given, said",
    [
        (b"\xff\xfe", "1: the file is no text in UTF-8"),
        (b"a" * 200_001, "1: the file has 201 kB; allowed: up to 200 kB"),
        (None, "1: the file cannot be read (No such file or directory)"),
        (b"---\n" + b"a: b\n" * 3000 + b"---\n", "1: the head has 14999 characters; allowed: up to 10000"),
    ],
)
def test_files_that_are_no_text(tmp_path, given, said):
    file = tmp_path / "tried.md"
    if given is not None:
        file.write_bytes(given)
    with pytest.raises(LessonError) as caught:
        read(file)
    assert str(caught.value).splitlines()[0] == said


def test_every_sentence_is_asked_for_and_there():
    own = lessons(SOURCE).texts.keys() - library(SOURCE).texts.keys()
    own = {code for code in own if not code.startswith("print.")}  # on paper, asked for by parts of their names
    sources = "".join(path.read_text("utf-8") for path in Path(app.lessons.__file__).parent.glob("*.py"))
    assert own == {code for code in own if f'"{code.removeprefix("lesson.").removeprefix("wanted.")}"' in sources}
    asked = set(re.findall(r'wanted\("([\w-]+)"', sources))
    assert {f"lesson.wanted.{code}" for code in asked} == {code for code in own if code.startswith("lesson.wanted.")}


@pytest.mark.parametrize(
    "scene, listed",
    [
        ("fixed-rod", "touch, part, touch-2, part-2, wall, back, second"),
        ("two-balls", "touch, part, touch-2, part-2"),
        ("spinning-ball", "touch, part, stick, reversal"),
    ],
)
def test_events_are_listed_that_the_scene_can_have(scene, listed):
    ((_, said),) = refused(fence("scene", f'scene = "{scene}"\nat = "noon"'))
    assert said.endswith(f"or an event: {listed}")
