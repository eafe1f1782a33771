"""A report of a study as one page of A4, in HTML that needs neither network nor script; all text is escaped."""

import base64
from collections.abc import Iterable, Mapping
from html import escape
from typing import Any

from . import sheet_frame as frame
from .report import method_line
from .sheet_inputs import inputs_table, key_of, values_of
from .sheet_model import limits_of, model_body
from .words import family, named, text

LISTED = 8  # words that are listed; of more the first
METHODS = 4  # that are named with what they assume; of more their names alone
KINDS = 5  # of refusals, and of notes, that are said; of others how many points have them
SAMPLES = ("grid", "random", "lhs", "sobol")


def page(found: Any) -> str:
    """A whole file."""
    return frame.page(_title(found), article(found))


def article(found: Any) -> str:
    """The page alone, as a part of another."""
    drawn = found.picture()
    parts = (
        _heading(found),
        _varied(found),
        f"<div class='two'>{_inputs(found)}{_model(found)}</div>",
        _picture(found, drawn),
        _figures(found),
        _notes(found),
        _again(found),
    )
    return frame.article(parts, _lines(found, drawn is not None))


def _lines(found: Any, drawn: bool) -> float:
    """About how many lines the page takes in large letters."""
    inputs = 6.0 + sum(1.1 * frame.wrapped(values_of(each), 46) for each in found.inputs)
    model = 3.0 + sum(frame.wrapped(each, 40) + 0.3 for each in (_why(found), *limits_of(_few(found.methods))))
    places = [
        max(frame.wrapped(_at(found, end.at), 40) for end in (each.least, each.largest)) for each in found.reaches
    ]
    figures = 4.0 + sum(1.3 + each for each in places)
    notes = 2.5 + sum(frame.wrapped(f"{each.said} {_at(found, each.at)}", 100) + 0.3 for each in _all(found))
    code = [*(found.command or "").splitlines(), *(found.python or "").splitlines(), found.page + (found.query or "")]
    rest = 6.0 + sum(frame.wrapped(each, 88) for each in code)
    head = 5.0 + 2.4 * frame.wrapped(_title(found), 52) + 1.4 * len(found.varied)
    return head + max(inputs, model) + (19.0 if drawn else 3.0) + figures + notes + rest


def _all(found: Any) -> list[Any]:
    """Kinds of refusals and notes that have a line of their own."""
    return [*found.refusals[:KINDS], *found.notes[:KINDS]]


def _title(found: Any) -> str:
    return found.scene.title or text("report.scene")


def _heading(found: Any) -> str:
    """Title of the scene, and how many points there are."""
    version = text("sheet.version", version=found.version)
    source = text("sheet.source", source=found.scene.source) if found.scene.source else ""
    return frame.heading(
        text("study-sheet.kind"), version, _title(found), (text("study-sheet.counts", **found.counts), source)
    )


# --- what is varied ---------------------------------------------------------------------------------------------------


def _varied(found: Any) -> str:
    """A row for each key; how they are chosen stands below."""
    head = family("study-sheet.head")
    rows = []
    for each in found.varied:
        known = each.table()
        for key, values in known["keys"].items():
            first = f"<td class='key'>{key_of(key)}</td><td>{escape(named('sheet.key', _end(key)))}</td>"
            cells = (_range(values), _count(known, key))
            rows.append(f"<tr>{first}{''.join(f'<td>{escape(cell)}</td>' for cell in cells)}</tr>")
    design = found.design
    sample = design["sample"] if design["sample"] in SAMPLES else "other"
    said = text("study-sheet.design", sample=sample, points=design["points"], seed=design["seed"] or 0)
    body = frame.table([head["key"], head["name"], head["range"], head["values"]], rows)
    return frame.section("varied", text("study-sheet.varied"), f"{body}<p class='small'>{escape(said)}</p>")


def _range(values: Mapping[str, Any]) -> str:
    """From the lowest to the highest, or words one after another."""
    if "values" in values:
        more = "; …" if len(values["values"]) > LISTED else ""
        return "; ".join(map(str, values["values"][:LISTED])) + more
    ends = dict.fromkeys(frame.number(values[end]) for end in ("lowest", "highest"))
    return f"{' … '.join(ends)} {frame.printed_unit(values['unit'])}".rstrip()


def _count(known: Mapping[str, Any], key: str) -> str:
    """How many values there are, or by which law they are drawn; with which key it goes together."""
    law, first = known["law"], next(iter(known["keys"]))
    said = text("study-sheet.drawn", law=law) if law else text("study-sheet.count", count=known["keys"][key]["count"])
    return said if key == first else text("study-sheet.together", said=said, key=first)


# --- the scene and its model ------------------------------------------------------------------------------------------


def _inputs(found: Any) -> str:
    """What is not varied."""
    head = family("sheet.head")
    heads = [head["key"], head["name"], head["value"]]
    body = inputs_table(found.inputs, heads, lambda each: [f"<td>{escape(values_of(each))}</td>"])
    return frame.section("inputs", text("study-sheet.rest"), body)


def _model(found: Any) -> str:
    few = _few(found.methods)
    names = escape("; ".join(map(method_line, few))) if few else escape(text("study-sheet.none"))
    method = f"<b>{names}</b>. {escape(_why(found))}"
    laws = found.laws if len(found.laws) <= METHODS else []
    return frame.section("model", text("sheet.model"), model_body(method, laws, limits_of(few)))


def _few(methods: Any) -> list[Mapping[str, Any]]:
    """Methods with their options, or of many alone their names."""
    if len(methods) <= METHODS:
        return list(methods)
    return [{"name": name} for name in dict.fromkeys(each["name"] for each in methods)]


def _why(found: Any) -> str:
    if any(each["name"] == "auto" for each in found.methods):
        return text("study-sheet.auto")
    return text("study-sheet.method-varied") if found.why == "varied" else family("sheet.why").get(found.why, "")


# --- picture and figures ----------------------------------------------------------------------------------------------


def _picture(found: Any, drawn: bytes | None) -> str:
    if drawn is None:
        return ""
    name = escape(named("quantity", found.reaches[0].name), quote=True)
    image = f"<img alt='{name}' src='data:image/svg+xml;base64,{base64.b64encode(drawn).decode()}'/>"
    return frame.section("picture", text("study-sheet.picture"), f"<figure>{image}</figure>")


def _figures(found: Any) -> str:
    """A row for each figure: its least, median and largest value, and where they are."""
    title = text("sheet.numbers")
    if not found.reaches:
        said = text("study-sheet.no-figures", **found.counts)
        return frame.section("numbers", title, f"<p class='invalid'>{escape(said)}</p>")
    head = family("study-sheet.head")
    heads = [family("sheet.head")["figure"], head["least"], head["median"], head["largest"]]
    body = frame.table(heads, (f"<tr>{''.join(_figure(found, each, heads))}</tr>" for each in found.reaches))
    said = [text("study-sheet.median"), _error(found)]
    said += [text("study-sheet.more", names=", ".join(found.more))] if found.more else []
    said += [text("study-sheet.empty", names=", ".join(found.empty))] if found.empty else []
    return frame.section("numbers reaches", title, f"{body}<p class='small'>{escape(' '.join(said))}</p>")


def _figure(found: Any, each: Any, heads: list[str]) -> Iterable[str]:
    """Cells of one row; on a telephone each has its head."""
    yield f"<th scope='row'>{escape(named('quantity', each.name))}</th>"
    factor, unit = frame.scale(max(abs(each.least.value), abs(each.largest.value)), each.unit)
    if each.least.value == each.largest.value:
        said = f"{frame.number(each.least.value * factor)} {frame.printed_unit(unit)}".rstrip()
        yield f"<td colspan='3'><span class='number'>{escape(said)}</span> {escape(text('study.everywhere'))}</td>"
        return
    for name, end in zip(heads[1:], (each.least, each.median, each.largest), strict=True):
        said = escape(f"{frame.number(end.value * factor)} {frame.printed_unit(unit)}".rstrip())
        place = escape(_at(found, end.at))
        inner = f"<span class='number'>{said}</span> <small>{place}</small>"
        yield f"<td data-head='{escape(name, quote=True)}'>{inner}</td>"


def _at(found: Any, at: Mapping[str, Any]) -> str:
    """Values of the keys, by their last words where no two are the same; of keys that go together the first one's."""
    keys = [each.keys[0] for each in found.varied]
    ends = [_end(key) for key in keys]
    names = {key: end if ends.count(end) == 1 else key for key, end in zip(keys, ends, strict=True)}
    return ", ".join(f"{name} {_said(at[key])}" for key, name in names.items() if key in at)


def _end(key: str) -> str:
    """Its last word; of the name of a method what it names."""
    return "method" if key == "method.name" else key.rpartition(".")[2]


def _said(value: Any) -> str:
    return frame.number(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else str(value)


def _error(found: Any) -> str:
    if found.error is None:
        return text("study-sheet.no-error")
    ends = {
        name: frame.rough(100.0 * end.value, 2)
        for name, end in (("median", found.error.median), ("largest", found.error.largest))
    }
    return text("study-sheet.error", **ends, at=_at(found, found.error.largest.at))


# --- notes, and how to do it again ------------------------------------------------------------------------------------


def _notes(found: Any) -> str:
    """Refusals first; each kind once, with how many points have it, what it says at the first, and where that is."""
    names = family("sheet.severity")

    def said(each: Any) -> str:
        return text("study-sheet.kind-of", points=each.points, at=_at(found, each.at), said=each.said)

    listed = frame.notes_list(
        [("invalid", names["refusal"], said(each)) for each in found.refusals[:KINDS]]
        + [("warning", each.code, said(each)) for each in found.notes[:KINDS]]
    )
    none = "study-sheet.no-notes" if found.notes_looked_for else "study-sheet.not-looked"
    body = f"<ul>{listed}</ul>" if listed else ""
    further = [*found.refusals[KINDS:], *found.notes[KINDS:]]
    if further:
        kinds = ", ".join(f"{each.code} ({each.points})" for each in further)
        body += f"<p class='small'>{escape(text('study-sheet.further', kinds=kinds))}</p>"
    body += "" if found.notes else f"<p>{escape(text(none))}</p>"
    return frame.section("notes", text("sheet.notes"), body)


def _again(found: Any) -> str:
    """Command, Python, link, fingerprint and scene file."""
    command = f"<code>{escape(found.command)}</code>" if found.command else escape(text("study-sheet.no-command"))
    rows = [(text("sheet.command"), command)]
    rows += [(text("sheet.python"), f"<code>{escape(found.python)}</code>")] if found.python else []
    rows += [*frame.link(found.query, found.page), (text("study-sheet.fingerprint"), _fingerprint(found))]
    return frame.again(rows, found.file, found.toml)


def _fingerprint(found: Any) -> str:
    return f"<code>{found.fingerprint}</code> {escape(text('study-sheet.same'))}"
