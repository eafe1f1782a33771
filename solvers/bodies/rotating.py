"""Rods that turn about an axis through one end: their waves disperse, they stretch, and bending is stiffened."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from .. import validation
from ..numerics.beams.modes import BeamLine, beam_modes
from ..numerics.beams.rotating import rotating_beam_modes, rotating_frequencies, simplified_squares
from ..numerics.modes import Modes
from ..numerics.rods import rotating_rod_modes
from ..text.notes import Note, Severity
from .beams import CLOSEST, LARGEST_DAMPING, SLENDER, read_beam_section
from .material import LENGTH_RANGE, Material, read_radius, required_material
from .protocol import AnyBody
from .sections import Section, section_of_bar

FREQUENCIES = 10  # listed in results
SERIES_TERMS = 1_000  # of the steady stretch, (5.54)
PLACES = 11  # at which the steady displacement is listed
MAX_SHARE_OF_CRITICAL = 1.0 - 1e-6
MAX_STRAIN = 0.01  # of the root, beyond which small strain is no longer true; said in a note
AXIAL, ACROSS = "fixed", "cantilever"  # supports at the axis of rods and of beams


@dataclass(frozen=True)
class RotatingRod(AnyBody):
    """A uniform rod that turns at a constant speed about an axis through its far end, struck on its end, or across.

    With the support of a rod it moves along its length only, as in a stiff tube: displacements are those from its
    steady stretch, in the turning frame. With that of a beam it bends in the plane of rotation.
    Assumes: small strain; along, no bending, and across, no stretching, so that Coriolis forces do nothing.
    x of its fields runs from the struck end of a rod, from the axis of a beam.
    Source: thesis 5.6. Differs: (5.55), (5.56) leave out the tension; the text after (5.54) says that the shape of the
    steady stretch is the same at any speed.
    """

    length: float  # L [m]
    section: Section
    material: Material
    speed: float  # Omega [rad/s]
    support: str = AXIAL
    at: float = 1.0  # where it is struck, as a fraction of the length from the axis
    damping: float = 0.0
    radius: float | None = None

    KEYS = ("kind", "length", "section", "material", "speed", "support", "theory", "at", "damping", "radius")
    kind = "rotating-rod"
    velocity = 0.0
    fixed = held = True

    @classmethod
    def read(cls, key: str, given: Mapping[str, Any]) -> "RotatingRod":
        given = validation.table(key, given, cls.KEYS)
        usual = ACROSS if "theory" in given else AXIAL
        support = validation.choice(f"{key}.support", given.get("support", usual), (AXIAL, ACROSS))
        across = support == ACROSS
        if "theory" in given:
            theories = ("euler-bernoulli",) if across else ()
            validation.choice(f"{key}.theory", given["theory"], theories)
        rod = cls(
            validation.required_number(key, given, "length", *LENGTH_RANGE, "m"),
            read_beam_section(key, given) if across else section_of_bar(key, given),
            required_material(key, given),
            0.0,
            support,
            validation.number(f"{key}.at", given.get("at", 1.0), CLOSEST if across else 1.0, 1.0),
            validation.number(f"{key}.damping", given.get("damping", 0.0), 0.0, LARGEST_DAMPING),
            read_radius(f"{key}.radius", given.get("radius")),
        )
        fastest = MAX_SHARE_OF_CRITICAL * rod.critical_speed
        return replace(rod, speed=validation.required_number(key, given, "speed", 0.0, fastest, "rad/s"))

    @property
    def across(self) -> bool:
        """Whether it bends."""
        return self.support == ACROSS

    @property
    def mass(self) -> float:
        return self.material.density * self.section.area * self.length

    @property
    def wave_speed(self) -> float:
        """c = sqrt(E / rho) [m/s]"""
        return math.sqrt(self.material.young / self.material.density)

    @property
    def impedance(self) -> float:
        """rho c A [kg/s]"""
        return self.material.density * self.wave_speed * self.section.area

    @property
    def place(self) -> float:
        """Where it is struck [m], from where x of its fields runs."""
        return self.at * self.length if self.across else 0.0

    @property
    def critical_speed(self) -> float:
        """At which the lowest frequency along it would be zero and its stretch infinite [rad/s], (5.50)."""
        return 0.5 * math.pi * self.wave_speed / self.length

    @property
    def angle(self) -> float:
        """a = Omega L / c: pi / 2 at the critical speed."""
        return self.speed * self.length / self.wave_speed

    @property
    def steady_stretch(self) -> float:
        """Of its end [m]: L (tan a / a - 1)."""
        return float(self.steady_displacement(np.array([self.length]))[0])

    @property
    def root_strain(self) -> float:
        """Of the steady stretch where it is largest, at the axis: sec a - 1."""
        return 2.0 * math.sin(0.5 * self.angle) ** 2 / math.cos(self.angle)

    def steady_displacement(self, x: np.ndarray) -> np.ndarray:
        """u(x) = sin(k x) / (k cos k L) - x with k = Omega / c, at x [m] from the axis. The sum of (5.54)."""
        part, a = np.asarray(x, float) / self.length, self.angle
        if a < 1e-3:  # of second order in a, where the difference would cancel; the next term is of fourth
            return self.length * a**2 * part * (0.5 - part**2 / 6.0)
        return self.length * (np.sin(a * part) / (a * math.cos(a)) - part)

    def steady_series(self, x: np.ndarray, terms: int = SERIES_TERMS) -> np.ndarray:
        """The same by the first terms of (5.54); what is left out falls with their third power at the end."""
        odd = 2.0 * np.arange(1, terms + 1) - 1.0
        ratio = (self.speed / (odd * self.critical_speed)) ** 2  # eta^2
        waves = 0.5 * math.pi * odd / self.length
        sizes = 2.0 * (-1.0) ** np.arange(terms) * ratio / ((1.0 - ratio) * waves**2 * self.length)
        return sizes @ np.sin(np.multiply.outer(waves, np.asarray(x, float)))

    @cached_property
    def time_unit(self) -> float:
        """Round trip of a wave along it, 2 L / c, or its slowest period of bending [s]."""
        if self.across:
            return 2.0 * math.pi / float(rotating_frequencies(self.line, self.speed, 1)[0])
        return 2.0 * self.length / self.wave_speed

    @property
    def slowest_period(self) -> float:
        return 2.0 * math.pi / float(self.modes(1).frequencies[0])

    @property
    def line(self) -> BeamLine:
        """What bends of it."""
        second = self.section.second_moment
        return BeamLine(self.length, self.material.young * second, self.material.density * self.section.area)

    @property
    def softness(self) -> float:
        return self.modes(1).residual_compliance + float((self.modes(1).at_contact / self.modes(1).frequencies)[0] ** 2)

    @property
    def stress_source(self) -> tuple[str, float]:
        if self.across:
            return "moments", self.section.half_depth / self.section.second_moment
        return "slopes", self.material.young

    def modes(self, count: int) -> Modes:
        if self.across:
            return rotating_beam_modes(self.line, self.place, self.speed, count)
        return rotating_rod_modes(self.length, self.mass, self.wave_speed, self.speed, count)

    def notes(self) -> list[Note]:
        found = []
        if self.root_strain > MAX_STRAIN:
            strain, share = 100.0 * self.root_strain, self.speed / self.critical_speed
            found.append(Note("rotation-strains", Severity.WARNING, strain=strain, share=share))
        least = SLENDER["euler-bernoulli"]
        slenderness = self.length / (2.0 * (self.section.half_depth or math.inf))
        if self.across and slenderness < least:
            values = {"slenderness": slenderness, "theory": "euler-bernoulli", "least": least}
            found.append(Note("beam-not-slender", Severity.WARNING, **values))
        return found

    def figures(self) -> dict[str, Any]:
        """Of its rotation: frequencies in the turning frame, what is critical, the steady stretch, and "simplified",
        bending by the thesis's (5.56), whose instability is false.
        """
        along = self._along()
        bending = None
        if self.section.second_moment is not None:
            bending = rotating_frequencies(self.line, self.speed, FREQUENCIES).tolist()
        x = np.linspace(0.0, self.length, PLACES)
        return {
            "frequencies": bending if self.across else along["frequencies"],
            "axial": along,
            **({} if bending is None else {"bending": {"frequencies": bending}, "simplified": self._simplified()}),
            "critical_speed": self.critical_speed,
            "steady_stretch": self.steady_stretch,
            "steady_stretch_by_series": float(self.steady_series(x[-1:])[0]),
            "steady_displacement": np.column_stack((x, self.steady_displacement(x))).tolist(),
            "root_strain": self.root_strain,
        }

    def _along(self) -> dict[str, list[float]]:
        """(5.48), (5.49): dispersive, the faster the rod turns; fronts still travel at c."""
        waves = 0.5 * math.pi * (2.0 * np.arange(1, FREQUENCIES + 1) - 1.0) / self.length
        root = np.sqrt(1.0 - (self.speed / (self.wave_speed * waves)) ** 2)
        return {
            "frequencies": (self.wave_speed * waves * root).tolist(),
            "phase_speeds": (self.wave_speed * root).tolist(),
            "group_speeds": (self.wave_speed / root).tolist(),
        }

    def _simplified(self) -> dict[str, Any]:
        """(5.56): frequencies, None where they are imaginary, and the speed from which the lowest is."""
        still = beam_modes(self.line, ACROSS, self.length, FREQUENCIES).frequencies
        squares = simplified_squares(still, self.speed)
        return {
            "frequencies": [math.sqrt(square) if square >= 0.0 else None for square in squares.tolist()],
            "critical_speed": float(still[0]),
            "stable": bool(squares[0] > 0.0),
        }

    def usual_impactor(self) -> dict[str, Any]:
        """What strikes it where nothing is said to."""
        return {"kind": "mass", "mass": self.mass, "velocity": 1.0}

    def table(self) -> dict[str, Any]:
        written: dict[str, Any] = {
            "kind": self.kind,
            "length": self.length,
            "section": self.section.table(),
            "material": self.material.table(),
            "speed": self.speed,
            "support": self.support,
            "at": self.at,
        }
        for name, nothing in (("damping", 0.0), ("radius", None)):
            if getattr(self, name) != nothing:
                written[name] = getattr(self, name)
        return written
