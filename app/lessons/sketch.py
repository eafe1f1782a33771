"""A line that is drawn, and the criteria by which the page judges it."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from solvers import SceneError
from solvers.validation import whole_number

from .fields import LARGEST, Fields, numbers
from .lesson import Boundary, Judge, Part, Sketch, Span, Time
from .problems import wanted
from .scales import Range, is_log, share_of
from .stage import Stage, bounds_of

BOUNDARY = "boundary"
TRACKS = {"force": ("kN", "N"), BOUNDARY: ()}  # with the units of their axes
GAPS = ("yours", "true")
GAPS_OF_BOUNDARY = ("at", "yours", "true", "off")
CONTACTS = (2, 6)  # from which on a map has lines, and the most that it tells apart
OUT_OF_REACH = 1e6


class Criterion(NamedTuple):
    """`span`: whether it is of a stretch of time, else of an instant; `outcomes`: each has its sentence."""

    span: bool
    outcomes: tuple[str, ...]
    options: tuple[str, ...] = ()


OF_FORCE = {
    "falls": Criterion(True, ("yes", "no"), ("slack",)),
    "rises": Criterion(True, ("yes", "no"), ("slack",)),
    "jump": Criterion(False, ("yes", "early", "late", "small", "none"), ("within", "by")),
    "zero-from": Criterion(False, ("yes", "early", "late", "none"), ("within",)),
    "push": Criterion(True, ("yes", "none"), ("within", "above")),
    "zero-beyond": Criterion(False, ("yes", "no"), ("within", "slack")),
}
OF_BOUNDARY = {
    "falls": OF_FORCE["falls"],
    "rises": OF_FORCE["rises"],
    "near": Criterion(True, ("yes", "high", "low"), ("within",)),
}


def read_sketch(fields: Fields, stage: Stage, name: str, line: int) -> Part:
    """The chart, and its criteria in the order in which their sentences come."""
    if stage.kind != "axial":
        fields.reading.problems.add(line, "sketch-elsewhere", fence=f":::{{sketch}} {name}")
    track = fields.choice("track", TRACKS)
    if track == BOUNDARY:
        return _boundary(fields, stage, name, line)
    unit = fields.choice("unit", TRACKS[track], TRACKS[track][0])
    until: Time = fields.time("until", must=True) or 1.0
    axis = fields.interval("axis", -LARGEST, LARGEST, must=True) or (0.0, 1.0)
    given = fields.tried("given", _pair, None, False)
    return Sketch(
        name=name, line=line, track=track, unit=unit, until=until, axis=axis, given=given,
        judges=_judges(fields, OF_FORCE),
    )  # fmt: skip


def _boundary(fields: Fields, stage: Stage, name: str, line: int) -> Part:
    """Over the map of its step; places of the file are values of settings, and become shares of what is shown."""
    settings = (stage.map[1], stage.map[2]) if stage.map else ("", "")
    shown = {*settings} <= {*stage.mapped()}
    if not shown:
        fields.refuse("track", BOUNDARY, wanted("boundary"))
    bounds = [bounds_of(each) if shown else (-LARGEST, LARGEST) for each in settings]
    across = fields.interval("across", *bounds[0], must=True) or bounds[0]
    upwards = fields.interval("upwards", *bounds[1], must=True) or bounds[1]
    logs = is_log(bounds[0]), is_log(bounds[1])
    contacts = fields.tried("contacts", lambda key, value: whole_number(key, value, *CONTACTS), CONTACTS[0], True)
    given = fields.tried("given", _pair, None, False)
    if given:
        place, value = share_of(given[0], across, logs[0]), share_of(given[1], upwards, logs[1])
        if not (0.0 <= place <= 1.0 and 0.0 <= value <= 1.0):
            fields.refuse("given", [*given], wanted("given"))
        given = place, value
    judges = tuple(replace(each, at=_shares(each.at, across, logs[0])) for each in _judges(fields, OF_BOUNDARY, across))
    return Boundary(
        name=name, line=line, track=BOUNDARY, unit="", until=1.0, axis=(0.0, 1.0), given=given, judges=judges,
        contacts=contacts, settings=settings, ranges=(across, upwards), logs=logs,
    )  # fmt: skip


def _pair(key: str, value: Any) -> tuple[float, ...]:
    found = numbers(value, 2)
    if found is None:
        raise SceneError(key, value, wanted("pair"))
    return found


def _shares(at: Time | Span, across: Range, log: bool) -> Span:
    """Of a stretch between two values."""
    first, last = at if isinstance(at, tuple) else (at, at)
    return share_of(float(first), across, log), share_of(float(last), across, log)


def _judges(fields: Fields, criteria: dict[str, Criterion], across: Range | None = None) -> tuple[Judge, ...]:
    """`across`: between which values of a setting they are, None where they are in time."""
    found = [_judge(each, criteria, across) for each in fields.tables("judge", 1, 10)]
    return tuple(each for each in found if each)


def _judge(fields: Fields, criteria: dict[str, Criterion], across: Range | None) -> Judge | None:
    named = [each for each in criteria if each in fields.given]
    if len(named) != 1:
        example = f"near = [{across[0]:g}, {across[1]:g}]" if across else "jump = 1"
        fields.problem("", "one-criterion", value=", ".join(named) or "nothing", names=[*criteria], example=example)
        return None
    criterion = criteria[named[0]]
    at: Time | Span | None
    if across:
        at = fields.interval(named[0], *across, must=True) or across
    else:
        at = (fields.span if criterion.span else fields.time)(named[0], must=True)
    gaps: Sequence[str] = GAPS_OF_BOUNDARY if across else GAPS
    options = {name: fields.number(name, 0.0, OUT_OF_REACH, getattr(Judge, name)) for name in criterion.options}
    says = {outcome: fields.said(outcome, gaps) for outcome in criterion.outcomes}
    fields.close()
    return Judge(criterion=named[0], at=0.0 if at is None else at, says=says, line=fields.line(named[0]), **options)
