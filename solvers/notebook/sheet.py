"""A report of one impact as one page of A4, in HTML that needs neither network nor script; all text is escaped."""

import re
from collections.abc import Iterable
from html import escape
from typing import Any

from . import sheet_frame as frame
from .report import method_line
from .sheet_inputs import inputs_table, values_of
from .sheet_model import limits_of, model_body
from .sheet_pictures import picture
from .words import family, named, shown, text, vector

SHARE = re.compile(r"\s*([\d.]+)\s*%\s*")  # a tolerance about the scene's own value
ROUNDING = 1e-9  # of a figure: a smaller error of its numbers is not worth a number


def page(found: Any) -> str:
    """A whole file."""
    return frame.page(_title(found), article(found))


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
    return frame.article(parts, _lines(found))


def _lines(found: Any) -> float:
    """About how many lines the page takes in large letters."""
    scene = found.scene
    head = 2.4 * frame.wrapped(_title(found), 52) + frame.wrapped(f"{scene.note} {scene.source}", 105)
    tolerances = any(each.tolerance for each in found.inputs)
    inputs = 8.0 + sum(1.1 * frame.wrapped(values_of(each), 34 if tolerances else 46) for each in found.inputs)
    model = 4.0 + sum(frame.wrapped(each, 40) + 0.3 for each in _said_of_model(found))
    figures = 5.5 + 1.27 * len(found.numbers) + 2.0 * bool(found.uncertain)
    notes = 2.5 + sum(frame.wrapped(str(note), 105) + 0.3 for note in found.notes)
    code = [found.command, *found.python.splitlines(), found.page + (found.query or "")]
    rest = 5.0 + sum(frame.wrapped(each, 88) for each in code)
    return head + max(inputs, model) + (16.0 if found.pictures else 3.0) + figures + notes + rest


def _title(found: Any) -> str:
    return found.scene.title or text("report.scene")


def _heading(found: Any) -> str:
    """Title, source and note of the scene."""
    scene = found.scene
    source = text("sheet.source", source=scene.source) if scene.source else ""
    version = text("sheet.version", version=found.version)
    return frame.heading(text("sheet.kind"), version, _title(found), (scene.note, source))


# --- inputs -----------------------------------------------------------------------------------------------------------


def _inputs(found: Any) -> str:
    """Each with its tolerance, if any has one."""
    head = family("sheet.head")
    tolerances = any(each.tolerance for each in found.inputs)
    heads = [head["key"], head["name"], head["value"], *([head["tolerance"]] if tolerances else [])]

    def cells(each: Any) -> Iterable[str]:
        yield f"<td>{escape(values_of(each))}</td>"
        if tolerances:
            yield f"<td class='tolerance'>{escape(_tolerance(found, each))}</td>"

    follows = f"<p class='small follows'>{escape(text('sheet.follows'))}</p>"
    return frame.section("inputs", text("sheet.inputs"), f"{inputs_table(found.inputs, heads, cells)}{follows}")


def _tolerance(found: Any, each: Any) -> str:
    """As it was given where that is a share; else its distribution, in few digits."""
    given = SHARE.fullmatch(str(dict(found.laws).get(each.key, "")))
    if given:
        return text("sheet.about", share=float(given[1]))
    return re.sub(r"\d+\.\d+(?:e[+-]?\d+)?", lambda digits: shown(float(digits[0]), ".5g"), each.tolerance)


# --- model ------------------------------------------------------------------------------------------------------------


def _model(found: Any) -> str:
    """Method and why it, what it assumes and what it leaves out."""
    law = found.scene.contact.NAME
    why, *paragraphs = _said_of_model(found)
    method = f"<b>{escape(method_line(found.solution.method))}</b>. {escape(why)}"
    return frame.section("model", text("sheet.model"), model_body(method, [law], paragraphs))


def _said_of_model(found: Any) -> list[str]:
    """Why this method; what it assumes, what it leaves out, and what none of them has."""
    chosen = found.chosen
    why = str(chosen) if chosen is not None else family("sheet.why").get(found.why, "")
    return [why, *limits_of([found.solution.method])]


# --- pictures ---------------------------------------------------------------------------------------------------------


def _pictures(found: Any) -> str:
    """Two beside each other."""
    if not found.pictures:
        return frame.section("pictures", text("sheet.pictures"), f"<p>{escape(text('sheet.no-pictures'))}</p>")
    drawn = "".join(f"<figure>{picture(each)}</figure>" for each in found.pictures)
    shaded = any(getattr(each, "spans", ()) for each in found.pictures)
    said = [text("sheet.shaded")] if shaded else []
    said += [text("sheet.raw")] if any("raw" in getattr(each, "lines", ()) for each in found.pictures) else []
    below = f"<p class='small'>{escape(' '.join(said))}</p>" if said else ""
    return frame.section("pictures", text("sheet.pictures"), f"<div class='two even'>{drawn}</div>{below}")


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
    return frame.section("numbers", text("sheet.numbers"), f"{above}{frame.table(heads, rows)}{small}")


def _figure(found: Any, each: Any) -> Iterable[str]:
    """Cells of one row."""
    yield f"<th scope='row'>{escape(named('quantity', each.name))}</th>"
    if each.value is None:
        yield f"<td>{escape(text('sheet.none'))}</td>"
        yield "<td></td>"
    elif isinstance(each.value, tuple):
        yield f"<td class='number'>{escape(vector(each.value).replace('-', '−'))} {frame.printed_unit(each.unit)}</td>"
        yield f"<td>{escape(_error(each, max(map(abs, each.value))))}</td>"
    else:
        factor, unit = frame.scale(abs(each.value), each.unit)
        value = f"{frame.number(each.value * factor)} {frame.printed_unit(unit)}".rstrip()
        yield f"<td class='number'>{escape(value)}</td>"
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
    factor, unit = frame.scale(each.error, each.unit)
    error = f"{frame.rough(each.error * factor, 2)} {frame.printed_unit(unit)}".rstrip()
    within = text("sheet.within", error=error)
    return text("sheet.share", error=within, share=frame.rough(100.0 * each.error / size, 1)) if size else within


def _spread(outcome: Any, each: Any) -> tuple[str, str]:
    """Between which values nine tenths lie, and which input makes most of it."""
    if outcome is None or not outcome.samples:
        return "", ""
    low, high = outcome.quantiles[5], outcome.quantiles[95]
    factor, unit = frame.scale(abs(each.value or high), each.unit)
    ends = {"low": frame.power(shown(low * factor, ".4g")), "high": frame.power(shown(high * factor, ".4g"))}
    said = text("sheet.spread", **ends, unit=frame.printed_unit(unit)).strip()
    if not outcome.shares or not outcome.ranking:
        return said, ""
    first = outcome.ranking[0]
    share = min(max(outcome.shares[first].total, 0.0), 1.0)
    return said, text("sheet.mostly", key=first, share=100.0 * share)


# --- notes, and how to do it again ------------------------------------------------------------------------------------


def _notes(found: Any) -> str:
    """The gravest first."""
    names = family("sheet.severity")
    listed = frame.notes_list((str(note.severity), names[note.severity], str(note)) for note in found.notes)
    body = f"<ul>{listed}</ul>" if listed else f"<p>{escape(text('sheet.no-notes'))}</p>"
    return frame.section("notes", text("sheet.notes"), body)


def _again(found: Any) -> str:
    """Command, Python, scene file and link."""
    rows = [
        (text("sheet.command"), f"<code>{escape(found.command)}</code>"),
        (text("sheet.python"), f"<code>{escape(found.python)}</code>"),
        *frame.link(found.query, found.page),
    ]
    return frame.again(rows, found.file, found.toml)
