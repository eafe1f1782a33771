"""The frame of a page of A4 in HTML that needs neither network nor script, and how numbers stand in it; all text is
escaped."""

import base64
from collections.abc import Iterable, Sequence
from html import escape

from ..text.catalogue import spoken
from .sheet_pictures import scaled
from .sheet_style import PAGE, STYLE
from .words import shown, text

RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
# Lines up to which letters are large, smaller and smaller still: what is built in takes one page each.
SIZES = {"": 73.0, " dense": 82.0, " denser": 91.0}


def page(title: str, body: str) -> str:
    """A whole file."""
    return (
        f"<!DOCTYPE html>\n<html lang='{spoken()}'><head><meta charset='utf-8'><title>{escape(title)}</title>"
        f"<meta name='viewport' content='width=device-width, initial-scale=1'><style>{PAGE}</style></head>"
        f"<body>{body}</body></html>\n"
    )


def article(parts: Iterable[str], lines: float) -> str:
    """The page alone, as a part of another; `lines`: about how many it takes in large letters."""
    dense = next((name for name, most in SIZES.items() if lines <= most), " densest")
    return f"<article class='strikewave-report{dense}'><style>{STYLE}</style>{''.join(parts)}</article>"


def wrapped(words: str, letters: int) -> int:
    """How many lines these words take, of so many letters of a wide font, as none is sent along."""
    return 1 + len(words) // letters


def heading(kind: str, version: str, title: str, about: Iterable[str]) -> str:
    """What kind of page it is, of which version; its title, and what is said of that."""
    said = " ".join(escape(each) for each in about if each)
    head = f"<p class='kind'><span>{escape(kind)}</span><span>{escape(version)}</span></p>"
    below = f"<p class='about'>{said}</p>" if said else ""
    return f"<header>{head}<h1>{escape(title)}</h1>{below}</header>"


def section(name: str, title: str, body: str) -> str:
    return f"<section class='{name}'><h2>{escape(title)}</h2>{body}</section>"


def table(heads: Sequence[str], rows: Iterable[str]) -> str:
    cells = "".join(f"<th scope='col'>{escape(each)}</th>" for each in heads)
    return f"<table><thead><tr>{cells}</tr></thead><tbody>{''.join(rows)}</tbody></table>"


def notes_list(notes: Iterable[tuple[str, str, str]]) -> str:
    """Notes: how grave each is, in a word of the style and in one of the reader's, and what it says."""
    return "".join(
        f"<li class='{escape(grave)}'><b>{escape(name)}.</b> {escape(said)}</li>" for grave, name, said in notes
    )


def again(rows: Iterable[tuple[str, str]], name: str, toml: str) -> str:
    """How to do it again: names with what is written, escaped already; and the scene file of that name."""
    packed = base64.b64encode(toml.encode()).decode()
    file = (
        f"<a download='{escape(name, quote=True)}' href='data:application/toml;base64,{packed}'>"
        f"{escape(text('sheet.file', file=name))}</a>"
    )
    cells = "".join(f"<dt>{escape(name)}</dt><dd>{value}</dd>" for name, value in rows)
    return f"<footer><h2>{escape(text('sheet.again'))}</h2><dl>{cells}</dl><p class='small'>{file}</p></footer>"


def link(query: str | None, address: str) -> list[tuple[str, str]]:
    """To the scene: behind the address of a page, if one is named."""
    if query is None:
        return [(text("sheet.link"), escape(text("sheet.too-long")))]
    if not address:
        return [(text("sheet.link"), f"<code>{escape(query)}</code> {escape(text('sheet.query'))}")]
    whole = escape(address + query, quote=True)
    return [(text("sheet.link"), f"<a href='{whole}'>{whole}</a>")]


# --- numbers ----------------------------------------------------------------------------------------------------------


def number(value: float) -> str:
    return power(shown(value + 0.0, ".6g"))


def power(written: str) -> str:
    """As it is printed: 3.4e+10 is 3.4·10¹⁰, with a true minus."""
    digits, _, exponent = written.partition("e")
    raised = f"·10{str(int(exponent)).translate(RAISED)}" if exponent else ""
    return digits.replace("-", "−") + raised


def printed_unit(unit: str) -> str:
    """With exponents as they are printed."""
    for plain, printed in (("m^1.5", "m¹·⁵"), ("m2", "m²"), ("m3", "m³"), ("m4", "m⁴"), ("s2", "s²")):
        unit = unit.replace(plain, printed)
    return unit


def rough(value: float, digits: int) -> str:
    """In so many digits: 420 rather than 4.2·10²."""
    return power(shown(float(f"{value:.{digits}g}"), "g"))


def scale(size: float, unit: str) -> tuple[float, str]:
    """A prefix for quantities that usually have one."""
    return (1.0, unit) if unit == "m/s" else scaled(size, unit)
