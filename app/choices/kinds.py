"""Kinds of scene, as the page draws them: which choices each has, which of them act, and the scene they describe."""

from abc import ABC, abstractmethod
from collections.abc import Collection, Sequence
from dataclasses import fields
from typing import Any, ClassVar

import numpy as np

import solvers
from solvers import LAWS, Body, Modal, Rod, Scene, Waveguide
from solvers.bodies import AnyBody, Balls, FlexiblePendulum, Mechanism, RotatingRod
from solvers.bodies.beams import THEORIES
from solvers.bodies.pendulum import SHAPES
from solvers.contact import Hertz, HuntCrossley, Rigid
from solvers.methods.modal.method import FRAMES
from solvers.methods.multibody.method import Multibody

from .beam import BEAM_CHOICES, on_beam, other_beam
from .built_in import able_methods, base_of, keyed
from .choices import LINKS, SOLVED_BY, Choices, accepts, within
from .laws import contact_table, law_choices, law_values
from .mechanism import mechanism_changes, mechanism_values, on_mechanism
from .opened import Comparison, Trial
from .space import has_length, in_space, leaning, struck_at, struck_place

RESTORING = ("balance", "rigid", Multibody.NAME)  # methods that take a restitution
OF_MODES = ("shapes",)  # keys of bodies that act on their modes alone
OPTIONS = ("restitution", "modes", "elements")  # of methods, that are choices
JAMMING = {"friction-jams", "impact-without-approach", "slides-on"}  # notes of Painlevé's paradox
FASTER, HEAVIER = 2.0, 4.0  # times, to be tried and compared
FEW = 5  # modes
CLAMPED = (5, 10, 30)  # modes of a rod in a frame that is fixed to its struck end

Values = dict[str, Any]
Tries = Sequence[Trial]


class Kind(ABC):
    """What all kinds have. `base`: the built-in scene with the chosen values of its bodies."""

    NAME: ClassVar[str]  # in messages
    EXACT: ClassVar[bool] = False  # whether an exact solution is shown

    def values(self, base: Scene) -> Values:
        """The choices that the scene itself sets, with its values."""
        method = base.method
        named = method.get("name")  # which may be one that the page does not have
        usual = named if isinstance(named, str) and named in SOLVED_BY else solvers.usual_method(base)
        options = {option: method[option] for option in OPTIONS if option in method}
        return {"speed": base.speed, "method": usual} | options

    @abstractmethod
    def acting(self, base: Scene, chosen: Values) -> list[str]:
        """The choices that change anything, besides scene and bodies."""

    @abstractmethod
    def described(self, base: Scene, chosen: Values, own: Values) -> Scene:
        """The scene with these choices; `own`: those that it is opened with. Raises SceneError where there is none."""

    def trials(self, scene: Scene, chosen: Values, of_scene: Tries, notes: Collection[str]) -> list[Trial]:
        """What can be tried, the most telling first, of which what acts is offered; `of_scene`: what its file names,
        `notes`: codes of what is noted on the solution."""
        faster, heavier = FASTER * chosen["speed"], chosen["mass_ratio"] / HEAVIER
        found = Trial("faster", "speed", faster), Trial("heavier", "mass_ratio", heavier)
        return [*(each for each in found if accepts(each.choice, each.value)), *of_scene]

    def comparisons(self, scene: Scene, chosen: Values, own: Values) -> list[Comparison]:
        """What can be asked, likewise."""
        speed = chosen["speed"]
        return [Comparison.of("speed", "speed", speed, within("speed", FASTER * speed))]


class InSpace(Kind):
    """Rigid bodies in space, struck by an impulse with friction."""

    NAME = "bodies"

    def values(self, base: Scene) -> Values:
        place = struck_place(base)
        end = float(round(place))
        at_end = abs(place - end) < 1e-6  # but for the digits of a scene file
        model = {"restitution_model": base.method["model"]} if "model" in base.method else {}
        return super().values(base) | {"place": end if at_end else place, "friction": base.friction or 0.0} | model

    def acting(self, base: Scene, chosen: Values) -> list[str]:
        names = [*(["speed"] if base.speed > 0.0 else []), "restitution", "friction", "tilt"]
        names += ["restitution_model"] if chosen["friction"] else []
        names += ["tilt_way"] if chosen["tilt"] else []
        return names + (["place"] if has_length(base) else [])

    def described(self, base: Scene, chosen: Values, own: Values) -> Scene:
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

    def trials(self, scene: Scene, chosen: Values, of_scene: Tries, notes: Collection[str]) -> list[Trial]:
        # it jams by where it is hit: in the centre nothing of that is left
        centre = [Trial("centre", "place", 0.5)] if JAMMING.isdisjoint(notes) else []
        return [*super().trials(scene, chosen, (), notes), Trial("elastic", "restitution", 1.0), *centre, *of_scene]

    def comparisons(self, scene: Scene, chosen: Values, own: Values) -> list[Comparison]:
        return [
            *super().comparisons(scene, chosen, own),
            Comparison.of("restitution", "restitution", 1.0, 0.0),
            Comparison.of("off-centre", "place", 0.5, own["place"]),
        ]


class WithLaw(Kind):
    """Bodies on a line, between which a contact law or a rigid contact acts."""

    def values(self, base: Scene) -> Values:
        ratio = {"mass_ratio": float(f"{base.mass_ratio:.12g}")} if np.isfinite(base.mass_ratio) else {}
        return super().values(base) | ratio | law_values(base)

    def acting(self, base: Scene, chosen: Values) -> list[str]:
        if base.prescribed_force:
            return []
        of_bodies = [name for name in keyed(chosen["scene"], chosen["bodies"]) if name not in OF_MODES]
        names = ["method", "speed", "law", *law_choices(chosen["law"]), *of_bodies, *self.target_choices(base)]
        if "restitution" in LAWS[chosen["law"]].KEYS or self.restores(base, chosen):
            names.append("restitution")
        if base.impactor.free_mass and np.isfinite(base.mass_ratio):
            names.append("mass_ratio")
        return self.solved(base, chosen, names)

    def target_choices(self, base: Scene) -> list[str]:
        """The choices of what is struck."""
        return []

    def restores(self, base: Scene, chosen: Values) -> bool:
        """Whether a restitution acts beside the contact law."""
        return chosen["method"] in RESTORING

    def solved(self, base: Scene, chosen: Values, names: list[str]) -> list[str]:
        """These choices and those that say how it is solved."""
        return names + resolutions(base, shown_method(chosen))

    def speed_keys(self, base: Scene, chosen: Values) -> Values:
        """The keys of the scene that set the chosen speed."""
        faster = chosen["speed"] / base.speed
        if not base.target.velocity:
            return _of_velocity("impactor", base.impactor, chosen["speed"])
        target = _of_velocity("target", base.target, faster * base.target.velocity)
        return _of_velocity("impactor", base.impactor, faster * base.impactor.velocity) | target

    def with_bodies(self, base: Scene, chosen: Values, own: Values) -> Scene:
        """The scene with the chosen values and description of its bodies."""
        keys = keyed(chosen["scene"], chosen["bodies"])
        changed = {Choices.KEYS[name]: chosen[name] for name, value in keys.items() if chosen[name] != value}
        return base.replace(changed) if changed else base

    def described(self, base: Scene, chosen: Values, own: Values) -> Scene:
        if base.prescribed_force:
            return base
        changes = self.speed_keys(base, chosen)
        scene = self.with_bodies(base, chosen, own)  # first: the mass of what is struck may follow
        if scene.impactor.free_mass and np.isfinite(base.mass_ratio):
            mass = scene.target.mass / chosen["mass_ratio"]
            changes |= {f"impactor.{key}": value for key, value in scene.impactor.of_mass(mass).items()}
        of_law = ("law", "restitution", *law_choices(chosen["law"]))
        if any(chosen[name] != own.get(name, chosen[name]) for name in of_law):
            changes["contact"] = contact_table(chosen)  # else as the scene says, with all that the sliders do not show
        return scene.replace(changes)

    def comparisons(self, scene: Scene, chosen: Values, own: Values) -> list[Comparison]:
        ratio = chosen["mass_ratio"]
        less, more = (within("mass_ratio", times * ratio) for times in (1.0 / HEAVIER, HEAVIER))
        return [
            Comparison.of("modes", "modes", 5, 100),
            Comparison.of("elements", "elements", 10, 100),
            Comparison.of("law", "law", Rigid.NAME, Hertz.NAME),
            Comparison.of("hammer", "mass_ratio", ratio, less),
            Comparison.of("constant", "mass_ratio", more, less),
            *super().comparisons(scene, chosen, own),
        ]


class Axial(WithLaw):
    """Rods, masses, balls and pendulums."""

    NAME = "axial"
    EXACT = True

    def values(self, base: Scene) -> Values:
        frame = {"floating_frame": base.method["frame"]} if has_frames(base) and "frame" in base.method else {}
        modes = {"modes": base.impactor.known_as(FlexiblePendulum).count} if bends_alone(base) else {}
        return super().values(base) | frame | modes

    def restores(self, base: Scene, chosen: Values) -> bool:
        return super().restores(base, chosen) or not isinstance(base.target, Balls)

    def solved(self, base: Scene, chosen: Values, names: list[str]) -> list[str]:
        able, shown = able_methods(chosen["scene"], chosen["bodies"]), shown_method(chosen)
        if able <= {"waves"}:
            names.remove("method")  # there is nothing to compare with
        if shown not in able:
            return names
        if shown == Modal.NAME:
            names += [name for name in keyed(chosen["scene"], chosen["bodies"]) if name in OF_MODES]
            names += ["floating_frame"] if has_frames(base) else []
        return super().solved(base, chosen, names)

    def with_bodies(self, base: Scene, chosen: Values, own: Values) -> Scene:
        scene, changes, frame = super().with_bodies(base, chosen, own), {}, chosen["floating_frame"]
        if bends_alone(base) and chosen["modes"] != own.get("modes"):
            changes["impactor.modes"] = chosen["modes"]
        if base.method.get("name") == Modal.NAME and has_frames(base) and frame != base.method.get("frame", FRAMES[0]):
            changes["method"] = {**base.method, "frame": frame}
        return scene.replace(changes) if changes else scene

    def trials(self, scene: Scene, chosen: Values, of_scene: Tries, notes: Collection[str]) -> list[Trial]:
        softer = [Trial("softer", "law", Hertz.NAME)] if scene.rigid_contact else []
        loses = scene.contact.LOSSY or scene.contact.PLASTIC
        losing = [] if loses else [Trial("losing", "law", HuntCrossley.NAME)]
        return [*super().trials(scene, chosen, of_scene, notes), *losing, *softer]

    def comparisons(self, scene: Scene, chosen: Values, own: Values) -> list[Comparison]:
        found = [Comparison.of("shapes", "shapes", *SHAPES), *super().comparisons(scene, chosen, own)]
        target = scene.target
        rings = isinstance(target, Waveguide) or (isinstance(target, RotatingRod) and not target.across)
        if not rings:  # a rigid contact of rigid bodies takes no time
            found = [each for each in found if each.question != "law"]
        mean, attached = FRAMES[:2]
        if has_frames(scene) and own["floating_frame"] == attached:
            found.insert(0, Comparison.of("frame", "floating_frame", mean, attached))
        if has_frames(scene) and chosen["floating_frame"] == attached and shown_method(chosen) == Modal.NAME:
            found.insert(0, Comparison.of("clamped", "modes", *CLAMPED))
        return found


class OnBeam(WithLaw):
    """What strikes a beam."""

    NAME = "beam"

    def values(self, base: Scene) -> Values:
        return super().values(base) | {name: read(base.target) for name, read in BEAM_CHOICES.items()}

    def target_choices(self, base: Scene) -> list[str]:
        return [*BEAM_CHOICES]

    def with_bodies(self, base: Scene, chosen: Values, own: Values) -> Scene:
        changed = {name: chosen[name] for name in BEAM_CHOICES if chosen[name] != own.get(name, chosen[name])}
        return super().with_bodies(other_beam(base, changed), chosen, own)

    def trials(self, scene: Scene, chosen: Values, of_scene: Tries, notes: Collection[str]) -> list[Trial]:
        return [*_bending_trials(chosen), *super().trials(scene, chosen, of_scene, notes)]

    def comparisons(self, scene: Scene, chosen: Values, own: Values) -> list[Comparison]:
        return [*super().comparisons(scene, chosen, own), Comparison.of("theory", "theory", *THEORIES)]


class OnMechanism(WithLaw):
    """What strikes a link of a mechanism."""

    NAME = "mechanism"

    def values(self, base: Scene) -> Values:
        found, method = super().values(base) | mechanism_values(base), base.method
        seconds = method.get("name") == Multibody.NAME and "duration" in method
        return found | ({"motion_seconds": method["duration"]} if seconds else {})

    def target_choices(self, base: Scene) -> list[str]:
        return [*mechanism_values(base)]

    def restores(self, base: Scene, chosen: Values) -> bool:
        return super().restores(base, chosen) and (chosen["law"] == Rigid.NAME or not moves_on(chosen))

    def solved(self, base: Scene, chosen: Values, names: list[str]) -> list[str]:
        if not moves_on(chosen):
            return names
        bends = base.target.known_as(Mechanism).flexible
        return [*names, "motion_seconds", *(["motion_links"] if bends else [])]

    def speed_keys(self, base: Scene, chosen: Values) -> Values:
        return mechanism_changes(base, chosen)

    def trials(self, scene: Scene, chosen: Values, of_scene: Tries, notes: Collection[str]) -> list[Trial]:
        moving = [Trial("rigid", "motion_links", LINKS[1]), Trial("moves", "method", Multibody.NAME)]
        able = Multibody().refusal(scene) is None
        return [*(moving if able else []), *_bending_trials(chosen), *super().trials(scene, chosen, of_scene, notes)]


KINDS = {  # by whether a scene is one; the first that holds
    in_space: InSpace(),
    on_beam: OnBeam(),
    on_mechanism: OnMechanism(),
    lambda _: True: Axial(),
}


def kind_of(scene: Scene) -> Kind:
    """Of a scene."""
    return next(kind for holds, kind in KINDS.items() if holds(scene))


def moves_on(chosen: Values) -> bool:
    """Whether a mechanism is followed as it moves on."""
    base = base_of(chosen["scene"], chosen["bodies"])
    return chosen["method"] == Multibody.NAME and on_mechanism(base) and base.impactor.free_mass


def shown_method(chosen: Values) -> str:
    """The method whose resolutions are set: modes beside exact waves."""
    return Modal.NAME if chosen["method"] == "waves" else chosen["method"]


def has_frames(scene: Scene) -> bool:
    """Whether the modes of what is struck can be described in a frame that is fixed to its end."""
    return isinstance(scene.target, Rod) and scene.target.support == "free"


def bends_alone(scene: Scene) -> bool:
    """Whether only a pendulum vibrates: then the chosen modes are its own."""
    return isinstance(scene.impactor, FlexiblePendulum) and scene.target.time_unit is None


def own_options(scene: Scene, method: str) -> Values:
    """What the scene itself says on how this method is to solve it."""
    if scene.method.get("name") != method:
        return {}
    return {option: value for option, value in scene.method.items() if option not in ("name", "duration")}


def resolutions(scene: Scene, method: str) -> list[str]:
    """Which of modes and elements the method takes; where the scene gives any of them, those only.

    For a beam, what refines the method: it keeps so few modes of its elements that their number need not be set.
    """
    known, own = {option.name for option in fields(SOLVED_BY[method])}, own_options(scene, method)
    if on_beam(scene) and not own:
        known &= set(SOLVED_BY[method].RESOLUTIONS)
    found = [name for name in ("modes", "elements") if name in known]
    return [name for name in found if name in own] or found


def _bending_trials(chosen: Values) -> list[Trial]:
    """Of a beam, or a link of a mechanism."""
    few = [Trial("few", "modes", FEW)] if chosen["modes"] > FEW else []
    return [Trial("middle", "place", 0.5), *few]


def _of_velocity(name: str, body: AnyBody, velocity: float) -> Values:
    """The keys of a scene that let a body come with this velocity [m/s]."""
    return {f"{name}.{key}": value for key, value in body.of_velocity(velocity).items()}
