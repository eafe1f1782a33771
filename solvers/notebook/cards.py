"""What a notebook shows of an object: plain HTML tables, with all text escaped.

Bodies, methods, models and options are named as scene files name them; all other words are those of `printed.card`.
"""

import math
from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

from ..text.catalogue import library, spoken
from . import contour_tables, study_tables, tables, uncertain_tables
from .words import existing, family, listed, named, shown, text, vector

Rows = Iterable[tuple[str, str]]


def scene_card(scene: Any) -> str:
    """What strikes what, and how it is asked to be solved."""
    name = family("card.name")
    rows = [(name[body], _body(getattr(scene, body), scene.normal)) for body in ("impactor", "target")]
    rows += [(name["contact"], scene.contact.NAME)]
    if scene.normal is not None:
        rows += [(name["normal"], vector(scene.normal))]
        rows += [] if scene.friction is None else [(name["friction"], _number(scene.friction))]
    elif not scene.prescribed_force:
        rows += [(name["mass-ratio"], _number(scene.mass_ratio))]
    if not scene.prescribed_force:
        rows += [(name["approach"], _number(scene.speed, "m/s"))]
    method = _method(scene.method) if scene.method.get("name") else text("card.usual")
    rows += [(name["method"], method), (name["source"], scene.source)]
    return _card("scene", scene.title, _pairs(rows), [scene.note] if scene.note else [])


def solution_card(solution: Any) -> str:
    """What happened, how well it is known, and what it warns of."""
    contacts = [
        (str(number), _number(c.start, "s"), _number(c.end, "s"), _number(c.impulse, "N s"), _number(c.peak_force, "N"))
        for number, c in enumerate(solution.contacts, 1)
    ]
    name, found = family("card.name"), solution.diagnostics
    error, unknown = found["estimated_error"], family("card.word")["unknown"]
    rows = [
        (name["method"], _method(solution.method)),
        (name["contact-time"], _number(solution.contact_time, "s")),
        (name["impulse"], _quantity(solution.impulse, "N s")),
        (name["peak-force"], _number(solution.peak_force, "N")),
        (name["leaves"], _quantity(solution.impactor_velocity, "m/s")),
        (name["moves-on"], _quantity(solution.target_velocity, "m/s")),
        (name["indentation"], _number(solution.peak_indentation, "m")),
        *(
            (text("card.restitution", by=named("restitution", by)), _number(e))
            for by, e in solution.restitution.items()
        ),
        *(
            (text("card.energy", part=named("energy", part)), _number(joules, "J"))
            for part, joules in solution.energy.items()
        ),
        (name["energy-error"], _number(found["energy_error"])),
        (name["momentum-error"], _number(found["momentum_error"])),
        (name["error"], unknown if error is None else text("card.of-impact-speed", share=_number(error))),
        (name["solved"], _number(found["wall_time"], "s")),
    ]
    heads = ("contact", "start", "end", "impulse", "peak-force")
    return _card("solution", solution.scene.title, _table(_named(heads), contacts) + _pairs(rows), solution.notes)


def tradeoff_card(found: Any) -> str:
    """The points that nothing beats in time and in one of the errors."""
    best: dict[int, Any] = {}
    for quantity in found.quantities:
        best |= {id(point): point for point in found.front(quantity)}
    points = [
        (
            point.label,
            _number(1e3 * point.wall_time, "ms"),
            *(_percent(point.errors.get(quantity)) for quantity in found.quantities),
            _part(point.true_contacts_found, point.true_contacts),
        )
        for point in sorted(best.values(), key=lambda point: point.wall_time)
    ]
    name, called = family("card.name"), {key: named("card.quantity", key) for key in found.quantities}
    rows = [
        (name["reference"], found.reference.words if found.reference else family("card.word")["nothing"]),
        (name["points"], text("card.points", points=len(found.points), best=len(points))),
        (name["took"], _number(found.seconds, "s")),
        (name["date"], found.date),
        *((text("card.error-of", quantity=called[key]), words) for key, words in found.quantities.items()),
        *((text("card.cannot", name=method), str(reason)) for method, reason in found.refused.items()),
    ]
    heads = [name["method"], name["time"], *called.values(), name["true-contacts"]]
    stopped = [text("card.not-complete", stopped=found.stopped)] if found.stopped else []
    title = str(found.scene.get("title", ""))
    return _card("tradeoff", title, _table(heads, points) + _pairs(rows), [*stopped, *found.remarks])


def plan_card(plan: Any) -> str:
    """The model chosen, why, and what the others would miss."""
    name, word = family("card.name"), family("card.word")
    candidates = [
        (found.model, _percent(found.expected_error), word["chosen"] if found is plan.chosen else "")
        for found in plan.candidates
    ]
    rows = [
        (name["question"], plan.question),
        (name["tolerance"], _percent(plan.tolerance)),
        (name["chosen"], plan.model),
        (name["expected-error"], _percent(plan.expected_error)),
        (name["next-better"], plan.next_better.model if plan.next_better else word["none"]),
        *((named("card.group", group), _number(value)) for group, value in plan.groups.items()),
        (name["why"], plan.reason),
    ]
    warnings = [] if plan.measured else [text("card.not-measured")]
    heads = [name["model"], name["expected-error"], ""]
    return _card("plan", plan.scene.title, _table(heads, candidates) + _pairs(rows), warnings)


def stability_card(found: Any) -> str:
    """How every integrator did over the two axes."""
    cannot = family("card.word")["cannot"]
    maps = [
        (
            of.label,
            cannot if of.reason else _part(of.failures, of.ending.size),
            "" if of.reason else str(of.stopped),
            "" if of.reason else _percent(of.worst_energy_error),
            str(of.reason or ""),
        )
        for of in found.maps.values()
    ]
    name, axis_names = family("card.name"), library(spoken()).family("name.axis")
    axes = [(axis_names[axis.name], _axis(axis, here)) for axis, here in zip(found.axes, found.here, strict=True)]
    rows = [*axes, (name["modes"], str(found.modes)), (name["most-steps"], str(found.bound))]
    heads = _named(("integrator", "failed", "stopped", "worst-energy", "why-not"))
    return _card("stability", found.scene.title, _table(heads, maps) + _pairs(rows), found.notes)


def ensemble_card(found: Any) -> str:
    """The spread of every figure, and what can be trusted."""
    spreads = [
        (
            _figure(row.quantity, row.unit),
            *(_number(value, unknown="-") for value in (row.unperturbed, row.lowest, row.median, row.highest)),
            named("verdict", row.verdict.replace(" ", "-")),
        )
        for row in found.spread
    ]
    name = family("card.name")
    rows = [
        (name["runs"], str(found.perturbations.size)),
        (name["varied"], found.key),
        (name["method"], _method(found.method)),
    ]
    heads = _named(("figure", "unperturbed", "lowest", "median", "highest", "verdict"))
    return _card("ensemble", found.title, _table(heads, spreads) + _pairs(rows), [found.summary, *found.notes])


def gradient_card(found: Any) -> str:
    """Every derivative with its error and elasticity, or why there is none."""
    derivatives = [
        (
            named("quantity", figure),
            key,
            existing(value, ".6g"),
            found.unit[figure][key],
            existing(found.error[figure][key], ".1e"),
            existing(round(found.elasticity[figure][key], 9), "+.6g"),
            str(found.why[figure][key] or ""),
        )
        for figure, by in found.value.items()
        for key, value in by.items()
    ]
    name = family("card.name")
    heads = _named(("figure", "varied", "derivative", "unit", "own-error", "elasticity", "why-not"))
    rows = [(name["method"], _method(found.method)), (name["solves"], str(found.solves))]
    return _card("gradient", found.title, _table(heads, derivatives) + _pairs(rows), found.notes)


def uncertain_card(found: Any) -> str:
    """How far every figure spreads, and what each input has to do with it."""
    of_figures = _table(uncertain_tables.spread_heads(found), uncertain_tables.spreads(found))
    of_inputs = _table(uncertain_tables.share_heads(), uncertain_tables.shares(found))
    said = [*uncertain_tables.inputs(found), *uncertain_tables.without(found), *found.notes]
    return _card("uncertain", found.title, of_figures + of_inputs, said)


def convergence_card(found: Any) -> str:
    """Every figure at every level, and what becomes of it."""
    beside = found.reference_values or {}
    known = [found.reference] if found.reference else []
    figures = [
        (
            _figure(key, found.units[key]),
            *(_number(float(value)) for value in values),
            *(_number(beside.get(key), unknown="-") for _ in known),
            str(found.summary[key]),
        )
        for key, values in found.values.items()
    ]
    heads = [named("convergence.kind", found.kind), *(shown(count, "g") for count in found.counts), *known, ""]
    rows = [(family("card.name")["method"], found.method)]
    return _card("convergence", found.title, _table(heads, figures) + _pairs(rows), [])


def sweep_card(found: Any) -> str:
    """A row for each value."""
    unknown = family("card.word")["unknown"]
    rows = [
        (
            _number(row["value"]),
            str(row["contacts"]),
            _number(row["contact_time"]),
            _quantity(row["impulse"], ""),
            _number(row["peak_force"], unknown="-"),
            _quantity(tuple(v) if isinstance(v := row["impactor"]["final_velocity"], list) else v, ""),
            _number(row["restitution"]["newton"], unknown="-"),
            _number(row["estimated_error"], unknown=unknown),
            *(_number(row[name], unknown="-") for name in found.asked),
        )
        for row in found
    ]
    heads = ("contacts", "seconds", "newton-seconds", "newtons", "metres-per-second", "restitution", "own-error")
    asked = (f"{name} [{unit}]" if unit else name for name, unit in found.asked.items())
    return _card("sweep", "", _table([found.key, *_named(heads), *asked], rows), [])


def figures_card(found: Any) -> str:
    """How far each figure of many scenes reaches, and where."""
    rows = [
        (_figure(figure, each["unit"]) if n == 0 else "", *cells)
        for figure, each in study_tables.figures_reach(found).items()
        for n, cells in enumerate(study_tables.reach_cells(each))
    ]
    name = family("card.name")
    table = _table([name["figure"], f"{name['lowest']}, {name['highest']}", ""], rows)
    return _card("figures", study_tables.figures_head(found), table, [])


def sought_card(found: Any) -> str:
    """A row for each value of the key, and what is to be said besides."""
    rows = [
        (
            _number(root.value),
            _number(root.slope, unknown="-"),
            _number(root.elasticity, unknown="-"),
            " ".join(note.code for note in root.notes),
        )
        for root in found.roots
    ]
    said = [tables.sought_for(found), *tables.sought_beside(found), *found.notes]
    return _card("seek", found.title, _table(tables.sought_heads(found), rows), said)


def contour_card(found: Any) -> str:
    """A row for each vertex that the table has, and what is to be said besides."""
    rows = [
        (head if n == 0 else "", *map(_number, vertex))
        for head, vertices in contour_tables.parts(found)
        for n, vertex in enumerate(vertices)
    ]
    said = [contour_tables.asked(found), *contour_tables.beside(found), *found.notes]
    return _card("contour", found.title, _table(["", *contour_tables.heads(found)], rows), said)


def comparison_card(found: Any) -> str:
    """What every method misses and costs."""
    cannot = family("card.word")["cannot"]
    rows = [
        (row.label, cannot, "", "", "", str(row.reason))
        if row.reason is not None
        else (
            row.label,
            _percent(row.rebound_error),
            _part(row.true_contacts_found, row.true_contacts),
            "-" if row.force_error is None else _percent(row.force_error),
            _number(1e3 * (row.wall_time or 0.0), "ms"),
            "",
        )
        for row in found
    ]
    heads = _named(("method", "rebound-error", "true-contacts", "force-error", "time", "why-not"))
    name = family("card.name")
    measured = [(name["reference"], _method(found.exact.method)), (name["rebound"], _number(found.rebound, "m/s"))]
    return _card("comparison", found.exact.scene.title, _table(heads, rows) + _pairs(measured), [])


# --- HTML -------------------------------------------------------------------------------------------------------------


def _card(kind: str, title: str, body: str, notes: Sequence[Any]) -> str:
    head = f"<p><strong>{family('card.kind')[kind]}</strong> {escape(title)}</p>"
    listed = "".join(f"<li>{escape(str(note))}</li>" for note in notes)
    return f"<div>{head}{body}{f'<ul>{listed}</ul>' if listed else ''}</div>"


def _pairs(rows: Rows) -> str:
    cells = (f"<tr><th scope='row'>{escape(name)}</th><td>{escape(value)}</td></tr>" for name, value in rows if value)
    return f"<table><tbody>{''.join(cells)}</tbody></table>"


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    names = "".join(f"<th scope='col'>{escape(name)}</th>" for name in head)
    cells = ("".join(f"<td>{escape(cell)}</td>" for cell in row) for row in rows)
    body = "".join(f"<tr>{row}</tr>" for row in cells)
    return f"<table><thead><tr>{names}</tr></thead><tbody>{body}</tbody></table>"


# --- words ------------------------------------------------------------------------------------------------------------


def _named(keys: Iterable[str]) -> list[str]:
    names = family("card.name")
    return [names[key] for key in keys]


def _figure(key: str, unit: str | None) -> str:
    return named("quantity", key) + (f" [{unit}]" if unit else "")


def _axis(axis: Any, here: float) -> str:
    low, high, at = (shown(value, ".4g") for value in (axis.values[0], axis.values[-1], here))
    return text("card.axis", count=axis.values.size, low=low, high=high, unit=axis.unit, here=at)


def _part(count: int | None, of: int | None) -> str:
    return text("card.of", count=str(count), all=str(of))


def _number(value: float | None, unit: str = "", unknown: str = "") -> str:
    return unknown if value is None else f"{shown(value, '.6g')} {unit}".rstrip()


def _percent(share: float | None) -> str:
    if share is None or math.isnan(share):
        return text("card.not-known")
    return text("card.cannot-predict") if math.isinf(share) else f"{shown(100.0 * share, '.3g')} %"


def _quantity(value: Any, unit: str) -> str:
    return f"{vector(value)} {unit}".rstrip() if isinstance(value, tuple) else _number(value, unit)


def _body(body: Any, normal: Any) -> str:
    parts = [body.kind]
    if math.isfinite(body.mass):
        parts.append(_number(body.mass, "kg"))
    if body.length:
        parts.append(text("card.length", length=_number(body.length, "m")))
    if body.kind == "pulse":
        parts.append(text("card.largest-force", force=_number(max(body.forces), "N")))
    elif normal is not None or body.velocity:
        parts.append(text("card.velocity", velocity=_quantity(body.velocity, "m/s")))
    return listed(parts)


def _method(method: Any) -> str:
    options = {key: value for key, value in method.items() if key != "name" and value is not None}
    parts = (f"{key} {value:g}" if type(value) in (int, float) else f"{key} {value}" for key, value in options.items())
    return ", ".join((str(method["name"]), *parts))
