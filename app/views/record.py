"""A measured record beside the chosen scene: how it lies on the solution, and the contact force by it."""

import json
import math
from typing import Any

import numpy as np

from solvers import Rod, Scene, SceneError, Solution, read_method, validation
from solvers.accuracy.reference import exact_solution
from solvers.records.files import read_record
from solvers.records.gauges import from_one_gauge
from solvers.records.record import Alignment, Record, align, expected
from solvers.text.catalogue import Catalogue
from solvers.text.notes import Note, Severity

from ..choices.request import Request
from ..messages.transverse import main_solution
from ..text.refusals import Refused, reason_of
from .figures import COLOURS, blank, cursor, hover, legend, source

MAX_POINTS = 2_000  # of each history in an answer
MAX_FOLLOWED = 50.0  # time units of the scene that a record is followed beyond the impact
BEFORE = 1.0  # [T] of a record that are shown ahead of the impact


def record_answer(content: bytes, chosen: dict[str, Any], arguments: dict[str, list[bytes]]) -> str:
    """What the page draws of a record, as JSON. Raises ValueError about file or query.

    `time` [T] and `values` of the record as it lies best on the solution; `computed`: `time` [T] and `model`, what the
    exact solution says of the same place; `recovered`: `time` [T] and `force` [N] from the record alone, moved and
    scaled like it, or None; `kind`, `trip`, which is T [s], `shift` [s], `scale`, `residual`, `notes`. Values are
    in SI units.
    """
    request = Request.of(chosen)
    if request.kind == "bodies":
        raise Refused("serving.record.in-space")
    given = {key: arguments.get(key, [b""])[-1].decode("utf-8", "replace")[:40] for key in ("kind", "at", "sign")}
    sign = int(validation.choice("sign", given["sign"] or "1", ("1", "-1")))
    record = read_record(content, kind=given["kind"] or None, sign=sign)
    place = _place(given["at"], record, request.scene)
    solution = _solution(request, record)
    found = align(record, solution, place)
    notes = list(solution.notes)
    if (other := other_sign(record, solution, place, found)) is not None:
        notes.append(Note("record.other-sign", Severity.WARNING, residual=other))
    notes += clock_notes(record)
    recovered = None
    try:
        if request.kind == "axial":
            recovered = _recovered(record, solution, place, found)
    except ValueError as refusal:
        notes.append(Note("record.not-recovered", Severity.WARNING, reason=reason_of(refusal)))
    return _packed(record, solution, place, found, recovered, notes)


def _place(text: str, record: Record, scene: Scene) -> float | None:
    """Of the gauge [m]; of a contact force none. Raises ValueError, for the visitor."""
    if record.kind == "force":
        return None
    if not text.strip() and record.place is not None:
        return record.place
    length = sum(rod.length for rod in scene.target.rods)
    try:
        place = float(text)
    except ValueError:
        place = math.nan
    if not 0.0 <= place <= (length or math.inf):
        said = {"given": text or "none", "length": length, "known": length > 0.0}
        raise Refused("serving.record.place", **said)
    return place


def _solution(request: Request, record: Record) -> Solution:
    """The exact one, of a beam the one that is shown, for as long as the record may show it."""
    scene = request.scene
    beam, trip = request.kind == "beam", scene.time_unit
    exact = main_solution(request)[0] if beam else exact_solution(scene, request.restitution)
    lag = sum(rod.round_trip_time for rod in scene.target.rods)
    wanted = min(float(np.ptp(record.time)) + lag, exact.duration + MAX_FOLLOWED * trip)
    if exact.motion is None or wanted <= exact.duration:
        return exact
    given = {key: value for key, value in exact.method.items() if value is not None}
    return read_method(given)[0].solve(scene, wanted)


def _recovered(
    record: Record, solution: Solution, place: float | None, found: Alignment
) -> tuple[np.ndarray, np.ndarray]:
    """Times [s] and contact force [N] from the record alone."""
    moved = record.shifted(found.shift).scaled(found.scale)
    if record.kind == "force":
        return moved.time, moved.values
    target = solution.scene.target
    if not isinstance(target, Rod):
        raise Refused("refused.value", key="target.kind", value=validation.shown(target.kind), allowed="wanted.rod")
    waves = from_one_gauge(moved, target, 0.0 if place is None else place)
    return waves.time, waves.force


def _packed(
    record: Record,
    solution: Solution,
    place: float | None,
    found: Alignment,
    recovered: tuple[np.ndarray, np.ndarray] | None,
    notes: list[Note],
) -> str:
    trip = solution.scene.time_unit
    ends = min(solution.duration, float(record.time[-1]) + found.shift)
    computed = np.linspace(0.0, ends, MAX_POINTS)
    histories = {
        "record": (record.time + found.shift, record.values * found.scale),
        "computed": (computed, expected(solution, record.kind, computed, place)),
    }
    if recovered is not None:
        histories["recovered"] = recovered
    shown = {name: _shown(times, values, trip, ends) for name, (times, values) in histories.items()}
    answer = {
        "kind": record.kind,
        "at": place,
        "time": shown["record"][0],
        "values": shown["record"][1],
        "computed": dict(zip(("time", "model"), shown["computed"], strict=True)),
        "recovered": dict(zip(("time", "force"), shown["recovered"], strict=True)) if recovered else None,
        "trip": trip,
        "shift": found.shift,
        "scale": found.scale,
        "residual": found.residual.relative,
        "notes": [note.table() for note in notes],
    }
    return json.dumps(answer, allow_nan=False)


def _shown(time: np.ndarray, values: np.ndarray, trip: float, ends: float) -> tuple[list[float], list[float]]:
    """Around the impact, in units of T, and thinned to what can be drawn."""
    inside = np.flatnonzero((time >= -BEFORE * trip) & (time <= ends * (1.0 + 1e-12)) & np.isfinite(values))
    rows = inside[np.linspace(0, inside.size - 1, min(inside.size, MAX_POINTS)).round().astype(int)]
    return (time[rows] / trip).tolist(), values[rows].tolist()


def other_sign(record: Record, solution: Solution, x: float | None, found: Alignment) -> float | None:
    """The residual with the sign turned, where that lies much better; else None."""
    try:
        other = align(record.scaled(-1.0), solution, x).residual.relative
    except SceneError:  # with the other sign it lies nowhere
        return None
    return other if other < 0.7 * found.residual.relative else None


def clock_notes(record: Record) -> list[Note]:
    """That its times are counted from its first row, where they are."""
    return [Note("record.from-first-row", Severity.REMARK, start=record.start)] if record.start else []


def record_figure(texts: Catalogue) -> list[Any]:
    """The record as it is moved and scaled, over what the exact solution says, in two sources of their names."""
    plot = blank("record", texts.text("record.figure"), texts.text("panel.time-in", unit="T"), "")
    drawn, names, at = [], texts.family("record.curve"), texts.text("chart.time")
    for name, colour, width, dash in (("computed", COLOURS[0], 3.4, "solid"), ("measured", COLOURS[2], 1.6, [6, 2])):
        data = source(name, "time", "value")
        drawn.append(
            (
                names[name],
                [plot.line("time", "value", source=data, line_color=colour, line_width=width, line_dash=dash)],
            )
        )
        hover(plot, drawn[-1][1], {names[name]: "@value{0.000a}", at: "@time{0.000} T"}, mode="vline",
              line_policy="nearest", name=f"record-{name}")  # fmt: skip
    legend(plot, drawn)
    cursor(plot, "record-cursor")
    return [plot]
