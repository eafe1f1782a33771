"""A lesson file is read into steps and parts; text is a tree of nodes without markup."""

import json

import pytest

from app.lessons.lesson import Choice, Goal, Node, Number, Order, Scene, Set, Sketch, Text
from app.lessons.record import lesson_record
from app.lessons.shipped import shipped_lesson

from .written import CHOICE, HEAD, SUMMARY, fence, lesson, nodes_in


def nodes(text):
    (part,) = lesson(f"## Step\n\n{text}").steps[0].parts
    assert isinstance(part, Text)
    return part.nodes


def test_the_head():
    read = lesson(SUMMARY, HEAD.replace("title: Tried", "title: Tried\nfor: a class\nminutes: 15\nnext: other"))
    assert (read.lesson, read.version, read.language, read.title, read.title_before) == (
        *("tried", 1, "en", "Tried", "Tried"),
    )
    assert (read.scene, read.audience, read.minutes, read.next, read.translates) == (
        *("fixed-rod", "a class", 15, "other", ""),
    )


def test_yaml_makes_nothing_else_of_words():
    read = lesson(SUMMARY, HEAD.replace("language: en", "language: no").replace("title: Tried", "title: 2024-01-01"))
    assert (read.language, read.title) == ("no", "2024-01-01")


def test_text_is_a_tree():
    assert nodes("One *two* **three `four`** $F_c = A sigma$ [five](https://example.org/)\nsix") == (
        Node(
            "paragraph",
            nodes=(
                Node("text", "One "),
                Node("emphasis", nodes=(Node("text", "two"),)),
                Node("text", " "),
                Node("strong", nodes=(Node("text", "three "), Node("code", "four"))),
                Node("text", " "),
                Node("formula", "F_c = A sigma"),
                Node("text", " "),
                Node("link", nodes=(Node("text", "five"),), target="https://example.org/"),
                Node("text", " six"),
            ),
        ),
    )


def test_lists():
    (bullets, numbered) = nodes("- one\n- two\n\n1. three\n")
    assert bullets.kind == "list" and [each.kind for each in bullets.nodes] == ["item", "item"]
    assert numbered.kind == "steps" and numbered.nodes[0].nodes[0].nodes == (Node("text", "three"),)


@pytest.mark.parametrize(
    "markup", ["<script>alert(1)</script>", "<b onclick='x'>bold</b>", "<!-- hidden -->", "&lt;i&gt;"]
)
def test_markup_stays_text(markup):
    (paragraph,) = nodes(markup)
    assert [node.kind for node in paragraph.nodes] == ["text"]
    assert paragraph.nodes[0].text == markup.replace("&lt;", "<").replace("&gt;", ">")


def test_comments_are_left_out():
    assert nodes("% not this\n\nThis.\n% nor this") == (Node("paragraph", nodes=(Node("text", "This."),)),)


def test_prices_are_no_formulas():
    assert [each.kind for each in nodes("$5 or $6")[0].nodes] == ["text"]


def test_gaps_are_nodes():
    table = 'yes = "All."\nno = "{right} of {all}."\n[[item]]\ntext = "a"\n[[item]]\ntext = "b"'
    (order,) = lesson(fence("order", table)).steps[0].parts
    assert isinstance(order, Order)
    assert order.no == (Node("value", "right"), Node("text", " of "), Node("value", "all"), Node("text", "."))


def test_what_a_goal_is_about_has_a_gap():
    table = 'slider = "mass_ratio"\nrange = [0.5, 2]\nstart = 1.0\ngoal = "restitution > 0.9"\n'
    (goal,) = lesson(fence("set", table + 'not-yet = "{value}"\n[[found]]\nsay = "So."')).steps[0].parts
    assert isinstance(goal, Set)
    assert goal.not_yet == (Node("value", "value"),)


def test_a_scene_goes_on_from_step_to_step():
    text = (
        "## One\n:::{scene}\nchanges = { mass_ratio = 0.8 }\n:::\n## Two\n:::{scene}\nchanges = { speed = 2.0 }\n:::\n"
        '## Three\n:::{scene}\nscene = "free-rod"\nplay = [-0.2, "part"]\nsliders = ["mass_ratio"]\n:::\n'
    )
    one, two, three = lesson(text).steps
    assert one.choices == {"mass_ratio": 0.8}
    assert two.choices == {"mass_ratio": 0.8, "speed": 2.0}
    assert (three.scene, three.choices) == ("free-rod", {})
    (part,) = three.parts
    assert isinstance(part, Scene)
    assert (part.play, part.sliders) == ((-0.2, "part"), ("mass_ratio",))


def test_a_law_brings_its_constants():
    (step,) = lesson(fence("scene", 'changes = { law = "hertz", hertz_stiffness = 2e10 }')).steps
    assert step.choices == {"law": "hertz", "hertz_stiffness": 2e10}


def test_choice():
    (choice,) = lesson("## Step\n" + CHOICE).steps[0].parts
    assert isinstance(choice, Choice)
    assert [each.right for each in choice.options] == [True, False]


@pytest.mark.parametrize("within, tolerance", [('"2 %"', 2.0), ("0.5", 0.5)])
def test_number(within, tolerance):
    table = f'answer = -100\nunit = "ms"\nwithin = {within}\nyes = "Yes."\nno = "No."'
    (number,) = lesson(fence("number", table)).steps[0].parts
    assert isinstance(number, Number)
    assert number.tolerance == pytest.approx(tolerance, rel=1e-12)
    assert number.units == ("ms",) and number.factors == (1e-3,)


def test_text_behind_an_answer():
    after = "## Step\n" + CHOICE + ":::{after}\nplay = [0, 1]\n\nLook *there*.\n:::\n"
    part = lesson(after).steps[0].parts[-1]
    assert part.play == (0.0, 1.0)
    assert [node.kind for node in part.nodes[0].nodes] == ["text", "emphasis", "text"]


def test_lines_may_end_as_windows_has_them():
    text = HEAD + "## Step\n" + CHOICE
    assert lesson(text.replace("\n", "\r\n"), "") == lesson(text, "")


def test_a_whole_lesson():
    read = shipped_lesson("bounce-twice")
    kinds = [[part.KIND for part in step.parts] for step in read.steps]
    assert kinds == [
        ["scene", "text", "choice", "after"],
        ["scene", "text", "sketch", "after"],
        ["scene", "text", "set"],
        ["scene", "text", "number"],
        ["scene", "text", "order"],
        ["summary"],
    ]
    sketch, setting = read.steps[1].parts[2], read.steps[2].parts[2]
    assert isinstance(sketch, Sketch) and isinstance(setting, Set)
    assert [each.criterion for each in sketch.judges] == ["falls", "jump", "zero-from", "push", "zero-beyond"]
    assert (sketch.judges[1].at, sketch.judges[1].within, sketch.judges[1].by) == ("back", 0.12, 25.0)
    assert setting.goal == Goal("contacts", "=", 1.0)
    assert read.steps[2].choices == {"mass_ratio": 0.8}


def test_the_record_is_plain():
    record = lesson_record(shipped_lesson("bounce-twice"))
    assert json.loads(json.dumps(record, allow_nan=False)) == record
    assert len(nodes_in(record)) > 50
    assert record["steps"][0]["parts"][0] == {
        "kind": "scene", "scene": None, "changes": {"mass_ratio": 0.8}, "show": ["bodies"], "map": [],
        "beside": {}, "play": [-0.2, 1.85], "at": None, "time": "T", "sliders": [],
    }  # fmt: skip
    text = record["steps"][0]["parts"][1]["nodes"]
    assert text[0]["kind"] == "paragraph" and text[0]["nodes"][0]["text"].startswith("A mass of 2.7 kg")
