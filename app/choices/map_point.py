"""A point of the map of regimes as choices: what the sliders must say for the scene to lie there."""

import math
from typing import Any

from solvers import LAWS, Scene
from solvers.regimes.models import contact_duration, family_of
from solvers.regimes.plan import law_of
from solvers.validation import shown

from ..text.refusals import Refused
from .choices import Choices, within
from .laws import STIFFNESS
from .scene_of import acting_choices, chosen_scene

SHOWN_DIGITS = 4  # of what the sliders are set to
STIFFNESS_TOLERANCE = 1e-4  # of a stiffness, in logarithms


def choices_at(asked: dict[str, Any]) -> dict[str, Any]:
    """The choices that change for the scene to lie at `map_point`, or as near to it as the sliders reach.

    `map_point`: contact time of two rigid bodies over the time unit of the map, 0 for a rigid contact, and mass ratio,
    as "0.3 2.5". A rigid contact gets the law of the map. Raises ValueError for another text, and for scenes that lie
    on no map.
    """
    time, ratio = _read(asked["map_point"])
    chosen = {name: asked[name] for name in Choices.CHOSEN}
    scene = chosen_scene(chosen)
    if family_of(scene) is None:
        raise _refused(asked["map_point"], "wanted.on-a-map")
    wanted = {}
    if "mass_ratio" in acting_choices(chosen):
        wanted["mass_ratio"] = _within("mass_ratio", ratio)
    if time == 0.0:
        return wanted | {"law": "rigid"}
    law = chosen["law"] if "stiffness" in LAWS[chosen["law"]].KEYS else law_of(scene)
    wanted["law"], name = law, STIFFNESS[law]
    return wanted | {name: _stiffness(chosen | wanted, name, time * scene.time_unit)}


def _read(text: str) -> tuple[float, float]:
    try:
        time, ratio = map(float, text.split())
    except ValueError:
        time = ratio = math.nan
    if not (0.0 <= time < math.inf and 0.0 < ratio < math.inf):
        raise _refused(text, "wanted.map-point")
    return time, ratio


def _refused(text: str, allowed: str) -> Refused:
    return Refused("refused.value", key="question.map_point", value=shown(text), allowed=allowed)


def _stiffness(chosen: dict[str, Any], name: str, duration: float) -> float:
    """Value of the slider with which two rigid bodies touch for so long [s]; the stiffer, the shorter."""
    from scipy.optimize import brentq

    def too_long(logarithm: float) -> float:
        return math.log(contact_duration(_with(chosen, name, math.exp(logarithm))) / duration)

    ends = [math.log(bound) for bound in Choices.param[name].bounds]
    if too_long(ends[0]) <= 0.0:
        return _within(name, math.exp(ends[0]))
    if too_long(ends[1]) >= 0.0:
        return _within(name, math.exp(ends[1]))
    return _within(name, math.exp(brentq(too_long, *ends, xtol=STIFFNESS_TOLERANCE)))


def _with(chosen: dict[str, Any], name: str, value: float) -> Scene:
    return chosen_scene(chosen | {name: _within(name, value, 17)})


def _within(name: str, value: float, digits: int = SHOWN_DIGITS) -> float:
    return within(name, float(f"{value:.{digits}g}"))
