"""A mechanism whose configuration does not change while it is struck: its motion before, its modes, its reactions.

M v' + K q + J^T L = n F and J v' = 0, with one contact force F. On the motions that the joints allow this is a set of
natural modes, of which those of frequency zero move as one under a force at one place. Coordinates count from the state
before the impact: links bent steadily by weight and inertia, accelerated by both.
Error: the configuration turns by the spin times the duration, and the arms of all forces change by as much.
Source: thesis 6.2 and 6.3. Differs: (6.5), (6.6) and (6.12) print the contact force with the sign of a gap.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..modes import Modes
from .system import System

RANK_TOLERANCE = 1e-9  # of the largest singular value, with lengths in units of the mechanism's own
JERK_ANGLE = 1e-3  # [rad], by which the fastest link is turned to find it: second order, half the digits left
STANDING = 1e-100  # [rad/s], of the fastest link: what is slower stands, and times squared are finite
FELT = 1e-12  # of what a unit impulse could move at the most: below it the struck point is held


def rates_before(system: System, started: bool = True) -> np.ndarray:
    """Rates (size,) that meet all joints and drives, `started`: those that only begin too; of all such motions without
    vibration the one of least kinetic energy."""
    rigid, chosen = system.rigid, system.held | started
    found = np.zeros(system.size)
    mass, rows = system.mass[np.ix_(rigid, rigid)], system.jacobian[np.ix_(chosen, rigid)]
    found[rigid] = _constrained(mass, rows, np.zeros(mass.shape[0]), system.rates[chosen])[0]
    return found


def accelerations(system: System, rates: np.ndarray) -> np.ndarray:
    """Of links that do not vibrate, (size,), under weight and at rates (size,)."""
    rigid, held = system.rigid, system.held
    load = (system.weight + system.centrifugal(rates))[rigid]
    rows, required = system.jacobian[np.ix_(held, rigid)], system.drift(rates)[held]
    found = np.zeros(system.size)
    found[rigid], _ = _constrained(system.mass[np.ix_(rigid, rigid)], rows, load, required)
    return found


def _constrained(mass, rows, load, required):
    """Solution of M a + J^T L = load, J a = required, by null space; reactions L of independent rows."""
    count = rows.shape[0]
    matrix = np.block([[mass, rows.T], [rows, np.zeros((count, count))]])
    found = np.linalg.solve(matrix, np.append(load, required))
    return found[: mass.shape[0]], found[mass.shape[0] :]


def null_space(rows: np.ndarray) -> np.ndarray:
    """Orthonormal motions (size, motions) that independent rows allow."""
    q, _ = np.linalg.qr(rows.T, mode="complete")
    return q[:, rows.shape[0] :]


@dataclass(frozen=True)
class Frozen:
    """A system struck at `at` (2,) of a link, by a force along `normal` (2,) that points into it."""

    system: System
    link: int
    at: np.ndarray
    normal: np.ndarray

    @cached_property
    def rates(self) -> np.ndarray:
        """Before the impact, (size,)."""
        return rates_before(self.system)

    @cached_property
    def accelerations(self) -> np.ndarray:
        """Before the impact, of links that do not vibrate, (size,)."""
        return accelerations(self.system, self.rates)

    @cached_property
    def bent(self) -> np.ndarray:
        """Shapes (size,) under weight and inertia before the impact; the reactions of the joints follow."""
        system, bends = self.system, ~self.system.rigid
        found = np.zeros(system.size)
        if bends.any():
            found[bends] = (self._load - self.jacobian.T @ self.reactions_before)[bends] / system.stiffness[bends]
        return found

    @cached_property
    def _load(self) -> np.ndarray:
        """Weight and inertia before the impact, (size,)."""
        system = self.system
        return system.weight + system.centrifugal(self.rates) - system.mass @ self.accelerations

    @cached_property
    def reactions_before(self) -> np.ndarray:
        """To weight and inertia before the impact, (held constraints,); of those that do not follow the least ones."""
        rigid = self.system.rigid
        return np.linalg.lstsq(self.jacobian[:, rigid].T, self._load[rigid], rcond=None)[0]

    @cached_property
    def jacobian(self) -> np.ndarray:
        """Of what lasts through the impact, (held constraints, size)."""
        return self.system.jacobian[self.system.held]

    @cached_property
    def closing(self) -> np.ndarray:
        """Velocity of the struck point along the normal per unit of each rate, (size,)."""
        return self.normal @ self.system.point(self.link, self.at)

    @property
    def velocity(self) -> float:
        """Of the struck point along the normal before the impact [m/s]."""
        return float(self.closing @ self.rates)

    @cached_property
    def acceleration(self) -> float:
        """The same of its acceleration [m/s2]."""
        return self._acceleration_after(0.0)

    @cached_property
    def jerk(self) -> float:
        """How fast that changes along the normal, which turns with the link, as the mechanism moves on [m/s3]."""
        fastest = float(np.abs(self.rates[self._angles]).max())
        if fastest < STANDING:
            return 0.0
        later = JERK_ANGLE / fastest
        return (self._acceleration_after(later) - self._acceleration_after(-later)) / (2.0 * later)

    def acceleration_gained(self, impulse: float) -> float:
        """How much more the struck point accelerates along the normal once an impulse [N s] has changed the rates, of
        links that do not vibrate [m/s2]."""
        found, link, at = [], self.link, self.at
        for rates in (self.rates, self.rates + impulse / self.rigid_mass * self.whole):
            turned = self.system.point(link, at) @ accelerations(self.system, rates)
            found.append(float(self.normal @ (turned + self.system.centripetal(link, at, rates))))
        return found[1] - found[0]

    @property
    def _angles(self) -> np.ndarray:
        """Which coordinates are the angles of the links."""
        return np.array(self.system.offsets[:-1]) + 2

    def _acceleration_after(self, time: float) -> float:
        system, change = self.system, time * self.rates + 0.5 * time**2 * self.accelerations
        rates = self.rates + time * self.accelerations
        moved = system.moved(change) if time else system
        at = system.followed(self.link, self.at, change)
        turned = change[system.offsets[self.link] + 2]
        normal = np.array([[np.cos(turned), -np.sin(turned)], [np.sin(turned), np.cos(turned)]]) @ self.normal
        own = moved.point(self.link, at) @ accelerations(moved, rates) + moved.centripetal(self.link, at, rates)
        return float(normal @ own)

    @cached_property
    def _free(self) -> np.ndarray:
        """Motions without vibration that joints and drives allow, of unit mass: (size, motions)."""
        system, rigid = self.system, self.system.rigid
        allowed = null_space(self.jacobian[:, rigid])
        found = np.zeros((system.size, allowed.shape[1]))
        if allowed.shape[1]:
            lower = np.linalg.cholesky(allowed.T @ system.mass[np.ix_(rigid, rigid)] @ allowed)
            found[rigid] = np.linalg.solve(lower, allowed.T).T
        return found

    @cached_property
    def whole(self) -> np.ndarray:
        """Motion as a whole that a force sets it into, 1 m/s at the struck point, (size,); zero if nothing can move."""
        seen = self._free.T @ self.closing
        if not seen.size or float(seen @ seen) <= FELT**2 * float(self.closing @ self.closing) / self._least_mass:
            return np.zeros(self.system.size)
        return self._free @ seen / float(seen @ seen)

    @property
    def _least_mass(self) -> float:
        return min(link.mass for link in self.system.links)

    @property
    def rigid_mass(self) -> float:
        """Felt at the struck point by a force that sets it into motion as a whole [kg]; infinite where it is held."""
        energy = float(self.whole @ self.system.mass @ self.whole)
        return energy if energy > 0.0 else np.inf

    @cached_property
    def vibrations(self) -> tuple[np.ndarray, np.ndarray]:
        """Frequencies (modes,) [rad/s] and mass-normalised motions (size, modes) of the links between their joints."""
        from scipy.linalg import eigh

        system = self.system
        if system.rigid.all():
            return np.zeros(0), np.zeros((system.size, 0))
        rows = np.vstack((self.jacobian, (system.mass @ self._free).T))
        basis = null_space(rows)
        squares, vectors = eigh(basis.T * system.stiffness @ basis, basis.T @ system.mass @ basis)
        motions = basis @ vectors
        return np.sqrt(np.maximum(squares, 0.0)), motions * np.where(self.closing @ motions < 0.0, -1.0, 1.0)

    @cached_property
    def modes(self) -> Modes:
        """As the kernels take them; x runs along the struck link, displacements are those along the normal."""
        link, start = self.system.links[self.link], self.system.offsets[self.link]
        own, across = slice(start, start + link.size), link.axes @ self.normal
        frequencies, motions = self.vibrations
        weights = self.mean_weights

        def moved(motion: np.ndarray, x: np.ndarray) -> np.ndarray:
            """Along the normal, of motions (size, n): (n, x)."""
            return (self.normal @ link.points(x) @ motion[own]).T

        def carried(name: str):
            return lambda x: motions[own][3:].T @ link.shapes.carried(name, x)

        return Modes(
            frequencies=frequencies,
            at_contact=self.closing @ motions,
            rigid_mass=self.rigid_mass,
            residual_compliance=float(link.shapes.left_out @ across**2),
            shapes=lambda x: moved(motions, x),
            slopes=lambda x: motions[own][3:].T @ link.shapes.turns(x),
            rigid_shape=lambda x: moved(self.whole[:, None], x)[0],
            means=weights @ motions,
            rigid_mean=float(weights @ self.whole) if np.isfinite(self.rigid_mass) else 1.0,
            moments=carried("moments"),
            shears=carried("shears"),
        )

    @property
    def mean_weights(self) -> np.ndarray:
        """Velocity of the centre of all masses along the normal per unit of each rate, (size,)."""
        total = sum(link.mass for link in self.system.links)
        return self.mean_rows @ self.normal / total

    @cached_property
    def mean_rows(self) -> np.ndarray:
        """Momentum along x and y per unit of each rate, (size, 2) [kg]."""
        found = np.zeros((self.system.size, 2))
        for link, start in zip(self.system.links, self.system.offsets, strict=False):
            found[start : start + link.size] = link.mass_matrix()[:, :2]
        return found

    # --- reactions, (..., constraints): what the joints do to their first links, and the negative to their second ones

    @cached_property
    def _reaction_to(self) -> np.ndarray:
        """Reactions from loads that they balance, (held constraints, size)."""
        return np.linalg.pinv(self.jacobian.T)

    def at_once(self, impulse: np.ndarray) -> np.ndarray:
        """Impulses of the reactions to a sudden impulse (...) [N s] at the struck point: thesis (6.12)."""
        _, motions = self.vibrations
        jump = motions @ (self.closing @ motions) + self.whole / self.rigid_mass
        return np.multiply.outer(impulse, self._reaction_to @ (self.closing - self.system.mass @ jump))

    def as_rigid(self, impulse: np.ndarray) -> np.ndarray:
        """The same of links that do not vibrate."""
        rigid = self.system.rigid
        load = (self.closing - self.system.mass @ self.whole / self.rigid_mass)[rigid]
        return np.multiply.outer(impulse, np.linalg.pinv(self.jacobian[:, rigid].T) @ load)

    def over_time(self, impulse: np.ndarray, rates: np.ndarray) -> np.ndarray:
        """Impulses of the reactions (..., held constraints), elastic forces and all, since the state before the impact,
        when the contact has given `impulse` (...) [N s] and the vibrations have `rates` (..., modes)."""
        frequencies, motions = self.vibrations
        at_contact, given = self.closing @ motions, np.asarray(impulse)[..., None]
        jump = rates @ motions.T + given * self.whole / self.rigid_mass
        swung = ((at_contact * given - rates) / frequencies**2) @ motions.T
        borne = given * self.closing - jump @ self.system.mass - swung * self.system.stiffness
        return borne @ self._reaction_to.T

    def forces(self, force: np.ndarray, coordinates: np.ndarray) -> np.ndarray:
        """Reactions (times, held constraints) under a contact force (times,) and at modal coordinates (times, modes),
        beside those before the impact."""
        frequencies, motions = self.vibrations
        inertia = self.system.mass @ (motions * frequencies**2) - self.system.stiffness[:, None] * motions
        return self.at_once(force) + coordinates @ (self._reaction_to @ inertia).T
