"""What each kernel of `waves` knows, in its own units: the wave sent by the struck end and the motion of the mass.

Units: time in round trips T, velocity in the impact speed v, displacement in v T, stress in v sqrt(E rho).
"""

import math
from typing import NamedTuple

import numpy as np

from ...numerics.waves import rigid as rigid_waves
from ...numerics.waves import rigid_figures
from ...numerics.waves import stepped as stepped_waves
from ...numerics.waves.contact_table import ContactTable
from ...scene import Scene
from ...text.notes import Note
from ..base import AFTERGLOW, MAX_ROUND_TRIPS
from ..validity import cut_short
from .chain_scene import UNKNOWN, end_notes


class WaveFigures(NamedTuple):
    """What is not in the table of contacts, at one time: see `rigid_figures.figures`."""

    impulse: float  # [Z v T]
    target: float  # velocity of the centre of mass of the rod [v]
    compressing: float  # impulse up to the end of compression; NaN if that never comes
    energy: float  # of the rod [Z v v T]


class History:
    """What one of the kernels returned, in its units: the wave sent, and the motion of the mass."""

    contacts: ContactTable[np.ndarray]
    reach: float  # last time known
    steps: int
    notes: list[Note]
    complete = True  # solved to the time asked for, or until the bodies parted for good

    def jumps(self) -> np.ndarray:
        """Times at which the force may jump or bend: every event and every return of one."""
        trips = np.arange(math.floor(self.reach) + 1)
        events = np.concatenate((self.contacts.start, self.contacts.end))
        return np.unique((events[:, None] + trips).ravel()) if trips.size < 200 else np.unique(np.append(events, trips))

    def estimated_error(self, residual: float) -> float:
        """Relative to the impact speed, in the final velocity of the impactor."""
        return max(residual, 1e-15) if self.complete else UNKNOWN


class RigidHistory(History):
    pieces: list[np.ndarray]
    _rows: np.ndarray  # of the contacts, as kernels take them
    kappa: float
    reflection: float
    FIRST_PIECES, MAX_PIECES = 64, 200_000  # most impacts have a dozen; room for more takes longer than they
    TERMS = 40  # of a piece; those that no double can see are dropped

    @classmethod
    def strike(cls, scene: Scene, until: float) -> "RigidHistory":
        self = cls()
        beta, reflection = scene.mass_ratio, 1.0 if scene.target.fixed else -1.0
        asked, limit = math.isfinite(until), min(until, MAX_ROUND_TRIPS)
        pieces = cls.FIRST_PIECES
        while True:
            sent = rigid_waves.Pieces.of(pieces, cls.TERMS, pieces)
            status, count, contacts = rigid_waves.strike(beta, reflection, limit, sent)
            if status != rigid_waves.FULL or pieces >= cls.MAX_PIECES:
                break
            pieces = min(8 * pieces, cls.MAX_PIECES)
        *self.pieces, self._rows = sent.first(count, contacts)
        self.contacts = ContactTable.of(self._rows)
        self.kappa, self.reflection = 2.0 * beta, reflection
        self.reach, self.steps = float(self.pieces[0][-1]), int(count)
        full, trip = None, scene.time_unit
        if status == rigid_waves.FULL:
            times = (self.reach * trip, until * trip) if asked else (None, None)
            full = cut_short(cls.MAX_PIECES, "pieces", *times)
        self.notes = end_notes(status == rigid_waves.PARTED, bool(np.isnan(self.contacts.position[-1])), asked, full)
        self.complete = status == rigid_waves.PARTED or (asked and not full)
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
        following = np.append(self.contacts.start[1:], math.inf)
        for row, touches in zip(self.contacts.rows(), following, strict=True):
            if not math.isnan(row.position):
                yield (t >= row.end) & (t <= touches), row.end, row.velocity_after, row.position

    def figures(self, time: float) -> WaveFigures:
        out = np.empty(rigid_figures.FIGURES)
        rigid_figures.figures(time, 0.5 * self.kappa, self.reflection, *self.pieces, self._rows, out)
        return WaveFigures(*out.tolist())

    def squares(self, begin, end):
        start, coefficients, degrees, _ = self.pieces
        return rigid_waves.stored_energy(begin, end, self.kappa, start, coefficients, degrees)


class SteppedHistory(History):
    per_trip: int
    before: np.ndarray  # force at the ends of steps, before a jump
    after: np.ndarray
    position: np.ndarray
    velocity: np.ndarray
    totals: np.ndarray
    square_totals: np.ndarray
    difference: float  # of the last velocity to that without steps
    FINER = 8  # times as many steps, by which the error is estimated; it falls at first order or faster
    MOST_FINER_STEPS = 4_000_000
    COARSE = 64  # steps per round trip of the first look, which finds how long the impact lasts

    @classmethod
    def strike(cls, scene: Scene, until: float, steps: int) -> "SteppedHistory":
        self = cls()
        beta, reflection = scene.mass_ratio, 1.0 if scene.target.fixed else -1.0
        asked, parted = math.isfinite(until), True
        if not asked:
            lasting, parted = cls._lasting(beta, reflection)
            until = lasting + AFTERGLOW
        self.per_trip = max(2, round(steps / until))
        count = max(1, math.ceil(until * self.per_trip - 1e-9))
        found = stepped_waves.strike(beta, reflection, self.per_trip, count, True, 1000)
        self.before, self.after, self.position, self.velocity, rows, _ = found
        self.contacts = ContactTable.of(rows)
        self.reach, self.steps = count / self.per_trip, count
        self.totals = np.concatenate(([0.0], np.cumsum(0.5 * (self.after[:-1] + self.before[1:])))) / self.per_trip
        square = (self.after[:-1] ** 2 + self.after[:-1] * self.before[1:] + self.before[1:] ** 2) / 3.0
        self.square_totals = np.concatenate(([0.0], np.cumsum(square))) / self.per_trip
        self.notes = end_notes(parted, bool(self.contacts.end[-1] >= self.reach), asked)
        self.difference = self._difference(beta, reflection)
        return self

    def _difference(self, beta: float, reflection: float) -> float:
        """Of the last velocity to that by so many more steps that they resolve the decay of a pulse, T / (2 beta)."""
        times = self.FINER * math.ceil(max(1.0, 2.0 * beta / self.per_trip))
        if times > self.FINER and times * self.steps > self.MOST_FINER_STEPS:
            return 1.0
        _, _, _, velocity, *_ = stepped_waves.strike(
            beta, reflection, times * self.per_trip, times * self.steps, True, 1000
        )
        return abs(float(velocity[-1] - self.velocity[-1])) / (1.0 - 1.0 / self.FINER)

    @classmethod
    def _lasting(cls, beta: float, reflection: float) -> tuple[float, bool]:
        """When the last contact ends [T], on the coarse grid, and whether the bodies part then; with room for few steps
        first: most impacts are short.
        """
        limit, most = 1_000, int(min(cls.COARSE * MAX_ROUND_TRIPS, 2_000_000))
        while True:
            limit = min(8 * limit, most)
            *_, contacts, parted = stepped_waves.strike(beta, reflection, cls.COARSE, limit, False, 1000)
            if parted or limit == most:
                return float(ContactTable.of(contacts).end[-1]), bool(parted)

    def estimated_error(self, residual):
        return max(self.difference, 1e-15)  # what energy is missing is of the sums over the grid

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
