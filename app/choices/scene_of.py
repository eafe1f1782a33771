"""The scene that choices describe, and the choices that a scene asks for."""

from dataclasses import fields
from functools import cache, lru_cache
from typing import Any

import numpy as np
import param

import solvers
from solvers import LAWS, Body, Modal, Rod, Scene, SceneError
from solvers.bodies import AnyBody, Balls, FlexiblePendulum, Mechanism
from solvers.contact import Rigid
from solvers.contact.constants import STIFFNESS_RANGE
from solvers.contact.viscous import LEAST_RESTITUTION
from solvers.methods.modal.method import FRAMES
from solvers.methods.multibody.method import Multibody

from .beam import BEAM_CHOICES, on_beam, other_beam
from .bodies import parts_of, read_values, with_values
from .choices import SCENES, SOLVED_BY, Choices, accepts
from .mechanism import mechanism_changes, mechanism_values, on_mechanism
from .space import has_length, in_space, leaning, struck_at, struck_place

DEPTH = 1e-5  # [m] at which `force_at_depth` says how stiff a power law is: its stiffness has no unit of its own

RESTORING = ("balance", "rigid", Multibody.NAME)  # methods that take a restitution
OF_MODES = ("shapes",)  # keys of bodies that act on their modes alone
OF_ANOTHER_NAME = ("stiffness", "restitution", "nominal_restitution", "damping")  # constants set by other choices


def kind_of(scene: Scene) -> str:
    """How the page draws it: "axial", "beam" or "bodies", as its message says too."""
    if in_space(scene):
        return "bodies"
    return "beam" if on_beam(scene) or on_mechanism(scene) else "axial"


def choices_of(name: str, bodies: str = "") -> dict[str, Any]:
    """The values that a built-in scene asks for, each within its bounds; `bodies`: values of these that are changed."""
    return _own_values(name, bodies) | {"bodies": bodies}


def own_choices(name: str, bodies: str = "") -> dict[str, Any]:
    """A value for every choice, as the page opens a built-in scene; an address says only what differs from these."""
    return dict(_all_choices(name, bodies))


@lru_cache(maxsize=1024)
def _all_choices(name: str, bodies: str) -> dict[str, Any]:
    return Choices(scene=name, **choices_of(name, bodies)).chosen()


@lru_cache(maxsize=512)
def base_of(name: str, bodies: str = "") -> Scene:
    """A built-in scene with other values of its bodies, before all other choices.

    Raises ValueError with a sentence for the visitor.
    """
    return with_values(SCENES[name], read_values(bodies))


@cache
def body_keys(name: str) -> tuple[str, ...]:
    """All values of its bodies that can be set in a built-in scene."""
    return tuple(f"{part.key}.{quantity}" for part in parts_of(SCENES[name]) for quantity in part.quantities)


@lru_cache(maxsize=1024)
def _own_values(name: str, bodies: str) -> dict[str, Any]:
    scene = base_of(name, bodies)
    wanted: dict[str, Any] = {"speed": scene.speed}
    if in_space(scene):
        wanted |= {"place": _at_end(struck_place(scene)), "friction": scene.friction or 0.0}
        wanted |= {"restitution_model": scene.method["model"]} if "model" in scene.method else {}
    elif np.isfinite(scene.mass_ratio):
        wanted["mass_ratio"] = float(f"{scene.mass_ratio:.12g}")
    method = dict(scene.method)
    wanted |= {option: method[option] for option in ("restitution", "modes", "elements") if option in method}
    named = method.get("name")  # which may be one that the page does not have
    wanted["method"] = named if named in SOLVED_BY else solvers.usual_method(scene)
    wanted |= keyed(name, bodies)
    wanted |= {"floating_frame": method["frame"]} if has_frames(scene) and "frame" in method else {}
    if bends_alone(scene):
        wanted["modes"] = scene.impactor.known_as(FlexiblePendulum).count
    if on_mechanism(scene):
        wanted |= mechanism_values(scene)
        wanted |= {"motion_seconds": method["duration"]} if named == Multibody.NAME and "duration" in method else {}
    elif on_beam(scene):
        wanted |= {name: read(scene.target) for name, read in BEAM_CHOICES.items()}
    if not in_space(scene):
        wanted |= {"law": scene.contact.NAME} | _constants(scene)
    return {name: value for name, value in wanted.items() if accepts(name, value)}


@lru_cache(maxsize=1024)
def keyed(name: str, bodies: str) -> dict[str, Any]:
    """The choices that are a value in the table of one of a scene's bodies, and this value."""
    scene, found = base_of(name, bodies), {}
    for choice, key in Choices.KEYS.items():
        body, _, quantity = key.partition(".")
        if quantity in getattr(scene, body).KEYS and _takes(scene, key, _extreme(choice)):
            found[choice] = getattr(getattr(scene, body), quantity)
    return found


def _extreme(choice: str) -> Any:
    """The last value that a choice can have."""
    parameter = Choices.param[choice]
    return parameter.objects[-1] if isinstance(parameter, param.Selector) else parameter.bounds[1]


def _takes(scene: Scene, key: str, value: Any) -> bool:
    """Whether a scene may have this value: some keys are only for some supports."""
    try:
        scene.replace({key: value})
    except SceneError:
        return False
    return True


def _at_end(place: float) -> float:
    """A place along a body that is its end but for the digits of a scene file is its end."""
    return float(round(place)) if abs(place - round(place)) < 1e-6 else place


def _constants(scene: Scene) -> dict[str, Any]:
    """What the sliders of the contact laws show for a scene."""
    law, found = scene.contact, {}
    if scene.target.softness and not scene.target.bends and len(scene.target.rods) < 2:
        found["linear_stiffness"] = _rounded(20.0 / scene.target.softness)
    table = law.table(scene.speed)
    if "stiffness" in table:
        name = STIFFNESS[law.NAME]
        found[name] = table["stiffness"]
        if name == "force_at_depth":
            found[name] *= DEPTH ** (law.EXPONENT or table["exponent"])
    for name in (*_of_own_name(law.NAME), "restitution"):
        if name in table:
            found[name] = table[name]
    return found


STIFFNESS = {  # by law: the choice that sets it, as its unit follows from the exponent
    name: {1.0: "linear_stiffness", 1.5: "hertz_stiffness"}.get(law.EXPONENT or 0.0, "force_at_depth")
    for name, law in LAWS.items()
    if "stiffness" in law.KEYS
}


def law_choices(law: str) -> list[str]:
    """The choices that set the constants of a contact law."""
    keys = LAWS[law].KEYS
    names = [STIFFNESS[law]] if "stiffness" in keys else []
    return names + _of_own_name(law)


def _of_own_name(law: str) -> list[str]:
    """The constants of a law that are choices by the same name."""
    return [name for name in LAWS[law].KEYS if name in Choices.CHOSEN and name not in OF_ANOTHER_NAME]


def acting_choices(chosen: dict[str, Any]) -> list[str]:
    """The choices that change anything in the chosen scene."""
    base = base_of(chosen["scene"], chosen["bodies"])
    first = ["scene", "bodies"] if body_keys(chosen["scene"]) else ["scene"]
    if in_space(base):
        names = [*first, *(["speed"] if base.speed > 0.0 else []), "restitution", "friction", "tilt"]
        further = (("restitution_model", chosen["friction"]), ("tilt_way", chosen["tilt"]))
        names += [name for name, acts in further if acts]
        return names + (["place"] if has_length(base) else [])
    if base.prescribed_force:
        return first
    names = [*first, "method", "speed", "law", *law_choices(chosen["law"])]
    names += [name for name in keyed(chosen["scene"], chosen["bodies"]) if name not in OF_MODES]
    if on_mechanism(base):
        names += mechanism_values(base)
    elif on_beam(base):
        names += BEAM_CHOICES
    by_law = chosen["law"] != Rigid.NAME and moves_on(chosen)
    restored = "restitution" in LAWS[chosen["law"]].KEYS or (chosen["method"] in RESTORING and not by_law)
    if restored or not (kind_of(base) == "beam" or isinstance(base.target, Balls)):
        names.append("restitution")
    if base.impactor.free_mass and np.isfinite(base.mass_ratio):
        names.append("mass_ratio")
    if on_mechanism(base):
        if not moves_on(chosen):
            return names
        bends = base.target.known_as(Mechanism).flexible
        return [*names, "motion_seconds", *(["motion_links"] if bends else [])]
    shown = Modal.NAME if chosen["method"] == "waves" else chosen["method"]
    if kind_of(base) == "axial":
        able = able_methods(chosen["scene"], chosen["bodies"])
        if able <= {"waves"}:
            names.remove("method")  # there is nothing to compare with
        if shown not in able:
            return names
        names += _of_modes(chosen, base) if shown == Modal.NAME else []
    return names + resolutions(base, shown)


def _of_modes(chosen: dict[str, Any], base: Scene) -> list[str]:
    """The choices that say by which modes a bar is described."""
    shapes = [name for name in keyed(chosen["scene"], chosen["bodies"]) if name in OF_MODES]
    return shapes + (["floating_frame"] if has_frames(base) else [])


def has_frames(scene: Scene) -> bool:
    """Whether the modes of what is struck can be described in a frame that is fixed to its end."""
    return isinstance(scene.target, Rod) and scene.target.support == "free"


@lru_cache(maxsize=512)
def able_methods(name: str, bodies: str) -> frozenset[str]:
    """Those that can solve a built-in scene with other values of its bodies."""
    scene = base_of(name, bodies)
    return frozenset(method for method, kind in SOLVED_BY.items() if kind().refusal(scene) is None)


def moves_on(chosen: dict[str, Any]) -> bool:
    """Whether a mechanism is followed as it moves on."""
    base = base_of(chosen["scene"], chosen["bodies"])
    return chosen["method"] == Multibody.NAME and on_mechanism(base) and base.impactor.free_mass


def own_options(scene: Scene, method: str) -> dict[str, Any]:
    """What the scene itself says on how this method is to solve it."""
    if scene.method.get("name") != method:
        return {}
    return {option: value for option, value in scene.method.items() if option not in ("name", "duration")}


def resolutions(scene: Scene, method: str) -> list[str]:
    """Which of modes and elements the method takes; where the scene gives any of them, those only.

    Of a beam what makes the method finer: it keeps so few modes of its elements that their number need not be set.
    """
    known, own = {option.name for option in fields(SOLVED_BY[method])}, own_options(scene, method)
    if on_beam(scene) and not own:
        known &= set(SOLVED_BY[method].RESOLUTIONS)
    found = [name for name in ("modes", "elements") if name in known]
    return [name for name in found if name in own] or found


def _rounded(value: float) -> float:
    return float(f"{value:.2g}")


def contact_table(chosen: dict[str, Any]) -> dict[str, Any]:
    """The table `[contact]` that these choices describe."""
    law = chosen["law"]
    keys, table = LAWS[law].KEYS, {"law": law}
    unset = {name: value for name, value in LAWS[law].EXAMPLE.items() if name not in OF_ANOTHER_NAME}
    table |= unset | {name: chosen[name] for name in _of_own_name(law)}
    if "stiffness" in keys:
        table["stiffness"] = chosen[STIFFNESS[law]]
        if STIFFNESS[law] == "force_at_depth":
            exponent = LAWS[law].EXPONENT or chosen["exponent"]
            table["stiffness"] = min(table["stiffness"] / DEPTH**exponent, STIFFNESS_RANGE[1])
    if "restitution" in keys:
        table["restitution"] = max(chosen["restitution"], LEAST_RESTITUTION)
    return table


def chosen_scene(chosen: dict[str, Any]) -> Scene:
    """The scene that these choices describe. Raises ValueError with a sentence for the visitor if there is none."""
    base = base_of(chosen["scene"], chosen["bodies"])
    if in_space(base):
        faster = chosen["speed"] / base.speed if base.speed > 0.0 else 1.0
        scene = base.replace(
            {
                f"{name}.{key}": [faster * v for v in getattr(getattr(base, name), key)]
                for name in ("impactor", "target")
                for key in ("velocity", "spin")
                if isinstance(getattr(base, name), Body)
            }
        )
        if chosen["friction"] or base.friction is not None:
            scene = scene.replace({"contact.friction": chosen["friction"]})
        scene = struck_at(scene, chosen["place"]) if has_length(base) else scene
        return leaning(scene, chosen["tilt"], chosen["tilt_way"])
    if base.prescribed_force:
        return base
    if on_mechanism(base):
        changes = mechanism_changes(base, chosen)
    else:
        changes = _of_velocity("impactor", base.impactor, chosen["speed"])
    if base.target.velocity and not on_mechanism(base):
        faster = chosen["speed"] / base.speed
        changes = _of_velocity("impactor", base.impactor, faster * base.impactor.velocity)
        changes |= _of_velocity("target", base.target, faster * base.target.velocity)
    own = choices_of(chosen["scene"], chosen["bodies"])
    if on_beam(base):
        base = other_beam(
            base, {name: chosen[name] for name in BEAM_CHOICES if chosen[name] != own.get(name, chosen[name])}
        )
    keys = keyed(chosen["scene"], chosen["bodies"])
    if set_anew := {Choices.KEYS[name]: chosen[name] for name, value in keys.items() if chosen[name] != value}:
        base = base.replace(set_anew)  # first: the mass of what is struck may follow from them
    if "mass_ratio" in acting_choices(chosen):
        mass = base.target.mass / chosen["mass_ratio"]
        changes |= {f"impactor.{key}": value for key, value in base.impactor.of_mass(mass).items()}
    if bends_alone(base) and chosen["modes"] != own.get("modes"):
        changes["impactor.modes"] = chosen["modes"]
    frame = chosen["floating_frame"]
    if base.method.get("name") == Modal.NAME and has_frames(base) and frame != base.method.get("frame", FRAMES[0]):
        changes["method"] = {**base.method, "frame": frame}
    if any(chosen[name] != own.get(name, chosen[name]) for name in ("law", "restitution", *law_choices(chosen["law"]))):
        changes["contact"] = contact_table(chosen)  # else as the scene says, with all that the sliders do not show
    return base.replace(changes)


def bends_alone(scene: Scene) -> bool:
    """Whether all that rings is a pendulum, whose own modes are then those that are chosen."""
    return isinstance(scene.impactor, FlexiblePendulum) and scene.target.time_unit is None


def _of_velocity(name: str, body: AnyBody, velocity: float) -> dict[str, Any]:
    """The keys of a scene that let a body come with this velocity [m/s]."""
    return {f"{name}.{key}": value for key, value in body.of_velocity(velocity).items()}
