"""The command `impact record`: a measured record beside a scene, and the contact force that follows from it."""

import argparse
import json
from pathlib import Path
from typing import Any

import numpy as np

import solvers
from solvers import Rod, SceneError, Solution, Waveguide, validation
from solvers.records import (
    Alignment,
    Record,
    RecoveredWaves,
    align,
    example,
    expected,
    from_one_gauge,
    from_two_gauges,
    load_record,
)
from solvers.text.notes import Note, Severity, coded

from ..views.record import MAX_FOLLOWED, clock_notes, other_sign
from .export import check_name
from .reading import how
from .words import family, figure, text

UNITS = {"strain": "", "stress": "_Pa", "force": "_N"}


def print_record(scene: solvers.Scene, options: argparse.Namespace) -> int:
    """Read, compare, recover if asked to, print."""
    if options.series is not None:
        check_name(options.series, ".csv")
    places = _places(options)
    records = _records(options, max(len(places), 1))
    if not places and records[0].place is not None:
        places = [records[0].place]
    if records[0].kind != "force" and not places:
        raise SceneError("--at", None, text("wanted.gauge"))
    places = places or [0.0]
    solution = _solution(scene, records[0])
    shift = None if options.shift is None else _float("--shift", options.shift, -1e4, 1e4, "s")
    found = [align(records[0], solution, places[0], shift)]
    found += [align(record, solution, x, found[0].shift) for record, x in zip(records[1:], places[1:], strict=True)]
    waves = _recovered(solution, [r.shifted(found[0].shift) for r in records], places) if options.recover else None
    notes, other = list(solution.notes), other_sign(records[0], solution, places[0], found[0])
    if other is not None:
        notes.append(Note("record.other-sign", Severity.WARNING, residual=other))
    notes += clock_notes(records[0])
    if options.series is not None:
        write_columns(options.series, _series(solution, records, places, found, waves))
    answer = _answer(solution, records, places, found, waves, notes)
    print(json.dumps(answer, indent=1, allow_nan=False) if options.json else _report(answer))
    return 0


def _places(options: argparse.Namespace) -> list[float]:
    if len(options.at) > 2:
        raise SceneError("--at", options.at[2], text("wanted.two-gauges"))
    return [_float("--at", word, 0.0, 1e6, "m") for word in options.at]


def _float(key: str, word: str, low: float, high: float, unit: str) -> float:
    try:
        value = float(word)
    except ValueError:
        value = word
    return validation.number(key, value, low, high, unit)


def _records(options: argparse.Namespace, count: int) -> list[Record]:
    if options.example == (options.file is not None):
        raise SceneError("FILE", options.file, text("wanted.record"))
    file = example() if options.example else options.file
    given = how(options)
    return [load_record(file, gauge=number, **given) for number in range(1, count + 1)]


def _solution(scene: solvers.Scene, record: Record) -> Solution:
    """The scene solved for as long as the record may show it."""
    solution = solvers.solve(scene)
    lag = sum(rod.round_trip_time for rod in scene.target.rods)  # beyond any place in them
    wanted = min(float(np.ptp(record.time)) + lag, solution.duration + MAX_FOLLOWED * scene.time_unit)
    if "duration" in scene.method or solution.motion is None or wanted <= solution.duration:
        return solution
    return solvers.solve(scene, duration=wanted)


def _recovered(solution: Solution, records: list[Record], places: list[float]) -> RecoveredWaves:
    target = solution.scene.target
    if isinstance(target, Rod) and len(records) == 1:
        return from_one_gauge(records[0], target, places[0])
    if not isinstance(target, Waveguide) or len(records) == 1:
        raise SceneError("target.kind", target.kind, text("wanted.rod-or-rods"))
    first, second = records
    near, far = places
    return from_two_gauges(first, second, target.rods[0], near, far)


def _answer(
    solution: Solution,
    records: list[Record],
    places: list[float],
    found: list[Alignment],
    waves: RecoveredWaves | None,
    notes: list[Note],
) -> dict[str, Any]:
    gauges = [
        {
            "at": x,
            "kind": record.kind,
            "rows": record.time.size,
            "shift": one.shift,
            "scale": one.scale,
            "residual": one.residual.relative,
            "greatest_residual": one.residual.greatest,
            "samples": one.residual.samples,
        }
        for record, x, one in zip(records, places, found, strict=True)
    ]
    recovered = None
    if waves is not None:
        within = waves.time <= solution.duration
        true = expected(solution, "force", waves.time[within])
        recovered = {
            "peak_force": float(waves.force.max()),
            "impulse": float(np.trapezoid(waves.force, waves.time)),
            "until": float(waves.time[-1]),
            "terms": waves.terms,
            "residual": float(np.linalg.norm(waves.force[within] - true) / np.linalg.norm(true)),
        }
    impact = {"peak_force": solution.peak_force, "impulse": solution.impulse, "duration": solution.duration}
    return {"gauges": gauges, "solution": impact, "recovered": recovered, **coded(notes)}


def _report(answer: dict[str, Any]) -> str:
    head = family("record.head")
    lines = [
        f"  {head['gauge']:>5}{head['at']:>8}    {head['kind']:8}{head['shift']:>12}{head['scale']:>12}"
        f"{head['residual']:>16}{head['greatest']:>13}{head['samples']:>10}"
    ]
    forms = {"shift": "12.4f", "scale": "12.6g", "residual": "16.4g", "greatest_residual": "13.4g"}
    for number, one in enumerate(answer["gauges"], 1):
        cells = one | {"shift": 1e6 * one["shift"]}
        figures = "".join(figure(cells[name], form) for name, form in forms.items())
        lines.append(f"  {number:5d}{figure(one['at'], '8.4g')}    {one['kind']:8}{figures}{one['samples']:10d}")
    if answer["recovered"] is not None:
        impact, found = answer["solution"], answer["recovered"]
        peak = (
            text("record.none") if impact["peak_force"] is None else f"{figure(impact['peak_force'] / 1e3, '.6g')} kN"
        )
        rows, terms = family("record.row"), text("record.readings", terms=found["terms"])
        lines += [
            "",
            f"  {rows['force']:14}{rows['recovered']:>13}{rows['solution']:>14}",
            f"  {rows['peak']:14}{figure(found['peak_force'] / 1e3, '10.6g')} kN   {peak}",
            f"  {rows['impulse']:14}{figure(found['impulse'], '10.6g')} N s  {figure(impact['impulse'], '.6g')} N s",
            f"  {rows['residual']:14}{figure(found['residual'], '10.4g')}",
            f"  {rows['until']:14}{figure(1e6 * found['until'], '10.6g')} us   {terms}",
        ]
    return "\n".join(lines + ["  " + text("printed.report.note", note=note) for note in answer["notes"]])


def _series(
    solution: Solution,
    records: list[Record],
    places: list[float],
    found: list[Alignment],
    waves: RecoveredWaves | None,
) -> dict[str, np.ndarray]:
    """Columns: the recovered force beside that of the solution, or the moved records beside what it says of them."""
    if waves is not None:
        return {
            "time_s": waves.time,
            "recovered_force_N": waves.force,
            "solution_force_N": expected(solution, "force", waves.time),
            "sent_stress_Pa": waves.sent,
            "returned_stress_Pa": waves.returned,
        }
    columns = {"time_s": records[0].time + found[0].shift}
    for number, (record, x, one) in enumerate(zip(records, places, found, strict=True), 1):
        name = f"{record.kind}{UNITS[record.kind]}_{number}"
        columns[f"measured_{name}"] = record.values * one.scale
        columns[f"solution_{name}"] = expected(solution, record.kind, record.time + one.shift, x)
    return columns


def write_columns(name: str, columns: dict[str, np.ndarray]) -> None:
    """As CSV; cells without a value, as where a solution has ended, are empty."""
    rows = np.column_stack(list(columns.values())).tolist()
    lines = [",".join(columns), *(",".join("" if v != v else f"{v:.12g}" for v in row) for row in rows)]
    try:
        Path(name).write_text("\n".join(lines) + "\n", encoding="utf-8")
    except OSError as error:
        raise SceneError("--series", name, text("wanted.writable", why=error.strerror)) from None
