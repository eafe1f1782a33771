"""Straight beams struck across: bending waves, which disperse."""

import math
from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from .. import validation
from ..numerics.beams.clamped_frame import clamped_frame_modes
from ..numerics.beams.modes import BeamLine, attached_beam_modes, beam_modes, dispersion
from ..numerics.beams.statics import static_compliance
from ..numerics.elements.beam import beam_mesh
from ..numerics.elements.mesh import Mesh
from ..numerics.modes import Modes
from ..text.notes import Note, Severity
from ..validation import SceneError
from .lumped import MASS_RANGE, read_impact_velocity, read_target_velocity
from .material import LENGTH_RANGE, Material, read_radius, required_material
from .protocol import AnyBody
from .sections import Section, section_of_bar

SUPPORTS = ("cantilever", "pinned-pinned", "clamped-clamped", "free-free", "pinned-free")
SAME_SUPPORTS = {  # other words for them, read with spaces or underlines, too
    "simply-supported": "pinned-pinned",
    "hinged-hinged": "pinned-pinned",
    "fixed-fixed": "clamped-clamped",
    "clamped-free": "cantilever",
    "fixed-free": "cantilever",
}
THEORIES = ("euler-bernoulli", "timoshenko")
USUAL_PLACES = {"cantilever": 1.0, "pinned-free": 1.0}  # fraction of the length; else the middle
CLOSEST = 1e-3  # to a place that a support holds, as a fraction of the length
LARGEST_DAMPING = 0.2  # modal damping ratio: light, so that modes stay apart
SLENDER = {"euler-bernoulli": 10.0, "timoshenko": 2.5}  # least length over depth at which a theory is of use
NEAR_NODE = 0.05  # of a mode's amplitude where it is largest, about 2 / sqrt(mass)


class Bending(AnyBody):
    """A body along which waves of bending run when it is struck across, the shorter the faster; on its supports."""

    support: str
    theory: str
    material: Material
    section: Section
    place: float  # where it is struck [m]
    line: BeamLine  # what its theory knows of it
    slenderness: float  # length over depth
    at: float  # the same as a fraction of the length
    time_unit: float
    bends = True

    @property
    def second_moment(self) -> float:
        """I [m4]"""
        return self.section.second_moment

    @property
    def half_depth(self) -> float:
        """Of the outer fibre from the neutral line [m]."""
        return self.section.half_depth

    @property
    def effective_mass(self) -> float:
        """Of what moves as a whole; it may turn as it goes off."""
        return self.modes(1).rigid_mass

    @property
    def softness(self) -> float:
        return static_compliance(self.line, self.support, self.place, self.end_mass)

    @property
    def stress_source(self) -> tuple[str, float]:
        """M / W on the side that is struck."""
        return "moments", self.half_depth / self.second_moment

    def joined_modes(self, count: int, mass: float) -> Modes:
        """Of the beam and a rigid mass [kg] that rides on it where it is struck; see `attached_beam_modes`."""
        return attached_beam_modes(self.line, self.support, self.place, count, mass, self.end_mass)

    @abstractmethod
    def halting_time(self, mass: float) -> float:
        """How long its waves take to slow down a rigid mass [kg] that has struck it rigidly [s]."""

    @abstractmethod
    def notes_on_modes(self, count: int) -> list[Note]:
        """What its lowest `count` modes cannot resolve of an impact, with the limit."""


@dataclass(frozen=True)
class Beam(Bending):
    """A uniform straight beam struck across its length; waves of bending run along it, the shorter the faster.

    Assumes: plane sections, small deflection, and that the section keeps its shape where it is struck. Theory
    "euler-bernoulli" leaves out shear deformation and rotary inertia; "timoshenko" has both.
    x runs from the first-named support (the clamp, the pin; of a free beam its left end) to `length`.
    Source: thesis 5.5, 8.4.1.
    """

    length: float  # L [m]
    section: Section
    material: Material
    support: str
    theory: str = "euler-bernoulli"
    at: float = 1.0  # where it is struck, as a fraction of the length
    velocity: float = 0.0  # of a free beam [m/s], positive the way the impactor goes
    end_mass: float = 0.0  # rigid mass on the free end of a cantilever [kg]
    damping: float = 0.0  # of every mode, as a fraction of the critical
    radius: float | None = None  # of curvature where it is struck [m]

    KEYS = (
        "kind", "length", "section", "material", "support", "theory", "at", "velocity", "end_mass", "damping", "radius",
    )  # fmt: skip
    kind = "beam"

    @classmethod
    def read(cls, key: str, given: Mapping[str, Any]) -> "Beam":
        given = validation.table(key, given, cls.KEYS)
        length = validation.required_number(key, given, "length", *LENGTH_RANGE, "m")
        material = required_material(key, given)
        if key == "impactor":
            support = validation.choice("impactor.support", given.get("support", "free-free"), ("free-free",))
            velocity = read_impact_velocity(given)
        else:
            support = _read_support(given.get("support", "cantilever"))
            velocity = read_target_velocity(given)
            if velocity != 0.0 and support != "free-free":
                raise SceneError("target.velocity", velocity, validation.allowed("still", support=["free-free"]))
        return cls(
            length,
            read_beam_section(key, given),
            material,
            support,
            validation.choice(f"{key}.theory", given.get("theory", "euler-bernoulli"), THEORIES),
            _read_place(key, given, support),
            velocity,
            _read_end_mass(key, given, support),
            validation.number(f"{key}.damping", given.get("damping", 0.0), 0.0, LARGEST_DAMPING),
            read_radius(f"{key}.radius", given.get("radius")),
        )

    @property
    def area(self) -> float:
        """A [m2]"""
        return self.section.area

    @property
    def shear_coefficient(self) -> float:
        """kappa"""
        return self.section.shear_coefficient_for(self.material.poisson)

    @property
    def shear_modulus(self) -> float:
        """G = E / 2 (1 + nu) [Pa]"""
        return 0.5 * self.material.young / (1.0 + self.material.poisson)

    @property
    def place(self) -> float:
        """Where it is struck [m]."""
        return self.at * self.length

    @property
    def fixed(self) -> bool:
        return self.support not in ("free-free", "pinned-free")

    @property
    def held(self) -> bool:
        return self.support != "free-free"

    @property
    def swings(self) -> bool:
        return self.support == "pinned-free"

    @property
    def turns(self) -> bool:
        return self.swings or (self.support == "free-free" and abs(self.at - 0.5) > 1e-12)

    @property
    def mass(self) -> float:
        """m2"""
        return self.material.density * self.area * self.length + self.end_mass

    @cached_property
    def line(self) -> BeamLine:
        """What the theory in use knows of it."""
        density, shears = self.material.density, self.theory == "timoshenko"
        return BeamLine(
            length=self.length,
            bending_stiffness=self.material.young * self.second_moment,
            mass_per_length=density * self.area,
            rotary_inertia=density * self.second_moment if shears else 0.0,
            shear_stiffness=self.shear_coefficient * self.shear_modulus * self.area if shears else math.inf,
        )

    @cached_property
    def time_unit(self) -> float:
        """Period of its slowest vibration [s]: the unit in which its impacts are measured."""
        return 2.0 * math.pi / float(self.modes(1).frequencies[0])

    def modes(self, count: int) -> Modes:
        return _modes(self.line, self.support, self.place, count, self.end_mass)

    def attached_modes(self, count: int) -> Modes:
        """Of a beam on a pin, as a frame fixed to its section there and shapes clamped there give them."""
        return _attached_modes(self.line, self.place, count)

    def halting_time(self, mass: float) -> float:
        """How long the bending waves take to slow down a rigid mass [kg] that has struck it rigidly [s].

        The period of the wave of which half a length weighs as much as the mass, a quarter as much next to a free end,
        which gives way four times as easily. Modes of longer periods alone are heavier than the mass: they throw it
        back at once. Infinite where there is an end mass to be struck.
        """
        wavenumber = math.pi * self.line.mass_per_length / mass
        free = [self.length - self.place] if self.support in ("cantilever", "free-free", "pinned-free") else []
        free += [self.place] if self.support == "free-free" else []
        if wavenumber * min(free, default=math.inf) < 1.0:
            if self.end_mass:
                return math.inf
            wavenumber *= 0.25
        return 2.0 * math.pi / float(dispersion(self.line, np.array([wavenumber]))[0][0])

    def mesh(self, elements: int, lumping: float = 0.0) -> Mesh:
        """Two-node elements with a node where it is struck; consistent mass, whatever `lumping` asks of rods."""
        return beam_mesh(self.line, self.support, self.place, elements, self.end_mass)

    @property
    def slenderness(self) -> float:
        """Length over depth."""
        return self.length / (2.0 * self.half_depth)

    def notes(self) -> list[Note]:
        least = SLENDER[self.theory]
        if self.slenderness >= least:
            return []
        values = {"slenderness": self.slenderness, "theory": self.theory, "least": least}
        return [Note("beam-not-slender", Severity.WARNING, **values)]

    def notes_on_modes(self, count: int) -> list[Note]:
        notes, reach = [], self.modes_within_reach(count)
        if np.abs(self.modes(count).at_contact).max() * math.sqrt(self.line.mass + self.end_mass) < NEAR_NODE:
            notes.append(Note("struck-at-node", Severity.WARNING, modes=count))
        if reach < count:
            notes.append(Note("modes-too-fast", Severity.WARNING, modes=count, fast=count - reach, most=reach))
        return notes

    def modes_within_reach(self, count: int) -> int:
        """How many of its `count` lowest modes have waves no faster than any can be in the material, sqrt(E / rho).

        Euler-Bernoulli theory lets short waves run as fast as one likes. Source: thesis 8.4.1.
        """
        frequencies = self.modes(count).frequencies
        line = self.line
        wavenumbers = (line.mass_per_length / line.bending_stiffness * frequencies**2) ** 0.25
        if self.theory == "timoshenko":
            return count
        return int((frequencies <= wavenumbers * math.sqrt(self.material.young / self.material.density)).sum())

    def table(self) -> dict[str, Any]:
        written = {
            "kind": "beam",
            "length": self.length,
            "section": self.section.table(),
            "material": self.material.table(),
            "support": self.support,
            "theory": self.theory,
            "at": self.at,
        }
        for name, nothing in (("velocity", 0.0), ("end_mass", 0.0), ("damping", 0.0), ("radius", None)):
            if getattr(self, name) != nothing:
                written[name] = getattr(self, name)
        return written


@lru_cache(maxsize=64)
def _modes(line: BeamLine, support: str, place: float, count: int, end_mass: float) -> Modes:
    """Kept, as one solve asks for them more than once, and a slider of the impactor for the same ones again."""
    return beam_modes(line, support, place, count, end_mass)


@lru_cache(maxsize=64)
def _attached_modes(line: BeamLine, place: float, count: int) -> Modes:
    """Kept as those are."""
    return clamped_frame_modes(line, place, count)


def read_beam_section(key: str, given: Mapping[str, Any]) -> Section:
    section = section_of_bar(key, given)
    if section.second_moment is None:
        raise SceneError(f"{key}.section.second_moment", None, validation.allowed("second-moment"))
    return section


def free_places(support: str) -> tuple[float, float]:
    """First and last place, as fractions of the length, where nothing holds a beam on this support."""
    first = 0.0 if support == "free-free" else CLOSEST
    return first, 1.0 - (CLOSEST if support in ("pinned-pinned", "clamped-clamped") else 0.0)


def _read_support(given: object) -> str:
    """One of SUPPORTS, whatever it was called."""
    word = "-".join(given.lower().replace("_", " ").replace("-", " ").split()) if isinstance(given, str) else given
    known = SAME_SUPPORTS.get(word, word) if isinstance(word, str) else word
    return validation.choice("target.support", known if known in SUPPORTS else given, SUPPORTS)


def _read_place(key: str, given: Mapping[str, Any], support: str) -> float:
    """`at`, a fraction of the length, not where a support holds the beam."""
    at = validation.number(f"{key}.at", given.get("at", USUAL_PLACES.get(support, 0.5)), 0.0, 1.0)
    first, last = free_places(support)
    if not first <= at <= last:
        raise SceneError(f"{key}.at", at, validation.allowed("free-place", low=first, high=last))
    return at


def _read_end_mass(key: str, given: Mapping[str, Any], support: str) -> float:
    if "end_mass" not in given:
        return 0.0
    if support != "cantilever":
        reason = validation.allowed("only-with", key="support", value=["cantilever"])
        raise SceneError(f"{key}.end_mass", given["end_mass"], reason)
    return validation.number(f"{key}.end_mass", given["end_mass"], *MASS_RANGE, "kg")
