"""What each kernel of `waves` knows, in its own units: the wave sent by the struck end and the motion of the mass.

Units: time in round trips T, velocity in the impact speed v, displacement in v T, stress in v sqrt(E rho).
"""

import math

import numpy as np

from ..method import AFTERGLOW, MAX_ROUND_TRIPS
from ..numerics import contact_waves, rigid_waves, stepped_waves
from ..scene import Scene

UNKNOWN = 2.0  # error of a velocity of which one knows only that it lies between -v and v


class History:
    """What one of the kernels returned, in its units: the wave sent, and the motion of the mass."""

    contacts: np.ndarray
    reach: float  # last time known
    steps: int
    notes: list[str]
    complete = True  # solved to the time asked for, or until the bodies parted for good

    def jumps(self) -> np.ndarray:
        """Times at which the force may jump or bend: every event and every return of one."""
        trips = np.arange(math.floor(self.reach) + 1)
        events = self.contacts[:, :2].ravel()
        return np.unique((events[:, None] + trips).ravel()) if trips.size < 200 else np.unique(np.append(events, trips))

    def local(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Energy stored in the contact law, and lost by it."""
        return np.zeros_like(t), np.zeros_like(t)

    def deepest(self, unit: float) -> float | None:
        return None

    def estimated_error(self, residual: float) -> float:
        """Relative to the impact speed, in the final velocity of the impactor."""
        return max(residual, 1e-15) if self.complete else UNKNOWN


def _notes(parted: bool, touching: bool, asked: bool, cut: bool = False) -> list[str]:
    if cut or (not parted and not asked):
        return [
            "The solution stopped at its limit of steps before the bodies had parted for good: do not trust its end."
        ]
    if touching:
        return ["The bodies are still in contact at the end of the time solved."]
    return []


class RigidHistory(History):
    MAX_PIECES = 200_000

    @classmethod
    def strike(cls, scene: Scene, until: float) -> "RigidHistory":
        self = cls()
        beta, reflection = scene.mass_ratio, 1.0 if scene.target.fixed else -1.0
        asked, limit = math.isfinite(until), min(until, MAX_ROUND_TRIPS)
        pieces = 400
        while True:
            status, count, *self.pieces, contacts = rigid_waves.strike(beta, reflection, limit, pieces, 40, pieces)
            if status != rigid_waves.FULL or pieces >= cls.MAX_PIECES:
                break
            pieces = min(8 * pieces, cls.MAX_PIECES)
        self.kappa, self.reflection = 2.0 * beta, reflection
        self.contacts, self.reach, self.steps = contacts, float(self.pieces[0][-1]), int(count)
        cut = status == rigid_waves.FULL
        self.notes = _notes(status == rigid_waves.PARTED, bool(np.isnan(contacts[-1, 5])), asked, cut)
        self.complete = status == rigid_waves.PARTED or (asked and not cut)
        return self

    def wave(self, t, after=True):
        wave = np.empty(t.size)
        rigid_waves.sample(np.ascontiguousarray(t), after, self.kappa, *self.pieces, wave, np.empty(0))
        return wave

    def total(self, t):
        wave, total = np.empty(t.size), np.empty(t.size)
        rigid_waves.sample(np.ascontiguousarray(t), True, self.kappa, *self.pieces, wave, total)
        return total

    def mass_position(self, t):
        """With the struck end while they touch, on its own in between."""
        position = self.total(t) - self.reflection * self.total(t - 1.0)
        for apart, end, speed, place in self._flights(t):
            position = np.where(apart, place + speed * (t - end), position)
        return position

    def mass_velocity(self, t):
        # it never jumps, so either side of a jump of the waves will do
        velocity = self.wave(t, False) - self.reflection * self.wave(t - 1.0, False)
        for apart, _, speed, _ in self._flights(t):
            velocity = np.where(apart, speed, velocity)
        return np.where(t > 0.0, velocity, 1.0)

    def _flights(self, t):
        for row, (_, end, _, speed, _, place, _) in enumerate(self.contacts):
            following = self.contacts[row + 1, 0] if row + 1 < len(self.contacts) else math.inf
            if not math.isnan(place):
                yield (t >= end) & (t <= following), end, speed, place

    def squares(self, begin, end):
        start, coefficients, degrees, _ = self.pieces
        return rigid_waves.stored_energy(begin, end, self.kappa, start, coefficients, degrees)


class SteppedHistory(History):
    COARSE = 64  # steps per round trip of the first look, which finds how long the blow lasts

    @classmethod
    def strike(cls, scene: Scene, until: float, steps: int) -> "SteppedHistory":
        self = cls()
        beta, reflection = scene.mass_ratio, 1.0 if scene.target.fixed else -1.0
        asked = math.isfinite(until)
        if not asked:
            most = int(min(cls.COARSE * MAX_ROUND_TRIPS, 2_000_000))
            contacts = stepped_waves.strike(beta, reflection, cls.COARSE, most, False, 1000)[4]
            until = float(contacts[-1, 1]) + AFTERGLOW
        self.per_trip = max(2, round(steps / until))
        count = max(1, math.ceil(until * self.per_trip - 1e-9))
        found = stepped_waves.strike(beta, reflection, self.per_trip, count, True, 1000)
        self.before, self.after, self.position, self.velocity, self.contacts, _ = found
        self.reach, self.steps = count / self.per_trip, count
        self.totals = np.concatenate(([0.0], np.cumsum(0.5 * (self.after[:-1] + self.before[1:])))) / self.per_trip
        square = (self.after[:-1] ** 2 + self.after[:-1] * self.before[1:] + self.before[1:] ** 2) / 3.0
        self.square_totals = np.concatenate(([0.0], np.cumsum(square))) / self.per_trip
        self.notes = _notes(True, bool(self.contacts[-1, 1] >= self.reach), asked)
        half = max(1, self.per_trip // 2)
        coarse = stepped_waves.strike(beta, reflection, half, math.ceil(self.reach * half), True, 1000)
        self.difference = abs(float(coarse[3][-1] - self.velocity[-1]))
        return self

    def estimated_error(self, residual):
        return max(self.difference, residual, 1e-15)

    def _cell(self, t, after):
        grid = np.clip(t * self.per_trip, 0.0, self.steps)
        grid = np.where(np.abs(grid - np.rint(grid)) < 1e-9, np.rint(grid), grid)
        cell = np.clip(np.floor(grid) if after else np.ceil(grid) - 1.0, 0, self.steps - 1).astype(int)
        return cell, grid - cell, self.after[cell], self.before[cell + 1]

    def wave(self, t, after=True):
        _, part, left, right = self._cell(t, after)
        return np.where(t >= 0.0 if after else t > 0.0, left + part * (right - left), 0.0)

    def total(self, t):
        cell, part, left, right = self._cell(t, True)
        return np.where(t > 0.0, self.totals[cell] + part * (left + 0.5 * part * (right - left)) / self.per_trip, 0.0)

    def mass_position(self, t):
        return np.interp(t, np.arange(self.steps + 1) / self.per_trip, self.position)

    def mass_velocity(self, t):
        return np.interp(t, np.arange(self.steps + 1) / self.per_trip, self.velocity)

    def squares(self, begin, end):
        grid = np.arange(self.steps + 1) / self.per_trip
        at_begin, at_end = np.interp([begin, end], grid, self.square_totals)
        return float(at_end - at_begin)


class ContactHistory(History):
    MAX_SEGMENTS = 200_000

    @classmethod
    def strike(cls, scene: Scene, until: float, tolerance: float) -> "ContactHistory":
        self = cls()
        rod, speed = scene.target, scene.impactor.velocity
        beta, reflection = scene.mass_ratio, 1.0 if rod.fixed else -1.0
        self.law = scene.contact.scaled(speed * rod.round_trip_time, speed, rod.impedance * speed)
        asked, limit = math.isfinite(until), min(until, MAX_ROUND_TRIPS)
        segments = 4_000
        while True:
            found = contact_waves.strike(self.law, beta, reflection, limit, tolerance, segments, segments)
            status, count, self.start, self.sent, self.totals, self.depth, self.speed, self.contacts, self.lost = found
            if status != contact_waves.FULL or segments >= cls.MAX_SEGMENTS:
                break
            segments = min(8 * segments, cls.MAX_SEGMENTS)
        self.reflection = reflection
        self._join()
        self.reach, self.steps = float(self.start[-1]), int(count)
        touching = bool(self.contacts[-1, 1] >= self.reach)
        cut = status in (contact_waves.FULL, contact_waves.FAILED)
        self.notes = _notes(status == contact_waves.PARTED, touching, asked, cut)
        self.complete = status == contact_waves.PARTED or (asked and not cut)
        return self

    def _join(self) -> None:
        """Take as one what only rounding parts: contacts between which the bodies open by less than it can tell."""
        least = 1e-13 * max(float(self.depth.max()), 0.1)
        joined = [self.contacts[0]]
        for contact in self.contacts[1:]:
            between = (self.start[:-1] >= joined[-1][1]) & (self.start[1:] <= contact[0] * (1.0 + 1e-15))
            opened = -self.depth[between].min() if between.any() else 0.0
            if opened > least:
                joined.append(contact)
            else:
                peak = max(joined[-1][4], contact[4])
                joined[-1] = np.array([joined[-1][0], contact[1], joined[-1][2], contact[3], peak, *contact[5:]])
        impulses = np.array([contact[2] - contact[3] for contact in joined])
        told = impulses > 1e-12 * max(float(impulses.sum()), 0.0)
        told[0] = True
        self.contacts = np.array(joined)[told]

    def _sampled(self, t, values):
        out = np.empty(t.size)
        contact_waves.sample(np.ascontiguousarray(t), self.start, values, out)
        return out

    def wave(self, t, after=True):
        return self._sampled(t, self.sent)

    def total(self, t):
        return self._sampled(t, self.totals)

    def mass_position(self, t):
        return self.total(t) - self.reflection * self.total(t - 1.0) + self._sampled(t, self.depth)

    def mass_velocity(self, t):
        return np.where(t > 0.0, self._sampled(t, self.speed), 1.0)

    def squares(self, begin, end):
        return contact_waves.stored_energy(begin, end, self.start, self.sent)

    def local(self, t):
        depth = self._sampled(t, self.depth)
        stored = np.array([self.law.stored(a, 0.0) for a in depth.tolist()])
        return stored, self._sampled(t, self.lost)

    def deepest(self, unit):
        """Refined by the parabola through the highest of the stored values and its neighbours."""
        fine = np.linspace(0.0, 1.0, 9)
        times = (self.start[:-1, None] + np.diff(self.start)[:, None] * fine).ravel()
        depth = self._sampled(times, self.depth)
        k = int(np.argmax(depth))
        near = np.linspace(times[max(k - 1, 0)], times[min(k + 1, times.size - 1)], 201)
        return unit * float(self._sampled(near, self.depth).max())

    def estimated_error(self, residual):
        return max(residual, 1e-13) if self.complete else UNKNOWN
