"""What a visitor has chosen: bounded values, no widget. The same bounds guard sliders, address and socket."""

import re
from typing import Any

import param

import solvers
from solvers import METHODS, Scene, SceneError
from solvers.contact.viscous import LEAST_RESTITUTION

SHOWN = ("waves", "modal")  # the methods that the page compares
LAWS = ("rigid", "linear", "hertz", "hunt-crossley")  # those that it knows how to set
SCENES = {
    name: scene
    for name, scene in ((name, solvers.load(name)) for name in solvers.scene_names())
    if not any(METHODS[method]().refusal(scene) for method in SHOWN)
}
START = next(iter(SCENES))


class Choices(param.Parameterized):
    """Everything that can be set on the page. SI units; a value out of bounds raises ValueError."""

    scene = param.Selector(default=START, objects=list(SCENES))
    method = param.Selector(default="waves", objects=list(SHOWN))
    mass_ratio = param.Number(default=1.0, bounds=(1e-3, 1e3))  # target / impactor
    speed = param.Number(default=1.0, bounds=(1e-2, 1e2))  # [m/s]
    law = param.Selector(default="rigid", objects=list(LAWS))
    linear_stiffness = param.Number(default=1.3e10, bounds=(1e5, 1e14))  # [N/m]
    hertz_stiffness = param.Number(default=1e10, bounds=(1e6, 1e14))  # [N/m^1.5], Hertz and Hunt-Crossley
    restitution = param.Number(default=0.8, bounds=(0.0, 1.0))
    modes = param.Integer(default=50, bounds=(1, 200))

    CHOSEN = (
        "scene",
        "method",
        "mass_ratio",
        "speed",
        "law",
        "linear_stiffness",
        "hertz_stiffness",
        "restitution",
        "modes",
    )

    def chosen(self) -> dict[str, Any]:
        """All values by name, as one consistent set that a worker thread can keep."""
        return {name: getattr(self, name) for name in self.CHOSEN}

    @staticmethod
    def of_scene(name: str) -> dict[str, Any]:
        """The values that a built-in scene asks for."""
        scene = SCENES[name]
        values = {
            "mass_ratio": float(f"{scene.mass_ratio:.12g}"),
            "speed": scene.impactor.velocity,
            "law": scene.contact.NAME,
            "linear_stiffness": _rounded(20.0 * scene.target.stiffness),
        }
        if scene.contact.NAME in ("hertz", "hunt-crossley"):
            values["hertz_stiffness"] = scene.contact.stiffness
        return values


def _rounded(value: float) -> float:
    return float(f"{value:.2g}")


def chosen_scene(chosen: dict[str, Any]) -> Scene:
    """The scene that these choices describe."""
    base = SCENES[chosen["scene"]]
    contact: dict[str, Any] = {"law": chosen["law"]}
    if chosen["law"] == "linear":
        contact["stiffness"] = chosen["linear_stiffness"]
    elif chosen["law"] != "rigid":
        contact["stiffness"] = chosen["hertz_stiffness"]
    if chosen["law"] == "hunt-crossley":
        contact["restitution"] = max(chosen["restitution"], LEAST_RESTITUTION)
    changes: dict[str, Any] = {
        "impactor.mass": base.target.mass / chosen["mass_ratio"],
        "impactor.velocity": chosen["speed"],
        "contact": contact,
    }
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
        text = arguments[name][-1].decode("utf-8", "replace")[:40]
        parameter = Choices.param[name]
        value: Any = text
        try:
            if isinstance(parameter, param.Integer):
                value = int(text)
            elif isinstance(parameter, param.Number):
                value = float(text)
        except ValueError:
            pass  # and so it stays text, which no number accepts
        if not accepts(name, value):
            plain = re.fullmatch(r"[\w.+-]{1,24}", text)  # nothing else from an address is ever shown
            refused.append(refusal(name, value if plain else "text"))
            continue
        if name == "scene":
            kept |= Choices.of_scene(value)
        kept[name] = value
    return kept, refused


def refusal(name: str, value: object) -> str:
    """One sentence: the key, the value and what is allowed."""
    parameter = Choices.param[name]
    if isinstance(parameter, param.Selector):
        allowed = ", ".join(parameter.objects)
    else:
        kind = "a whole number" if isinstance(parameter, param.Integer) else "a number"
        allowed = f"{kind} from {parameter.bounds[0]:g} to {parameter.bounds[1]:g}"
    return str(SceneError(name, value, allowed))
