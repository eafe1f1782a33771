"""One value of a body typed by the visitor, as choices: what must change for it, all else of the bodies staying."""

from typing import Any

from solvers import Bending, Scene

from ..text.refusals import Refused
from .bodies import SAME, Values, parts_of, read_value, read_values, split, title_of_value, written
from .built_in import base_of, body_keys
from .choices import SCENES, Choices, accepts, title_of
from .scene_of import acting_choices, choices_of, chosen_scene

DEPTH = ("section.height", "section.radius")  # of a beam


def with_body_value(asked: dict[str, Any]) -> dict[str, Any]:
    """The choices that change where `body_value` is "KEY=VALUE" in SI units, or "KEY" to go back to that of the scene.

    A key without a quantity, "impactor", is that of all values of the body. Raises ValueError, for the
    visitor.
    """
    chosen = {name: asked[name] for name in Choices.CHOSEN}
    key, _, text = asked["body_value"].partition("=")
    scene = chosen["scene"]
    keys = [key] if key in body_keys(scene) else [each for each in body_keys(scene) if each.startswith(f"{key}.")]
    if not keys or (text and keys != [key]):
        raise Refused("refused.no-such-value", value=title_of_value(key))
    wanted: dict[str, Any] = {}
    for each in sorted(
        keys, key=lambda each: _slider_of(chosen, each) is not None
    ):  # the mass may follow from the rest
        value = read_value(each, text) if text else None
        wanted |= _one_changed(chosen | wanted, each, value)
    return wanted


def _one_changed(chosen: dict[str, Any], key: str, value: float | str | None) -> dict[str, Any]:
    """`value` None: as the scene has it."""
    now, own = chosen_scene(chosen), _own_value(chosen["scene"], key)
    values = read_values(chosen["bodies"])
    slider = _slider_of(chosen, key)
    if value is None and slider:
        value = own
    size = value if slider and isinstance(value, float) else 0.0  # what a slider is to follow
    if not slider:
        _keep(values, key, value, own)
    wanted: dict[str, Any] = {"bodies": written(values)}
    before, after = (choices_of(chosen["scene"], text) for text in (chosen["bodies"], wanted["bodies"]))
    wanted |= {name: each for name, each in after.items() if chosen[name] == before.get(name)}
    if "slenderness" in acting_choices(chosen) and (slider == "slenderness" or split(key)[1] in DEPTH):
        length = size if slider == "slenderness" else now.target.length
        depth = 2.0 * base_of(chosen["scene"], wanted["bodies"]).target.known_as(Bending).half_depth
        wanted["slenderness"] = _snapped("slenderness", length / depth, after)
    if "mass_ratio" in acting_choices(chosen):
        mass = size if slider == "mass_ratio" else _kept_mass(chosen, wanted["bodies"], now)
        wanted["mass_ratio"] = _snapped("mass_ratio", chosen_scene(chosen | wanted).target.mass / mass, after)
    chosen_scene(chosen | wanted)  # raises SceneError where the bodies do not go together
    return {name: each for name, each in wanted.items() if each != chosen[name]}


def _slider_of(chosen: dict[str, Any], key: str) -> str | None:
    """The choice that alone sets this value, if there is one."""
    name = {"impactor.mass": "mass_ratio", "target.length": "slenderness"}.get(key)
    return name if name in acting_choices(chosen) else None


def _own_value(scene: str, key: str) -> Any:
    name, quantity = split(key)
    return next(part for part in parts_of(SCENES[scene]) if part.key == name).value(quantity)


def _keep(values: Values, key: str, value: Any, own: Any) -> None:
    """Only what differs from the scene is kept; another material brings all its constants."""
    name, quantity = split(key)
    if quantity == "material":
        for each in [each for each in values if each.startswith(f"{name}.material.")]:
            del values[each]
    values.pop(key, None)
    of_other_material = quantity.startswith("material.") and f"{name}.material" in values
    if value is not None and (value != own or of_other_material):
        values[key] = value


def _kept_mass(chosen: dict[str, Any], bodies: str, now: Scene) -> float:
    """Of the striker [kg]: as it is, unless it follows from what was changed, as that of a ball from its radius."""
    before, after = (base_of(chosen["scene"], text).impactor.mass for text in (chosen["bodies"], bodies))
    return now.impactor.mass * (after / before)


def _snapped(name: str, value: float, own: dict[str, Any]) -> float:
    """The value of a slider; the scene's own where it is that but for rounding. Raises ValueError out of its bounds."""
    if name in own and abs(value - own[name]) <= SAME * own[name]:
        return own[name]
    if not accepts(name, value):
        low, high = Choices.param[name].bounds
        raise Refused("refused.slider-beyond", control=title_of(name), value=value, low=low, high=high)
    return float(f"{value:.12g}")
