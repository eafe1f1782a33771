"""When an impact of rods under weight is over: by the rule of `modal.weight`, from the waves that are known."""

import math
from typing import Any

import numpy as np

from ...numerics.parting import reach
from ...numerics.waves.parted import of_part
from ...numerics.waves.parts import ABSORBING
from ...numerics.waves.record import PLACE, SPEED, TOTAL_LEFT, TOTAL_RIGHT
from ...text.notes import Note, Severity
from ..base import AFTERGLOW
from ..weight import (
    FLIES,
    GOES_ON,
    RESTS,
    SINKS,
    SWINGS_ON,
    about_so_long,
    comes_to_rest,
    is_at_rest,
    never_leaves,
    stays,
)

PARTS = 4  # of an impact, after each of which it is looked whether all is over
IN_A_FLIGHT, IN_A_PART = 32, 64  # instants of each
ROUNDING = 1e-12  # of a time


class Falling:
    """How an impact goes whose end is not asked for.

    how: one of the above; stop [T]: of what flies, up to when it is followed, at most half of its flight; comes_back:
    whether it had touched again when that was seen. Units as in `chain_scene`.
    """

    def __init__(self, given: Any):
        self.given, self.chain = given, given.chain
        self.mass, self.fall = float(given.striker), float(given.chain.fall)
        self.every = max(about_so_long(given.scene) / given.trip / PARTS, 0.5)
        self.how, self.stop, self.comes_back, self._looked = GOES_ON, math.inf, False, 0.0
        self._moments: tuple[float, float] = (0.0, 0.0)
        last = given.chain.kind.size - 1
        self._give = of_part(given.chain, given.contact, last)[1]
        self._own_give = of_part(given.chain, 0, given.contact)[2] if given.contact else 0.0
        self._endless = bool(given.chain.kind[last] == ABSORBING)

    def look(self, history: Any, t: float) -> int:
        """How it goes, from a history up to a time."""
        self._moments = t, self._depth(history, t)
        if self._flies(history, t):
            self.how = FLIES
        else:
            self._looked = t
            self.how = self._stays(history, t)
        return self.how

    def _flies(self, history: Any, t: float) -> bool:
        """Whether it is higher than anything that still rings can reach: what follows is another impact."""
        edges = np.array([(each.start, each.end) for each in history.periods(history.contact)]) / history.trip
        edges = edges.reshape(-1, 2)[edges.reshape(-1, 2)[:, 0] < t]
        for number, begin in enumerate(edges[:, 1].tolist()):
            end = float(edges[number + 1, 0]) if number + 1 < len(edges) else t
            if end <= max(begin * (1.0 + ROUNDING), self._looked):
                continue
            instants = np.linspace(begin, end, IN_A_FLIGHT + 1)[1:]
            height = self._height(history, instants)
            if height.max() > self._reach(history, float(instants[-1])):
                leaves = -float(history.velocity_as_whole(np.array([begin]))[0])
                self.stop = begin + min(AFTERGLOW, max(leaves, 0.0) / self.fall)
                self.comes_back = number + 1 < len(edges)
                return True
        return False

    def _stays(self, history: Any, t: float) -> int:
        """Of one that has not left: whether it rests, or swings and cannot leave any more."""
        count = 1 + IN_A_PART * math.ceil(t / self.every)
        instants = np.linspace(0.0, t, count + 1)[1:]
        velocity, speed = history.velocity_as_whole(instants), history.speed
        pressed = history.force_unit * history.pressing(t)
        if self._endless:
            carried = self.fall * self.mass / float(self.chain.impedance[-1])
            if is_at_rest(history.scene, speed * (velocity - carried), pressed):
                return SINKS
        kept = 0.5 * self.mass * float(velocity[-1]) ** 2 + sum(self._ringing(history, t))
        kept += float(np.sum(history.stored(np.array([t])))) + self.mass * self.fall * float(
            self._height(history, np.array([t]))[0]
        )
        return stays(history.scene, speed * velocity, pressed, kept)

    def _height(self, history: Any, t: np.ndarray) -> np.ndarray:
        """Of the impactor as a whole, over where it touched first and what dent is left."""
        law, high = history.laws[history.contact], -history.middle(t)
        if self._endless:  # which has moved on
            rod, lag, z = history.contact, self.chain.transit[history.contact], self.chain.impedance[history.contact]
            sent = history.sampled(rod, TOTAL_RIGHT, t) - history.sampled(rod + 1, TOTAL_LEFT, t - lag)
            high = high + sent / z
        return high if law is None else high + float(law.dent(float(history.deepest_at(history.contact, t).max())))

    def _ringing(self, history: Any, t: float) -> tuple[float, float]:
        """What the target and the impactor hold beside their motion as wholes."""
        now, contact = np.array([t]), history.contact
        target = sum(float(history.rod_energy(rod, now)[0]) for rod in range(contact, len(history.rods)))
        own = sum(float(history.rod_energy(rod, now)[0]) for rod in range(contact))
        ends = float(history.sampled(0, SPEED, now)[0]), float(history.sampled(len(history.rods), SPEED, now)[0])
        own += 0.5 * float(self.chain.mass_left[0]) * ends[0] ** 2 if contact else 0.0
        if self.chain.spring:
            bent = float(history.sampled(len(history.rods), PLACE, now)[0])
            target += 0.5 * float(self.chain.mass_right[-1]) * ends[1] ** 2 + 0.5 * float(self.chain.spring) * bent**2
        falling = float((history.velocity_as_whole(now) - history.gained(now))[0])
        return target, max(own - 0.5 * self.mass * falling**2, 0.0) if contact else 0.0

    def _reach(self, history: Any, t: float) -> float:
        """How far both faces can come by what rings."""
        target, own = self._ringing(history, t)
        far = reach(target, self._give)
        if self._endless:  # from where it is, and what is before the rod without end pushes that on
            chain, rods = self.chain, slice(self.given.contact, -1)
            before = float(chain.impedance[rods] @ chain.transit[rods])
            far = 2.0 * (far + math.sqrt(2.0 * target * before) / float(chain.impedance[-1]))
        return far + reach(own, self._own_give)

    def _depth(self, history: Any, t: float) -> float:
        return float(history.middle(np.array([t]))[0])

    def notes(self) -> list[Note]:
        """Of what never leaves."""
        scene, (t, depth) = self.given.scene, self._moments
        time = t * self.given.trip
        if self.how == RESTS:
            return [comes_to_rest(scene, time, depth * self.given.speed * self.given.trip)]
        if self.how == SINKS:
            weight = scene.impactor.mass * scene.weight_acceleration
            impedance = self.given.rods[-1].impedance
            return [Note("sinks-on", Severity.REMARK, velocity=weight / impedance, force=weight)]
        return [never_leaves(scene, time)] if self.how == SWINGS_ON else []
