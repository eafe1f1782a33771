"""A catalogue: the texts of one language, from the TOML files of one or more rooms."""

import os
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from .messages import filled, names_in, terms_in

SOURCE = "en"  # in which all has a text
CHOSEN = "IMPACT_LANGUAGE"  # variable of the environment: what commands and notebooks speak
OWN = Path(__file__).parent


class Catalogue:
    """Texts by code. A table in a file is a part of the code: `[terms] waves` is "terms.waves".

    `rooms`: folders that have one folder for each language, and what is below that. A later one may name the terms of
    an earlier one in its own way. What a language has no text for is said in `SOURCE`.
    """

    def __init__(self, language: str, rooms: Sequence[tuple[Path, str]]):
        self.language = language
        self.texts: dict[str, str] = {}
        for each in dict.fromkeys((SOURCE, language)):
            known: set[str] = set()
            for room, below in rooms:
                for file in sorted((room / each / below).glob("*.toml")):
                    self._take(dict(flat(tomllib.loads(file.read_text(encoding="utf-8")))), file, known)
        self.terms: Mapping[str, str] = self.family("terms")

    def _take(self, texts: Mapping[str, str], file: Path, known: set[str]) -> None:
        twice = [code for code in texts if code in known and not code.startswith("terms.")]
        if twice:
            raise ValueError(f"{file}: {', '.join(twice)} has a text already")
        known.update(texts)
        self.texts |= texts

    def text(self, code: str, /, **values: Any) -> str:
        """The sentence of a code. Raises KeyError for a code, a value or a term that is not there."""
        return filled(self.texts[code], values, self)

    def names(self, code: str) -> set[str]:
        """Values that the text of a code takes, and those of the terms that it mentions."""
        found = names_in(self.texts[code])
        return found.union(*(self.names(f"terms.{term}") for term in terms_in(self.texts[code])))

    def family(self, code: str) -> dict[str, str]:
        """All texts below a code, such as the titles of controls, by the rest of their codes."""
        start = f"{code}."
        return {name.removeprefix(start): text for name, text in self.texts.items() if name.startswith(start)}


def flat(table: Mapping[str, Any], start: str = "") -> Iterator[tuple[str, str]]:
    """Codes and texts of nested tables."""
    for name, part in table.items():
        if isinstance(part, Mapping):
            yield from flat(part, f"{start}{name}.")
        else:
            yield f"{start}{name}", part


@cache
def languages() -> frozenset[str]:
    """Those that have texts, by the names of their folders, such as `es` or `pt-BR`."""
    return frozenset(folder.name for folder in OWN.iterdir() if any(folder.glob("*.toml")))


def spoken() -> str:
    """The language of this process, for what is said to who runs it; a page has one for each visitor."""
    chosen = os.environ.get(CHOSEN, SOURCE)
    return chosen if chosen in languages() else SOURCE


@cache
def library(language: str) -> Catalogue:
    """What the library itself says."""
    return Catalogue(language, ((OWN, ""),))
