"""Every language says what the source says: all of it, with the same gaps."""

import re
import tomllib
from collections.abc import Iterator
from functools import cache
from typing import Any

import pytest

from app.text.catalogues import HERE, LANGUAGES, command, lessons, page
from solvers.text.catalogue import OWN, SOURCE, flat, languages, library
from solvers.text.messages import Choice, Term, Value, parsed

from .pseudo import scenes

ROOMS = {  # folders of one language each, what is below, and all that is said with it
    "page": (HERE, "page", page),
    "command": (HERE, "command", command),
    "lessons": (HERE, "lessons", lessons),
    "library": (OWN, "", library),
}
TRANSLATED = sorted({*LANGUAGES, *languages()} - {SOURCE})
ENGLISH = re.compile(r"(?<!-)\b(the|of|and|with|which|are|from|this)\b(?!-)")
TITLES = re.compile(r"Lindley, [^,]+,|Wood Handbook")  # of books
EACH = pytest.mark.parametrize("language", TRANSLATED)
EVERY = pytest.mark.parametrize("room", ROOMS)


def own(room: str, language: str) -> dict[str, str]:
    """What the files of a room say, by codes."""
    folder, below, _ = ROOMS[room]
    files = sorted((folder / language / below).glob("*.toml"))
    return {code: text for file in files for code, text in flat(tomllib.loads(file.read_text("utf-8")))}


def translated(room: str, language: str) -> dict[str, str]:
    """The same but for scenes, whose texts their files have in the source."""
    return {code: text for code, text in own(room, language).items() if not code.startswith("scene.")}


def gaps(code: str, catalogue: Any) -> set[tuple[str, str]]:
    """Values with their formats, and keys of options, in a text and in the terms that it mentions."""
    return set(_gaps(parsed(catalogue.texts[code]), catalogue))


def _gaps(pieces: list[Any], catalogue: Any) -> Iterator[tuple[str, str]]:
    for piece in pieces:
        if isinstance(piece, Value):
            yield piece.name, piece.format
        elif isinstance(piece, Term):
            yield from _gaps(parsed(catalogue.terms[piece.name]), catalogue)
        elif isinstance(piece, Choice):
            yield from ((piece.name, f"{piece.by} {key}") for key in piece.options if piece.by == "select")
            for inner in piece.options.values():
                yield from _gaps(inner, catalogue)


def words(pieces: list[Any]) -> str:
    """What is said whatever the values are."""
    options = (words(inner) for piece in pieces if isinstance(piece, Choice) for inner in piece.options.values())
    return " ".join([*(piece for piece in pieces if isinstance(piece, str)), *options])


@cache
def keys() -> set[str]:
    """By which any text of the source chooses, and what its texts are called: kinds, quantities, figures."""
    found = {gap[1] for _, _, of in ROOMS.values() for code in of(SOURCE).texts for gap in gaps(code, of(SOURCE))}
    return found | {f"select {code.split('.')[-1]}" for _, _, of in ROOMS.values() for code in of(SOURCE).texts}


@EACH
@EVERY
def test_every_text_is_translated_and_no_other(room, language):
    """A language may have terms of its own, as for other cases of a noun."""
    found, source = translated(room, language), own(room, SOURCE)
    assert source.keys() - found.keys() == set()
    assert {code for code in found.keys() - source.keys() if not code.startswith("terms.")} == set()


@EACH
@EVERY
def test_translations_take_the_values_that_the_source_takes(room, language):
    """By the same formats, but that a share may be one that has the decimal sign of the language. They may choose by
    other values than the source, as genders ask for it, if there are such; plurals are as many as the language has."""
    _, _, of = ROOMS[room]
    for code in translated(room, language).keys() & own(room, SOURCE).keys():
        said, source = gaps(code, of(language)), gaps(code, of(SOURCE))
        assert {name for name, _ in said} == {name for name, _ in source}, code
        shares = {(name, "percent") for name, form in source if form.endswith("%")}
        new = said - source - shares
        assert [form for _, form in new if not form.startswith("select ") or form not in keys()] == [], code


@EACH
@EVERY
def test_nothing_of_the_source_is_left_in_a_translation(room, language):
    for code, text in translated(room, language).items():
        assert not ENGLISH.search(TITLES.sub("", words(parsed(text)))), code


def test_texts_of_scenes_are_in_their_files_in_the_source():
    assert [code for room in ROOMS for code in own(room, SOURCE) if code.startswith("scene.")] == []


@EACH
def test_texts_of_scenes_are_of_scenes_that_there_are(language):
    found = {code: text for code, text in own("library", language).items() if code.startswith("scene.")}
    assert found.keys() - scenes().keys() == set()
    if found:
        assert scenes().keys() - found.keys() == set()
    assert [code for code, text in found.items() if not text.strip()] == []


def test_each_language_of_the_page_has_a_name_of_its_own():
    names = {page(language).texts["document.language"] for language in LANGUAGES}
    assert len(names) == len(LANGUAGES) > 1
