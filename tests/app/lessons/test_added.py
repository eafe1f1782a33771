"""Lessons of a server's own folder: behind those of the program, or refused by line before anything is served."""

import json
import os

import pytest

from app.command.main import main
from app.lessons import shipped
from app.lessons.added import add
from app.lessons.shipped import lesson_names, shipped_lesson
from app.page.picker import lessons
from app.serving.lessons import lesson_text

from ..command.calls import refusal

LESSON = """---
lesson: NAME
version: 1
language: en
title: A mass strikes
scene: fixed-rod
---

## What will happen?

Look.
"""
TRANSLATION = """---
translates: mine.md
language: fr
title: Une masse frappe
---

## Que se passe-t-il ?

Regarde.
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setattr(shipped, "ADDED", {})
    monkeypatch.setattr("app.lessons.added.ADDED", shipped.ADDED)
    write(tmp_path, "mine.md", LESSON.replace("NAME", "mine"))
    return tmp_path


def write(folder, name, text):
    (folder / name).write_text(text, encoding="utf-8")


def said(folder):
    return [(path.name, problem.line, problem.note.code) for path, problem in add(folder)]


def test_they_are_listed_behind_those_of_the_program_and_opened_by_name(folder):
    write(folder, "mine.fr.md", TRANSLATION)
    before = lesson_names()
    assert add(folder) == []
    (folder / "mine.md").unlink()  # what was checked is what is served
    assert lesson_names() == [*before, "mine"]
    assert [each["name"] for each in lessons("en")][-1] == "mine"
    assert json.loads(lesson_text("mine", "en"))["title"] == "A mass strikes"
    assert [shipped_lesson("mine", each).title for each in ("fr", "es")] == ["Une masse frappe", "A mass strikes"]
    assert "fr" in shipped.lesson_languages()


def test_names_are_those_of_files_and_none_of_the_program(folder):
    write(folder, "other.md", LESSON.replace("NAME", "another"))
    write(folder, "bounce-twice.md", LESSON.replace("NAME", "bounce-twice"))
    write(folder, "mine.es.md", TRANSLATION)
    assert said(folder) == [
        ("bounce-twice.md", 2, "lesson.name-shipped"),
        ("other.md", 1, "lesson.file-elsewhere"),
        ("mine.es.md", 1, "lesson.file-elsewhere"),
    ]
    assert "mine" not in lesson_names()


def test_the_server_does_not_start_with_a_lesson_that_has_errors(folder, capsys, monkeypatch):
    write(folder, "wrong.md", LESSON.replace("NAME", "wrong").replace("fixed-rod", "no-rod"))
    monkeypatch.setenv("IMPACT_LESSONS", str(folder))
    assert main(["serve"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(f"{folder / 'wrong.md'}:6: scene: got ") and err.count("\n") == 1


@pytest.mark.parametrize("given", ["", "nowhere", "a\0b"])
def test_a_folder_without_lessons_is_refused(given, tmp_path, capsys):
    assert "a folder with lesson files" in refusal(capsys, "serve", "--lessons", str(tmp_path / given))


def test_a_pipe_and_what_says_what_is_in_the_folder_are_none(folder):
    """A pipe was waited for without end."""
    os.mkfifo(folder / "pipe.md")
    write(folder, "README.md", "Lessons of mine.")
    (folder / "folder.md").mkdir()
    assert add(folder) == [] and list(shipped.ADDED) == ["mine"]
