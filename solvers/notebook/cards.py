"""What a notebook shows of an object: plain HTML tables, with all text escaped."""

import math
from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

Rows = Iterable[tuple[str, str]]


def scene_card(scene: Any) -> str:
    """What strikes what, and how it is asked to be solved."""
    rows = [(name, _body(getattr(scene, name), scene.normal)) for name in ("impactor", "target")]
    rows += [("contact", scene.contact.NAME)]
    if scene.normal is not None:
        rows += [("normal, impactor to target", _vector(scene.normal))]
        rows += [] if scene.friction is None else [("friction", _number(scene.friction))]
    elif not scene.prescribed_force:
        rows += [("mass ratio, target / impactor", _number(scene.mass_ratio))]
    if not scene.prescribed_force:
        rows += [("speed of approach", _number(scene.speed, "m/s"))]
    rows += [
        ("method", _method(scene.method) if scene.method.get("name") else "the usual one"),
        ("source", scene.source),
    ]
    return _card("Scene", scene.title, _pairs(rows), [scene.note] if scene.note else [])


def solution_card(solution: Any) -> str:
    """What happened, how well it is known, and what it warns of."""
    contacts = [
        (str(number), _number(c.start, "s"), _number(c.end, "s"), _number(c.impulse, "N s"), _number(c.peak_force, "N"))
        for number, c in enumerate(solution.contacts, 1)
    ]
    found = solution.diagnostics
    rows = [
        ("method", _method(solution.method)),
        ("in contact for", _number(solution.contact_time, "s")),
        ("impulse", _quantity(solution.impulse, "N s")),
        ("peak force", _number(solution.peak_force, "N")),
        ("impactor leaves at", _quantity(solution.impactor_velocity, "m/s")),
        ("target moves on at", _quantity(solution.target_velocity, "m/s")),
        ("deepest indentation", _number(solution.peak_indentation, "m")),
        *((f"restitution, {name.replace('_', ' ')}", _number(e)) for name, e in solution.restitution.items()),
        *((f"energy, {name.replace('_', ' ')}", _number(part, "J")) for name, part in solution.energy.items()),
        ("energy residual", _number(found["energy_error"])),
        ("momentum residual", _number(found["momentum_error"])),
        ("estimated error of the velocity", _number(found["estimated_error"], "of the impact speed", "unknown")),
        ("solved in", _number(found["wall_time"], "s")),
    ]
    shown = _table(("contact", "start", "end", "impulse", "peak force"), contacts) + _pairs(rows)
    return _card("Solution", solution.scene.title, shown, solution.notes)


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
            f"{point.true_contacts_found} of {point.true_contacts}",
        )
        for point in sorted(best.values(), key=lambda point: point.wall_time)
    ]
    rows = [
        ("measured by", found.reference.words if found.reference else "nothing yet"),
        ("points", f"{len(found.points)}, of which {len(points)} are best for something"),
        ("took", _number(found.seconds, "s")),
        ("date", found.date),
        *((f"error of {name}", words) for name, words in found.quantities.items()),
        *((f"{name} cannot", str(reason)) for name, reason in found.refused.items()),
    ]
    shown = _table(("method", "time", *found.quantities, "true contacts"), points) + _pairs(rows)
    stopped = [f"Not complete: {found.stopped}."] if found.stopped else []
    return _card("Cost and accuracy", str(found.scene.get("title", "")), shown, [*stopped, *found.remarks])


def plan_card(plan: Any) -> str:
    """The model chosen, why, and what the others would miss."""
    candidates = [
        (found.model, _percent(found.expected_error), "chosen" if found is plan.chosen else "")
        for found in plan.candidates
    ]
    rows = [
        ("question", plan.question),
        ("tolerance", _percent(plan.tolerance)),
        ("chosen", plan.model),
        ("expected error", _percent(plan.expected_error)),
        ("next better", plan.next_better.model if plan.next_better else "none"),
        *((name.replace("_", " "), _number(value)) for name, value in plan.groups.items()),
        ("why", plan.reason),
    ]
    warnings = [] if plan.measured else ["The scene lies beside what was measured: take the errors as a guess."]
    shown = _table(("model", "expected error", ""), candidates) + _pairs(rows)
    return _card("Plan", plan.scene.title, shown, warnings)


def stability_card(found: Any) -> str:
    """How every integrator did over the two axes."""
    maps = [
        (
            of.label,
            "cannot" if of.reason else f"{of.failures} of {of.ending.size}",
            "" if of.reason else str(of.stopped),
            "" if of.reason else _percent(of.worst_energy_error),
            str(of.reason or ""),
        )
        for of in found.maps.values()
    ]
    axes = [
        (
            axis.name.replace("_", " "),
            f"{axis.values.size} from {axis.values[0]:.4g} to {axis.values[-1]:.4g} ({axis.unit}); here {here:.4g}",
        )
        for axis, here in zip(found.axes, found.here, strict=True)
    ]
    rows = [*axes, ("modes", str(found.modes)), ("most steps of a run", str(found.bound))]
    head = ("integrator", "failed", "stopped at the bound", "worst energy error", "why not")
    return _card("Stability", found.scene.title, _table(head, maps) + _pairs(rows), found.notes)


def ensemble_card(found: Any) -> str:
    """The spread of every figure, and what can be trusted."""
    spreads = [
        (
            f"{row.quantity.replace('_', ' ')} [{row.unit}]" if row.unit else row.quantity.replace("_", " "),
            *(_number(value, unknown="-") for value in (row.unperturbed, row.lowest, row.median, row.highest)),
            str(row.verdict),
        )
        for row in found.spread
    ]
    rows = [("runs", str(found.perturbations.size)), ("varied", found.key), ("method", _method(found.method))]
    shown = _table(("figure", "unperturbed", "lowest", "median", "highest", "verdict"), spreads) + _pairs(rows)
    return _card("Ensemble", found.title, shown, [found.summary, *found.notes])


def convergence_card(found: Any) -> str:
    """Every figure at every level, and what becomes of it."""
    beside = found.reference_values or {}
    known = [found.reference] if found.reference else []
    figures = [
        (
            f"{name.replace('_', ' ')} [{found.units[name]}]" if found.units[name] else name.replace("_", " "),
            *(_number(float(value)) for value in values),
            *(_number(beside.get(name), unknown="-") for _ in known),
            str(found.summary[name]),
        )
        for name, values in found.values.items()
    ]
    head = (found.kind, *(f"{count:g}" for count in found.counts), *known, "")
    return _card("Convergence", found.title, _table(head, figures) + _pairs([("method", found.method)]), [])


def sweep_card(found: Any) -> str:
    """A row for each value."""
    rows = [
        (
            _number(row["value"]),
            str(row["contacts"]),
            _number(row["contact_time"]),
            _quantity(row["impulse"], ""),
            _number(row["peak_force"], unknown="-"),
            _quantity(tuple(v) if isinstance(v := row["impactor"]["final_velocity"], list) else v, ""),
            _number(row["restitution"]["newton"], unknown="-"),
            _number(row["estimated_error"], unknown="unknown"),
        )
        for row in found
    ]
    head = (found.key, "contacts", "in contact [s]", "impulse [N s]", "peak force [N]", "leaves at [m/s]")
    return _card("Sweep", "", _table((*head, "restitution", "estimated error"), rows), [])


def comparison_card(found: Any) -> str:
    """What every method misses and costs."""
    rows = [
        (row.label, "cannot", "", "", "", str(row.reason))
        if row.reason is not None
        else (
            row.label,
            _percent(row.rebound_error),
            f"{row.true_contacts_found} of {row.true_contacts}",
            "-" if row.force_error is None else _percent(row.force_error),
            _number(1e3 * (row.wall_time or 0.0), "ms"),
            "",
        )
        for row in found
    ]
    head = ("method", "error of the rebound", "true contacts", "error of the force", "time", "why not")
    measured = [("measured by", _method(found.exact.method)), ("its rebound", _number(found.rebound, "m/s"))]
    return _card("Comparison", found.exact.scene.title, _table(head, rows) + _pairs(measured), [])


# --- HTML -------------------------------------------------------------------------------------------------------------


def _card(kind: str, title: str, body: str, notes: Sequence[Any]) -> str:
    head = f"<p><strong>{kind}</strong> {escape(title)}</p>"
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


def _number(value: float | None, unit: str = "", unknown: str = "") -> str:
    return unknown if value is None else f"{value:.6g} {unit}".rstrip()


def _percent(share: float | None) -> str:
    if share is None or math.isnan(share):
        return "not known"
    return "cannot predict" if math.isinf(share) else f"{100.0 * share:.3g} %"


def _vector(values: Sequence[float]) -> str:
    return "(" + ", ".join(f"{value + 0.0:.6g}" for value in values) + ")"


def _quantity(value: Any, unit: str) -> str:
    return f"{_vector(value)} {unit}" if isinstance(value, tuple) else _number(value, unit)


def _body(body: Any, normal: Any) -> str:
    shown = [body.kind]
    if math.isfinite(body.mass):
        shown.append(_number(body.mass, "kg"))
    if body.length:
        shown.append(f"length {_number(body.length, 'm')}")
    if body.kind == "pulse":
        shown.append(f"largest force {_number(max(body.forces), 'N')}")
    elif normal is not None or body.velocity:
        shown.append("velocity " + _quantity(body.velocity, "m/s"))
    return ", ".join(shown)


def _method(method: Any) -> str:
    options = {key: value for key, value in method.items() if key != "name" and value is not None}
    shown = (f"{key} {value:g}" if type(value) in (int, float) else f"{key} {value}" for key, value in options.items())
    return ", ".join((str(method["name"]), *shown))
