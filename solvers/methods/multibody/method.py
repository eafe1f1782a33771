"""A mechanism of rigid links followed through impacts as far as it moves."""

import math
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ...bodies import Mechanism
from ...numerics.multibody import bouncing, moving
from ...provenance import clock
from ...scene import Scene
from ...solution.solution import Solution
from ...text.notes import Note, Severity
from ..base import Method
from ..options import option, real, whole
from ..validity import cut_short
from .linkage import centres, rates_of_centres, rigid_linkage, struck_by
from .motion import MovingMotion

# Of the fastest link, or of the shortest one as it swings under its weight: with as many the energy of a double
# pendulum is kept to 1e-8, see `tests/solvers/numerics/multibody/test_moving.py`.
STEPS_PER_TURN = 200
MAX_STEPS = 1_000_000
MOST_IMPACTS = 2_000
USUAL_TURNS = 1.0  # for which it is followed, where no duration is asked for


@dataclass(frozen=True)
class Multibody(Method):
    """Rigid links that move as far as they like, joints closed in positions and velocities, by a symplectic integrator
    of sixth order; impacts of a point mass with a restitution, located to rounding.

    The mass strikes the line of the struck link along a normal that turns with it, and misses it beside its ends.
    Assumes: rigid links, impacts without duration or friction.
    Error: sixth order in the step; the energy does not drift.
    Source: thesis 6.3, (6.12); kernel: see `numerics.multibody.moving`.
    """

    restitution: float = option(1.0, real(0.0, 1.0))
    steps: int | None = option(None, whole(10, MAX_STEPS))  # over the whole duration
    estimate: bool = field(default=True, repr=False)

    NAME = "multibody"
    BEAMS = MOVES = True

    def why_not(self, scene: Scene) -> Note | None:
        target = scene.target
        if not isinstance(target, Mechanism):
            return Note("refusals.no-mechanism", Severity.REFUSAL, target=target.kind)
        if target.flexible:
            return Note("refusals.flexible-links", Severity.REFUSAL)
        if not scene.impactor.free_mass:
            return Note("refusals.mass-on-mechanism", Severity.REFUSAL, impactor=scene.impactor.kind)
        return None

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        begun = clock()
        motion, full = self._follow(scene, duration)
        wall_time = clock() - begun
        end = float(motion.time[-1])
        contacts = motion.contacts()
        energy = {name: float(value[-1]) for name, value in motion.energies(motion.time[-1:]).items()}
        initial = scene.initial_energy
        totals = sum(motion.energies(motion.time).values())
        final = float(motion.impactor_velocity(np.array([end]))[0])
        parted = float(motion.end_velocity(np.zeros(1))[0] - motion.impactor_velocity(np.zeros(1))[0])
        notes = [] if scene.rigid_contact else [Note("balance-without-law", Severity.WARNING)]
        if full:
            notes.append(cut_short(MOST_IMPACTS, "balances"))
        return Solution(
            scene=scene,
            method=self.table(),
            contacts=contacts,
            duration=end,
            motion=motion,
            impulse=float(motion.course.impulse[-1]),
            impactor_velocity=final,
            target_velocity=float(motion.rigid_velocity(np.array([end]))[0]),
            restitution={"newton": None, "poisson": self.restitution, "newton_at_contact": parted / scene.speed},
            energy={"initial": initial} | energy,
            diagnostics={
                "energy_error": (sum(energy.values()) - initial) / initial,
                "energy_drift": float(np.abs(totals - initial).max()) / initial,
                "momentum_error": self._momentum_error(scene, motion),
                "constraint_error": _widest_gap(scene, motion),
                "steps": motion.time.size - 2 * motion.impulses[0].size,
                "balances": motion.impulses[0].size,
                "wall_time": wall_time,
                "estimated_error": self._estimated_error(scene, motion) if self.estimate else None,
            },
            notes=notes,
            peak_force=None,
            peak_indentation=None,
            residual_indentation=None,
        )

    @staticmethod
    def _momentum_error(scene: Scene, motion: MovingMotion) -> float:
        """Of the first impact, along the normal: what the mass has lost and the impulse, over that of approach."""
        lost = scene.impactor.mass * (scene.impactor.velocity - float(motion.impactor_velocity(np.zeros(1))[0]))
        return (lost - float(motion.impulses[1][0])) / (scene.impactor.mass * scene.speed)

    def _estimated_error(self, scene: Scene, motion: MovingMotion) -> float:
        """Of the last velocity, relative to the speed of approach, against half the steps."""
        end = motion.time[-1:]
        half = max(10, (motion.time.size - 2 * motion.impulses[0].size) // 2)
        other, _ = replace(self, steps=half)._follow(scene, float(end[0]))
        return float(np.abs(other.impactor_velocity(end) - motion.impactor_velocity(end))[0]) / scene.speed

    def _follow(self, scene: Scene, duration: float | None) -> tuple[MovingMotion, bool]:
        """The motion, and whether it was ended by too many impacts."""
        mechanism = scene.target.known_as(Mechanism)
        linkage, rows = rigid_linkage(mechanism)
        contact, normal = struck_by(mechanism, scene.impactor.mass), np.array(mechanism.struck.normal)
        state, later = (
            bouncing.State(
                centres(mechanism),
                rates_of_centres(mechanism),
                mechanism.contact_point.copy(),
                scene.impactor.velocity * normal,
                np.zeros(rows.joint.size),
            )
            for _ in range(2)
        )
        turn = self._turn(mechanism, scene.speed)
        duration = USUAL_TURNS * turn if duration is None else duration
        steps = self.steps or min(MAX_STEPS, max(10, math.ceil(STEPS_PER_TURN * duration / turn)))
        kept = bouncing.course(steps + 2 * MOST_IMPACTS + 2, len(mechanism.links), rows.joint.size)
        count = bouncing.march(
            linkage, moving.work(rows.joint.size, state.q.size), contact, moving.STAGES, self.restitution,
            duration / steps, steps, state, later, kept,
        )  # fmt: skip
        course = bouncing.Course(*(values[:count] for values in kept))
        full = float(course.time[-1]) < duration * (1.0 - 1e-9)
        return MovingMotion(scene, course, rows, linkage.lines.direction), full

    @staticmethod
    def _turn(mechanism: Mechanism, speed: float) -> float:
        """Shortest time in which a link turns once, as fast as it is or as the mass can make it, or swings [s]."""
        system, rates = mechanism.system, mechanism.frozen.rates
        lengths = np.array([link.length or math.inf for link in system.links])
        spins = np.abs([system.spin(i, rates) for i in range(len(system.links))])
        shortest = float(lengths.min())
        swing = math.sqrt(1.5 * float(np.hypot(*system.gravity)) / shortest)
        fastest = max(float(spins.max()), 2.0 * speed / shortest, swing)
        return 2.0 * math.pi / fastest if fastest > 0.0 else 1.0


def _widest_gap(scene: Scene, motion: MovingMotion) -> float:
    """By how much any joint is ever open at the instants [m]."""
    linkage, rows = rigid_linkage(scene.target.known_as(Mechanism))
    count, size = rows.joint.size, motion.course.coordinates.shape[1]
    room: Any = moving.work(count, size)
    worst = 0.0
    for time, q in zip(motion.course.time.tolist(), motion.course.coordinates, strict=True):
        moving.joints_at(linkage, q, time, room.gap, room.jacobian, room.moving)
        worst = max(worst, float(np.abs(room.gap).max(initial=0.0)))
    return worst
