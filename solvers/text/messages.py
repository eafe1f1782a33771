"""Sentences with gaps, as catalogues keep them, and how values are filled in.

The syntax is a part of that of ICU messages: `{mass:.3g}` is a value with a format of Python, or with one of `FORMATS`
or `WORDED`; `{count, plural, =0 {none} one {one contact} other {{count} contacts}}` and `{kind, select, beam {…} other
{…}}` choose by a value; `{@waves}` is a term of the catalogue: what has one name wherever it is mentioned, or a
sentence that others end with, which takes their values. A brace cannot be written literally.
`app/static/text/catalogue.js` reads the same.
"""

import math
import re
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from typing import Any, NamedTuple, Protocol

from babel import Locale
from babel.numbers import get_decimal_symbol

OPENING = re.compile(r"\{(?P<name>@?[\w.-]+)(?:\}|:(?P<format>[^{}]+)\}|, (?P<by>plural|select), )")
OPTION = re.compile(r"\s*(?P<key>=\d+|[\w.-]+)\s*\{")
PREFIXES = "n", "µ", "m", "", "k", "M", "G"


def engineering(value: float, unit: str, digits: int = 3) -> str:
    """A value in SI units with the prefix that suits it: 100 µs rather than 0.0001 s."""
    rounded = float(f"{value:.{digits}g}")
    if rounded == 0.0 or not math.isfinite(rounded):
        return f"{rounded:g} {unit}"
    power = int(f"{rounded:e}".partition("e")[2])
    step = min(max(power // 3, -3), 3)
    return f"{float(f'{rounded / 1000.0**step:.{digits}g}'):.15g} {PREFIXES[step + 3]}{unit}"


FORMATS: dict[str, Callable[[Any], str]] = {
    "time": lambda seconds: engineering(seconds, "s"),
    "rough-time": lambda seconds: engineering(seconds, "s", 1),
    "length": lambda metres: engineering(metres, "m"),
    "force": lambda newtons: engineering(newtons, "N"),
    "stress": lambda pascals: engineering(pascals, "Pa"),
    "percent": lambda share: f"{float(f'{100.0 * share:.2g}'):g} %",
    "rough": lambda value: f"{float(f'{value:.1g}'):g}",  # one digit, 20 rather than 2e+01
    "integrators": lambda names: ", ".join(names),
    "list": ", ".join,
    "options": lambda words: ", ".join(map(repr, words)),
    "method": lambda label: f"'{label}'",  # of a method, with its resolution
    "law": lambda name: f"'{name}'",
    "kind": str,  # of a body
    "link": str,  # of a mechanism, by its name
    "links": ", ".join,
}


class Texts(Protocol):
    """What a sentence needs of its catalogue."""

    @property
    def language(self) -> str: ...

    @property
    def terms(self) -> Mapping[str, str]: ...

    @property
    def texts(self) -> Mapping[str, str]: ...

    def text(self, code: str, /, **values: Any) -> str: ...


class Value(NamedTuple):
    name: str
    format: str


class Term(NamedTuple):
    name: str


class Choice(NamedTuple):
    name: str
    by: str  # plural or select
    options: dict[str, list[Any]]


@cache
def parsed(message: str) -> list[Any]:
    """Texts, values, terms and choices. Raises ValueError for what does not close."""
    pieces, end = _pieces(message, 0)
    if end != len(message):
        raise ValueError(f"an unopened brace at {end} in {message!r}")
    return pieces


def _pieces(message: str, at: int) -> tuple[list[Any], int]:
    """Up to the end, or to the brace that closes an option."""
    pieces: list[Any] = []
    while at < len(message) and message[at] != "}":
        brace = re.compile(r"[{}]").search(message, at)
        stop = brace.start() if brace else len(message)
        if stop > at:
            pieces.append(message[at:stop])
            at = stop
            continue
        opening = OPENING.match(message, at)
        if opening is None:
            raise ValueError(f"no value at {at} in {message!r}")
        name, at = opening["name"], opening.end()
        if opening["by"]:
            options, at = _options(message, at)
            pieces.append(Choice(name, opening["by"], options))
        else:
            pieces.append(Term(name[1:]) if name[0] == "@" else Value(name, opening["format"] or ""))
    return pieces, at


def _options(message: str, at: int) -> tuple[dict[str, list[Any]], int]:
    options: dict[str, list[Any]] = {}
    while option := OPTION.match(message, at):
        options[option["key"]], end = _pieces(message, option.end())
        if message[end : end + 1] != "}":
            raise ValueError(f"an option that does not end in {message!r}")
        at = end + 1
    if message[at : at + 1] != "}" or "other" not in options:
        raise ValueError(f"a choice without an end, or without 'other', in {message!r}")
    return options, at + 1


def names_in(message: str) -> set[str]:
    """Values that it takes."""
    return {piece.name for piece in _walk(parsed(message)) if not isinstance(piece, Term)}


def terms_in(message: str) -> set[str]:
    """Terms that it mentions."""
    return {piece.name for piece in _walk(parsed(message)) if isinstance(piece, Term)}


def _walk(pieces: list[Any]) -> Iterator[Any]:
    for piece in pieces:
        if not isinstance(piece, str):
            yield piece
        if isinstance(piece, Choice):
            for option in piece.options.values():
                yield from _walk(option)


def filled(message: str, values: Mapping[str, Any], own: Texts) -> str:
    """The sentence."""
    return "".join(_shown(piece, values, own) for piece in parsed(message))


def _shown(piece: Any, values: Mapping[str, Any], own: Texts) -> str:
    if isinstance(piece, str):
        return piece
    if isinstance(piece, Term):
        return filled(own.terms[piece.name], values, own)
    value = values[piece.name]
    if isinstance(piece, Value):
        if piece.format in WORDED:
            return WORDED[piece.format](value, own)
        return written(value, piece.format, own.language)
    return "".join(_shown(inner, values, own) for inner in _option(piece, value, own.language))


def _said(note: Any, own: Texts) -> str:
    """Of a note, or of a code; what is neither stands as it is."""
    if isinstance(note, Mapping):
        return own.text(note["code"], **note["values"])
    return own.text(note) if note in own.texts else str(note)


def _model(parts: Mapping[str, Any], own: Texts) -> str:
    modes = filled(own.terms["resolution"], {"resolution": "modes"}, own)
    return ", ".join(f"{part} {modes}" if name == "modes" else part for name, part in parts.items())


def _figures(names: list[str], own: Texts) -> str:
    called = (own.texts.get(f"printed.quantity.{name}", name.replace("_", " ")) for name in names)
    return ", ".join(called) or own.text("name.none.figures")


def _error(share: float, own: Texts) -> str:
    return own.text("name.none.error") if share == 0.0 else f"{written(100.0 * share, '.2g', own.language)} %"


# formats with words of the catalogue in them
WORDED: dict[str, Callable[[Any, Texts], str]] = {
    "note": _said,  # a note, or a code, within a note
    "notes": lambda notes, own: ", ".join(_said(each, own) for each in notes),
    "refusals": lambda notes, own: "; ".join(f"'{name}': {_said(no, own)}" for name, no in notes.items()),  # by method
    "model": _model,
    "figures": _figures,
    "error": _error,
}


def _option(choice: Choice, value: Any, language: str) -> list[Any]:
    if choice.by == "select":
        key = str(value).lower() if isinstance(value, bool) else str(value)
    else:
        key = f"={value}" if f"={value}" in choice.options else _locale(language).plural_form(value)
    return choice.options.get(key, choice.options["other"])


def written(value: Any, form: str, language: str) -> str:
    """A value with the language's decimal sign."""
    text = FORMATS[form](value) if form in FORMATS else format(value, form)
    sign = _decimal(language)
    return text.replace(".", sign) if sign != "." and isinstance(value, (int, float)) else text


@cache
def _locale(language: str) -> Locale:
    return Locale.parse(language, sep="-")


@cache
def _decimal(language: str) -> str:
    return get_decimal_symbol(_locale(language))
