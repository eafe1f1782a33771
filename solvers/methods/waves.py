"""Exact waves in a rod: every other method is measured against this one."""

import math
import time
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .. import checks
from ..contact import Rigid
from ..method import AFTERGLOW, MAX_ROUND_TRIPS, Method
from ..numerics import contact_waves, rigid_waves, stepped_waves
from ..scene import Scene
from ..solution import ContactPeriod, Solution, summary

FORCE_SAMPLES = 200  # per round trip, in `force_history`


@dataclass(frozen=True)
class Waves(Method):
    """Travelling waves in a uniform rod struck by a rigid body.

    Rigid contact: exact, events to rounding; with `steps` over the whole duration, second order on a grid of times.
    Any other law: a delay equation integrated by collocation of order 11, events located, to `tolerance` per step.
    Source: thesis chapter 4; with a law, its 9.3 without the truncation to modes.
    """

    steps: int | None = None
    tolerance: float = 1e-9

    NAME = "waves"

    @classmethod
    def read(cls, given: Mapping[str, object]) -> "Waves":
        given = checks.table("method", given, ("steps", "tolerance"))
        steps = given.get("steps")
        return cls(
            None if steps is None else checks.whole_number("method.steps", steps, 10, 1_000_000),
            checks.number("method.tolerance", given.get("tolerance", 1e-9), 1e-13, 1e-2),
        )

    def why_not(self, scene: Scene) -> str | None:
        if self.steps is not None and not isinstance(scene.contact, Rigid):
            return "steps is for rigid contact; with a contact law give tolerance, or use 'modal'"
        return None

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        begun = time.perf_counter()
        trip = scene.target.round_trip_time
        until = math.inf if duration is None else duration / trip
        if not isinstance(scene.contact, Rigid):
            history = _ContactHistory.strike(scene, until, self.tolerance)
        elif self.steps is None:
            history = _RigidHistory.strike(scene, until)
        else:
            history = _SteppedHistory.strike(scene, until, self.steps)
        shown = until if duration is not None else min(history.contacts[-1, 1] + AFTERGLOW, history.reach)
        shown = min(shown, history.reach)
        wall_time = time.perf_counter() - begun
        motion = WaveMotion(scene, history)
        rod, speed = scene.target, scene.impactor.velocity
        contacts = [
            ContactPeriod(
                start=trip * start,
                end=trip * end,
                impulse=scene.impactor.mass * speed * (before - after),
                peak_force=rod.impedance * speed * peak,
            )
            for start, end, before, after, peak, *_ in history.contacts.tolist()
        ]
        found = summary(scene, motion, contacts, trip * shown, wall_time)
        found["diagnostics"]["steps"] = history.steps
        found["diagnostics"]["estimated_error"] = history.estimated_error(
            abs(found["diagnostics"]["energy_error"]) + abs(found["diagnostics"]["momentum_error"])
        )
        depth = history.deepest(trip * speed)
        return Solution(
            scene=scene,
            method=self.table(),
            contacts=contacts,
            duration=trip * shown,
            motion=motion,
            peak_force=max(contact.peak_force for contact in contacts),
            peak_indentation=depth,
            residual_indentation=None if depth is None else 0.0,
            notes=history.notes,
            **found,
        )


class WaveMotion:
    """Fields and histories of a rod from the one wave its struck end has sent: see `numerics.rigid_waves`."""

    def __init__(self, scene: Scene, history: "_History"):
        self.scene, self.history = scene, history
        rod = scene.target
        self._trip, self._speed = rod.round_trip_time, scene.impactor.velocity
        self._reflection = 1.0 if rod.fixed else -1.0
        self._force_unit = rod.impedance * self._speed
        self._length_unit = self._speed * self._trip

    def _sent_and_arriving(self, time, after=True):
        """Wave sent by the struck end and wave arriving there."""
        t = np.asarray(time, float) / self._trip
        return self._both(t, t - 1.0, t, after)

    def _both(self, out, back, t, after=True):
        """The wave at times `out` and `back`; at the end of the time solved no value after a jump is known."""
        sent, returned = self.history.wave(out, after), self.history.wave(back, after)
        last = t >= self.history.reach
        if after and last.any():
            sent = np.where(last, self.history.wave(out, False), sent)
            returned = np.where(last, self.history.wave(back, False), returned)
        return sent, self._reflection * returned

    def _totals(self, time):
        """Their integrals from the beginning."""
        t = np.asarray(time, float) / self._trip
        return self.history.total(t), self._reflection * self.history.total(t - 1.0)

    def force(self, time, after=True):
        sent, arriving = self._sent_and_arriving(time, after)
        return self._force_unit * np.maximum(sent + arriving, 0.0) * self._touching(time, after)

    def _touching(self, time, after):
        t = np.asarray(time, float) / self._trip
        start, end = self.history.contacts[:, 0], self.history.contacts[:, 1]
        inside = (t[:, None] >= start) & (t[:, None] < end) if after else (t[:, None] > start) & (t[:, None] <= end)
        return inside.any(axis=1)

    def force_history(self):
        """Times and forces with every jump kept: at a jump the time stands twice, value before, value after."""
        reach = self.history.reach
        even = np.linspace(0.0, reach, max(2, int(min(FORCE_SAMPLES * reach, 20_000.0)) + 1))
        jumps = self.history.jumps()
        t = np.unique(np.concatenate([even, jumps[jumps <= reach]]))
        before, after = self.force(t * self._trip, False), self.force(t * self._trip, True)
        jump = np.abs(after - before) > 1e-9 * self._force_unit
        times = np.concatenate([t[jump], t])
        forces = np.concatenate([before[jump], after])
        order = np.argsort(times, kind="stable")
        return self._trip * times[order], forces[order]

    def end_position(self, time):
        sent, arriving = self._totals(time)
        return self._length_unit * (sent - arriving)

    def end_velocity(self, time, after=True):
        sent, arriving = self._sent_and_arriving(time, after)
        return self._speed * (sent - arriving)

    def impulse(self, time):
        sent, arriving = self._totals(time)
        return self._force_unit * self._trip * (sent + arriving)

    def impactor_position(self, time):
        return self._length_unit * self.history.mass_position(np.asarray(time, float) / self._trip)

    def impactor_velocity(self, time, after=True):
        return self._speed * self.history.mass_velocity(np.asarray(time, float) / self._trip)

    def rigid_velocity(self, time):
        """Velocity of the rod's centre of mass [m/s], (4.29)."""
        t = np.asarray(time, float) / self._trip
        now, half, whole = (self.history.total(t - lag) for lag in (0.0, 0.5, 1.0))
        return 2.0 * self._speed * ((now - half) - self._reflection * (half - whole))

    def _paths(self, time, x):
        """When what is at (time, x) set out from the struck end: going outward, and coming back; shape (time, x)."""
        t = np.asarray(time, float)[:, None] / self._trip
        place = 0.5 * np.asarray(x, float)[None, :] / self.scene.target.length
        t, place = np.broadcast_arrays(t, place)
        return t.shape, (t - place).ravel(), (t + place - 1.0).ravel(), t.ravel()

    def stress(self, time, x):
        shape, *paths = self._paths(time, x)
        out, back = self._both(*paths)
        return self._force_unit / self.scene.target.area * (out + back).reshape(shape)

    def velocity(self, time, x):
        shape, *paths = self._paths(time, x)
        out, back = self._both(*paths)
        return self._speed * (out - back).reshape(shape)

    def displacement(self, time, x):
        shape, outward, back, _ = self._paths(time, x)
        moved = self.history.total(outward) - self._reflection * self.history.total(back)
        return self._length_unit * moved.reshape(shape)

    def energies(self, time):
        """Energy split [J] at each time; the rod's own is what its waves hold, summed from the field."""
        time = np.asarray(time, float)
        t = time / self._trip
        unit = self._force_unit * self._speed * self._trip
        rod = unit * np.array([self.history.squares(max(0.0, now - 1.0), now) for now in t.tolist()])
        moving = self.rigid_velocity(time)
        rigid = np.zeros_like(rod) if self.scene.target.fixed else 0.5 * self.scene.target.mass * moving**2
        local, lost = self.history.local(t)
        return {
            "impactor": 0.5 * self.scene.impactor.mass * self.impactor_velocity(time) ** 2,
            "target_rigid": rigid,
            "target_vibration": rod - rigid,
            "local": unit * local,
            "dissipated": unit * lost,
        }


class _History:
    """What one of the kernels returned, in its units: the wave sent, and the motion of the mass."""

    contacts: np.ndarray
    reach: float  # last time known
    steps: int
    notes: list[str]

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
        return max(residual, 1e-15)


def _notes(parted: bool, touching: bool, asked: bool) -> list[str]:
    if touching:
        return ["The bodies are still in contact at the end of the time solved."]
    if not parted and not asked:
        return ["The solution stopped at its limit of steps before the bodies had parted for good."]
    return []


class _RigidHistory(_History):
    MAX_PIECES = 200_000

    @classmethod
    def strike(cls, scene: Scene, until: float) -> "_RigidHistory":
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
        self.notes = _notes(status == rigid_waves.PARTED, bool(np.isnan(contacts[-1, 5])), asked)
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


class _SteppedHistory(_History):
    COARSE = 64  # steps per round trip of the first look, which finds how long the blow lasts

    @classmethod
    def strike(cls, scene: Scene, until: float, steps: int) -> "_SteppedHistory":
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


class _ContactHistory(_History):
    MAX_SEGMENTS = 200_000

    @classmethod
    def strike(cls, scene: Scene, until: float, tolerance: float) -> "_ContactHistory":
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
        self.beta, self.reflection, self.tolerance = beta, reflection, tolerance
        self.reach, self.steps = float(self.start[-1]), int(count)
        touching = bool(self.contacts[-1, 1] >= self.reach)
        self.notes = _notes(status == contact_waves.PARTED, touching, asked)
        return self

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
        stored = np.array([self.law.work(a) for a in depth.tolist()])
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
        return max(residual, 1e-13)
