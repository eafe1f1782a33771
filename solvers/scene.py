"""A scene: what is struck by what. SI units, immutable, checked when built, and written back without loss."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from . import validation
from .bodies import (
    AnyBody,
    Balls,
    Beam,
    Bending,
    Body,
    Mechanism,
    Pivoted,
    Pulse,
    RigidMass,
    Rod,
    Rods,
    Wall,
    Waveguide,
    in_space,
    read_body,
)
from .bodies.drop import STANDARD_GRAVITY, fallen, height_and_gravity, read_gravity, with_gravity
from .bodies.lumped import SPEED_RANGE
from .contact import Rigid, check_law
from .contact.duration import contact_time
from .contact.protocol import Law
from .contact_table import chain_laws, read_contact_normal, read_joint_laws, read_law
from .numerics.rigid import impulses
from .validation import SceneError, allowed, bound_beside

LARGEST_MASS_RATIO = 1e9  # of target to impactor, and the other way round; beyond it doubles resolve nothing
LONGEST_NOTE = 600  # characters
RIGID: Any = Rigid()  # the contact of a scene that says nothing of it
KEYS = ("title", "source", "note", "impactor", "target", "contact", "method", "view")
IN_PLACE = {"velocity": ("height",), "height": ("velocity",)}  # of what of an impactor a key stands
ALONG_AXIS = ("mass", "sphere", "rod", "rods", "beam")  # kinds that a velocity along the axis moves as wholes


@dataclass(frozen=True)
class Scene:
    """An impactor about to touch a target at rest at time zero.

    `contact` is a contact law with its constants in SI units; `method` holds the table `[method]` as given, which says
    how the scene is solved unless the caller says otherwise; `view` holds `[view]`, how the page opens it; `note` says
    what is seen and what was printed.
    """

    impactor: AnyBody
    target: AnyBody
    contact: Law = RIGID
    joint_laws: tuple[Law | None, ...] = ()  # of the joints of a chain of rods, None where bonded; between balls
    title: str = ""
    source: str = ""
    method: Mapping[str, Any] = field(default_factory=dict, hash=False)
    given: Mapping[str, Any] = field(default_factory=dict, repr=False, compare=False)
    normal: tuple[float, float, float] | Any = None  # from impactor to target, where they are bodies in space
    note: str = ""
    friction: float | None = None  # of bodies in space: Coulomb's coefficient, where the scene gives one
    view: Mapping[str, Any] = field(default_factory=dict, repr=False, compare=False)
    gravity: float = 0.0  # that pulls the impactor along the axis towards the target [m/s2]
    striker_laws: tuple[Law | None, ...] = ()  # as `joint_laws`, of a chain of rods that strikes

    def __post_init__(self) -> None:
        # What follows from a scene that was read may be seen the other way round: a mechanism strikes a held rod.
        if isinstance(self.impactor, Waveguide) and self.impactor.held and not self.given:
            raise SceneError("impactor.support", self.impactor.support, allowed("choice", options=["free"]))
        check_law(type(self.contact))

    @classmethod
    def from_table(cls, given: object) -> "Scene":
        """A scene from nested tables of SI values, as in a scene file.

        Raises SceneError that names the key, the value and what is allowed.
        """
        given = validation.table("", validation.plain(given), KEYS)
        target = read_body("target", validation.required("", given, "target", allowed("a-table")))
        usual = target.usual_impactor()
        given = given if usual is None else {"impactor": usual} | dict(given)
        validation.required("", given, "impactor", allowed("a-table"))
        given = with_gravity(given, target)
        impactor = _read_impactor(given["impactor"], target)
        normal, friction = read_contact_normal(impactor, target, given.get("contact"))
        if isinstance(impactor, Pulse):
            impactor = _on_rod(impactor, target, given.get("contact"))
        else:
            if normal is None:
                _check_approach(impactor, target)
            _check_masses(impactor, target)
        if not isinstance(given.get("method", {}), Mapping):
            raise SceneError("method", given["method"], allowed("method-table"))
        if not isinstance(given.get("view", {}), Mapping):
            raise SceneError("view", given["view"], allowed("a-table"))
        return cls(
            impactor,
            target,
            read_law("contact", given.get("contact", {"law": "rigid"}), impactor, target, normal is not None),
            read_joint_laws(impactor, target, given.get("contact", {"law": "rigid"})),
            validation.text("title", given.get("title", "")),
            validation.text("source", given.get("source", "")),
            dict(given.get("method", {})),
            given,
            normal,
            validation.text("note", given.get("note", ""), LONGEST_NOTE),
            friction,
            dict(given.get("view", {})),
            read_gravity(given["impactor"])
            if not any(isinstance(body, Mechanism) for body in (impactor, target))
            else 0.0,
            chain_laws("impactor", impactor, impactor.velocity - target.velocity) if impactor.rods else (),
        )

    def replace(self, changes: Mapping[str, Any]) -> "Scene":
        """The scene with other values, by dotted key: `scene.replace({"target.length": 0.5})`; what is in a list goes
        by its number, from 1 on: `target.links.1.modes`.

        Another `method.name` takes the options of the method before with it; `duration` stays. Raises SceneError for a
        key that does not exist or a value that is not allowed.
        """
        tables = validation.plain(self.given or self.table())
        options = tables.get("method", {})
        if changes.get("method.name", options.get("name")) != options.get("name") is not None:
            tables["method"] = {name: value for name, value in options.items() if name == "duration"}
        for key, value in changes.items():
            *path, last = key.split(".")
            table: Any = tables
            for name in path:
                table = validation.entry(table, name, key, value)
                if not isinstance(table, dict | list):
                    raise SceneError(key, value, allowed("no-table", name=name))
            if isinstance(table, list):
                raise SceneError(key, value, allowed("number-in-list", count=len(table)))
            table[last] = value
            if path == ["impactor"] and last == "velocity" and "height" in table:
                table.setdefault("gravity", STANDARD_GRAVITY)  # it keeps its weight
            for other in IN_PLACE.get(last, ()) if path == ["impactor"] else ():
                table.pop(other, None)
        return Scene.from_table(tables)

    def with_impactor_mass(self, mass: float) -> "Scene":
        """The scene with an impactor of another mass [kg]. Raises SceneError if that is not allowed."""
        return self.replace({f"impactor.{key}": value for key, value in self.impactor.of_mass(mass).items()})

    def table(self) -> dict[str, Any]:
        """Nested tables that `from_table` reads back into the same scene, with what follows; without its view."""
        contact: dict[str, Any] = {"law": self.contact.NAME} | self.contact.table(self.speed)
        for name in {"restitution", "nominal_restitution"} & set(self.given.get("contact", ())):
            del contact["damping"]  # as given: it says more, and stays with the impact when its speed is changed
            contact[name] = self.given["contact"][name]
        if isinstance(self.target, Balls) and "contact" in self.given:
            contact = dict(self.given["contact"])  # as given: from it every pair of neighbours has its own constants
        if self.normal is not None:
            contact["normal"] = list(self.normal)
        if self.friction is not None:
            contact["friction"] = self.friction
        tables: dict[str, Any] = {
            "title": self.title,
            "source": self.source,
            **({"note": self.note} if self.note else {}),
            "impactor": self._dropped(self.impactor.table()),
            "target": self.target.table(),
            "contact": contact,
        }
        return validation.plain(tables | ({"method": self.method} if self.method else {}))

    def _dropped(self, impactor: dict[str, Any]) -> dict[str, Any]:
        """The table of the impactor, with its gravity, and the height of its fall where that is given."""
        given = self.given.get("impactor", {})
        if self.impactor.kind in ALONG_AXIS:
            impactor = impactor | {"velocity": self.impactor.velocity}  # which may be zero, and cannot be left out
        if "height" not in given or fallen(given, self.impactor.kind)["velocity"] != self.impactor.velocity:
            return impactor | ({"gravity": self.gravity} if self.gravity else {})
        height, gravity = height_and_gravity(given)
        rest = {key: value for key, value in impactor.items() if key != "velocity"}
        return rest | {"height": height, "gravity": gravity}

    def _repr_html_(self) -> str:
        from .notebook import cards

        return cards.scene_card(self)

    @property
    def mass_ratio(self) -> float:
        """beta = m2 / m1, target over impactor, (3.9); infinite for a wall."""
        return self.target.mass / self.impactor.mass

    @cached_property
    def rigid_contact(self) -> bool:
        """Whether nothing gives way at the contact itself."""
        return isinstance(self.contact, Rigid)

    @cached_property
    def prescribed_force(self) -> bool:
        """Whether a force stands for the impactor: nothing strikes."""
        return isinstance(self.impactor, Pulse)

    @property
    def bends(self) -> bool:
        """Whether one of the bodies bends."""
        return self.impactor.bends or self.target.bends

    def with_modes(self, most: int | None) -> "Scene":
        """The scene with so many modes of each link of a mechanism, where it has more; else the scene itself."""
        if not isinstance(self.target, Mechanism) or most is None:
            return self
        mechanism = self.target.with_modes(most)
        return self if mechanism is self.target else replace(self, target=mechanism)

    @cached_property
    def struck(self) -> "Scene":
        """Where a mechanism strikes, the same seen the other way round, where it is struck; else the scene itself."""
        if not isinstance(self.impactor, Mechanism):
            return self
        target: Any = self.target
        striker, mechanism = replace(target, velocity=0.0 - target.velocity), self.impactor.turned_round
        given = dict(self.given or self.table())
        body = {"kind": target.kind} | dict(given["target"]) | {"velocity": striker.velocity}
        given |= {"impactor": body, "target": dict(given["impactor"]) | {"struck": mechanism.struck.table()}}
        return replace(self, impactor=striker, target=mechanism, given=given)

    @property
    def refined(self) -> "Scene":
        """The scene with more modes of each link of a mechanism, by which the error of fewer is measured."""
        return replace(self, target=self.target.known_as(Mechanism).refined, given={})

    @property
    def at_contact(self) -> "Scene":
        """The impact alone: of a mechanism, seen from its struck point; else the scene itself."""
        if not isinstance(self.target, Mechanism):
            return self
        impactor: Any = self.impactor
        closing = replace(impactor, **impactor.of_velocity(self.speed))
        at_rest = self.target.at_rest
        return replace(self, impactor=closing, target=replace(at_rest, falls=False) if impactor.held else at_rest)

    @property
    def speed(self) -> float:
        """Of approach, v1 - v2 [m/s]; of bodies in space that of the touching points along the normal."""
        if self.normal is not None:
            return float(np.dot(self.normal, self._meeting_velocity))
        return self.impactor.velocity - (0.0 if self.prescribed_force else self.target.velocity)

    @property
    def meeting_speed(self) -> float:
        """The same, and of bodies in space that do not approach how fast they slide or part; never negative [m/s]."""
        if self.normal is None or self.speed > 0.0:
            return self.speed
        return float(np.linalg.norm(self._meeting_velocity))

    @property
    def _meeting_velocity(self) -> np.ndarray:
        """Of the impactor less that of the target where bodies in space touch, (3,) [m/s]."""
        return np.subtract(*(impulses.point_velocity(in_space(body)) for body in (self.impactor, self.target)))

    @property
    def weight_acceleration(self) -> float:
        """By which its weight accelerates the impactor towards the target while nothing else pushes it [m/s2].

        What is held stands in equilibrium under its own weight, and stays so: that drops out of the linear problem.
        What nothing holds falls as the impactor does, so that weight has no say between them.
        """
        return self.gravity if self.target.held else 0.0

    @property
    def fall(self) -> float:
        """By which both bodies accelerate towards each other without a touch [m/s2]: by the weight of the impactor, or
        as a mechanism does by itself.
        """
        return self.weight_acceleration - self.target.acceleration

    @property
    def reduced_mass(self) -> float:
        """m1 m2 / (m1 + m2) [kg]; that of one alone if the other is held."""
        if self.impactor.held and not isinstance(self.impactor, Mechanism):
            return self.target.mass
        return self.impactor.mass if self.target.held else self.impactor.mass / (1.0 + 1.0 / self.mass_ratio)

    @property
    def initial_energy(self) -> float:
        """Kinetic energy of both bodies before the impact [J]."""
        if self.normal is not None:
            return float(sum(impulses.kinetic_energy(in_space(body)) for body in (self.impactor, self.target)))
        return sum(body.kinetic_energy for body in (self.impactor, self.target) if not isinstance(body, Pulse))

    @property
    def rods(self) -> list[Rod]:
        """Of both bodies, along which waves keep their shape, from left to right."""
        return [*self.impactor.rods[::-1], *self.target.rods]

    @property
    def impedance(self) -> float:
        """Of the struck end of the target [kg/s] or, where no rod is struck, of the end of the rod that strikes."""
        rods = self.target.rods or self.impactor.rods
        return rods[0].impedance

    @property
    def halting_time(self) -> float:
        """m / Z of a compact body on a rod [s]: in this time a wave brings it to rest; of one on a beam its
        `halting_time`; infinite for any other pair.
        """
        bodies = (self.impactor, self.target)
        for body, other in (bodies, bodies[::-1]):
            if isinstance(body, Bending) and other.free_mass:
                return body.halting_time(other.mass)
        rings = [body for body in bodies if isinstance(body, Waveguide)]
        compact = [body for body in bodies if body.time_unit is None]
        return compact[0].mass / rings[0].impedance if rings and compact else math.inf

    @cached_property
    def time_unit(self) -> float:
        """Round trip T of a wave in the target [s], for a beam its slowest period, or else the same of the impactor;
        where nothing rings, about a contact time.
        """
        for body in (self.target, self.impactor):
            if body.time_unit is not None:
                return body.time_unit
        if self.target.half_swing is not None:
            return self.target.half_swing
        return contact_time(self.contact, self.reduced_mass, self.speed)


def _read_impactor(given: object, target: AnyBody) -> AnyBody:
    """What strikes; a mechanism may also run into what stands still, or overtake it: any velocity along its normal.

    A mechanism itself strikes what moves along its normal as one, rings, or stands still.
    """
    if isinstance(given, Mapping) and given.get("kind") == Mechanism.kind:
        plain_rod = isinstance(target, Rod) and target.support in ("free", "fixed") and not target.end_mass
        if not (isinstance(target, (RigidMass, Wall)) or plain_rod):
            key = "target.support" if isinstance(target, Rod) else "target.kind"
            raise SceneError(
                key, target.support if isinstance(target, Rod) else target.kind, allowed("mechanism-strikes")
            )
    if not isinstance(given, Mapping):
        return read_body("impactor", given)
    if not isinstance(target, Mechanism):
        return _read_met(given, target)
    if given.get("kind") in (Body.kind, Pulse.kind):
        raise SceneError("impactor.kind", given["kind"], allowed("strikes-mechanism"))
    fastest, known = SPEED_RANGE[1], "velocity" in given
    found: Any = read_body("impactor", {**given, "velocity": fastest} if known else given)
    if not isinstance(found, (RigidMass, Rod, Beam, Pivoted)):
        raise SceneError("impactor.kind", found.kind, allowed("strikes-mechanism"))
    if not known or isinstance(found, Pivoted):
        return found
    return replace(found, velocity=validation.number("impactor.velocity", given["velocity"], -fastest, fastest, "m/s"))


def _read_met(given: Mapping[str, Any], target: AnyBody) -> AnyBody:
    """What strikes; where the target comes towards it, it may stand still or move the same way more slowly."""
    comes = isinstance(target.velocity, (int, float)) and target.velocity < 0.0
    if not comes or "velocity" not in given or given.get("kind", "mass") not in ALONG_AXIS:
        return read_body("impactor", given)
    fastest = SPEED_RANGE[1]
    found: Any = read_body("impactor", {**given, "velocity": fastest})
    velocity = validation.number("impactor.velocity", given["velocity"], -fastest, fastest, "m/s")
    moving = {"rods": tuple(replace(rod, velocity=velocity) for rod in found.rods)} if isinstance(found, Rods) else {}
    return replace(found, velocity=velocity, **moving)


def _on_rod(pulse: Pulse, target: AnyBody, contact: object) -> Pulse:
    """A prescribed force, which needs a rod to act on and no contact."""
    if not isinstance(target, Waveguide):
        raise SceneError("target.kind", target.kind, allowed("pulse-on-rod"))
    if contact is not None and contact != {"law": "rigid"}:
        raise SceneError("contact", contact, allowed("no-contact"))
    return pulse.on(target.impedance)


def _check_approach(impactor: AnyBody, target: AnyBody) -> None:
    """The bodies must come closer."""
    if isinstance(impactor, Mechanism) and impactor.velocity - target.velocity < SPEED_RANGE[0]:
        values = {"link": impactor.struck.link, "velocity": impactor.velocity, "target": target.velocity}
        raise SceneError("impactor.struck", impactor.struck.table(), allowed("striking-link-approaches", **values))
    if isinstance(impactor, Mechanism) and target.held and math.isinf(impactor.frozen.rigid_mass):
        drives = [drive.table() for drive in impactor.drives]
        raise SceneError("impactor.drives", drives, allowed("drive-gives-way", link=impactor.struck.link))
    if isinstance(target, Mechanism) and impactor.velocity - target.velocity < SPEED_RANGE[0]:
        reason = allowed("struck-link-approaches", link=target.struck.link, velocity=target.velocity)
        raise SceneError("impactor.velocity", impactor.velocity, reason)
    if impactor.velocity - target.velocity < SPEED_RANGE[0]:
        raise SceneError("target.velocity", target.velocity, allowed("approach", velocity=impactor.velocity))


def _check_masses(impactor: AnyBody, target: AnyBody) -> None:
    """Each body must feel the other."""
    ratio = target.mass / impactor.mass
    if not 1.0 / LARGEST_MASS_RATIO <= ratio <= LARGEST_MASS_RATIO and ratio != math.inf:
        low, high = target.mass / LARGEST_MASS_RATIO, target.mass * LARGEST_MASS_RATIO
        bounds = {name: bound_beside(bound, impactor.mass, 3) for name, bound in (("low", low), ("high", high))}
        raise SceneError("impactor.mass", impactor.mass, allowed("impactor-mass", **bounds))
