"""The method that a scene file names, and solving by it."""

from collections.abc import Mapping

from . import checks
from .auto import Auto
from .checks import SceneError
from .method import Method
from .methods import METHODS
from .scene import Scene
from .solution import Solution

CHOICES: dict[str, type[Method]] = METHODS | {Auto.NAME: Auto}


def read_method(given: Mapping[str, object], usual: str = "waves") -> tuple[Method, float | None]:
    """Method and duration [s] from the table `[method]` of a scene file; `usual` is the method if it names none.

    Raises SceneError naming the key.
    """
    given = dict(given)
    duration = given.pop("duration", None)
    name = checks.choice("method.name", given.pop("name", usual), CHOICES)
    return CHOICES[name].read(given), duration


def solve(scene: Scene, method: str | Method | None = None, duration: float | None = None, **options) -> Solution:
    """Solve a scene by the method it names, or by another one.

    `options` are those of the method (`modes`, `steps`, `tolerance`). Duration in seconds; without one, until the
    bodies part for good. Raises SceneError for options that do not exist or are out of range, SceneNotSupported if the
    method cannot solve the scene.
    """
    table, usual = dict(scene.method), scene.usual_method
    if duration is None:
        duration = table.pop("duration", None)
    table.pop("duration", None)
    if isinstance(method, Method):
        if options:
            raise SceneError("method", options, "no options beside a method object; give them to the object")
        return method.solve(scene, duration)
    if method is not None and method != table.get("name", usual):
        table = {"name": method}
    chosen, _ = read_method(table | options, usual)
    return chosen.solve(scene, duration)
