"""A line that is drawn, and the criteria by which the page judges it."""

from typing import Any, NamedTuple

from solvers import SceneError

from .fields import LARGEST, Fields, numbers
from .lesson import Judge, Part, Sketch, Span, Time
from .problems import wanted
from .stage import Stage

TRACKS = {"force": ("kN", "N")}  # with the units of their axes
GAPS = ("yours", "true")
OUT_OF_REACH = 1e6


class Criterion(NamedTuple):
    """`span`: whether it is of a stretch of time, else of an instant; `outcomes`: each has its sentence."""

    span: bool
    outcomes: tuple[str, ...]
    options: tuple[str, ...] = ()


CRITERIA = {
    "falls": Criterion(True, ("yes", "no"), ("slack",)),
    "rises": Criterion(True, ("yes", "no"), ("slack",)),
    "jump": Criterion(False, ("yes", "early", "late", "small", "none"), ("within", "by")),
    "zero-from": Criterion(False, ("yes", "early", "late", "none"), ("within",)),
    "push": Criterion(True, ("yes", "none"), ("within", "above")),
    "zero-beyond": Criterion(False, ("yes", "no"), ("within", "slack")),
}


def read_sketch(fields: Fields, stage: Stage, name: str, line: int) -> Part:
    """The chart, and its criteria in the order in which their sentences come."""
    if stage.kind != "axial":
        fields.reading.problems.add(line, "sketch-elsewhere", fence=f":::{{sketch}} {name}")
    track = fields.choice("track", TRACKS)
    unit = fields.choice("unit", TRACKS[track], TRACKS[track][0])
    until: Time = fields.time("until", must=True) or 1.0
    axis = fields.interval("axis", -LARGEST, LARGEST, must=True) or (0.0, 1.0)
    given = fields.tried("given", _pair, None, False)
    judges = tuple(_judge(each) for each in fields.tables("judge", 1, 10))
    return Sketch(
        name=name, line=line, track=track, unit=unit, until=until, axis=axis, given=given,
        judges=tuple(each for each in judges if each),
    )  # fmt: skip


def _pair(key: str, value: Any) -> tuple[float, ...]:
    found = numbers(value, 2)
    if found is None:
        raise SceneError(key, value, wanted("pair"))
    return found


def _judge(fields: Fields) -> Judge | None:
    named = [each for each in CRITERIA if each in fields.given]
    if len(named) != 1:
        fields.problem("", "one-criterion", value=", ".join(named) or "nothing", names=[*CRITERIA])
        return None
    criterion = CRITERIA[named[0]]
    at: Time | Span | None = (fields.span if criterion.span else fields.time)(named[0], must=True)
    options = {name: fields.number(name, 0.0, OUT_OF_REACH, getattr(Judge, name)) for name in criterion.options}
    says = {outcome: fields.said(outcome, GAPS) for outcome in criterion.outcomes}
    fields.close()
    return Judge(criterion=named[0], at=0.0 if at is None else at, says=says, line=fields.line(named[0]), **options)
