"""Studies as tables of plain text: what `print` shows of them, and the command."""

import textwrap
from collections.abc import Iterable, Mapping
from typing import Any

from ..text.catalogue import library, spoken
from .report import line, method_line, title_of
from .words import existing, family, listed, named, shown, text, vector

COLUMNS = {  # and how wide they are at least
    "contacts": 8,
    "impulse": 13,
    "peak-force": 15,
    "contact-time": 15,
    "leaves": 15,
    "restitution": 11,
    "energy": 15,
    "error": 14,
}


def sweep(key: str, rows: list[dict[str, Any]], asked: Mapping[str, str]) -> str:
    """A line for each value; `asked` besides, by name its unit."""
    width = max(len(key), 12)
    heads = [family("sweep.head")[name] for name in COLUMNS]
    heads += [f"{name} [{unit}]" if unit else name for name, unit in asked.items()]
    least = [*COLUMNS.values()] + [12] * len(asked)
    sizes = [max(size, len(head)) for size, head in zip(least, heads, strict=True)]
    head = "  ".join([f"  {key:>{width}}", *(head.rjust(size) for head, size in zip(heads, sizes, strict=True))])
    return "\n".join([head, *(_line(row, width, sizes, asked) for row in rows)])


def _line(row: dict[str, Any], width: int, sizes: list[int], asked: Iterable[str]) -> str:
    velocity = row["impactor"]["final_velocity"]
    if isinstance(velocity, list):  # of a body in space
        velocity = vector(velocity, ".4g")
    peak = None if row["peak_force"] is None else row["peak_force"] / 1e3
    cells = [
        (row["contacts"], "d"), (row["impulse"], ".6g"), (peak, ".6g"), (1e6 * row["contact_time"], ".6g"),
        (velocity, "+.6f"), (row["restitution"]["newton"], ".6f"), (row["energy_error"], "+.1e"),
        (row["estimated_error"], ".1e"), *((row[name], ".6g") for name in asked),
    ]  # fmt: skip
    sized = (shown(*cell).rjust(size) for cell, size in zip(cells, sizes, strict=True))
    return "  ".join([f"  {shown(row['value'], '.8g'):>{width}}", *sized])


def sought(found: Any) -> str:
    """A line for each value of the key, then stretches, jumps, or what comes nearest."""
    lines = [found.title or text("report.scene"), f"  {sought_for(found)}"]
    if found.roots:
        heads = sought_heads(found)
        width = max(16, len(heads[0]))
        sizes = [max(13, len(head)) for head in heads[1:3]]
        head = "  ".join(head.rjust(size) for head, size in zip(heads, [width, *sizes], strict=False))
        lines += ["", f"  {head}  {heads[3]}".rstrip()]
        for root in found.roots:
            cells = [(root.value, ".10g", width), (root.slope, ".6g", sizes[0]), (root.elasticity, ".4g", sizes[1])]
            row = "  ".join(shown(value, form).rjust(size) for value, form, size in cells)
            lines.append(f"  {row}  {' '.join(note.code for note in root.notes)}".rstrip())
    beside = sought_beside(found)
    lines += ["", *(f"  {each}" for each in beside)] if beside else []
    return "\n".join([*lines, "", *("  " + text("report.note", note=note) for note in found.notes)])


def sought_for(found: Any) -> str:
    """What was asked, and how many values there are."""
    low, high = shown(found.low, ".8g"), _valued(found.high, found.unit)
    asked = {"figure": found.figure, "key": found.key, "method": found.method, "low": low, "high": high}
    counts = {"roots": len(found.roots), "stretches": len(found.stretches)}
    return text("seek.asked", wanted=_valued(found.wanted, found.figure_unit), **asked, **counts)


def sought_heads(found: Any) -> list[str]:
    """Of the key, the slope and the elasticity; of the warnings if there are some."""
    over, under = (f"({unit})" if {"/", " "} & set(unit) else unit for unit in (found.figure_unit, found.unit))
    over = f"{over or 1}/{under}" if under else found.figure_unit
    return [
        f"{found.key} [{found.unit}]" if found.unit else found.key,
        text("seek.slope") + (f" [{over}]" if over else ""),
        text("seek.elasticity"),
        text("seek.notes") if any(root.notes for root in found.roots) else "",
    ]


def sought_beside(found: Any) -> list[str]:
    """Stretches, jumps and what comes nearest, in words."""
    wanted = _valued(found.wanted, found.figure_unit)
    lines = [
        text("seek.stretch", low=shown(low, ".8g"), high=_valued(high, found.unit)) for low, high in found.stretches
    ]
    for jump in found.jumps:
        sides = {"below": shown(jump.below, ".6g"), "above": _valued(jump.above, found.figure_unit)}
        lines.append(text("seek.jump", value=_valued(jump.value, found.unit), wanted=wanted, **sides))
    if found.nearest is not None:
        value, figure = found.nearest
        there = {"value": _valued(value, found.unit), "found": _valued(figure, found.figure_unit)}
        lines.append(text("seek.nearest", figure=found.figure, key=found.key, **there))
    return lines


def _valued(value: float, unit: str) -> str:
    return shown(value, ".8g") + (f" {unit}" if unit else "")


def ensemble(found: Any) -> str:
    """The spread of every figure, a line each, and what can be trusted."""
    columns = {"unperturbed": 14, "lowest": 14, "median": 14, "highest": 14, "half-range": 12, "sensitivity": 13}
    columns["amplified"] = 11
    heads = family("ensemble.head")
    head = "".join(f"{heads[name]:>{width}}" for name, width in columns.items())
    runs = {"runs": found.perturbations.size, "method": found.method["name"], "key": found.key}
    spread, seconds = 100.0 * float(abs(found.perturbations).max()), found.wall_time
    names = [named("quantity", row.quantity) + (f" [{row.unit}]" if row.unit else "") for row in found.spread]
    wide = max(24, *map(len, names))
    lines = [
        found.title or text("report.scene"),
        "  " + text("ensemble.runs", spread=spread, seconds=seconds, **runs),
        "",
        f"  {'':{wide}}{head}  {heads['verdict']}",
    ]
    for name, row in zip(names, found.spread, strict=True):
        cells: list[Any] = [
            (row.unperturbed, 12, ".6g"), (row.lowest, 12, ".6g"), (row.median, 12, ".6g"), (row.highest, 12, ".6g"),
            (100.0 * row.half_range, 8, ".2g"), (row.sensitivity, 13, "+.3g"), (row.amplification, 9, ".2g"),
        ]  # fmt: skip
        values = "  ".join(shown(value, form).rjust(size) for value, size, form in cells[:4])
        rest = f"{shown(*cells[4][::2]):>8} %" + shown(*cells[5][::2]).rjust(13) + shown(*cells[6][::2]).rjust(11)
        verdict = named("verdict", row.verdict.replace(" ", "-"))
        lines.append(f"  {name:{wide}}  {values}  {rest}  {verdict}")
    return "\n".join([*lines, "", str(found.summary), *(text("report.note", note=note) for note in found.notes)])


def gradient(found: Any) -> str:
    """A line for each figure and key, and why there is no derivative."""
    solved = text("gradient.solved", method=found.method["name"], solves=found.solves, seconds=found.wall_time)
    rows, why = [tuple(family("gradient.head").values())], []
    for figure, by in found.value.items():
        for key, value in by.items():
            error, elasticity = found.error[figure][key], found.elasticity[figure][key]
            cells = (
                existing(value, ".7g"),
                found.unit[figure][key],
                existing(error, ".1e"),
                existing(round(elasticity, 9), "+.6g"),
            )
            rows.append((named("quantity", figure), key, *cells))
            if (note := found.why[figure][key]) is not None:
                why.append(f"{named('quantity', figure)}, {key}: {note}")
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    sides = "<<><>>"
    lines = [
        "  " + "  ".join(f"{cell:{side}{width}}" for cell, side, width in zip(row, sides, widths, strict=True)).rstrip()
        for row in rows
    ]
    notes = [*why, *(text("report.note", note=note) for note in found.notes)]
    return "\n".join([found.title or text("report.scene"), f"  {solved}", "", *lines, *([""] if notes else []), *notes])


def convergence(found: Any) -> str:
    """A column for each level, and what they show."""
    names = [named("quantity", name) + (f" [{unit}]" if unit else "") for name, unit in found.units.items()]
    width = max(map(len, names))
    by = text("convergence.by", method=found.method, seconds=found.wall_time)
    beside = found.reference_values or {}
    heads = [shown(count, ">14g") for count in found.counts] + ([f"{found.reference:>14}"] if found.reference else [])
    lines = [found.title or text("report.scene"), f"  {by}", ""]
    lines.append(f"  {named('convergence.kind', found.kind):{width}}" + "".join(heads))
    for name, (key, values) in zip(names, found.values.items(), strict=True):
        known = [shown(beside[key], ">14.7g") if key in beside else f"{'-':>14}"] if found.reference else []
        lines.append(f"  {name:{width}}" + "".join([*(shown(value, ">14.7g") for value in values), *known]))
    return "\n".join([*lines, "", *(f"  {named('quantity', name)}: {note}" for name, note in found.summary.items())])


def comparison(found: Any) -> str:
    """A table of plain text: every method against the exact solution, or the one taken for it."""
    exact, rows = found.exact, found
    scene = exact.scene
    moving = text("solve.target-moves" if exact.impactor_velocity is None else "solve.impactor-leaves")
    spans = [(each.start / scene.time_unit, each.end / scene.time_unit) for each in exact.contacts]
    periods = listed([text("compare.period", start=start, end=end) for start, end in spans])
    head, units = family("compare.head"), family("compare.unit")
    lines = [
        title_of(exact),
        line("solve.mass-ratio", shown(scene.mass_ratio, ".6g")),
        line("compare.reference", method_line(exact.method)),
        line("compare.contacts", textwrap.shorten(periods, 200, placeholder=" ...")),
        f"  {text('compare.moving', moving=moving):32}{shown(found.rebound, '+.8g')} m/s{_uncertainty(exact)}",
        "",
        f"  {head['method']:38}{head['rebound']:>10}{head['first']:>13}{head['true']:>7}{head['listed']:>8}"
        f"{head['raw']:>6}{head['force']:>10}{head['resolved']:>10}{head['time']:>9}",
        f"  {'':38}{units['rebound']:>10}{units['first']:>13}{units['true']:>7}{'':14}"
        f"{'[%]':>10}{'[%]':>10}{'[ms]':>9}",
    ]
    for row in rows:
        if row.reason is not None:
            lines.append(f"  {row.label:38}{text('compare.cannot', reason=row.reason)}")
            continue
        shares = [
            "-" if share is None else shown(100 * share, ".1f") for share in (row.force_error, row.resolved_force_error)
        ]
        lines.append(
            f"  {row.label:38}{shown(100 * row.rebound_error, '+10.4f')}{shown(row.duration_error, '+13.5f')}"
            f"{f'{row.true_contacts_found}/{row.true_contacts}':>7}{row.contacts:8d}{row.raw_contacts:6d}"
            f"{shares[0]:>10}{shares[1]:>10}{shown(1e3 * (row.wall_time or 0.0), '9.3f')}"
        )
    return "\n".join(lines + left_out({row.label: row.method.get("model", "") for row in rows}))


def left_out(models: Mapping[str, str]) -> list[str]:
    """What each quasi-static model leaves out, a paragraph each; models by what they are called in a table."""
    about, lines = library(spoken()).family("left-out"), []
    for called, model in models.items():
        if model in about:
            about_it = text("report.model", called=called, name=named("model-name", model), about=about[model])
            lines += textwrap.wrap(about_it, 118, initial_indent="  ", subsequent_indent="    ")
    return ["", *lines] if lines else []


def _uncertainty(reference: Any) -> str:
    error = reference.diagnostics["estimated_error"]
    return "" if reference.method["name"] == "waves" or error is None else "   " + text("compare.within", error=error)
