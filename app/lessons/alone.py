"""Which lessons a browser runs without a server: those whose scenes its kernels answer, with all that is changed."""

from typing import Any

from ..choices.choices import SCENES
from ..choices.laws import STIFFNESS
from ..choices.request import Request
from ..choices.scene_of import own_choices
from ..wasm.covered import covered
from .lesson import Lesson, Scene, Set, Step
from .showing import CHARTS, PLAIN

FOLLOWED = {
    "mass_ratio",
    "restitution",
    "speed",
    "law",
    *STIFFNESS.values(),
}  # of choices, those that some kernel follows
SHOWN = {*PLAIN, "forces", *CHARTS["axial"]}  # of what stands below the picture: analyses are solved by a server


def runs_alone(lesson: Lesson) -> bool:
    """Whether each step does, beside what stands beside it, and to both ends of its slider."""
    return all(_runs(step) for step in lesson.steps)


def _runs(step: Step) -> bool:
    scenes = [part for part in step.parts if isinstance(part, Scene)]
    if not all(SHOWN.issuperset(part.show or ()) for part in scenes):
        return False
    changes: list[dict[str, Any]] = [{}, *(part.beside for part in scenes)]
    changes += [{part.slider: end} for part in step.parts if isinstance(part, Set) for end in part.range]
    sliders = {name for part in scenes for name in part.sliders}
    return sliders <= FOLLOWED and all(_answered(step.scene, step.choices | each) for each in changes)


def _answered(scene: str, choices: dict[str, Any]) -> bool:
    """From the scene as it opens: its kernel must answer it then, too."""
    if not FOLLOWED.issuperset(choices) or not covered(SCENES[scene]):
        return False
    return covered(Request.of(own_choices(scene) | choices).scene)
