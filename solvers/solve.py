"""The method that a scene file names, or the one for such scenes if it names none, and solving by it."""

from collections.abc import Mapping
from typing import Any

from . import validation
from .accuracy.auto import Auto
from .bodies import Mechanism
from .methods import METHODS, Modal, usual_method
from .methods.base import Method
from .methods.multibody.method import Multibody
from .scene import Scene
from .scenes.library import SceneOrName, scene_of
from .solution.solution import Solution
from .validation import SceneError, allowed

CHOICES: dict[str, type[Method]] = {**METHODS, Auto.NAME: Auto, Multibody.NAME: Multibody}


def read_method(given: Mapping[str, Any], scene: SceneOrName | None = None) -> tuple[Method, float | None]:
    """Method and duration [s] from the table `[method]` of a scene file; if it names none, the scene's usual method.

    Raises SceneError naming the key; SceneNotSupported if nothing is named and no method can solve the scene.
    """
    given, scene = dict(given), None if scene is None else scene_of(scene)
    duration = given.pop("duration", None)
    name = given.pop("name", None)
    if name is None and scene is not None:
        name = usual_method(scene)
    if name == Modal.NAME and scene is not None and isinstance(scene.struck.target, Mechanism):
        given.setdefault("modes", max(Modal.modes, scene.struck.target.most_modes))
    return CHOICES[validation.choice("method.name", name, CHOICES)].read(given), duration


def solve(
    scene: SceneOrName, method: str | Method | None = None, duration: float | None = None, **options: Any
) -> Solution:
    """Solve a scene by the method it names, by `usual_method` if it names none, or by another one.

    `options` are those of the method (`modes`, `steps`, `tolerance`). Duration in seconds; without one, until the
    bodies part for good. Raises SceneError for options that do not exist or are out of range, SceneNotSupported if the
    method cannot solve the scene.
    """
    scene = scene_of(scene)
    chosen, usual = chosen_method(scene, method, **options)
    return chosen.solve_in_full(scene, usual if duration is None else duration)


def chosen_method(scene: Scene, method: str | Method | None = None, **options: Any) -> tuple[Method, float | None]:
    """By which `solve` solves a scene, and the duration [s] that the scene names. Raises SceneError as it does."""
    table = dict(scene.method)
    duration = table.pop("duration", None)
    if isinstance(method, Method):
        if options:
            raise SceneError("method", options, allowed("options-of-object"))
        return method, duration
    if method is not None and method != (table.get("name") or usual_method(scene)):
        table = {"name": method}
    return read_method(table | options, scene)[0], duration
