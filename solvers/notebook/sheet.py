"""A report of one impact as one page of A4, in HTML that needs neither network nor script; all text is escaped."""

import base64
import re
from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

from ..text.catalogue import library, spoken
from .report import method_line
from .sheet_pictures import picture, scaled
from .sheet_style import PAGE, STYLE
from .words import family, named, shown, text, vector

SYMBOLS = {"young": "E", "density": "ρ", "poisson": "ν", "yield": "σ_Y"}
KINDS = ("impactor.kind", "target.kind", "contact.law")
SHARE = re.compile(r"\s*([\d.]+)\s*%\s*")  # a tolerance about the scene's own value
ROUNDING = 1e-9  # of a figure: a smaller error of its numbers is not worth a number
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
# Lines up to which letters are large, smaller and smaller still, see `_lines`: built-in scenes take one page each.
SIZES = {"": 73.0, " dense": 82.0, " denser": 91.0}


def page(found: Any) -> str:
    """A whole file."""
    title = escape(_title(found))
    return (
        f"<!DOCTYPE html>\n<html lang='{spoken()}'><head><meta charset='utf-8'><title>{title}</title>"
        f"<meta name='viewport' content='width=device-width, initial-scale=1'><style>{PAGE}</style></head>"
        f"<body>{article(found)}</body></html>\n"
    )


def article(found: Any) -> str:
    """The page alone, as a part of another."""
    parts = (
        _heading(found),
        f"<div class='two'>{_inputs(found)}{_model(found)}</div>",
        _pictures(found),
        _numbers(found),
        _notes(found),
        _again(found),
    )
    lines = _lines(found)
    dense = next((name for name, most in SIZES.items() if lines <= most), " densest")
    return f"<article class='strikewave-report{dense}'><style>{STYLE}</style>{''.join(parts)}</article>"


def _lines(found: Any) -> float:
    """About how many lines the page takes in large letters, of a wide font, as none is sent along."""

    def wrapped(words: str, letters: int) -> int:
        return 1 + len(words) // letters

    scene = found.scene
    heading = 2.4 * wrapped(_title(found), 52) + wrapped(f"{scene.note} {scene.source}", 105)
    tolerances = any(each.tolerance for each in found.inputs)
    inputs = 8.0 + sum(1.1 * wrapped(_values(each), 34 if tolerances else 46) for each in found.inputs)
    model = 4.0 + sum(wrapped(each, 40) + 0.3 for each in _said_of_model(found))
    figures = 5.5 + 1.27 * len(found.numbers) + 2.0 * bool(found.uncertain)
    notes = 2.5 + sum(wrapped(str(note), 105) + 0.3 for note in found.notes)
    code = [found.command, *found.python.splitlines(), found.page + (found.query or "")]
    again = 5.0 + sum(wrapped(each, 88) for each in code)
    return heading + max(inputs, model) + (16.0 if found.pictures else 3.0) + figures + notes + again


def _title(found: Any) -> str:
    return found.scene.title or text("report.scene")


def _heading(found: Any) -> str:
    """Title, source and note of the scene."""
    scene = found.scene
    said = [scene.note, text("sheet.source", source=scene.source) if scene.source else ""]
    about = " ".join(escape(each) for each in said if each)
    version = escape(text("sheet.version", version=found.version))
    head = f"<p class='kind'><span>{text('sheet.kind')}</span><span>{version}</span></p>"
    below = f"<p class='about'>{about}</p>" if about else ""
    return f"<header>{head}<h1>{escape(_title(found))}</h1>{below}</header>"


# --- inputs -----------------------------------------------------------------------------------------------------------


def _inputs(found: Any) -> str:
    """A row for each, under the part of the scene it belongs to."""
    head = family("sheet.head")
    tolerances = any(each.tolerance for each in found.inputs)
    heads = [head["key"], head["name"], head["value"], *([head["tolerance"]] if tolerances else [])]
    rows, part = [], ""
    for each in found.inputs:
        if each.part != part:
            part = each.part
            name = escape(text("sheet.part", part=part) + _kind(found, part))
            rows.append(f"<tr class='part'><th scope='rowgroup' colspan='{len(heads)}'>{name}</th></tr>")
        if each.key in KINDS and not each.tolerance:  # stands in the head of the part
            continue
        cells = [f"<td class='key'>{_key(each)}</td>", f"<td>{escape(_name(each))}</td>"]
        cells.append(f"<td>{escape(_values(each))}</td>")
        cells += [f"<td class='tolerance'>{escape(_tolerance(found, each))}</td>"] if tolerances else []
        kind = " class='follows'" if each.follows else ""
        rows.append(f"<tr{kind}>{''.join(cells)}</tr>")
    follows = f"<p class='small follows'>{escape(text('sheet.follows'))}</p>"
    return _section("inputs", text("sheet.inputs"), f"{_table(heads, rows)}{follows}")


def _tolerance(found: Any, each: Any) -> str:
    """As it was given where that is a share; else its distribution, in few digits."""
    given = SHARE.fullmatch(str(dict(found.laws).get(each.key, "")))
    if given:
        return text("sheet.about", share=float(given[1]))
    return re.sub(r"\d+\.\d+(?:e[+-]?\d+)?", lambda number: shown(float(number[0]), ".5g"), each.tolerance)


def _kind(found: Any, part: str) -> str:
    """What kind of body it is, or which law."""
    said = [str(each.values[0].value) for each in found.inputs if each.part == part and each.key in KINDS]
    return f": {said[0]}" if said else ""


def _key(each: Any) -> str:
    """Without the part it stands under; breakable behind points."""
    return "<wbr/>.".join(escape(word) for word in each.key.split(".")[1:])


def _name(each: Any) -> str:
    """In plain words, by the last word of the key; of one in a list with its number."""
    words = each.key.split(".") if each.key else [each.values[0].name]
    if words[-1].isdecimal():
        return f"{named('sheet.key', words[-2])} {words[-1]}"
    if len(words) > 3 and words[-2].isdecimal():
        return f"{named('sheet.key', words[-3])} {words[-2]}, {named('sheet.key', words[-1])}"
    return named("sheet.key", words[-1])


def _values(each: Any) -> str:
    """Number and unit; of several each behind its name, but for a word that stands for all of them."""
    parts, apart = [], each.key.endswith(".struck") or each.key.rpartition(".")[2].isdecimal()  # of lists: as in files
    for one in each.values:
        plain = one.name == each.key.rpartition(".")[2] or not each.key
        own = apart or SYMBOLS.get(one.name)
        name = one.name if own is True else own or named("sheet.key", one.name)
        parts.append(_value(one) if plain else f"{name} {_value(one)}")
    return "; ".join(parts)


def _value(one: Any) -> str:
    if isinstance(one.value, bool) or not isinstance(one.value, (int, float)):
        return _words(one.value, one.unit)
    factor, unit = scaled(abs(one.value), one.unit) if one.unit == "Pa" else (1.0, one.unit)
    return f"{_number(one.value * factor)} {_unit(unit)}".rstrip()


def _words(value: Any, unit: str) -> str:
    """What is no single number."""
    if isinstance(value, (list, tuple)):
        numbers = bool(value) and all(isinstance(each, (int, float)) for each in value)
        inner = vector(value).replace("-", "−") if numbers else f"({', '.join(_words(each, '') for each in value)})"
        return f"{inner} {_unit(unit)}".rstrip()
    return _number(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else str(value)


def _number(value: float) -> str:
    return _power(shown(value + 0.0, ".6g"))


def _power(written: str) -> str:
    """As it is printed: 3.4e+10 is 3.4·10¹⁰, with a true minus."""
    digits, _, power = written.partition("e")
    raised = f"·10{str(int(power)).translate(RAISED)}" if power else ""
    return digits.replace("-", "−") + raised


def _unit(unit: str) -> str:
    """With exponents as they are printed."""
    for plain, printed in (("m^1.5", "m¹·⁵"), ("m2", "m²"), ("m3", "m³"), ("m4", "m⁴"), ("s2", "s²")):
        unit = unit.replace(plain, printed)
    return unit


# --- model ------------------------------------------------------------------------------------------------------------


def _model(found: Any) -> str:
    """Method and why it, what it assumes and what it leaves out."""
    law = found.scene.contact.NAME
    why, *paragraphs = _said_of_model(found)
    said = family("sheet.law-of").get(law, "")
    rows = [
        (text("sheet.method"), f"<b>{escape(method_line(found.solution))}</b>. {escape(why)}"),
        (text("sheet.law"), f"<b>{escape(law)}</b>{f': {escape(said)}' if said else ''}."),
    ]
    listed = "".join(f"<dt>{escape(name)}</dt><dd>{value}</dd>" for name, value in rows if value)
    below = "".join(f"<p>{escape(each)}</p>" for each in paragraphs)
    return _section("model", text("sheet.model"), f"<dl>{listed}</dl>{below}")


def _said_of_model(found: Any) -> list[str]:
    """Why this method; what it assumes, what it leaves out, and what none of them has."""
    method = str(found.solution.method["name"])
    chosen, limits = found.chosen, family("sheet.limits")
    why = str(chosen) if chosen is not None else family("sheet.why").get(found.why, "")
    left = library(spoken()).texts.get(f"left-out.{found.solution.method.get('model')}")
    leaves = f"{left[0].upper()}{left[1:]}" if left else limits.get(method, "")
    return [why, *filter(None, (family("sheet.assumes").get(method, ""), leaves, limits["all"]))]


# --- pictures ---------------------------------------------------------------------------------------------------------


def _pictures(found: Any) -> str:
    """Two beside each other."""
    if not found.pictures:
        return _section("pictures", text("sheet.pictures"), f"<p>{escape(text('sheet.no-pictures'))}</p>")
    drawn = "".join(f"<figure>{picture(each)}</figure>" for each in found.pictures)
    shaded = any(getattr(each, "spans", ()) for each in found.pictures)
    said = [text("sheet.shaded")] if shaded else []
    said += [text("sheet.raw")] if any("raw" in getattr(each, "lines", ()) for each in found.pictures) else []
    below = f"<p class='small'>{escape(' '.join(said))}</p>" if said else ""
    return _section("pictures", text("sheet.pictures"), f"<div class='two even'>{drawn}</div>{below}")


# --- numbers ----------------------------------------------------------------------------------------------------------


def _numbers(found: Any) -> str:
    """A row for each figure, with its error and its spread."""
    head = family("sheet.head")
    heads = [head["figure"], head["number"], head["error"]]
    heads += [head["spread"], head["mostly"]] if found.uncertain else []
    rows = [f"<tr>{''.join(_figure(found, each))}</tr>" for each in found.numbers]
    errors = f"{family('sheet.errors')[found.finer]} {text('sheet.errors.beside')}"
    below = [errors]
    if found.uncertain:
        below.append(text("sheet.drawn", samples=found.uncertain.kept, solves=found.uncertain.solves))
    trusted = not any(note.severity == "invalid" for note in found.notes)
    above = "" if trusted else f"<p class='invalid'>{escape(text('sheet.invalid'))}</p>"
    small = f"<p class='small'>{escape(' '.join(below))}</p>"
    return _section("numbers", text("sheet.numbers"), f"{above}{_table(heads, rows)}{small}")


def _figure(found: Any, each: Any) -> Iterable[str]:
    """Cells of one row."""
    yield f"<th scope='row'>{escape(named('quantity', each.name))}</th>"
    if each.value is None:
        yield f"<td>{escape(text('sheet.none'))}</td>"
        yield "<td></td>"
    elif isinstance(each.value, tuple):
        yield f"<td class='number'>{escape(vector(each.value).replace('-', '−'))} {_unit(each.unit)}</td>"
        yield f"<td>{escape(_error(each, max(map(abs, each.value))))}</td>"
    else:
        factor, unit = _scale(abs(each.value), each.unit)
        yield f"<td class='number'>{escape(f'{_number(each.value * factor)} {_unit(unit)}'.rstrip())}</td>"
        yield f"<td>{escape(_error(each, abs(each.value)))}</td>"
    if found.uncertain:
        yield from (f"<td>{escape(cell)}</td>" for cell in _spread(found.uncertain.figures.get(each.name), each))


def _error(each: Any, size: float) -> str:
    """With a prefix of its own, and as a part of the figure."""
    if each.name == "contacts":
        if each.finer is None:
            return ""
        return text("sheet.same-count") if each.finer == each.value else text("sheet.other-count", count=each.finer)
    if each.error is None:
        return text("sheet.noted") if each.noted else text("sheet.unknown")
    if each.error <= ROUNDING * size:
        return text("sheet.rounding")
    factor, unit = _scale(each.error, each.unit)
    error = f"{_rough(each.error * factor, 2)} {_unit(unit)}".rstrip()
    within = text("sheet.within", error=error)
    return text("sheet.share", error=within, share=_rough(100.0 * each.error / size, 1)) if size else within


def _rough(value: float, digits: int) -> str:
    """In so many digits: 420 rather than 4.2·10²."""
    return _power(shown(float(f"{value:.{digits}g}"), "g"))


def _scale(size: float, unit: str) -> tuple[float, str]:
    """A prefix for quantities that usually have one."""
    return (1.0, unit) if unit == "m/s" else scaled(size, unit)


def _spread(outcome: Any, each: Any) -> tuple[str, str]:
    """Between which values nine tenths lie, and which input makes most of it."""
    if outcome is None or not outcome.samples:
        return "", ""
    low, high = outcome.quantiles[5], outcome.quantiles[95]
    factor, unit = _scale(abs(each.value or high), each.unit)
    ends = {"low": _power(shown(low * factor, ".4g")), "high": _power(shown(high * factor, ".4g"))}
    said = text("sheet.spread", **ends, unit=_unit(unit)).strip()
    if not outcome.shares or not outcome.ranking:
        return said, ""
    first = outcome.ranking[0]
    share = min(max(outcome.shares[first].total, 0.0), 1.0)
    return said, text("sheet.mostly", key=first, share=100.0 * share)


# --- notes, and how to do it again ------------------------------------------------------------------------------------


def _notes(found: Any) -> str:
    """The gravest first."""
    names = family("sheet.severity")
    listed = "".join(
        f"<li class='{escape(str(note.severity))}'><b>{escape(names[note.severity])}.</b> {escape(str(note))}</li>"
        for note in found.notes
    )
    body = f"<ul>{listed}</ul>" if listed else f"<p>{escape(text('sheet.no-notes'))}</p>"
    return _section("notes", text("sheet.notes"), body)


def _again(found: Any) -> str:
    """Command, Python, scene file and link."""
    packed = base64.b64encode(found.toml.encode()).decode()
    name = escape(found.file, quote=True)
    file = (
        f"<a download='{name}' href='data:application/toml;base64,{packed}'>"
        f"{escape(text('sheet.file', file=found.file))}</a>"
    )
    rows = [
        (text("sheet.command"), f"<code>{escape(found.command)}</code>"),
        (text("sheet.python"), f"<code>{escape(found.python)}</code>"),
        *_link(found),
    ]
    listed = "".join(f"<dt>{escape(name)}</dt><dd>{value}</dd>" for name, value in rows)
    return f"<footer><h2>{escape(text('sheet.again'))}</h2><dl>{listed}</dl><p class='small'>{file}</p></footer>"


def _link(found: Any) -> list[tuple[str, str]]:
    if found.query is None:
        return [(text("sheet.link"), escape(text("sheet.too-long")))]
    if not found.page:
        return [(text("sheet.link"), f"<code>{escape(found.query)}</code> {escape(text('sheet.query'))}")]
    address = escape(found.page + found.query, quote=True)
    return [(text("sheet.link"), f"<a href='{address}'>{address}</a>")]


def _section(name: str, title: str, body: str) -> str:
    return f"<section class='{name}'><h2>{escape(title)}</h2>{body}</section>"


def _table(heads: Sequence[str], rows: Iterable[str]) -> str:
    cells = "".join(f"<th scope='col'>{escape(each)}</th>" for each in heads)
    return f"<table><thead><tr>{cells}</tr></thead><tbody>{''.join(rows)}</tbody></table>"
