"""What a search for the best values has found, to read."""

import math
from typing import Any

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


def _asked(found: Any) -> str:
    limits = ", ".join(str(limit) for limit in found.limits)
    goal = named("quantity", found.goal)
    return text("optimum.asked", goal=goal, largest="true" if found.largest else "false", limits=limits or "none")


def _value(value: Any) -> str:
    if isinstance(value, float) and math.isnan(value):
        return "-"
    return shown(value, ".8g" if isinstance(value, float) else "")
