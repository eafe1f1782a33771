"""The questions of lessons, each from the table of its fence."""

import math
from collections.abc import Callable
from typing import Any

from solvers import SceneError
from solvers.validation import choice, number

from .fields import LARGEST, Fields, numbers
from .figures import is_figure
from .figures import names as figure_names
from .formula import Formula, formula
from .lesson import Choice, Found, Goal, Item, Mistake, Number, Option, Order, Part, Set, Unsolved
from .problems import wanted
from .solving import COUNTED, QUANTITIES
from .stage import Stage, bounds_of, value_for
from .units import UNITS, alike

RELATIONS = ("=", "<", ">")
GAPS_OF_SET = ("start", "end", "peak", "value")
GAPS_OF_ORDER = ("right", "all")
MOST = 8  # options, mistakes


def read_choice(fields: Fields, stage: Stage, name: str, line: int) -> Part:
    """One right option at least."""
    tables = fields.tables("option", 2, MOST)
    options = []
    for each in tables:
        options.append(Option(text=each.said("text"), say=each.said("say"), right=each.flag("right")))
        each.close()
    if tables and not any(each.right for each in options):
        fields.reading.problems.add(line, "no-right")
    return Choice(name=name, line=line, options=tuple(options))


def read_number(fields: Fields, stage: Stage, name: str, line: int) -> Part:
    """An answer with its unit, and usual mistakes; either may be a formula, which is solved for later."""
    known = figure_names(stage.kind, stage.numeric())
    answer, asked = _answer(fields, known)
    all_units = [unit for units in UNITS for unit in units]
    unit = fields.tried("unit", lambda key, value: _unit(key, value, all_units), "1", True)
    units = fields.names("units", alike(unit)) or (unit,)
    within, share = fields.tried("within", _tolerance, (0.0, False), True)
    yes, no = fields.said("yes"), fields.said("no")
    tables = fields.tables("mistake", 0, MOST)
    mistakes, formulas = [], []
    for each in tables:
        mistake, wrong = _mistake(each, known)
        mistakes.append(mistake)
        formulas.append(wrong)
    solved = asked is not None or any(formulas)
    factors = tuple(alike(unit).get(each, 1.0) for each in units)
    lines = {"answer": fields.line("answer")} | {f"{each.key}.answer": each.line("answer") for each in tables}
    return Number(
        name=name, line=line, answer=answer, unit=unit, units=units, factors=factors, yes=yes, no=no,
        tolerance=within * abs(answer or 0.0) if share else within, mistakes=tuple(mistakes), lines=lines,
        unsolved=Unsolved(asked, within if share else None, tuple(formulas)) if solved else None,
    )  # fmt: skip


def _answer(fields: Fields, known: list[str]) -> tuple[float | None, Formula | None]:
    """A number, or a formula of figures."""
    if not isinstance(fields.given.get("answer"), str):
        return fields.number("answer", -LARGEST, LARGEST), None
    return None, fields.tried("answer", lambda key, value: _formula(key, value, known), None, True)


def _formula(key: str, value: str, known: list[str]) -> Formula:
    try:
        found = formula(value)
    except ValueError:
        raise SceneError(key, value, wanted("formula", example="{impulse} / 2")) from None
    if not found.figures or not all(is_figure(each, known) for each in found.figures):
        raise SceneError(key, value, wanted("figures", names=known, example="{touch-2}"))
    return found


def _unit(key: str, value: Any, known: list[str]) -> str:
    if not isinstance(value, str) or value not in known:
        raise SceneError(key, value, wanted("unit", names=known))
    return value


def _tolerance(key: str, value: Any) -> tuple[float, bool]:
    """In the unit of the answer, or as a share of it."""
    if not isinstance(value, str):
        try:
            return number(key, value, 0.0, LARGEST), False
        except SceneError:
            raise SceneError(key, value, wanted("part")) from None
    share = value.removesuffix("%").strip()
    try:
        part = float(share) if value.endswith("%") else math.nan
    except ValueError:
        part = math.nan
    if not 0.0 < part <= 100.0:
        raise SceneError(key, value, wanted("part"))
    return 0.01 * part, True


def _mistake(fields: Fields, known: list[str]) -> tuple[Mistake, Formula | None]:
    given = [each for each in ("answer", "numbers", "power-of-ten") if each in fields.given]
    if len(given) != 1:
        fields.problem("say", "mistake-of", value=", ".join(given) or "nothing")
    answer, asked = _answer(fields, known) if "answer" in given else (None, None)
    digits = fields.tried("numbers", _numbers, (), False)
    found = Mistake(say=fields.said("say"), answer=answer, numbers=digits, power_of_ten=fields.flag("power-of-ten"))
    fields.close()
    return found, asked


def _numbers(key: str, value: Any) -> tuple[float, ...]:
    found = numbers(value)
    if not found:
        raise SceneError(key, value, wanted("numbers"))
    return found


def read_order(fields: Fields, stage: Stage, name: str, line: int) -> Part:
    """Items in their right order."""
    yes, no = fields.said("yes", GAPS_OF_ORDER), fields.said("no", GAPS_OF_ORDER)
    items, last = [], -math.inf
    for each in fields.tables("item", 2, 12):
        items.append(Item(text=each.said("text"), at=each.time("at"), line=each.line("at")))
        now = items[-1].at
        if isinstance(now, float):
            if now <= last:
                each.problem("at", "times-fall", value=now)
            last = now
        each.close()
    return Order(name=name, line=line, items=tuple(items), yes=yes, no=no)


def read_set(fields: Fields, stage: Stage, name: str, line: int) -> Part:
    """A slider from `start` on, and what is said where the goal is met."""
    slider = stage.slider(fields, "slider")
    low, high = bounds_of(slider) if slider else (-LARGEST, LARGEST)
    span = fields.interval("range", low, high) or (low, high)
    start = value_for(fields, "start", slider) if slider else fields.number("start")
    if slider:
        stage.changes[slider] = start
    known = [*QUANTITIES[stage.kind]]
    goal = fields.tried("goal", lambda key, value: _goal(key, value, known), Goal(known[0], "=", 1.0), True)
    not_yet, more = fields.said("not-yet", GAPS_OF_SET), fields.sentence("more", must=False)
    whole, found = fields.sentence("all", must=False), []
    lines = {name: fields.line(name) for name in ("start", "goal")}
    for each in fields.tables("found", 1, MOST):
        found.append(Found(say=each.said("say"), range=each.interval("range", *span), line=each.line("range")))
        each.close()
    return Set(
        name=name, line=line, slider=slider or "", range=span, start=start, goal=goal,
        not_yet=not_yet, more=more, all=whole, found=tuple(found), lines=lines,
    )  # fmt: skip


def _goal(key: str, value: Any, known: list[str]) -> Goal:
    words = value.split() if isinstance(value, str) else []
    if len(words) == 3:
        quantity, relation, written = words
        try:
            choice(key, quantity, known)
            choice(key, relation, RELATIONS if quantity in COUNTED else RELATIONS[1:])  # never exactly met else
            return Goal(quantity, relation, number(key, float(written), -LARGEST, LARGEST))
        except ValueError:
            pass
    raise SceneError(key, value, wanted("goal", quantities=known))


Reader = Callable[[Fields, Stage, str, int], Part]
