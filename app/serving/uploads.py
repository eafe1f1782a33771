"""Measured records sent by the browser: checked, compared with the chosen scene, answered as JSON.

One request is one record and one answer; nothing is kept. A record is read and compared off the event loop.
"""

import asyncio
import json
import logging
from typing import Any
from urllib.parse import urlsplit

import numpy as np
from bokeh.server.util import check_allowlist
from tornado.web import RequestHandler, stream_request_body

from solvers import SceneError, Solution, checks, read_method
from solvers.inverse import from_one_gauge
from solvers.jit import NotCompiled
from solvers.record_files import check_size, read_record
from solvers.records import Alignment, Record, align, expected

from ..frames import exact_solution
from ..jobs.compiler import COMPILER
from ..jobs.runner import POOL, at_once
from ..measured import LONGEST, other_sign
from ..state import Choices, chosen_scene, from_address, in_space

MOST_POINTS = 2_000  # of each history in an answer
AT_ONCE = 4  # records that are received or compared
PATIENCE = 20.0  # [s] for a record to arrive
BEFORE = 1.0  # [T] of a record that are shown ahead of the blow
log = logging.getLogger("strikewave")


@stream_request_body
class MeasuredRecord(RequestHandler):
    """POST with the file as body; in the query the choices, `kind`, `at` [m] and `sign`."""

    _busy = 0  # of all visitors together

    def prepare(self):
        self._body, self._refusal, self._counted, self._comparing = bytearray(), None, False, False
        self.request.connection.set_body_timeout(PATIENCE)
        origin = urlsplit(self.request.headers.get("Origin", "")).netloc.lower()
        if not origin or not check_allowlist(origin, self.application.websocket_origins):
            self._refusal = 403, "Records are taken from this page only."
        elif MeasuredRecord._busy >= AT_ONCE:
            self._refusal = 429, "Other records are being compared: try again in a moment."
        else:
            MeasuredRecord._busy += 1
            self._counted = True
            length = self.request.headers.get("Content-Length", "0")
            self._check_size(int(length) if length.isdecimal() else 0)

    def data_received(self, chunk: bytes):
        """Keep the body, or let it pass by once it is refused: a browser listens when it has sent all."""
        if self._refusal is None:
            self._body += chunk
            self._check_size(len(self._body))

    def _check_size(self, size: int) -> None:
        try:
            check_size(size)
        except SceneError as refusal:
            self._refusal = 413, str(refusal)
            self._release()

    async def post(self):
        if self._refusal is not None:
            return self._refuse(*self._refusal)
        self._comparing = True
        try:
            work = (bytes(self._body), self.request.query_arguments)
            answer = await _answered(*work)
            self.set_header("Content-Type", "application/json; charset=UTF-8")
            self.write(answer)
        except ValueError as refusal:  # SceneError: the sentence is for the visitor
            self._refuse(400, str(refusal))
        except Exception:
            log.exception("a record could not be compared")
            self._refuse(500, "This record could not be compared.")
        finally:
            self._comparing = False
            self._release()

    def on_finish(self):
        self._release()

    def on_connection_close(self):
        self._release()

    def _release(self):
        """Once, and not before the work is done: who leaves early must not make room for more of it."""
        if self._comparing:
            return
        MeasuredRecord._busy -= self._counted
        self._counted = False
        self._body = bytearray()

    def _refuse(self, status: int, sentence: str) -> None:
        self.set_status(status)
        self.finish({"error": sentence})


async def _answered(content: bytes, arguments: dict[str, list[bytes]]) -> str:
    """`record_answer` off the event loop; what it needs that is not compiled yet is compiled in another process."""
    loop = asyncio.get_running_loop()
    try:
        return await loop.run_in_executor(POOL, at_once, record_answer, content, arguments)
    except NotCompiled:
        await COMPILER.ready("solve_frame", _chosen(arguments))
    return await loop.run_in_executor(POOL, record_answer, content, arguments)


def _chosen(arguments: dict[str, list[bytes]]) -> dict[str, Any]:
    choices, refused = from_address(arguments)
    if refused:
        raise ValueError(" ".join(refused))
    return Choices(**choices).chosen()


def record_answer(content: bytes, arguments: dict[str, list[bytes]]) -> str:
    """What the page draws of a record, as JSON. Raises SceneError naming what is wrong with file or query.

    `time` [T] and `values` of the record as it lies best on the solution; `computed`: `time` [T] and `model`, what the
    exact solution says of the same place; `recovered`: `time` [T] and `force` [N] from the record alone, moved and
    scaled like it, or None; `kind`, `shift` [s], `scale`, `residual`, `notes`. Values in SI units.
    """
    chosen = _chosen(arguments)
    scene = chosen_scene(chosen)
    if in_space(scene):
        raise SceneError("scene", chosen["scene"], "one on an axis: a blow in space has no history")
    given = {key: arguments.get(key, [b""])[-1].decode("utf-8", "replace")[:40] for key in ("kind", "at", "sign")}
    sign = int(checks.choice("sign", given["sign"] or "1", ("1", "-1")))
    record = read_record(content, kind=given["kind"] or None, sign=sign)
    place = _place(given["at"], record)
    solution = _solution(scene, record, chosen["restitution"])
    found = align(record, solution, place)
    notes = list(solution.notes)
    if (other := other_sign(record, solution, place, found)) is not None:
        notes.append(f"With the other sign the record lies better, with a residual of {100 * other:.3g} %.")
    recovered = None
    try:
        recovered = _recovered(record, solution, place, found)
    except SceneError as refusal:
        notes.append(f"No contact force is recovered. {refusal}")
    return _packed(record, solution, place, found, recovered, notes)


def _place(text: str, record: Record) -> float | None:
    """Of the gauge [m]; of a contact force none."""
    if record.kind == "force":
        return None
    try:
        value: Any = float(text.replace(",", ".", 1))
    except ValueError:
        value = text or None
    if value is None:
        raise SceneError("at", None, f"where the gauge of {record.kind} sits, in metres from the struck end")
    return checks.number("at", value, 0.0, 1e6, "m")


def _solution(scene: Any, record: Record, restitution: float) -> Solution:
    """The exact one, for as long as the record may tell of it."""
    exact, trip = exact_solution(scene, restitution), scene.time_unit
    lag = sum(rod.round_trip_time for rod in getattr(scene.target, "rods", ()))
    wanted = min(float(np.ptp(record.time)) + lag, exact.duration + LONGEST * trip)
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
    if target.kind != "rod":
        raise SceneError("target.kind", target.kind, "'rod', to recover the contact force by one gauge")
    waves = from_one_gauge(moved, target, place)
    return waves.time, waves.force


def _packed(
    record: Record,
    solution: Solution,
    place: float | None,
    found: Alignment,
    recovered: tuple[np.ndarray, np.ndarray] | None,
    notes: list[str],
) -> str:
    trip = solution.scene.time_unit
    ends = min(solution.duration, float(record.time[-1]) + found.shift)
    computed = np.linspace(0.0, ends, MOST_POINTS)
    histories = {
        "record": (record.time + found.shift, record.values * found.scale),
        "computed": (computed, expected(solution, record.kind, computed, place)),
    }
    if recovered is not None:
        histories["recovered"] = recovered
    shown = {name: _shown(*history, trip, ends) for name, history in histories.items()}
    answer = {
        "kind": record.kind,
        "time": shown["record"][0],
        "values": shown["record"][1],
        "computed": dict(zip(("time", "model"), shown["computed"], strict=True)),
        "recovered": dict(zip(("time", "force"), shown["recovered"], strict=True)) if recovered else None,
        "shift": found.shift,
        "scale": found.scale,
        "residual": found.residual.relative,
        "notes": notes,
    }
    return json.dumps(answer, allow_nan=False)


def _shown(time: np.ndarray, values: np.ndarray, trip: float, ends: float) -> tuple[list[float], list[float]]:
    """Around the blow, in units of T, and thinned to what can be drawn."""
    inside = np.flatnonzero((time >= -BEFORE * trip) & (time <= ends * (1.0 + 1e-12)) & np.isfinite(values))
    rows = inside[np.linspace(0, inside.size - 1, min(inside.size, MOST_POINTS)).round().astype(int)]
    return (time[rows] / trip).tolist(), values[rows].tolist()
