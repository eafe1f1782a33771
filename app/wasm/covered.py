"""Which scenes a browser answers by itself, by the kernels that it has: the only place that says so in Python.

The browser's own word on each answer is `covers` in `app/static/wasm/answers.js`, which also knows of which choices.
"""

from collections.abc import Callable, Mapping

from solvers import RigidMass, Rod, Scene, Waves


def covered(scene: Scene) -> bool:
    """Whether some kernel of the module answers this scene as it is."""
    return any(answers(scene) for answers in ANSWERED_BY.values())


def covered_of(scenes: Mapping[str, Scene]) -> list[str]:
    """Names of those that are."""
    return [name for name, scene in scenes.items() if covered(scene)]


def _by_waves(scene: Scene) -> bool:
    """A mass on one uniform rod at rest, fixed or free at its far end, by waves for as long as is usual."""
    target, method = scene.target, scene.method
    if not isinstance(scene.impactor, RigidMass) or not isinstance(target, Rod):
        return False
    plain = target.support in ("fixed", "free") and not target.end_mass and not target.velocity
    usual = method.get("name", Waves.NAME) == Waves.NAME and "duration" not in method
    return plain and usual and "height" not in scene.given.get("impactor", {})


ANSWERED_BY: dict[str, Callable[[Scene], bool]] = {  # by entry, as in `entries.ENTRIES`
    "rod": lambda scene: scene.rigid_contact and _by_waves(scene),
    "law": lambda scene: not scene.rigid_contact and _by_waves(scene),
}
