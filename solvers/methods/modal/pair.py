"""The modes of two bodies side by side, as one bank of oscillators."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ...contact import Linear
from ...numerics.modes import Modes
from ...numerics.oscillators import Bank, oscillator_bank
from ...scene import Scene


@dataclass(frozen=True)
class Pair:
    """The modes of both bodies side by side, as one bank of oscillators: the bending of either opens the contact."""

    impactor: Modes
    target: Modes
    truncated: tuple[bool, bool]  # whether modes of impactor and of target were left out
    damping_ratios: tuple[float, float] = (0.0, 0.0)  # of the modes of either, as fractions of the critical

    @cached_property
    def frequencies(self) -> np.ndarray:
        return np.concatenate((self.impactor.frequencies, self.target.frequencies))

    @cached_property
    def at_contact(self) -> np.ndarray:
        return np.concatenate((self.impactor.at_contact, self.target.at_contact))

    @property
    def split(self) -> int:
        """Number of the impactor's oscillators, which come first."""
        return self.impactor.frequencies.size

    @property
    def residual_compliance(self) -> float:
        """Of the modes left out of both bodies [m/N]."""
        return self.impactor.residual_compliance + self.target.residual_compliance

    @cached_property
    def resolved_time(self) -> float:
        """The shortest kept period, the longer one of two bodies [s]: nothing finer is known; 0 if none is left out."""
        parts = zip((self.impactor, self.target), self.truncated, strict=True)
        return max((modes.shortest_period for modes, truncated in parts if truncated), default=0.0)

    @cached_property
    def damping(self) -> np.ndarray:
        """Of every oscillator."""
        return np.repeat(self.damping_ratios, (self.split, self.frequencies.size - self.split))

    def bank(self, step: float) -> Bank:
        return oscillator_bank(self.frequencies, self.at_contact, step, damping=self.damping)

    def law(self, scene: Scene) -> tuple[Any, float]:
        """The law for the kernel, and the compliance in series with it [m/N]; rigid contact is that compliance."""
        if scene.rigid_contact:
            return Linear(1.0 / self.residual_compliance), 0.0
        return scene.contact, self.residual_compliance
