"""The command `impact lesson`: errors by line and an exit code, and a file to begin with."""

import json

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


def test_where_nothing_can_be_written(capsys, tmp_path):
    assert "FILE: got" in refusal(capsys, "lesson", "new", str(tmp_path / "none" / "a.md"))


def test_a_command_must_be_named(capsys):
    assert "missing: COMMAND" in refusal(capsys, "lesson")
