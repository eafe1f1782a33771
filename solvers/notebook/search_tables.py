"""What a search for the best values has found, to read."""

import math
from typing import Any

from .contour_tables import warned
from .words import named, shown, text


def optimum(found: Any) -> str:
    """The best values, what they give, and what they end at."""
    lines = [found.title or text("report.scene"), "  " + _asked(found)]
    said = [(key, found.units[key], value) for key, value in (found.values or {}).items()]
    said += [(name, found.units[name], value) for name, value in found.figures.items()]
    names = [f"{name} [{unit}]" if unit else name for name, unit, _ in said]
    wide = max(map(len, names))
    lines += [""] if found.values is not None else ["", "  " + text("optimum.none")]
    lines += [f"  {name:{wide}}  {_value(value):>14}" for name, (_, _, value) in zip(names, said, strict=True)]
    lines += ["", "  " + text("optimum.decides", what=", ".join(found.deciding))] if found.deciding else []
    return "\n".join([*lines, "", *("  " + text("report.note", note=note) for note in found.notes)])


def pareto(found: Any) -> str:
    """A line for each compromise, with its values and figures."""
    limits = ", ".join(str(limit) for limit in found.limits) or "none"
    one, other = (
        text("pareto.goal", goal=named("quantity", figure), largest="true" if which == "largest" else "false")
        for figure, which in found.goals.items()
    )
    lines = [found.title or text("report.scene"), "  " + text("pareto.asked", one=one, other=other, limits=limits)]
    if found.points:
        rows = [[*point.values.values(), *point.figures.values()] for point in found.points]
        names = [*found.points[0].values, *found.points[0].figures]
        heads = [f"{name} [{found.units[name]}]" if found.units[name] else name for name in names]
        table = [heads, *([_value(value) for value in row] for row in rows)]
        widths = [max(map(len, column)) for column in zip(*table, strict=True)]
        cells = (zip(row, widths, strict=True) for row in table)
        lines += ["", *("  " + "  ".join(cell.rjust(width) for cell, width in row) for row in cells)]
    else:
        lines += ["", "  " + text("pareto.none")]
    lines += ["", *("  " + each for each in warned(found.warnings, "pareto.noted"))] if found.warnings else []
    return "\n".join([*lines, "", *("  " + text("report.note", note=note) for note in found.notes)])


def _asked(found: Any) -> str:
    limits = ", ".join(str(limit) for limit in found.limits)
    goal = named("quantity", found.goal)
    return text("optimum.asked", goal=goal, largest="true" if found.largest else "false", limits=limits or "none")


def _value(value: Any) -> str:
    if isinstance(value, float) and math.isnan(value):
        return "-"
    return shown(value, ".8g") if isinstance(value, float) else str(value)
