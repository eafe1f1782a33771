"""The command `impact lesson`: errors by line and an exit code, and a file to begin with."""

import json
import re

import pytest

from app.command.main import main
from app.lessons.shipped import FOLDER

from .calls import answer, refusal

WRONG = "---\nlesson: tried\nversion: 3\nlanguage: en\ntitle: Tried\nscene: fixed-rod\n---\n## Step\n:::{quiz} a\n:::\n"


@pytest.fixture
def wrong(tmp_path):
    file = tmp_path / "wrong.md"
    file.write_text(WRONG, encoding="utf-8")
    return str(file)


def test_right_lessons(capsys):
    files = [str(FOLDER / name) for name in ("bounce-twice.md", "bounce-twice.es.md")]
    assert answer(capsys, "lesson", "check", *files).splitlines() == [f"{file}: no errors, 6 steps" for file in files]


def test_errors_are_listed_by_line(capsys, wrong):
    assert main(["lesson", "check", str(FOLDER / "bounce-twice.md"), wrong]) == 1
    out, err = capsys.readouterr()
    assert err == ""
    assert [line.split(": ")[0] for line in out.splitlines()[1:]] == [f"{wrong}:3", f"{wrong}:9"]


def test_errors_as_json(capsys, wrong):
    assert main(["lesson", "check", "--json", wrong]) == 1
    (found,) = json.loads(capsys.readouterr().out)
    assert (found["file"], found["missing"]) == (wrong, [])
    assert [(each["line"], each["code"]) for each in found["errors"]] == [
        (3, "lesson.version-later"),
        (9, "lesson.fence-unknown"),
    ]
    assert found["errors"][0]["sentence"].startswith("version: got 3; allowed: 1")


def test_a_file_that_is_not_there(capsys):
    assert main(["lesson", "check", "nowhere.md"]) == 1
    assert capsys.readouterr().out == "nowhere.md:1: the file cannot be read (No such file or directory)\n"


def test_what_a_translation_lacks_is_listed(capsys, tmp_path):
    for name in ("bounce-twice.md", "bounce-twice.es.md"):
        text = (FOLDER / name).read_text("utf-8")
        (tmp_path / name).write_text(
            text.replace('say = "La fuerza de un choque', '# say = "La fuerza'), encoding="utf-8"
        )
    lines = answer(capsys, "lesson", "check", str(tmp_path / "bounce-twice.es.md")).splitlines()
    assert lines[0].endswith("in the language of the original: :::{summary} (Your answers): say")
    assert lines[1].endswith("no errors, 6 steps")


def test_a_new_lesson_passes_its_check_and_is_never_overwritten(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for given, file in (([], "lesson.md"), (["my-own.md"], "my-own.md"), (["My own.md"], "My own.md")):
        assert file in answer(capsys, "lesson", "new", *given)
        assert answer(capsys, "lesson", "check", file) == f"{file}: no errors, 4 steps\n"
        before = (tmp_path / file).read_bytes()
        assert "allowed: a file that is not there yet" in refusal(capsys, "lesson", "new", file)
        assert (tmp_path / file).read_bytes() == before
    assert "lesson: my-own\n" in (tmp_path / "my-own.md").read_text("utf-8")


def test_a_lesson_for_paper_and_its_key(capsys):
    file = str(FOLDER / "bounce-twice.md")
    paper, key = answer(capsys, "lesson", "print", file), answer(capsys, "lesson", "print", file, "--key")
    assert paper.startswith("# What comes after the bounce?\n\nName: ____") and paper.count("\n## ") == 5
    for asked in (
        "- [ ] A second contact\n",
        "____ s / ms / µs\n",
        "____ Mass and rod touch\n",
        "Mass ratio, from 0.34 to 10 (at the start: 0.8): ____",
        "Draw it from 0 to 2.6 T, in kN, from 0 to 120.",
    ):
        assert asked in paper
    assert not any(told in paper for told in ("116", "Yes: a wave", "bounce twice", "One contact.", "In your line"))
    assert "# Key: Why does it bounce twice?" in key and "**116.4 µs** (± 2.3 µs)" in key
    assert "**✓** A second contact: Yes: a wave" in key and "- 58.19 µs: After this time" in key
    assert "**Mass ratio from 1.02 to 10**: One contact." in key and "1. Mass and rod touch\n2. The front" in key


def test_a_lesson_on_paper_is_in_its_own_language(capsys):
    paper = answer(capsys, "lesson", "print", str(FOLDER / "what-an-impact-is.es.md"), "--key")
    assert "# Soluciones: Qué es un impacto" in paper and "**0,4467 N s**" in paper


def test_the_key_of_a_slider_without_ranges_says_where_it_is(capsys, tmp_path):
    text = (FOLDER / "bounce-twice.md").read_text("utf-8")
    whole = text.replace("range = [1.02, 10]\n", "").replace("range = [0.34, 0.57]\n", "")
    (tmp_path / "bounce-twice.md").write_text(whole, encoding="utf-8")
    key = answer(capsys, "lesson", "print", str(tmp_path / "bounce-twice.md"), "--key")
    (line,) = [line for line in key.splitlines() if "A light mass leaves" in line]
    low, high = re.findall(r"from ([\d.]+) to ([\d.]+)", line)
    assert (
        float(low[0]) == 0.34 and 0.5 < float(low[1]) < 0.58 and 1.0 < float(high[0]) < 1.1 and float(high[1]) == 10.0
    )


def test_a_lesson_with_errors_is_not_printed(capsys, wrong):
    assert main(["lesson", "print", wrong]) == 1
    assert [line.split(": ")[0] for line in capsys.readouterr().out.splitlines()] == [f"{wrong}:3", f"{wrong}:9"]


def test_a_new_lesson_is_in_the_language_that_is_spoken_and_of_a_scene(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("IMPACT_LANGUAGE", "es")
    answer(capsys, "lesson", "new", "caida.md", "--scene", "drop-test")
    written = (tmp_path / "caida.md").read_text("utf-8")
    assert "language: es\n" in written and "scene: drop-test" in written and "## ¿Qué pasará?" in written
    assert answer(capsys, "lesson", "check", "caida.md") == "caida.md: sin errores, 4 pasos\n"
    assert "--scene" in refusal(capsys, "lesson", "new", "other.md", "--scene", "drop")
    assert not (tmp_path / "other.md").exists()


@pytest.mark.parametrize("name", ["bounce-twice", "a-ball-with-spin"])
def test_a_translation_to_begin_with_lacks_nothing(capsys, tmp_path, name):
    file = tmp_path / f"{name}.md"
    file.write_text((FOLDER / file.name).read_text("utf-8"), encoding="utf-8")
    made = tmp_path / f"{name}.pt-BR.md"
    assert made.name in answer(capsys, "lesson", "new", str(file), "--translation", "pt-BR")
    (line,) = answer(capsys, "lesson", "check", str(made)).splitlines()  # nothing is missing
    assert "no errors" in line and "language: pt-BR\n" in made.read_text("utf-8")
    assert "answer" not in made.read_text("utf-8").replace("answers", "")
    assert "FILE: got" in refusal(capsys, "lesson", "new", str(file), "--translation", "pt-BR")
    assert "--translation: got" in refusal(capsys, "lesson", "new", str(file), "--translation", "Spanish")
    assert main(["lesson", "new", str(made), "--translation", "es"]) == 1
    assert "is a translation itself" in capsys.readouterr().out


def test_where_nothing_can_be_written(capsys, tmp_path):
    assert "FILE: got" in refusal(capsys, "lesson", "new", str(tmp_path / "none" / "a.md"))


def test_a_command_must_be_named(capsys):
    assert "missing: COMMAND" in refusal(capsys, "lesson")
