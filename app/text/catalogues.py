"""The catalogues of page and command, and the page's as the browser takes it."""

import json
from functools import cache
from pathlib import Path

from solvers.text.catalogue import LANGUAGE, OWN, Catalogue

HERE = Path(__file__).parent
LANGUAGES = tuple(sorted(folder.name for folder in HERE.iterdir() if (folder / "page").is_dir()))


@cache
def page(language: str = LANGUAGE) -> Catalogue:
    """All that the page says: its own words, and the notes of the library with the page's names for things."""
    return Catalogue(language, (OWN / language, HERE / language / "page"))


@cache
def command(language: str = LANGUAGE) -> Catalogue:
    """All that the command says; things are named as scene files name them."""
    return Catalogue(language, (OWN / language, HERE / language / "command"))


@cache
def script(language: str = LANGUAGE) -> str:
    """The page's catalogue as a script for the browser, see app/static/text/catalogue.js."""
    texts = json.dumps({"language": language, "texts": page(language).texts}, ensure_ascii=False)
    return f"globalThis.strikewaveTexts = {texts};\n"
