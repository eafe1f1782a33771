"""What is printed of results, by the codes below `printed` in `solvers/text/*/`."""

import math
from collections.abc import Sequence
from typing import Any

from ..text.catalogue import library, spoken
from ..text.messages import written


def text(code: str, /, **values: Any) -> str:
    """A sentence, or a name."""
    return library(spoken()).text(f"printed.{code}", **values)


def named(family: str, key: str) -> str:
    """What a key of a result is called; the key itself in words where it has no name."""
    return library(spoken()).texts.get(f"printed.{family}.{key}", key.replace("_", " "))


def family(code: str) -> dict[str, str]:
    """All names below a code, such as the heads of a table."""
    return library(spoken()).family(f"printed.{code}")


def shown(value: Any, form: str) -> str:
    """A number in this form, a word as it is, a dash for what does not exist."""
    if value is None:
        return "-"
    return value if isinstance(value, str) else written(value, form, spoken())


def existing(value: float, form: str) -> str:
    """A number in this form, a dash for one that does not exist."""
    return "-" if math.isnan(value) else shown(value + 0.0, form)


def vector(values: Sequence[float], form: str = ".6g") -> str:
    """Numbers in brackets."""
    return f"({listed([shown(float(value) + 0.0, form) for value in values])})"


def listed(parts: Sequence[str]) -> str:
    """Numbers as written; where a comma stands in one, semicolons are between them."""
    return ("; " if any("," in part for part in parts) else ", ").join(parts)
