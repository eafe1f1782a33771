"""The method that a scene file names, or the one for such scenes if it names none."""

from collections.abc import Mapping

from . import checks
from .auto import Auto
from .method import Method
from .methods import METHODS, usual_method
from .scene import Scene

CHOICES: dict[str, type[Method]] = METHODS | {Auto.NAME: Auto}


def read_method(given: Mapping[str, object], scene: Scene | None = None) -> tuple[Method, float | None]:
    """Method and duration [s] from the table `[method]` of a scene file; if it names none, the scene's usual method.

    Raises SceneError naming the key; SceneNotSupported if nothing is named and no method can solve the scene.
    """
    given = dict(given)
    duration = given.pop("duration", None)
    name = given.pop("name", None)
    if name is None and scene is not None:
        name = usual_method(scene)
    return CHOICES[checks.choice("method.name", name, CHOICES)].read(given), duration
