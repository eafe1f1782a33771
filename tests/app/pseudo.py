"""A language in which every word stands in brackets, so that whatever no catalogue says is seen: Esperanto, as far
as page and command know.

`python -m tests.app.pseudo ARGUMENTS` is `impact ARGUMENTS` with it beside the others.
"""

import re
import sys
from collections.abc import Iterator
from typing import Any

import app.text.catalogues as catalogues
import solvers
import solvers.text.catalogue as catalogue
from solvers.text.catalogue import Catalogue, library
from solvers.text.messages import Choice, Term, Value, parsed

LANGUAGE = "eo"
WORD = re.compile(r"(?<![\w^_.])[^\W\d_]{3,}(?![\w^_(])")  # no symbol, and no part of a key
BARE = re.compile(r"(?<![⟦\w^_.'-])[^\W\d_]{3,}(?![\w⟧^_(=.'-]|: [a-z])")  # that no catalogue has said


def bracketed(message: str) -> str:
    """A message of a catalogue with each of its own words in brackets, its gaps as they are."""
    return "".join(_pieces(parsed(message)))


def _pieces(pieces: list[Any]) -> Iterator[str]:
    for piece in pieces:
        if isinstance(piece, str):
            yield WORD.sub(r"⟦\g<0>⟧", piece)
        elif isinstance(piece, Term):
            yield f"{{@{piece.name}}}"
        elif isinstance(piece, Value):
            yield f"{{{piece.name}:{piece.format}}}" if piece.format else f"{{{piece.name}}}"
        elif isinstance(piece, Choice):
            options = " ".join(f"{key} {{{''.join(_pieces(inner))}}}" for key, inner in piece.options.items())
            yield f"{{{piece.name}, {piece.by}, {options}}}"


def scenes() -> dict[str, str]:
    """Texts of the scenes, which their files have in English."""
    found = {}
    for name in solvers.scene_names():
        scene = solvers.load(name)
        texts = {"title": scene.title or name, "note": scene.note, "source": scene.source}
        found |= {f"scene.{name}.{what}": text for what, text in texts.items() if text}
    return found


def speak() -> None:
    """Have this process know the language; before anything that says something is imported."""
    own, of_scenes = Catalogue.__init__, scenes()

    def made(self: Catalogue, language: str, rooms: Any) -> None:
        own(self, language, rooms)
        if language == LANGUAGE:
            plain = {code: WORD.sub(r"⟦\g<0>⟧", text) for code, text in of_scenes.items()}
            self.texts = {code: bracketed(text) for code, text in self.texts.items()} | plain
            self.terms = self.family("terms")

    Catalogue.__init__ = made
    library.cache_clear()
    known = catalogue.languages() | {LANGUAGE}
    catalogue.languages = lambda: known
    catalogues.LANGUAGES = (*catalogues.LANGUAGES, LANGUAGE)


if __name__ == "__main__":
    speak()
    from app.command.main import main

    sys.exit(main(sys.argv[1:]))
