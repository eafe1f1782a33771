"""Impacts on mechanisms: what was solved at the struck point, seen in the laboratory with links and joints."""

from copy import copy
from functools import cached_property
from typing import Any

import numpy as np

from ..bodies import Mechanism
from ..numerics.multibody.mesh import ModeChange
from ..scene import Scene
from ..solution.motion import Balances, KnowsModes, Lasts, Motion, MovesFace, ResolvesForce, TargetState
from ..solution.solution import Later, Solution
from ..text.notes import Note
from .freezing import notes_on_freezing
from .weight import left_out_later


class MechanismMotion:
    """The motion of an impact on a mechanism that keeps its configuration meanwhile, in the laboratory.

    `relative` is what was solved: seen from the struck point as it would go on without the impact. Velocities are along
    the normal; fields are those of the struck link, x from its first end.
    """

    def __init__(self, scene: Scene, relative: Motion):
        self.scene, self.relative = scene, relative
        self.mechanism: Mechanism = scene.target.known_as(Mechanism)
        self.frozen = self.mechanism.frozen
        lasts = relative.lasts if isinstance(relative, Lasts) else isinstance(relative, KnowsModes)
        self.followed = lasts  # else it is over at once
        self.acceleration = self.frozen.acceleration if lasts else 0.0  # of the struck point
        self.jerk = self.frozen.jerk if lasts else 0.0
        falls = lasts and not scene.impactor.held
        self.weight = float(self.frozen.normal @ self.frozen.system.gravity) if falls else 0.0  # of 1 kg [N]
        self.names = [link.name for link in self.mechanism.links]

    # --- what does not depend on who looks

    def force(self, time, after=True):
        return self.relative.force(time, after)

    def force_history(self):
        return self.relative.force_history()

    def impulse(self, time, after=True):
        return self.relative.impulse(time, after)

    def resolved_force(self, time):
        """The force, averaged where its method says over what."""
        seen = self.relative
        return seen.resolved_force(time) if isinstance(seen, ResolvesForce) else seen.force(time)

    def stress(self, time, x):
        return self.relative.stress(time, x)

    def moment(self, time, x):
        """Bending moment in the struck link [N m] (time, x)."""
        return self.relative.moment(time, x)

    def shear(self, time, x):
        """Shear force in the struck link [N] (time, x)."""
        return self.relative.shear(time, x)

    # --- along the normal

    def impactor_position(self, time):
        return self.relative.impactor_position(time) + self.carried(time)

    def impactor_velocity(self, time, after=True):
        return self.relative.impactor_velocity(time, after) + self.speed(time)

    def face_velocity(self, time, after=True):
        """Of the impactor where it strikes."""
        seen = self.relative
        found = seen.face_velocity if isinstance(seen, MovesFace) else seen.impactor_velocity
        return found(time, after) + self.speed(time)

    def end_position(self, time):
        """Of the struck point."""
        return self.relative.end_position(time) + self.carried(time)

    def end_velocity(self, time, after=True):
        return self.relative.end_velocity(time, after) + self.speed(time)

    def rigid_velocity(self, time, after=True):
        """Of the centre of all masses."""
        return self.relative.rigid_velocity(time, after) + self.before(time) @ self.frozen.mean_weights

    def displacement(self, time, x):
        time = np.asarray(time, float)
        speeds, accelerations = self._of_points(x)
        moved = np.multiply.outer(time, speeds) + np.multiply.outer(0.5 * time**2, accelerations)
        return self.relative.displacement(time, x) + moved

    def velocity(self, time, x):
        speeds, accelerations = self._of_points(x)
        carried = speeds + np.multiply.outer(np.asarray(time, float), accelerations)
        return self.relative.velocity(time, x) + carried

    def carried(self, time):
        """How far the struck point would have come without the impact [m]."""
        time = np.asarray(time, float)
        return time * (self.mechanism.velocity + time * (self.acceleration / 2.0 + time * self.jerk / 6.0))

    def speed(self, time):
        """At what speed it would move [m/s]."""
        time = np.asarray(time, float)
        return self.mechanism.velocity + time * (self.acceleration + 0.5 * self.jerk * time)

    def before(self, time):
        """Rates without the impact, (time, size)."""
        sped_up = self.frozen.accelerations * self.followed
        return self.frozen.rates + np.multiply.outer(np.asarray(time, float), sped_up)

    def _of_points(self, x):
        """Velocities and accelerations of the points of the struck link without the impact, (x,) each."""
        frozen, x = self.frozen, np.atleast_1d(np.asarray(x, float))
        link, spin = frozen.system.links[frozen.link], frozen.system.spin(frozen.link, frozen.rates)
        start = frozen.system.offsets[frozen.link]
        own = slice(start, start + link.size)
        rows = frozen.normal @ link.points(x)
        accelerations = rows @ frozen.accelerations[own] - spin**2 * x * (link.axes[0] @ frozen.normal)
        return rows @ frozen.rates[own], accelerations * self.followed

    # --- all coordinates

    def target_state(self, time) -> TargetState:
        """Of the mechanism as a whole and of its modes that an impact can move."""
        time = np.atleast_1d(np.asarray(time, float))
        if isinstance(self.relative, KnowsModes):
            return self.relative.target_state(time)
        still = np.zeros((time.size, int(self.frozen.modes.is_excited.sum())))
        return TargetState(self.relative.end_position(time), self.relative.end_velocity(time), still, still)

    @property
    def _vibrations(self) -> np.ndarray:
        """Motions of the modes that an impact can move, (size, modes)."""
        return self.frozen.vibrations[1][:, self.frozen.modes.is_excited]

    def coordinates(self, time) -> np.ndarray:
        """How far all coordinates have come since the impact began, (time, size); see `numerics.multibody.system`."""
        state, time = self.target_state(time), np.atleast_1d(np.asarray(time, float))
        carried = 0.5 * time[:, None] * (self.frozen.rates + self.before(time))
        moved = carried + np.multiply.outer(state.position, self.frozen.whole)
        return moved + state.coordinates @ self._vibrations.T

    def rates(self, time) -> np.ndarray:
        """Of all coordinates, (time, size)."""
        state = self.target_state(time)
        moved = np.multiply.outer(state.velocity, self.frozen.whole) + state.rates @ self._vibrations.T
        return self.before(np.atleast_1d(np.asarray(time, float))) + moved

    def link_points(self, time, parts: int = 1, magnified: float = 1.0) -> dict[str, np.ndarray]:
        """Where the links are, by name: (time, parts + 1, 2) [m], in the laboratory, at even distances along each;
        what they bend and stretch is drawn `magnified` times.
        """
        moved = self.coordinates(time) + self.frozen.bent * ~self.frozen.system.rigid
        found = {}
        for given, link, start in zip(
            self.mechanism.links, self.frozen.system.links, self.frozen.system.offsets, strict=False
        ):
            own = moved[:, start : start + link.size]
            x = np.linspace(0.0, link.length, parts + 1)
            within = np.einsum("ts,sxk->txk", magnified * own[:, 3:], link.shapes.displacements(x))
            within[:, :, 0] += x
            angle = link.angle + own[:, 2]
            along = np.stack((np.cos(angle), np.sin(angle)), axis=1)[:, None]
            across = np.stack((-np.sin(angle), np.cos(angle)), axis=1)[:, None]
            found[given.name] = (
                (link.origin + own[:, :2])[:, None] + within[:, :, :1] * along + within[:, :, 1:] * across
            )
        return found

    def link_rates(self, time: float) -> dict[str, dict[str, Any]]:
        """By link: velocity of its centre and angular velocity, by its momentum and its angular momentum."""
        return self.of_links(self.rates(time)[0])

    def of_links(self, rates: np.ndarray) -> dict[str, dict[str, Any]]:
        """The same at any rates (size,)."""
        found = {}
        for given, link, start in zip(
            self.mechanism.links, self.frozen.system.links, self.frozen.system.offsets, strict=False
        ):
            momentum = link.mass_matrix()[:3] @ rates[start : start + link.size]
            turning = momentum[2] - 0.5 * link.length * float(link.axes[1] @ momentum[:2])
            found[given.name] = {
                "final_velocity": (momentum[:2] / link.mass).tolist(),
                "final_spin": float(turning / link.inertia),
            }
        return found

    # --- reactions

    def reaction_forces(self, time) -> np.ndarray:
        """What the first link of each joint does to the second beside what it did before the impact: force along x and
        y [N] and moment [N m], (time, joints, 3). Impulses without duration are left out."""
        time, frozen = np.atleast_1d(np.asarray(time, float)), self.frozen
        state, excited = self.target_state(time), frozen.modes.is_excited
        coordinates = np.zeros((time.size, excited.size))
        coordinates[:, excited] = state.coordinates
        push = np.zeros(time.size) if isinstance(self.relative, Balances) else self.relative.force(time)
        return self._by_joint(frozen.forces(push, coordinates))

    def _by_joint(self, reactions: np.ndarray) -> np.ndarray:
        """Force and moment on the second link of each joint, (..., joints, 3)."""
        system = self.frozen.system
        found = np.zeros((*reactions.shape[:-1], len(system.joints), 3))
        for row, number in enumerate(np.flatnonzero(system.held)):
            found[..., system.joint_of[number], :] -= reactions[..., row, None] * system.effect[number]
        return found

    def reactions(self, until: float) -> list[dict[str, Any]]:
        """Impulses of every joint on its second link up to a time [s], as `Solution.reactions` says them."""
        impulse = np.array(self.impulse(np.array([until]))[0])
        if not self._swings:
            return _impulses(self._by_joint(self.frozen.as_rigid(impulse)))
        excited = self.frozen.modes.is_excited
        rates = np.zeros(excited.size)
        rates[excited] = self.target_state(until).rates[0]
        whole = _impulses(self._by_joint(self.frozen.over_time(impulse, rates)))
        if not isinstance(self.relative, Balances):
            return whole
        sudden = _impulses(self._by_joint(self.frozen.at_once(impulse)))
        later = [{f"{name}_to_parting": value for name, value in joint.items()} for joint in whole]
        return [first | second for first, second in zip(sudden, later, strict=True)]

    @property
    def _swings(self) -> bool:
        """Whether the links vibrate in this motion."""
        return isinstance(self.relative, KnowsModes) and self.frozen.modes.frequencies.size > 0

    def mode_change(self) -> ModeChange | None:
        return self.mechanism.mode_change(self.scene.impactor.mass, self.scene.speed)

    # --- energy

    def _driven(self, time) -> np.ndarray:
        """Work that the drives have taken up, by the reactions to them [J]."""
        frozen, state, before = self.frozen, self.target_state(time), self.before(time)
        speeds, gained = before @ frozen.jacobian.T, frozen.jacobian @ frozen.accelerations * self.followed
        carried = 0.5 * time[:, None] * (frozen.rates + before) * self.followed
        borne = self._borne(self.impulse(time), state.rates)
        instants, summed = self._summed
        last = np.maximum(np.searchsorted(instants, time, "right") - 1, 0)
        since = 0.5 * (time - instants[last]) * (self.impulse(time, False) + self.impulse(instants[last]))
        grown = self._borne(summed[last] + since, state.coordinates)
        return carried @ frozen.jacobian.T @ frozen.reactions_before + (borne * speeds).sum(axis=1) - grown @ gained

    def _borne(self, impulse: np.ndarray, rates: np.ndarray) -> np.ndarray:
        """Impulses of the reactions (time, held constraints) to that of the contact (time,) and rates of modes."""
        frozen, excited = self.frozen, self.frozen.modes.is_excited
        if not self._swings:
            return frozen.as_rigid(impulse)
        found = np.zeros((impulse.size, excited.size))
        found[:, excited] = rates
        return frozen.over_time(impulse, found)

    @cached_property
    def _summed(self) -> tuple[np.ndarray, np.ndarray]:
        """Instants [s], and the impulse summed over the time up to each [N s2]; between them it grows steadily."""
        history = self.relative.force_history()[0]
        instants = history[np.append(True, np.diff(history) > 0.0)]
        middle = 0.5 * (self.impulse(instants[1:], False) + self.impulse(instants[:-1]))
        return instants, np.append(0.0, np.cumsum(np.diff(instants) * middle))

    def energies(self, time):
        """Parts of the energy [J], each by itself: of motion by the velocities, "weight" by how far all has fallen,
        negative where that feeds the motion, and "drives" by the reactions, what the drives have taken up.
        """
        time = np.atleast_1d(np.asarray(time, float))
        parts, state, frozen = self.relative.energies(time), self.target_state(time), self.frozen
        system, impactor = frozen.system, self.scene.impactor
        speed, mass = self.speed(time), 0.0 if impactor.held else impactor.mass  # what is held takes up no energy
        before = self.before(time)
        gained = np.multiply.outer(state.velocity, frozen.whole) + state.rates @ self._vibrations.T
        carried = ((0.5 * before + gained) @ system.mass * before).sum(axis=1)
        moving = mass * speed * (self.relative.impactor_velocity(time) + 0.5 * speed)
        fallen = self.coordinates(time) @ system.weight * self.followed
        bent = state.coordinates @ (self._vibrations.T @ (system.stiffness * frozen.bent))
        return parts | {
            "impactor": parts["impactor"] + moving,
            "target_rigid": parts["target_rigid"] + carried,
            "target_vibration": parts["target_vibration"] + bent,
            "drives": self._driven(time),
            "weight": 0.0 - fallen - self.weight * mass * self.impactor_position(time),
        }


def _impulses(joints: np.ndarray) -> list[dict[str, Any]]:
    """Of force and moment, (joints, 3)."""
    return [{"impulse": row[:2].tolist(), "moment_impulse": float(row[2])} for row in joints]


class BalancedMechanismMotion(MechanismMotion):
    """The same, made of impulses without duration."""

    @property
    def impulses(self) -> tuple[np.ndarray, np.ndarray]:
        """Times [s] and impulses [N s] of the balances."""
        assert isinstance(self.relative, Balances)
        return self.relative.impulses


def not_followed(solution: Solution) -> list[Note]:
    """What is left out in a time that is asked for, where a mechanism is struck as if the impact were over at once."""
    motion = solution.motion
    if not isinstance(motion, MechanismMotion) or motion.followed:
        return []
    frozen, falls = motion.frozen, not solution.scene.impactor.held
    weight = float(frozen.normal @ frozen.system.gravity) * falls
    return left_out_later(solution.scene, max(frozen.acceleration, weight, key=abs), solution.duration)


def in_laboratory(solution: Solution, scene: Scene) -> Solution:
    """The solution of an impact on a mechanism from what was solved at its struck point."""
    relative = solution.known_motion
    kind = BalancedMechanismMotion if isinstance(relative, Balances) else MechanismMotion
    motion, found = kind(scene, relative), copy(solution)
    end = np.array([solution.duration])

    def energy(_: Solution) -> dict[str, float]:
        parts = {name: float(value[0]) for name, value in motion.energies(end).items()}
        return {"initial": scene.initial_energy} | parts

    def diagnostics(solved: Solution) -> dict[str, Any]:
        parts = solved.energy
        split = sum(value for name, value in parts.items() if name != "initial")
        carried = 0.5 * end[0] * (motion.frozen.rates + motion.before(end)[0])
        apart = motion.frozen.jacobian @ (motion.coordinates(end)[0] - carried)
        if scene.impactor.held:  # then by what the mechanism has gained as a whole
            mass = motion.frozen.rigid_mass
            lost = mass * float(motion.target_state(end).velocity[0])
        else:
            mass = scene.impactor.mass
            lost = mass * (scene.impactor.velocity + motion.weight * end[0] - solved.impactor_velocity)
        return solution.diagnostics | {
            "momentum_error": (lost - solved.impulse) / (mass * scene.speed),
            "energy_error": (split - parts["initial"]) / parts["initial"],
            "constraint_error": float(np.abs(apart).max(initial=0.0)),
        }

    for name, value in {
        "scene": scene,
        "motion": motion,
        "impactor_velocity": Later(lambda _: solution.impactor_velocity + motion.speed(end[0])),
        "target_velocity": Later(lambda _: float(motion.rigid_velocity(end)[0])),
        "restitution": Later(lambda _: solution.restitution | {"newton": None}),
        "energy": Later(energy),
        "diagnostics": Later(diagnostics),
        "notes": Later(lambda solved: [*solution.notes, *notes_on_freezing(solved, motion)]),
    }.items():
        object.__setattr__(found, name, value)
    return found
