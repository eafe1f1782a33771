"""What a visitor has chosen: bounded values, no widget. The same bounds guard sliders, address and socket."""

import re
from dataclasses import fields
from functools import cache
from typing import Any

import numpy as np
import param

import solvers
from solvers import LAWS, METHODS, Scene, SceneError
from solvers.bodies.beams import LARGEST_DAMPING, SUPPORTS, THEORIES
from solvers.contact.constants import STIFFNESS_RANGE
from solvers.contact.viscous import LEAST_RESTITUTION

from .beam_choices import BEAM_CHOICES, free_place, on_beam, other_beam
from .space import has_length, struck_at, struck_place

SCENES = {name: solvers.load(name) for name in solvers.scene_names()}
START = next(iter(SCENES))
LONGEST_TEXT = 80  # of a value in an address
DEPTH = 1e-5  # [m] at which `force_at_depth` tells how stiff a power law is: its stiffness has no unit of its own


class Choices(param.Parameterized):
    """Everything that can be set on the page. SI units; a value out of bounds raises ValueError."""

    scene = param.Selector(default=START, objects=list(SCENES))
    method = param.Selector(default="waves", objects=list(METHODS))
    mass_ratio = param.Number(default=1.0, bounds=(1e-3, 1e3))  # target / impactor
    speed = param.Number(default=1.0, bounds=(1e-2, 1e2))  # of approach [m/s]
    law = param.Selector(default="rigid", objects=list(LAWS))
    linear_stiffness = param.Number(default=1.3e10, bounds=(1e5, 1e14))  # [N/m]
    hertz_stiffness = param.Number(default=1e10, bounds=(1e6, 1e14))  # [N/m^1.5]
    force_at_depth = param.Number(default=1e4, bounds=(1e-1, 1e9))  # [N], of laws with an exponent of their own
    exponent = param.Number(default=1.5, bounds=(1.0, 3.0))
    yield_indentation = param.Number(default=1e-6, bounds=(1e-9, 1e-2))  # [m]
    restitution = param.Number(default=0.8, bounds=(0.0, 1.0))
    modes = param.Integer(default=50, bounds=(1, 200))
    elements = param.Integer(default=50, bounds=(1, 200))
    place = param.Number(default=1.0, bounds=(0.0, 1.0))  # where along a beam, or a rod in space, the blow falls
    support = param.Selector(default=SUPPORTS[0], objects=list(SUPPORTS))  # of a beam
    theory = param.Selector(default=THEORIES[0], objects=list(THEORIES))
    slenderness = param.Number(default=10.0, bounds=(1.0, 1e3))  # length of a beam over its depth
    damping = param.Number(default=0.0, bounds=(0.0, LARGEST_DAMPING))  # of every mode of a beam, of the critical

    CHOSEN = (
        "scene",
        "method",
        "mass_ratio",
        "speed",
        "law",
        "linear_stiffness",
        "hertz_stiffness",
        "force_at_depth",
        "exponent",
        "yield_indentation",
        "restitution",
        "modes",
        "elements",
        "place",
        "support",
        "theory",
        "slenderness",
        "damping",
    )

    def chosen(self) -> dict[str, Any]:
        """All values by name, as one consistent set that a worker thread can keep."""
        return {name: getattr(self, name) for name in self.CHOSEN}

    @staticmethod
    def of_scene(name: str) -> dict[str, Any]:
        """The values that a built-in scene asks for, each within its bounds."""
        return dict(_own_values(name))


@cache
def _own_values(name: str) -> dict[str, Any]:
    scene = SCENES[name]
    wanted: dict[str, Any] = {"speed": scene.speed}
    if in_space(scene):
        wanted["place"] = struck_place(scene)
    elif np.isfinite(scene.mass_ratio):
        wanted["mass_ratio"] = float(f"{scene.mass_ratio:.12g}")
    method = dict(scene.method)
    wanted |= {option: method[option] for option in ("restitution", "modes", "elements") if option in method}
    wanted["method"] = method.get("name") or solvers.usual_method(scene)
    if on_beam(scene):
        wanted |= {name: read(scene.target) for name, read in BEAM_CHOICES.items()}
    if not in_space(scene):
        wanted |= {"law": scene.contact.NAME} | _constants(scene)
    return {name: value for name, value in wanted.items() if accepts(name, value)}


def in_space(scene: Scene) -> bool:
    """Whether the bodies are not on one axis but in space."""
    return scene.normal is not None


def _constants(scene: Scene) -> dict[str, Any]:
    """What the sliders of the contact laws show for a scene."""
    law, found = scene.contact, {}
    stiffness = getattr(scene.target, "stiffness", None)
    if stiffness is not None:
        found["linear_stiffness"] = _rounded(20.0 * stiffness)
    table = law.table(scene.speed)
    if "stiffness" in table:
        name = STIFFNESS.get(law.NAME, "hertz_stiffness")
        found[name] = table["stiffness"]
        if name == "force_at_depth":
            found[name] *= DEPTH ** table.get("exponent", 1.5)
    for name in ("exponent", "yield_indentation", "restitution"):
        if name in table:
            found[name] = table[name]
    return found


STIFFNESS = {"linear": "linear_stiffness", "kelvin-voigt": "linear_stiffness"} | {
    law: "force_at_depth" for law in LAWS if "exponent" in LAWS[law].KEYS
}


def law_choices(law: str) -> list[str]:
    """The choices that set the constants of a contact law."""
    keys = LAWS[law].KEYS
    names = [STIFFNESS.get(law, "hertz_stiffness")] if "stiffness" in keys else []
    return names + [name for name in ("exponent", "yield_indentation") if name in keys]


def acting_choices(chosen: dict[str, Any]) -> list[str]:
    """The choices that change anything in the chosen scene."""
    base = SCENES[chosen["scene"]]
    if in_space(base):
        return ["scene", "speed", "restitution"] + (["place"] if has_length(base) else [])
    if base.impactor.kind == "pulse":
        return ["scene"]
    names = ["scene", "method", "speed", "law", *law_choices(chosen["law"])]
    if on_beam(base):
        names += BEAM_CHOICES
    if not on_beam(base) or "restitution" in LAWS[chosen["law"]].KEYS or chosen["method"] in ("balance", "rigid"):
        names.append("restitution")
    if base.impactor.kind in ("mass", "sphere") and np.isfinite(base.mass_ratio):
        names.append("mass_ratio")
    shown = "modal" if chosen["method"] == "waves" else chosen["method"]
    return names + resolutions(base, shown)


def own_options(scene: Scene, method: str) -> dict[str, Any]:
    """What the scene itself says on how this method is to solve it."""
    if scene.method.get("name") != method:
        return {}
    return {option: value for option, value in scene.method.items() if option not in ("name", "duration")}


def resolutions(scene: Scene, method: str) -> list[str]:
    """Which of modes and elements the method takes; where the scene gives any of them, those only.

    Of a beam what makes the method finer: it keeps so few modes of its elements that their number need not be set.
    """
    known, own = {option.name for option in fields(METHODS[method])}, own_options(scene, method)
    if on_beam(scene) and not own:
        known &= set(METHODS[method].KNOBS)
    found = [name for name in ("modes", "elements") if name in known]
    return [name for name in found if name in own] or found


def _rounded(value: float) -> float:
    return float(f"{value:.2g}")


def contact_table(chosen: dict[str, Any]) -> dict[str, Any]:
    """The table `[contact]` that these choices describe."""
    law = chosen["law"]
    keys, table = LAWS[law].KEYS, {"law": law}
    for name in ("exponent", "yield_indentation"):
        if name in keys:
            table[name] = chosen[name]
    if "stiffness" in keys:
        name = STIFFNESS.get(law, "hertz_stiffness")
        table["stiffness"] = chosen[name]
        if name == "force_at_depth":
            table["stiffness"] = min(table["stiffness"] / DEPTH ** chosen["exponent"], STIFFNESS_RANGE[1])
    if "restitution" in keys:
        table["restitution"] = max(chosen["restitution"], LEAST_RESTITUTION)
    return table


def chosen_scene(chosen: dict[str, Any]) -> Scene:
    """The scene that these choices describe."""
    base = SCENES[chosen["scene"]]
    if in_space(base):
        faster = chosen["speed"] / base.speed
        scene = base.replace(
            {
                f"{name}.{key}": [faster * v for v in getattr(getattr(base, name), key)]
                for name in ("impactor", "target")
                for key in ("velocity", "spin")
                if hasattr(getattr(base, name), "spin")
            }
        )
        return struck_at(scene, chosen["place"]) if has_length(base) else scene
    if base.impactor.kind == "pulse":
        return base
    changes: dict[str, Any] = {"impactor.velocity": chosen["speed"]}
    if base.target.velocity:
        faster = chosen["speed"] / base.speed
        changes = {f"{name}.velocity": faster * getattr(base, name).velocity for name in ("impactor", "target")}
    own = Choices.of_scene(chosen["scene"])
    if on_beam(base):
        base = other_beam(
            base, {name: chosen[name] for name in BEAM_CHOICES if chosen[name] != own.get(name, chosen[name])}
        )
    if "mass_ratio" in acting_choices(chosen):
        changes["impactor.mass"] = base.target.mass / chosen["mass_ratio"]
    if any(chosen[name] != own.get(name, chosen[name]) for name in ("law", "restitution", *law_choices(chosen["law"]))):
        changes["contact"] = contact_table(chosen)  # else as the scene says, with all that the sliders do not show
    return base.replace(changes)


_TRIAL = Choices()


def accepts(name: str, value: object) -> bool:
    """Whether a choice may have this value."""
    if isinstance(value, bool):  # which Python counts among the numbers
        return False
    try:
        _TRIAL.param.update(**{name: value})
    except (ValueError, TypeError, OverflowError):
        return False
    return True


def from_address(arguments: dict[str, list[bytes]]) -> tuple[dict[str, Any], list[str]]:
    """Choices from the query of an address: what can be used, and a sentence for each that cannot.

    A scene in the address brings its own values; the others then change them.
    """
    kept: dict[str, Any] = {}
    refused = []
    for name in (name for name in Choices.CHOSEN if name in arguments):
        text = text_of(arguments[name])
        value = value_of(Choices.param[name], text)
        if not accepts(name, value):
            refused.append(refusal(name, told_of(text, value)))
            continue
        if name == "scene":
            kept |= Choices.of_scene(value)
        kept[name] = value
    if "support" in arguments and "place" not in arguments and "support" in kept and "place" in kept:
        kept["place"] = free_place(kept["support"], kept["place"])
    return kept, refused


def text_of(given: list[bytes]) -> str:
    """What an address says of one key, the last if it says it twice."""
    return given[-1].decode("utf-8", "replace")[:LONGEST_TEXT]


def value_of(parameter: param.Parameter, text: str) -> object:
    """What the text means to a parameter; the text itself, which it will not accept, where it means nothing."""
    if isinstance(parameter, param.Boolean):
        return {"true": True, "false": False}.get(text, text)
    try:
        if isinstance(parameter, param.Integer):
            return int(text)
        return float(text) if isinstance(parameter, param.Number) else text
    except ValueError:
        return text


def told_of(text: str, value: object) -> object:
    """What may be shown of a value from an address: nothing that could be more than a word or a number."""
    return value if re.fullmatch(r"[\w.+-]{1,24}", text) else "text"


def refusal(name: str, value: object, of: type[param.Parameterized] = Choices, key: str | None = None) -> str:
    """One sentence: the key, if it is not called like the parameter, the value and what is allowed."""
    parameter = of.param[name]
    if name == "scene":
        allowed = f"one of the {len(SCENES)} scenes of the picker, as {START}"
    elif isinstance(parameter, param.Selector):
        allowed = ", ".join(parameter.objects)
    elif isinstance(parameter, param.Boolean):
        allowed = "true, false"
    elif isinstance(parameter, param.String):
        allowed = "numbers"
    else:
        kind = "a whole number" if isinstance(parameter, param.Integer) else "a number"
        allowed = f"{kind} from {parameter.bounds[0]:g} to {parameter.bounds[1]:g}"
    return str(SceneError(key or name, value, allowed))
