"""The catalogues of page, command and lesson files, and the page's as the browser takes it."""

import json
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from babel import Locale

from solvers.text.catalogue import OWN, SOURCE, Catalogue

HERE = Path(__file__).parent
LANGUAGES = tuple(sorted(folder.name for folder in HERE.iterdir() if (folder / "page").is_dir()))
MOST_ACCEPTED = 20  # languages of a browser that are looked at


@cache
def page(language: str) -> Catalogue:
    """All that the page says: its own words, and the notes of the library with the page's names for things."""
    return Catalogue(language, ((OWN, ""), (HERE, "page")))


@cache
def command(language: str) -> Catalogue:
    """All that the command says; things are named as scene files name them."""
    return Catalogue(language, ((OWN, ""), (HERE, "command")))


@cache
def lessons(language: str) -> Catalogue:
    """All that is said of lesson files; the page has no use for it, and is not sent it."""
    return Catalogue(language, ((OWN, ""), (HERE, "lessons")))


def of_browser(language: str) -> dict[str, str]:
    """What of the page's catalogue a browser asks for: not what is printed."""
    return {code: text for code, text in page(language).texts.items() if not code.startswith("printed.")}


@cache
def script(language: str) -> str:
    """The page's catalogue as a script for the browser, see app/static/text/catalogue.js."""
    others = {each: page(each).texts["document.language"] for each in LANGUAGES if each != language}
    texts = {"language": language, "others": others, "texts": of_browser(language)}
    return f"globalThis.strikewaveTexts = {json.dumps(texts, ensure_ascii=False)};\n"


def direction(language: str) -> str:
    """In which it is written, as documents say it: ltr or rtl."""
    return Locale.parse(language, sep="-").text_direction


def language_for(accepted: str, languages: Iterable[str] = ()) -> str:
    """The language of a visitor whose browser accepts these, as its `Accept-Language` says, the dearest first; one of
    `languages`, or of those of the page."""
    known = {language.lower(): language for language in languages or LANGUAGES}
    for part in accepted.lower().split(",")[:MOST_ACCEPTED]:
        wanted = part.partition(";")[0].strip()
        for tag in (wanted, wanted.partition("-")[0]):
            if tag in known:
                return known[tag]
    return SOURCE
