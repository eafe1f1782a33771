"""The method that a scene file names."""

from collections.abc import Mapping

from . import checks
from .auto import Auto
from .method import Method
from .methods import METHODS

CHOICES: dict[str, type[Method]] = METHODS | {Auto.NAME: Auto}


def read_method(given: Mapping[str, object], usual: str = "waves") -> tuple[Method, float | None]:
    """Method and duration [s] from the table `[method]` of a scene file; `usual` is the method if it names none.

    Raises SceneError naming the key.
    """
    given = dict(given)
    duration = given.pop("duration", None)
    name = checks.choice("method.name", given.pop("name", usual), CHOICES)
    return CHOICES[name].read(given), duration
