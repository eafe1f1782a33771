"""A boundary that is drawn over a map: what of it is refused, what it is solved to be, and how a line is judged."""

import json
import subprocess

import numpy as np
import pytest

from app.lessons.checking import check
from app.lessons.judging import exact_boundary, judged
from app.lessons.lesson import Boundary
from app.lessons.own import read_own, try_own
from app.lessons.paper import Paper
from app.lessons.record import lesson_record
from app.lessons.shipped import shipped_lesson
from app.serving.pages import STATIC

from ...patience import SECONDS
from .written import HEAD, lesson, refused

SCENE = """\
## Step
:::{scene}
changes = { mass_ratio = 3.0, law = "hertz", hertz_stiffness = 3e11 }
show = ["bodies", "map"]
map = ["contacts", "speed", "hertz_stiffness"]
:::
"""
SKETCH = """\
:::{sketch} border
track = "boundary"
contacts = 2
across = [0.1, 10]
upwards = [1e10, 1e12]
given = [1, 1e11]
[[judge]]
falls = [0.1, 10]
yes = "Yes."
no = "No."
[[judge]]
near = [0.1, 10]
within = 0.08
yes = "Yes."
high = "High at {at}: {yours}, not {true}, off by {off}."
low = "Low."
:::
"""
STEP = shipped_lesson("heavier-faster-softer").steps[6]
(BORDER,) = [part for part in STEP.parts if isinstance(part, Boundary)]
PLACES = np.linspace(0.0, 1.0, 101)
JUDGE = f"""
import {{ curveOver, judged }} from '{STATIC}/lesson/judge.js';
import {{ valueOf }} from '{STATIC}/lesson/events.js';
const {{ judges, lines, truth }} = JSON.parse((await import('node:fs')).readFileSync(0, 'utf-8'));
const so = valueOf(curveOver(truth));
const of = (line) => judged(line, judges, [0, 1], so).map(({{ outcome, yours }}) => [outcome, yours]);
console.log(JSON.stringify(lines.map(of)));
"""


def test_values_of_settings_become_shares_of_what_is_shown():
    (part,) = [each for each in lesson(SCENE + SKETCH).steps[0].parts if isinstance(each, Boundary)]
    assert (part.contacts, part.settings, part.logs) == (2, ("speed", "hertz_stiffness"), (True, True))
    assert part.given == pytest.approx((0.5, 0.5)) and part.truth == ()
    assert [each.at for each in part.judges] == [(0.0, 1.0)] * 2
    linear = SKETCH.replace("across = [0.1, 10]", "across = [1, 2]").replace("[0.1, 10]\ny", "[1, 1.41421356]\ny")
    linear = linear.replace("[0.1, 10]\nw", "[1, 2]\nw").replace("given = [1,", "given = [2,")
    (part,) = [each for each in lesson(SCENE + linear).steps[0].parts if isinstance(each, Boundary)]
    assert part.given[0] == pytest.approx(1.0) and part.judges[0].at == pytest.approx((0.0, 0.5))


@pytest.mark.parametrize(
    "old, new, line, said",
    [
        ('"bodies", "map"', '"bodies"', 15, "track: got 'boundary'; allowed: in a step without a map"),
        ('map = ["contacts", "speed", "hertz_stiffness"]\n', "", 14, "track: got 'boundary'; allowed: in a"),
        (', law = "hertz", hertz_stiffness = 3e11', "", 12, "map: got ['contacts', 'speed', 'hertz_stiffness']"),
        ("contacts = 2", "contacts = 1", 16, "contacts: got 1; allowed: a whole number"),
        ("contacts = 2", "contacts = 7", 16, "contacts: got 7; allowed: a whole number"),
        ("contacts = 2", "contacts = 2.5", 16, "contacts: got 2.5; allowed: a whole number"),
        ("contacts = 2\n", "", 14, "contacts: got nothing; allowed: a whole number"),
        ("across = [0.1, 10]", "across = [10, 0.1]", 17, "across: got [10, 0.1]; allowed: two numbers that rise"),
        ("upwards = [1e10, 1e12]", "upwards = [1, 1e12]", 18, "upwards: got [1, 1000000000000.0]; allowed: two"),
        ("falls = [0.1, 10]", "falls = [0.01, 10]", 21, "judge[1].falls: got [0.01, 10]; allowed: two numbers that"),
        ("falls = [0.1, 10]", "jump = 1", 20, "judge[1]: got nothing; allowed: one of falls, rises, near as a key"),
        ("falls = [0.1, 10]", "falls = ['touch', 'part']", 21, "judge[1].falls: got ['touch', 'part']; allow"),
        ("given = [1, 1e11]", "given = [1, 1e13]", 19, "given: got [1.0, 10000000000000.0]; allowed: two numbers, a"),
        ("contacts = 2", "contacts = 2\nunit = 'N'", 17, "unit: got 'N'; allowed: no such key"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_with_its_line(old, new, line, said):
    text = (SCENE + SKETCH).replace(old, new, 1)
    found = refused(text)
    assert any(at == line and each.startswith(said) for at, each in found), found


def test_a_map_of_an_earlier_step_is_still_shown_and_another_show_takes_it_away():
    assert lesson(SCENE + "## Next\n" + SKETCH)
    (found,) = refused(SCENE + '## Next\n:::{scene}\nshow = ["bodies", "rows"]\n:::\n' + SKETCH)
    assert found[1].startswith("track: got 'boundary'")


@pytest.mark.parametrize(
    "old, new, line, said",
    [
        ("contacts = 2", "contacts = 3", 14, "contacts: no boundary of 3 contacts is on the map at speed = 0.1;"),
        ("upwards = [1e10, 1e12]", "upwards = [1e10, 1e14]", 14, "contacts: 2 boundaries of 2 contacts lie above each"),
        ("upwards = [1e10, 1e12]", "upwards = [1e11, 1e12]", 14, "contacts: no boundary of 2 contacts is on"),
        ("falls", "rises", 21, "rises: got a criterion of which the exact curve gets no"),
        ("within = 0.08", "within = 0.3", 0, ""),
        ('[[judge]]\nfalls = [0.1, 10]\nyes = "Yes."\nno = "No."\n', "", 0, ""),
    ],
)  # fmt: skip
def test_check_solves_for_the_boundary(tmp_path, old, new, line, said):
    file = tmp_path / "tried.md"
    file.write_text(HEAD + (SCENE + SKETCH).replace(old, new, 1), "utf-8")
    found = [(each.line, each.said()) for each in check(file).problems]
    if line:
        assert [at for at, _ in found] == [line] and found[0][1].startswith(said), found
    else:
        assert found == []


def test_a_question_that_a_level_line_answers_is_refused(tmp_path):
    file = tmp_path / "tried.md"
    whole = '[[judge]]\nfalls = [0.1, 10]\nyes = "Yes."\nno = "No."\n'
    level = (SCENE + SKETCH).replace(whole, "").replace("within = 0.08", "within = 0.3")
    file.write_text(HEAD + level, "utf-8")
    ((line, said),) = [(each.line, each.said()) for each in check(file).problems]
    assert line == 14 and said.startswith("judge: a level line at hertz_stiffness = ") and "gets every yes" in said


def test_a_lesson_of_a_visitors_own_gets_its_boundary_with_its_scenes(monkeypatch):
    content = (HEAD + SCENE + SKETCH).encode()
    assert json.loads(read_own(content, "en"))["lesson"]["steps"][0]["parts"][1]["truth"] == []
    found = json.loads(try_own(content, "en"))
    truth = found["lesson"]["steps"][0]["parts"][1]["truth"]
    assert found["whole"] and truth == pytest.approx(BORDER.truth, abs=1e-3)
    monkeypatch.setattr("app.lessons.own.TRY_SECONDS", 0.0)
    ((_, sentence),) = json.loads(try_own(content, "en"))["problems"]
    assert "border" in sentence and "impact lesson check" in sentence


def outcomes(line):
    return [each.outcome for each in judged(np.asarray(line), BORDER, {})]


@pytest.mark.parametrize(
    "line, said",
    [
        (exact_boundary(BORDER), ["yes", "yes"]),
        (exact_boundary(BORDER) + 0.079, ["yes", "yes"]),
        (exact_boundary(BORDER) + 0.081, ["yes", "high"]),
        (exact_boundary(BORDER) - 0.1, ["yes", "low"]),
        (np.full(101, 0.5), ["no", "low"]),
        (exact_boundary(BORDER)[::-1], ["no", "low"]),
        (1.0 - PLACES, ["yes", "low"]),
    ],
)
def test_lines(line, said):
    assert outcomes(line) == said


@pytest.mark.browser  # needs Node
def test_browser_and_python_judge_a_line_alike():
    random = np.random.default_rng(7)
    corners = [0.0, 0.3, 0.6, 1.0]
    near = [np.interp(corners, PLACES, exact_boundary(BORDER)) + random.normal(0.0, 0.06, 4) for _ in range(300)]
    lines = [np.round(np.interp(PLACES, corners, each), 4) for each in near]
    judges = lesson_record(shipped_lesson("heavier-faster-softer"))["steps"][6]["parts"][2]["judges"]
    asked = json.dumps({"judges": judges, "truth": BORDER.truth, "lines": [line.tolist() for line in lines]})
    call = ["node", "--input-type=module", "--eval", JUDGE]
    run = subprocess.run(call, input=asked, capture_output=True, text=True, check=True, timeout=SECONDS)
    found = json.loads(run.stdout)
    assert [[outcome for outcome, _ in each] for each in found] == [outcomes(line) for line in lines]
    assert {outcome for each in found for outcome, _ in each} == {"yes", "no", "high", "low"}
    places = [[judged(line, BORDER, {})[1].yours] for line in lines]
    assert [each[1][1:] for each in found] == [pytest.approx(place, abs=1e-9) for place in places]


@pytest.mark.parametrize("language, said", [("en", "a second contact begins"), ("es", "empieza un segundo contacto")])
def test_on_paper_it_says_what_is_to_be_drawn(language, said):
    assert said in Paper(shipped_lesson("heavier-faster-softer", language)).handout()
