"""Answers that are solved for, from formulas over figures of the impact, and what an impact contradicts."""

import json

import pytest

from app.lessons.answers import STORED, Solved, stored
from app.lessons.checking import check
from app.lessons.formula import Quantity, formula
from app.lessons.lesson import Boundary
from app.lessons.own import read_own, try_own
from app.lessons.shipped import FOLDER, shipped_lesson
from app.lessons.storing import solved_answers

from .numbers import solution_of
from .written import HEAD

FIGURES = {"a": Quantity(3.0, (1, 0, 0)), "b": Quantity(4.0, (0, 0, 1))}
MISTAKE = '[[mistake]]\nanswer = {}\nsay = "No."\n'


def asked(answer, unit="N s", name="asked", more="", scene="fixed-rod", within='"2 %"'):
    head = HEAD.replace("fixed-rod", scene)
    table = f'answer = {answer}\nunit = "{unit}"\nwithin = {within}\nyes = "Yes."\nno = "No."\n{more}'
    return f"{head}## Step\n:::{{number}} {name}\n{table}:::\n"


def checked(tmp_path, text):
    """The question, or lines and codes of what is wrong."""
    file = tmp_path / "tried.md"
    file.write_text(text, encoding="utf-8")
    found = check(file)
    if found.problems:
        return [(each.line, each.note.code.removeprefix("lesson.")) for each in found.problems]
    (part,) = found.lesson.steps[0].parts
    return part


@pytest.mark.parametrize(
    "text, value, dimension",
    [
        ("{a}", 3.0, (1, 0, 0)),
        ("-{a} + 2 * {a} - ({a} - {a} / 2)", 1.5, (1, 0, 0)),
        ("{a} / {b} / 2", 0.375, (1, 0, -1)),
        ("2e-1*{a}", 0.6, (1, 0, 0)),
        ("{a} / {20 µs}", 1.5e5, (1, 0, -1)),
        ("1 - {a} / {30 mm} / 1000", 0.9, (0, 0, 0)),
    ],
)
def test_arithmetic(text, value, dimension):
    found = formula(text).of(FIGURES)
    assert found.value == pytest.approx(value, rel=1e-12) and found.dimension == dimension


@pytest.mark.parametrize(
    "text",
    ["", "{a", "a", "{a} {b}", "{a} +", "({a}", "{a})", "{a} ** 2", "{a}.real", "__import__('os')", "{2 T}", "{3 ells}",
     "(" * 200 + "1"],
)  # fmt: skip
def test_nothing_else_is_a_formula(text):
    with pytest.raises(ValueError):
        formula(text)


@pytest.mark.parametrize(
    "answer, unit, value",
    [
        ("{impulse}", "N s", lambda one: one.impulse),
        ("{impulse}", "mN s", lambda one: 1e3 * one.impulse),
        ("{impulse} / {contact_time}", "kN", lambda one: 1e-3 * one.impulse / one.contact_time),
        ("{touch-2}", "T", lambda one: one.contacts[1].start / one.scene.time_unit),
        ("{touch-2} - {part}", "µs", lambda one: 1e6 * (one.contacts[1].start - one.contacts[0].end)),
        ("{impactor_velocity}", "m/s", lambda one: one.impactor_velocity),
        ("1 - {impactor_velocity} * {impactor_velocity} / {speed} / {speed}", "%",
         lambda one: 100.0 * (1.0 - one.impactor_velocity**2)),
    ],
)  # fmt: skip
def test_an_answer_is_solved_for(tmp_path, answer, unit, value):
    part = checked(tmp_path, asked(f'"{answer}"', unit, more=MISTAKE.format(f'"({answer}) / 2"')))
    expected = value(solution_of(shipped_lesson("mass-on-a-rod").steps[0]))
    assert part.answer == pytest.approx(expected, rel=1e-9)
    assert part.tolerance == pytest.approx(0.02 * abs(expected), rel=1e-9)
    assert part.mistakes[0].answer == pytest.approx(expected / 2.0, rel=1e-9)


@pytest.mark.parametrize(
    "given, code",
    [
        ({"answer": '"{impuls}"'}, "allowed"),
        ({"answer": '"2 * 3"'}, "allowed"),
        ({"answer": '"{impulse} + {peak_force}"'}, "formula-mixed"),
        ({"answer": '"{impulse}"', "unit": "kN"}, "formula-unit"),
        ({"answer": '"{touch-5}"'}, "formula-nothing"),
        ({"answer": '"{impulse} / ({speed} - {speed})"'}, "formula-nothing"),
        ({"answer": '"{wave_speed}"', "unit": "m/s", "scene": "two-balls"}, "formula-nothing"),
        ({"answer": "0.5", "name": "impulse"}, "answer-contradicts"),
        ({"answer": "12", "name": "peak-force", "unit": "kN"}, "answer-contradicts"),
        ({"answer": '"{impulse}"', "more": MISTAKE.format('"{impulse} * 1.01"')}, "mistake-right"),
        ({"answer": "5", "more": MISTAKE.format("4.95")}, "mistake-right"),
    ],
)
def test_what_cannot_be_is_refused_with_its_line(tmp_path, given, code):
    found = checked(tmp_path, asked(**given))
    assert [line for line, _ in found] == [16 if "more" in given else 10]
    assert code == "allowed" or [each for _, each in found] == [code]


def test_a_question_that_is_called_as_a_result_may_leave_its_sign_away(tmp_path):
    assert checked(tmp_path, asked("0.699", "m/s", "impactor-velocity")).answer == 0.699


def test_a_lesson_of_a_visitors_own_gets_its_answers_with_its_scenes():
    content = asked('"{impulse}"', scene="two-balls").encode()
    (question,) = json.loads(read_own(content, "en"))["lesson"]["steps"][0]["parts"]
    assert question["answer"] is None
    found = json.loads(try_own(content, "en"))
    (question,) = found["lesson"]["steps"][0]["parts"]
    assert question["answer"] > 0.0 and question["tolerance"] == pytest.approx(0.02 * question["answer"], rel=1e-12)
    assert json.loads(try_own(asked("1").encode(), "en")) == {"whole": True}


def test_one_whose_answers_take_too_long_is_refused(monkeypatch):
    monkeypatch.setattr("app.lessons.own.TRY_SECONDS", 0.0)
    ((line, sentence),) = json.loads(try_own(asked('"{impulse}"').encode(), "en"))["problems"]
    assert line == 9 and "asked" in sentence and "impact lesson check" in sentence


@pytest.mark.parametrize("name", list(stored()))
def test_stored_answers_are_those_that_are_solved_for(name):
    """`python -m app.lessons.storing` writes them anew."""
    now = solved_answers(check(FOLDER / f"{name}.md").lesson)
    kept = json.loads(STORED.read_text("utf-8"))[name]
    assert now.keys() == kept.keys()
    for question, own in now.items():
        if isinstance(own, dict):
            assert kept[question]["boundary"] == pytest.approx(own["boundary"], abs=1e-4)
            assert stored()[name][question] == tuple(kept[question]["boundary"])
            continue
        answer, mistakes = own
        assert kept[question][0] == pytest.approx(answer, rel=1e-9)
        pairs = zip(kept[question][1], mistakes, strict=True)
        assert all(old == new or old == pytest.approx(new, rel=1e-9) for old, new in pairs)
        assert stored()[name][question] == Solved(kept[question][0], tuple(kept[question][1]))


def test_every_formula_of_a_shipped_lesson_has_its_answer():
    for path in FOLDER.glob("*.md"):
        parts = [part for step in shipped_lesson(path.name.split(".")[0]).steps for part in step.parts]
        assert all(part.answer is not None for part in parts if part.KIND == "number")
        assert all(part.truth for part in parts if isinstance(part, Boundary))
