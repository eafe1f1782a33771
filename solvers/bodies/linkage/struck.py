"""What an impact feels of a mechanism: a body on the axis of the normal, at rest."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Self

import numpy as np

from ...numerics.modes import Modes
from ...numerics.multibody.frozen import Frozen
from ..material import Material
from ..protocol import AnyBody


@dataclass(frozen=True, eq=False)
class StruckMechanism(AnyBody):
    """A mechanism in the configuration in which it is struck, seen from its struck point: at rest, and held where its
    drives hold it. Positions are along the normal, from where it would be without the impact.
    """

    mechanism: Any  # the whole of it
    frozen: Frozen
    fibre: float  # stress on its struck side per unit of the bending moment there, 1 / W [1/m3]
    material: Material | None
    radius: float | None = None
    bends: bool = False
    falls: bool = True  # whether what strikes it does, by the gravity of the mechanism

    KEYS = ()
    kind = "mechanism"
    velocity = 0.0
    turns = own_modes = True

    @classmethod
    def read(cls, key: str, given: Mapping[str, Any]) -> Self:
        raise TypeError("a mechanism is read as a whole")

    def table(self) -> dict[str, Any]:
        raise TypeError("a mechanism is written as a whole")

    @property
    def most_modes(self) -> int:
        """Of any link, of bending or of stretching; 0 where all are rigid."""
        return self.mechanism.most_modes

    @property
    def refined(self) -> Self:
        """The same with more modes of each link that has any, of a mesh up to all it has."""
        return replace(self._finer.at_rest, falls=self.falls)

    @cached_property
    def _finer(self) -> Any:
        return self.mechanism.with_own_modes(self.mechanism.refined.most_modes)

    @property
    def acceleration(self) -> float:
        """Of its struck point against an impactor that falls freely, or is held."""
        weight = float(self.frozen.normal @ self.frozen.system.gravity)
        return self.frozen.acceleration - (weight if self.falls else 0.0)

    @cached_property
    def jerk(self) -> float:
        return self.frozen.jerk

    @property
    def mass(self) -> float:
        """Felt where it is struck; infinite where it is held."""
        return self.frozen.rigid_mass

    @property
    def effective_mass(self) -> float:
        return self.frozen.rigid_mass

    @property
    def held(self) -> bool:
        return math.isinf(self.mass)

    @property
    def fixed(self) -> bool:
        return self.held

    @property
    def length(self) -> float:
        return self.frozen.system.links[self.frozen.link].length

    @cached_property
    def time_unit(self) -> float | None:
        """Period of the slowest vibration that the impact sets going [s]; None if there is none."""
        moved = self.modes(0).excited().frequencies
        return 2.0 * math.pi / float(moved[0]) if moved.size else None

    @property
    def gives_way(self) -> bool:
        """Only where the struck link itself is flexible, and not all of it is in its modes."""
        return self.time_unit is not None and self.frozen.modes.residual_compliance > 0.0

    @cached_property
    def softness(self) -> float:
        modes = self.modes(0)
        return float(np.sum((modes.at_contact / modes.frequencies) ** 2)) + modes.residual_compliance

    @property
    def stress_source(self) -> tuple[str, float]:
        """M / W on the side that is struck."""
        return "moments", self.fibre

    def modes(self, count: int) -> Modes:
        """All of them, whatever the `count`: how many there are the links say."""
        return self.frozen.modes
