"""What methods may ask of a body, whatever its kind.

A kind says what it is capable of by the class it is built on and by what it answers here: `Lumped`, where nothing but
a mass and perhaps a spring is at work; `rods.Waveguide`, along which waves keep their shape; `beams.Bending`; natural
modes, unless `no_modes` says why not; a mesh, unless it is `endless`. Methods ask for that, and for no kind by name,
so that a new kind is taken by all methods that can solve it.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, ClassVar, Self, TypeVar

from ..numerics.elements.mesh import Mesh
from ..numerics.modes import Modes
from ..text.notes import Note, Severity
from .material import Material

Known = TypeVar("Known")


class AnyBody(ABC):
    """A body on the axis of the contact, or what acts in its place. What a kind does not say is as it stands here.

    x of its fields runs from where it is struck, or from its first support, to `length`.
    """

    KEYS: ClassVar[tuple[str, ...]]  # of its table in a scene file

    kind: str  # its word in scene files
    mass: float  # [kg], with all that is fixed to it; infinite of a wall
    velocity: float  # before the impact [m/s], positive the way the impactor goes
    acceleration: float = 0.0  # by itself, without the impact, against what strikes it [m/s2], positive the same way
    jerk: float = 0.0  # how fast that changes [m/s3]
    material: Material | None  # at the contact; None: rigid
    length: float  # [m]; 0: it has no places of its own
    radius: float | None = None  # of curvature at the contact [m]; None: flat
    end_mass: float = 0.0  # a rigid one on its far end [kg], part of `mass`
    damping: float = 0.0  # of every mode, as a fraction of the critical

    fixed: bool = False  # whether it cannot move as a whole
    held: bool = False  # whether something outside takes up momentum
    swings: bool = False  # whether it moves on as a whole though it is held
    turns: bool = False  # whether an impact turns it as it moves on
    free_mass: bool = False  # whether it is one rigid mass, free to move, which `of_mass` can change
    bends: bool = False  # whether it is `beams.Bending`
    endless: bool = False  # whether waves run away in it for good
    bonded: bool = True  # whether all its parts stay together, whatever strikes it

    own_modes: bool = False  # whether it says itself how many modes it has, whatever a method asks for

    round_trip_time: float | None = None  # of a wave that keeps its shape [s]
    time_unit: float | None = None  # in which its impacts are measured [s]; None: nothing rings in it
    half_swing: float | None = None  # half a period of a mass on its spring [s]; None: there is none
    softness: float = (
        0.0  # static compliance of what bends in it [m/N]; of what is free, against its inertia or about so
    )
    stress_source: tuple[str, float] = ("slopes", 0.0)  # the field of its shapes that stress follows, and the factor
    rods: tuple[Any, ...] = ()  # along which waves keep their shape, from where it is struck on: of `rods.Waveguide`

    @classmethod
    @abstractmethod
    def read(cls, key: str, given: Mapping[str, Any]) -> Self:
        """From the table `[impactor]` or `[target]` of a scene file. Raises SceneError naming the key."""

    @abstractmethod
    def table(self) -> dict[str, Any]:
        """As in a scene file."""

    @property
    def no_modes(self) -> Note | None:
        """Why its natural modes are not known, and what to use instead; None: they are."""
        known = type(self).modes is not AnyBody.modes
        return None if known else Note("refusals.no-modes", Severity.REFUSAL, body=self.kind)

    @property
    def has_mesh(self) -> bool:
        """Whether it can be divided into elements, or is but a mass or a support."""
        return type(self).mesh is not AnyBody.mesh

    def known_as(self, kind: type[Known]) -> Known:
        """Itself, as of this class: of which a method has made sure before it solves."""
        assert isinstance(self, kind), f"a {self.kind} is no {kind.__name__}"
        return self

    @property
    def gives_way(self) -> bool:
        """Whether it lets a rigid contact begin, as more rings in it than the modes that are kept."""
        return self.time_unit is not None

    @property
    def slowest_period(self) -> float | None:
        """No vibration or swing of its own is slower [s]; None: nothing rings or swings in it."""
        return self.time_unit if self.half_swing is None else 2.0 * self.half_swing

    @property
    def face_compliance(self) -> float:
        """How far its struck face gives way, or less, under 1 N at rest, or against its inertia if it is free [m/N]."""
        return self.softness

    @property
    def kinetic_energy(self) -> float:
        """Before the impact [J]."""
        return 0.5 * self.mass * self.velocity**2 if self.velocity else 0.0

    @property
    def effective_mass(self) -> float:
        """What a rigid impact on it feels [kg]; infinite where it is held."""
        return math.inf if self.held else self.mass

    def of_mass(self, mass: float) -> dict[str, float]:
        """What in its table gives it this mass [kg]; empty: no one key does."""
        return {}

    def of_velocity(self, velocity: float) -> dict[str, float]:
        """What in its table gives it this velocity [m/s] where it strikes or is struck."""
        return {"velocity": velocity}

    def with_share_of_modes(self, share: float) -> Self:
        """Itself known by this share of its modes, where their number is its own and not the method's."""
        return self

    def with_single_elements_cut(self, elements: int) -> Self:
        """Itself with every rod cut in two of which a mesh of about so many elements has one only."""
        return self

    def with_own_modes(self, count: int) -> Self:
        """Itself by so many modes, or by as many as it can have, where their number is its own."""
        return self

    def notes(self) -> list[Note]:
        """What lies outside the theory of it, with the limit."""
        return []

    def figures(self) -> dict[str, Any]:
        """What results say of it, whatever strikes it: keys and values."""
        return {}

    def usual_impactor(self) -> dict[str, Any] | None:
        """The table of what strikes it, where a scene does not say; None: it must."""
        return None

    def modes(self, count: int) -> Modes:
        """Its motion as a whole and its lowest natural modes."""
        raise TypeError(str(self.no_modes))

    def mesh(self, elements: int, lumping: float = 0.0) -> Mesh:
        """Two-node elements; `lumping` of the mass of rods stands on the nodes."""
        raise TypeError(f"a {self.kind} is not divided into elements")


class Lumped(AnyBody):
    """A body in which no wave runs: it is known by its mass, and by a spring if it is on one."""

    length = 0.0
