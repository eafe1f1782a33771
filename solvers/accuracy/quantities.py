"""How far one answer to a scene is from another: one number for each question that can be asked of an impact."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..scene import Scene
from ..solution.motion import ResolvesForce
from ..solution.solution import ContactPeriod, Solution, apparent_time
from ..text.catalogue import SOURCE, library
from .comparison import FORCE_SAMPLES, overlapping
from .reference import rebound

HISTORIES = ("force-history", "resolved-force")  # quantities for which the force over time is needed
QUANTITIES = library(SOURCE).family("name.error-in")  # and what they are


@dataclass(frozen=True)
class Metrics:
    """What can be asked of one solution, without its motion: small, so that many can be kept.

    `force` and `resolved` are means over time, sampled at `times` [s], which end with the last contact.
    """

    velocity: np.ndarray  # final, of the impactor; of the target under a prescribed force [m/s]
    impulse: float
    peak_force: float | None
    contacts: tuple[ContactPeriod, ...]
    energy_error: float
    times: np.ndarray = field(repr=False)
    force: np.ndarray | None = field(repr=False)  # None: an impact of no duration, bodies in space, or not asked for
    resolved: np.ndarray | None = field(repr=False)

    @classmethod
    def of(cls, solution: Solution, histories: bool = True) -> "Metrics":
        """`histories`: whether the force over time is asked for, which may take as long as a quick solve."""
        until = max((contact.end for contact in solution.contacts), default=0.0)
        times = (np.arange(FORCE_SAMPLES) + 0.5) * until / FORCE_SAMPLES
        motion, force, resolved = solution.motion, None, None
        lasting = until > 0.0 and all(contact.peak_force is not None for contact in solution.contacts)
        if histories and lasting and motion is not None:
            force = np.asarray(motion.force(times), float)
            resolved = np.asarray(motion.resolved_force(times), float) if isinstance(motion, ResolvesForce) else force
        return cls(
            velocity=np.atleast_1d(rebound(solution)),
            impulse=solution.normal_impulse,
            peak_force=solution.peak_force or None,
            contacts=tuple(solution.contacts),
            energy_error=solution.diagnostics["energy_error"],
            times=times,
            force=force,
            resolved=resolved,
        )

    def same(self, other: "Metrics") -> bool:
        """Whether nothing at all has changed."""
        return bool(np.array_equal(self.velocity, other.velocity)) and self.contacts == other.contacts


@dataclass(frozen=True)
class Reference:
    """The answer that others are measured by, with its force at any time."""

    scene: Scene
    solution: Solution
    metrics: Metrics

    @classmethod
    def of(cls, solution: Solution, histories: bool = True) -> "Reference":
        return cls(solution.scene, solution, Metrics.of(solution, histories))

    def errors(self, found: Metrics) -> dict[str, float | Any]:
        """By quantity, found minus true where that has a sign; None where one of both has no such thing."""
        true = self.metrics
        lasted, truly = apparent_time(found.contacts), apparent_time(true.contacts)
        errors = {
            "rebound": _difference(found.velocity, true.velocity) / (self.scene.meeting_speed or 1.0),
            "impulse": (found.impulse - true.impulse) / abs(true.impulse) if true.impulse else None,
            "peak-force": _relative(found.peak_force, true.peak_force),
            "force-history": self._force_error(found, found.force),
            "resolved-force": self._force_error(found, found.resolved),
            "contact-time": _relative(lasted, truly),
            "energy": found.energy_error,
        }
        return {name: None if error is None or not np.isfinite(error) else error for name, error in errors.items()}

    def contacts(self, found: Metrics) -> tuple[int, int]:
        """How many true contacts it has, and how many that are none."""
        seen = sum(overlapping(self.metrics.contacts, found.contacts))
        return seen, len(found.contacts) - seen

    def _force_error(self, found: Metrics, force: np.ndarray | None) -> float | None:
        """Over the contacts of both, however long either lasts."""
        true = self.metrics
        if force is None or true.force is None:
            return None
        width, true_width = found.times[0], true.times[0]  # half of a cell each
        own = self.solution.known_motion.force(np.minimum(found.times, self.solution.duration))
        within = np.where(found.times < true.contacts[-1].end, own, 0.0)
        missed = true.force[true.times > found.times[-1] + width]
        whole = true_width * float(np.sum(true.force**2))
        wrong = width * float(np.sum((force - within) ** 2)) + true_width * float(np.sum(missed**2))
        return float(np.sqrt(wrong / whole))


def _relative(found: float | None, true: float | None) -> float | None:
    return None if found is None or true is None else found / true - 1.0


def _difference(found: np.ndarray, true: np.ndarray) -> float:
    return float(found[0] - true[0]) if found.size == 1 else float(np.linalg.norm(found - true))
