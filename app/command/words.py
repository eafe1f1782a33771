"""What the command says, by the codes of `app/text/*/command/`."""

from typing import Any

from solvers.text.catalogue import spoken
from solvers.text.messages import written

from ..text.catalogues import command


def text(code: str, /, **values: Any) -> str:
    """A sentence, or a name."""
    return command(spoken()).text(code, **values)


def named(family: str, key: str) -> str:
    """What a key of a result is called; the key itself in words where it has no name."""
    return command(spoken()).texts.get(f"{family}.{key}", key.replace("_", " "))


def figure(value: float, form: str) -> str:
    """A number as a cell of a table."""
    return written(value, form, spoken())


def family(code: str) -> dict[str, str]:
    """All names below a code, such as the heads of a table."""
    return command(spoken()).family(code)
