"""A translation has sentences only; all else, and what it lacks, comes from its original."""

import pytest

from app.lessons.checking import check
from app.lessons.lesson import Choice
from app.lessons.problems import LessonError
from app.lessons.reading import read
from app.lessons.record import lesson_record
from app.lessons.shipped import FOLDER, shipped_lesson

from .written import CHOICE, HEAD, SUMMARY

ORIGINAL = HEAD + "## Step\n\nFirst.\n\n" + CHOICE + SUMMARY
OTHER = """\
---
lesson: tried
version: 1
language: es
translates: tried.md
title: Probado
---
## Paso

Primero.

:::{choice} first
[[option]]
text = "Esto"
say = "Sí."
[[option]]
text = "Eso"
say = "No."
:::
## Fin
:::{summary}
say = "Así es."
:::
"""


def files(folder, other, original=ORIGINAL):
    (folder / "tried.md").write_text(original, encoding="utf-8")
    (folder / "tried.es.md").write_text(other, encoding="utf-8")
    return folder / "tried.es.md"


def test_sentences_are_its_own(tmp_path):
    lesson = read(files(tmp_path, OTHER))
    assert (lesson.language, lesson.title, lesson.scene, lesson.missing) == ("es", "Probado", "fixed-rod", ())
    _, choice = lesson.steps[0].parts
    assert lesson.steps[0].title == "Paso"
    assert isinstance(choice, Choice)
    assert [(each.text[0].text, each.right) for each in choice.options] == [("Esto", True), ("Eso", False)]


def test_what_is_missing_is_the_originals_and_listed(tmp_path):
    other = OTHER.replace('say = "Sí."\n', "").replace("Primero.\n", "").replace("title: Probado\n", "")
    found = check(files(tmp_path, other))
    assert found.problems == ()
    assert found.missing == ("title", "text (Step)", ":::{choice} first (Step): option[1].say")
    assert found.lesson is not None
    assert found.lesson.steps[0].parts[1].options[0].say[0].text == "Yes."  # type: ignore[attr-defined]


def test_a_step_that_is_missing_is_listed(tmp_path):
    assert read(files(tmp_path, OTHER[: OTHER.index("## Fin")])).missing == ("End",)


@pytest.mark.parametrize(
    "old, new, line, said",
    [
        ('text = "Eso"', 'text = "Eso"\nright = true', 18, "option[2].right has no counterpart in the original"),
        ('text = "Esto"', 'text = "Esto"\nright = false', 15, "option[1].right: this comes from the original"),
        ("title: Probado", "scene: free-rod", 6, "scene: this comes from the original"),
        ("language: es", "language: en", 4, "language: got en; allowed: another one than that of the original"),
        ("translates: tried.md", "translates: ../tried.md", 5, "translates: got '../tried.md'; allowed: the name of a"),
        (
            "translates: tried.md",
            "translates: none.md",
            5,
            "translates: got 'none.md'; allowed: a lesson file in the same",
        ),
        ("translates: tried.md", "translates: tried.es.md", 5, "translates: tried.es.md is a translation itself"),
        ("{choice} first", "{choice} second", 12, ":::{choice} second has no counterpart"),
        (":::\n## Fin", '[[option]]\ntext = "Más"\n:::\n## Fin', 19, "option[3] has no counterpart"),
        ("Así es.", "Así {es}.", 22, "say: got es in braces"),
        ("## Fin", "## Fin\nMás.", 21, "text has no counterpart"),
    ],
)
def test_refusals(tmp_path, old, new, line, said):
    with pytest.raises(LessonError) as caught:
        read(files(tmp_path, OTHER.replace(old, new)))
    found = [(each.line, each.said()) for each in caught.value.problems]
    assert any(at == line and each.startswith(said) for at, each in found), found


def test_an_original_with_errors_is_to_be_checked_first(tmp_path):
    with pytest.raises(LessonError, match="has errors of its own"):
        read(files(tmp_path, OTHER, ORIGINAL.replace("right = true\n", "")))


def bare(record):
    """Without sentences."""
    if isinstance(record, dict):
        kept = {
            key: value
            for key, value in record.items()
            if not key.endswith(("title", "title_before")) and key != "audience"
        }
        return {key: bare(value) for key, value in kept.items() if key not in ("language", "translates")}
    if isinstance(record, list) and record and all(isinstance(each, dict) and "kind" in each for each in record):
        return (
            [] if "parts" not in record[0] and record[0]["kind"] in ("text", "value", "paragraph") else bare_all(record)
        )
    return bare_all(record) if isinstance(record, list) else record


def bare_all(record):
    return [bare(each) for each in record]


def test_the_shipped_translation_is_whole():
    lesson = shipped_lesson("bounce-twice", "es")
    assert lesson.language == "es" and lesson.missing == ()
    assert bare(lesson_record(lesson)) == bare(lesson_record(shipped_lesson("bounce-twice")))
    assert shipped_lesson("bounce-twice", "fr").language == "en"
    assert "bounce-twice.es.md" in [path.name for path in FOLDER.iterdir()]
