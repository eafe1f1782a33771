"""Pendulums: bodies that turn about a fixed pivot, rigid or bending as they swing."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple, Self

from .. import validation
from ..numerics.beams.statics import rigid_motion
from ..numerics.elements.mesh import Mesh, about_pivot, point_mesh
from ..numerics.modes import Modes, rigid_body
from ..text.notes import Note
from ..validation import SceneError, allowed
from .beams import CLOSEST, LARGEST_DAMPING, THEORIES, Beam, read_beam_section
from .lumped import MASS_RANGE, SPEED_RANGE, Lumped
from .material import LENGTH_RANGE, MATERIALS, Material, read_material, read_radius, required_material
from .protocol import AnyBody
from .sections import section_of_bar

SHAPES = ("pinned-free", "clamped-free")
INERTIA_RANGE = (1e-30, 1e24)  # kg m2
MODES_RANGE = (1, 500)
BENDING_KEYS = ("shapes", "theory", "damping")  # of a pendulum that bends
ROUNDING = 1e-9  # of what files say in digits: an inertia that is just that of a point mass


class Swing(NamedTuple):
    """How a pendulum goes on after an impact."""

    spin: float  # [rad/s]: moment of momentum about the pivot over the inertia, (10.13)
    centre_velocity: float  # of its centre of mass [m/s]
    pivot_impulse: float  # that the pivot has given it, along the impact [N s]
    felt_mass: float  # at the contact [kg], (9.4)


class Pivoted(AnyBody):
    """A body on a fixed pivot, struck across at `pivot_distance` from it.

    As a whole it has one motion, the turning, by which it is felt at the contact as the mass I0 / L_p^2 that moves at
    spin * L_p: `mass` and `velocity` are these, and all methods for a free mass hold. Gravity has no time to act.
    Source: thesis 9.1, (9.2)-(9.4). Differs: (9.3) prints I and L for I0 and L_p.
    """

    kind = "pendulum"
    held = swings = turns = False  # it is felt as a free mass
    pivot_distance: float  # L_p, from the pivot to the contact [m]
    spin: float  # before the impact [rad/s], positive where that moves the contact the way the impactor goes
    inertia: float  # I0, about the pivot [kg m2]
    own_mass: float  # of all of it [kg]
    centre: float  # of mass, from the pivot [m]

    def of_velocity(self, velocity: float) -> dict[str, float]:
        return {"spin": velocity / self.pivot_distance}

    def swing(self, velocity: float, push: float) -> Swing:
        """After an impulse `push` [N s] on it; its place of contact, turning as a whole, moves at `velocity` [m/s].

        What the pivot gives follows from the momentum of all of it, without what it gives and takes back as the
        pendulum goes on ringing. It is nothing where the contact is at the centre of percussion, I0 / (m d) from there.
        """
        spin = velocity / self.pivot_distance
        gained = self.own_mass * self.centre * (spin - self.velocity / self.pivot_distance)
        return Swing(spin, self.centre * spin, gained - push, self.mass)


@dataclass(frozen=True)
class Pendulum(Pivoted, Lumped):
    """A rigid pendulum, of any shape or a uniform bar; with `modes` in its table it is a `FlexiblePendulum`."""

    pivot_distance: float
    spin: float
    inertia: float
    own_mass: float
    centre: float
    radius: float | None = None  # of curvature at the contact [m]
    material: Material = MATERIALS["steel"]
    bar_length: float | None = None  # [m]; None: of a shape that is not known

    KEYS = (
        "kind", "pivot_distance", "at", "mass", "inertia", "centre", "length", "section", "material", "radius", "spin",
        "modes", *BENDING_KEYS,
    )  # fmt: skip
    free_mass = True

    @classmethod
    def read(cls, key: str, given: Mapping[str, Any]) -> "Pendulum | FlexiblePendulum":
        given = validation.table(key, given, cls.KEYS)
        if given.get("modes") is not None:
            return FlexiblePendulum.read(key, given)
        for name in BENDING_KEYS:
            if name in given:
                raise SceneError(f"{key}.{name}", given[name], allowed("with-modes"))
        length = None
        if "length" in given:
            length = validation.number(f"{key}.length", given["length"], *LENGTH_RANGE, "m")
        mass, inertia = _read_mass(key, given, length)
        distance = _read_distance(key, given, length)
        return cls(
            distance,
            _read_spin(key, given, distance),
            inertia,
            mass,
            _read_centre(key, given, length, mass, inertia),
            read_radius(f"{key}.radius", given.get("radius")),
            read_material(f"{key}.material", given.get("material", "steel")),
            length,
        )

    @property
    def mass(self) -> float:
        """Felt at the contact [kg], (9.4)."""
        return self.inertia / self.pivot_distance**2

    @property
    def velocity(self) -> float:
        """Of the place of contact [m/s]."""
        return self.spin * self.pivot_distance

    def of_mass(self, mass: float) -> dict[str, float]:
        return {"inertia": mass * self.pivot_distance**2, "mass": self.own_mass * mass / self.mass}

    def modes(self, count: int) -> Modes:
        return rigid_body(self.mass)

    def mesh(self, elements: int, lumping: float = 0.0) -> Mesh:
        return point_mesh(self.mass)

    def table(self) -> dict[str, Any]:
        written: dict[str, Any] = {"kind": self.kind}
        names = {name: name for name in ("pivot_distance", "inertia", "centre", "spin", "radius")}
        for name, own in (names | {"mass": "own_mass", "length": "bar_length"}).items():
            if getattr(self, own) is not None:
                written[name] = getattr(self, own)
        return written | {"material": self.material.table()}


@dataclass(frozen=True)
class FlexiblePendulum(Pivoted, Beam):
    """A uniform bar on a pivot that bends as it swings, by its own number of modes whatever the method takes of others.

    `shapes` are those of a bar pinned at the pivot, which are its natural modes, or those of one clamped there, in a
    frame that turns with its section at the pivot: see `numerics.beams.clamped_frame`.
    Source: thesis 9.5 and 10.3.
    """

    spin: float = 0.0
    count: int = 5  # of modes
    shapes: str = SHAPES[0]

    KEYS = Pendulum.KEYS
    own_modes = True

    @classmethod
    def read(cls, key: str, given: Mapping[str, Any]) -> Self:
        for name in ("mass", "inertia", "centre"):
            if name in given:
                raise SceneError(f"{key}.{name}", given[name], allowed("rigid-pendulum"))
        length = validation.required_number(key, given, "length", *LENGTH_RANGE, "m")
        distance = _read_distance(key, given, length)
        if not CLOSEST * length <= distance <= length:
            reason = validation.a_number(CLOSEST * length, length, "m")
            raise SceneError(f"{key}.pivot_distance", distance, reason)
        at = float(given.get("at", distance / length))
        spin = _read_spin(key, given, at * length)
        return cls(
            length,
            read_beam_section(key, given),
            required_material(key, given),
            "pinned-free",
            validation.choice(f"{key}.theory", given.get("theory", THEORIES[0]), THEORIES),
            at,
            spin * at * length,
            0.0,
            validation.number(f"{key}.damping", given.get("damping", 0.0), 0.0, LARGEST_DAMPING),
            read_radius(f"{key}.radius", given.get("radius")),
            spin,
            validation.whole_number(f"{key}.modes", given["modes"], *MODES_RANGE),
            validation.choice(f"{key}.shapes", given.get("shapes", SHAPES[0]), SHAPES),
        )

    @property
    def pivot_distance(self) -> float:
        return self.place

    @property
    def own_mass(self) -> float:
        return self.line.mass

    @property
    def centre(self) -> float:
        return 0.5 * self.length

    @property
    def mass(self) -> float:
        """Felt at the contact by its turning as a whole [kg], (9.4)."""
        return rigid_motion(self.line, self.support, self.place).mass

    @property
    def inertia(self) -> float:
        return self.mass * self.place**2

    def modes(self, count: int) -> Modes:
        """Its own number of them. Averages are those of the moment of momentum, to which vibrations add nothing."""
        attached = self.shapes == "clamped-free"
        modes = self.attached_modes(self.count) if attached else super().modes(self.count)
        return replace(modes, means=None, rigid_mean=1.0)

    def with_share_of_modes(self, share: float) -> Self:
        return replace(self, count=max(1, round(share * self.count)))

    def with_own_modes(self, count: int) -> Self:
        return replace(self, count=count)

    def notes_on_modes(self, count: int) -> list[Note]:
        return super().notes_on_modes(self.count)

    def mesh(self, elements: int, lumping: float = 0.0) -> Mesh:
        return about_pivot(super().mesh(elements, lumping))

    def table(self) -> dict[str, Any]:
        written = super().table()
        for name in ("support", "velocity"):
            written.pop(name, None)
        own = {"spin": self.spin, "modes": self.count, "shapes": self.shapes}
        return written | {"kind": self.kind} | own


def _read_distance(key: str, given: Mapping[str, Any], length: float | None) -> float:
    """`pivot_distance` [m], or of a bar `at`, the fraction of its length."""
    if "at" not in given:
        return validation.required_number(key, given, "pivot_distance", *LENGTH_RANGE, "m")
    if length is None:
        raise SceneError(f"{key}.at", given["at"], allowed("at-of-bar"))
    if "pivot_distance" in given:
        raise SceneError(f"{key}.at", given["at"], allowed("nothing-beside", other="pivot_distance"))
    return length * validation.number(f"{key}.at", given["at"], CLOSEST, 1.0)


def _read_mass(key: str, given: Mapping[str, Any], length: float | None) -> tuple[float, float]:
    """Mass [kg] and inertia about the pivot [kg m2]; of a bar those of a uniform one, unless given."""
    usual: dict[str, float] = {}
    if length is not None and not {"mass", "inertia"} <= set(given):
        density, area = required_material(key, given).density, section_of_bar(key, given).area
        usual["mass"] = density * area * length
        mass = float(given["mass"]) if isinstance(given.get("mass"), (int, float)) else usual["mass"]
        usual["inertia"] = mass * length**2 / 3.0
    return (
        validation.required_number(key, usual | dict(given), "mass", *MASS_RANGE, "kg"),
        validation.required_number(key, usual | dict(given), "inertia", *INERTIA_RANGE, "kg m2"),
    )


def _read_centre(key: str, given: Mapping[str, Any], length: float | None, mass: float, inertia: float) -> float:
    """Distance of the centre of mass [m]; unless given, half the length, or half that of the bar of this inertia."""
    farthest = math.sqrt(inertia / mass)  # where all the mass is in one point
    usual = 0.5 * length if length is not None else 0.5 * math.sqrt(3.0) * farthest
    if "centre" in given:
        return validation.number(f"{key}.centre", given["centre"], 0.0, farthest * (1.0 + ROUNDING), "m")
    if usual > farthest * (1.0 + ROUNDING):
        reason = validation.a_number(mass * usual**2, INERTIA_RANGE[1], "kg m2")
        raise SceneError(f"{key}.inertia", inertia, reason)
    return usual


def _read_spin(key: str, given: Mapping[str, Any], distance: float) -> float:
    """[rad/s]; of an impactor towards the target, and it cannot be left out."""
    slowest, fastest = (speed / distance for speed in SPEED_RANGE)
    if key == "impactor":
        return validation.required_number(key, given, "spin", slowest, fastest, "rad/s")
    return validation.number(f"{key}.spin", given.get("spin", 0.0), -fastest, fastest, "rad/s")
