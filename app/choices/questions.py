"""A question of a visitor about an impact, beside its choices."""

from collections.abc import Callable
from typing import Any, NamedTuple


class Question(NamedTuple):
    """One bounded value that a view is asked; the views declare theirs, and the page makes its properties of them."""

    parameter: Any  # a param.Parameter, which as a descriptor no type checker reads as a field
    address: str = ""  # its key in the address, if it has one
    needs: tuple[str, Any] | None = None  # another question of the view, and the value with which this one holds
    sent: bool = True  # whether the view's work is asked it; else only the page acts on it
    leads: Callable[[dict[str, Any]], dict[str, Any]] | None = None  # work that answers it by choices to be set
    example: Any = None  # what `leads` can answer, where the default asks nothing
