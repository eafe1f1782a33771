"""Fields, histories and energies of a chain of rods from the waves that its history knows."""

import numpy as np

from ...bodies import Waveguide
from ...numerics.waves.record import FORCE, IMPULSE, OUT_LEFT, OUT_RIGHT, PLACE, SPEED, TOTAL_LEFT, TOTAL_RIGHT
from .chain_scene import ChainHistory


class ChainMotion:
    """Fields and histories of a chain of rods from the waves that its nodes have sent."""

    def __init__(self, history: ChainHistory):
        self.history = history
        self.scene = history.scene
        self.edges = np.concatenate(([0.0], np.cumsum([rod.length for rod in history.rods])))
        self.edges -= self.edges[history.contact]  # x = 0 where they touch
        self._length_unit = history.speed * history.trip

    # --- waves of rod i: f sent by its left end, g by its right end, each as it leaves --------------------------------

    def sent(self, rod: int, right_going: bool, t: np.ndarray, after: bool = True) -> np.ndarray:
        """Force wave [Z v] that an end of a rod sends at times [T]."""
        node, quantity = (rod, OUT_RIGHT) if right_going else (rod + 1, OUT_LEFT)
        return self.history.sampled(node, quantity, t, after)

    def sent_total(self, rod: int, right_going: bool, t: np.ndarray) -> np.ndarray:
        """Its integral from the beginning."""
        node, quantity = (rod, TOTAL_RIGHT) if right_going else (rod + 1, TOTAL_LEFT)
        return self.history.sampled(node, quantity, t)

    def _face(self, rod: int, at_left: bool, t: np.ndarray, after: bool = True) -> tuple[np.ndarray, np.ndarray]:
        """Displacement [v T] and velocity [v] of an end of a rod."""
        chain, lag, t = self.history.chain, self.history.chain.transit[rod], self._before_the_end(t)
        f, g = (t, t - lag) if at_left else (t - lag, t)
        z, drift = chain.impedance[rod], chain.drift[rod]
        place = drift * t + (self.sent_total(rod, True, f) - self.sent_total(rod, False, g)) / z
        return place, drift + (self.sent(rod, True, f, after) - self.sent(rod, False, g, after)) / z

    def _t(self, time):
        return np.minimum(np.asarray(time, float) / self.history.trip, self.history.reach)

    def _before_the_end(self, t: np.ndarray) -> np.ndarray:
        """Times at which values after a jump are known."""
        return np.minimum(t, self.history.reach * (1.0 - 1e-13))

    def force(self, time, after=True):
        t = np.asarray(time, float) / self.history.trip
        after_all = t < self.history.reach
        force = self.history.sampled(self.history.contact, FORCE, t, after)
        if after and not after_all.all():  # at the end of the time solved no value after a jump is known
            force = np.where(after_all, force, self.history.sampled(self.history.contact, FORCE, t, False))
        return self.history.force_unit * np.maximum(force, 0.0)

    def force_history(self):
        """Times and forces with every jump kept: at a jump the time stands twice, value before, value after."""
        history = self.history
        even = np.linspace(0.0, history.reach, max(2, int(min(200 * history.reach, 20_000.0)) + 1))
        jumps = history.jumps()
        t = np.unique(np.concatenate([even, jumps[jumps <= history.reach]]))
        before, after = self.force(t * history.trip, False), self.force(t * history.trip, True)
        jump = np.abs(after - before) > 1e-9 * history.force_unit
        times, forces = np.concatenate([t[jump], t]), np.concatenate([before[jump], after])
        order = np.argsort(times, kind="stable")
        return history.trip * times[order], forces[order]

    def impulse(self, time, after=True):
        unit = self.history.force_unit * self.history.trip
        return unit * self.history.sampled(self.history.contact, IMPULSE, self._t(time))

    def impactor_position(self, time):
        """Of its face at the contact."""
        t = self._t(time)
        if self.history.contact:
            return self._length_unit * (self._face(self.history.contact - 1, False, t)[0] + self.history.fallen(t))
        return self._length_unit * (self.history.sampled(0, PLACE, t) + self.history.fallen(t))

    def face_velocity(self, time, after=True):
        """Of the impactor's face at the contact."""
        if self.history.contact:
            t = self._t(time)
            falling = self._face(self.history.contact - 1, False, t, after)[1]
            return self.history.speed * (falling + self.history.gained(t))
        return self.impactor_velocity(time, after)

    def impactor_velocity(self, time, after=True):
        """Of its centre of mass."""
        t = self._t(time)
        if self.history.contact:
            falling = self.scene.impactor.velocity + self.history.speed * self.history.gained(t)
            return falling - self.impulse(time) / self.scene.impactor.mass
        return self.history.speed * (self._mass_velocity(0, t) + self.history.gained(t))

    def end_position(self, time):
        t, contact = self._t(time), self.history.contact
        if not self.scene.target.rods:
            return self._length_unit * self.history.sampled(contact, PLACE, t)
        return self._length_unit * self._face(contact, True, t)[0]

    def end_velocity(self, time, after=True):
        t, contact = self._t(time), self.history.contact
        if not self.scene.target.rods:
            return self.history.speed * self._mass_velocity(contact, t)
        return self.history.speed * self._face(contact, True, t, after)[1]

    def rigid_velocity(self, time, after=True):
        """Mean velocity of the target [m/s], (4.29); as every force is finite, it never jumps."""
        t, target, last = self._t(time), self.scene.target, len(self.history.rods)
        if not target.rods:
            return self.history.speed * self._mass_velocity(last, t)
        momentum = sum(self._momentum(rod, t) for rod in range(self.history.contact, last))
        if target.rods[-1].end_mass:
            momentum = momentum + target.rods[-1].end_mass * self._mass_velocity(last, t)
        return self.history.speed * momentum / target.mass

    def _mass_velocity(self, node: int, t: np.ndarray) -> np.ndarray:
        """Of the mass beside a node [v]; unlike that of a face it makes no jump."""
        return np.where(t > 0.0, self.history.sampled(node, SPEED, t), self.history.chain.mass_drift[node])

    def _momentum(self, rod: int, t: np.ndarray) -> np.ndarray:
        """Of a rod [kg] times v, without what is fixed to its end."""
        body, lag = self.history.rods[rod], self.history.chain.transit[rod]
        inside = [self.sent_total(rod, way, t) - self.sent_total(rod, way, t - lag) for way in (True, False)]
        unit = self.history.force_unit * self.history.trip / self.history.speed
        return (body.mass - body.end_mass) * self.history.chain.drift[rod] + unit * (inside[0] - inside[1])

    def energies(self, time):
        """Energy split [J] at each time; that of the rods is what their waves hold, summed from the field."""
        history, scene = self.history, self.scene
        t = np.atleast_1d(self._t(time))
        unit = history.force_unit * history.speed * history.trip
        last, contact = len(history.rods), history.contact
        target = unit * sum(history.rod_energy(rod, t) for rod in range(contact, last)) + self._mass_energy(last, t)
        if history.chain.spring:
            target = target + 0.5 * unit * history.chain.spring * history.sampled(last, PLACE, t) ** 2
        if scene.target.endless and scene.target.rods:
            gone = [
                history.squares(last - 1, OUT_RIGHT, 0.0, max(now - history.chain.transit[last - 1], 0.0))
                for now in t.tolist()
            ]
            target = target + unit * np.array(gone) / history.chain.impedance[last - 1]
        moved = np.zeros_like(t) if scene.target.held else target
        rigid = self._as_wholes(t) if scene.target.rods else moved
        impactor = unit * sum(history.rod_energy(rod, t) for rod in range(contact)) + self._mass_energy(0, t)
        impactor = impactor + self._seen_from_ground(t)
        fall = history.chain.fall * history.speed / history.trip  # none where that is left out
        return {
            "impactor": impactor,
            "target_rigid": rigid,
            "target_vibration": target - rigid,
            "local": unit * history.stored(t),
            "dissipated": unit * history.dissipated(t),
        } | ({"weight": -scene.impactor.mass * fall * self._length_unit * history.middle(t)} if fall else {})

    def _seen_from_ground(self, t: np.ndarray) -> np.ndarray:
        """Kinetic energy of the impactor, less that in the frame that falls with it [J]."""
        if not self.history.chain.fall:
            return np.zeros_like(t)
        gained = self.history.speed * self.history.gained(t)
        return self.scene.impactor.mass * gained * (self.impactor_velocity(t * self.history.trip) - 0.5 * gained)

    def _mass_energy(self, node: int, t: np.ndarray) -> np.ndarray:
        """Kinetic, of the mass at the first or the last node [J]."""
        chain, history = self.history.chain, self.history
        mass = (chain.mass_left if node == 0 else chain.mass_right)[node]
        if not 0.0 < mass < np.inf:
            return np.zeros_like(t)
        unit = history.force_unit * history.speed * history.trip
        return 0.5 * unit * mass * self._mass_velocity(node, t) ** 2

    def work(self, time: float) -> float:
        """What the contact force has done to the target [J]: the integral of force times velocity of its face."""
        history, rod = self.history, self.history.contact
        t, lag, z = min(time / history.trip, history.reach), history.chain.transit[rod], history.chain.impedance[rod]
        out = history.squares(rod, OUT_RIGHT, 0.0, t)
        back = history.squares(rod + 1, OUT_LEFT, 0.0, max(t - lag, 0.0))
        pushed = float(history.sampled(rod, IMPULSE, np.array([t]))[0])
        unit = history.force_unit * history.speed * history.trip
        return float(unit * ((out - back) / z + history.chain.drift[rod] * pushed))

    def _as_wholes(self, t: np.ndarray) -> np.ndarray:
        """Kinetic energy [J] of the mean motion of each part of the target that nothing holds and no joint divides."""
        rods, target = self.history.rods, self.scene.target.known_as(Waveguide)
        energy, momentum, mass = np.zeros_like(t), np.zeros_like(t), 0.0
        for rod in range(self.history.contact, len(rods)):
            momentum, mass = momentum + self._momentum(rod, t), mass + rods[rod].mass
            if rods[rod].end_mass:
                momentum = momentum + rods[rod].end_mass * self._mass_velocity(len(rods), t)
            joint = rod - self.history.contact
            last = rod == len(rods) - 1
            if last or not target.joints[joint].bonded:
                if not (last and target.held):
                    energy += 0.5 * (self.history.speed * momentum) ** 2 / mass
                momentum, mass = np.zeros_like(t), 0.0
        return energy

    def jumps(self, rod: int, right_going: bool, until: float) -> np.ndarray:
        """Times [T] at which a wave jumps as it is sent."""
        jumps = self.history.sent_jumps(*((rod, OUT_RIGHT) if right_going else (rod + 1, OUT_LEFT)))
        return jumps[jumps <= until]

    # --- fields -------------------------------------------------------------------------------------------------------

    def _field(self, time, x, of_rod):
        """`of_rod(rod, t, place)` on every rod, place [T] a wave's time from its left end; x < 0 in the impactor."""
        t, x = self._before_the_end(self._t(time))[:, None], np.asarray(x, float)
        found = np.empty((t.size, x.size))
        rods = np.clip(np.searchsorted(self.edges, x, "right") - 1, 0, len(self.history.rods) - 1)
        rods = np.where((x == 0.0), min(self.history.contact, len(self.history.rods) - 1), rods)
        for rod in np.unique(rods):
            here = rods == rod
            share = (x[here] - self.edges[rod]) / self.history.rods[rod].length
            place = np.clip(share, 0.0, 1.0) * self.history.chain.transit[rod]
            found[:, here] = of_rod(rod, t, place[None, :])
        return found

    def stress(self, time, x):
        def of_rod(rod, t, place):
            lag = self.history.chain.transit[rod]
            waves = self.sent(rod, True, t - place) + self.sent(rod, False, t - lag + place)
            return self.history.force_unit / self.history.rods[rod].area * waves

        return self._field(time, x, of_rod)

    def velocity(self, time, x):
        def of_rod(rod, t, place):
            chain, lag = self.history.chain, self.history.chain.transit[rod]
            waves = self.sent(rod, True, t - place) - self.sent(rod, False, t - lag + place)
            gained = self.history.gained(t) if rod < self.history.contact else 0.0
            return self.history.speed * (chain.drift[rod] + waves / chain.impedance[rod] + gained)

        return self._field(time, x, of_rod)

    def displacement(self, time, x):
        def of_rod(rod, t, place):
            chain, lag = self.history.chain, self.history.chain.transit[rod]
            moved = self.sent_total(rod, True, t - place) - self.sent_total(rod, False, t - lag + place)
            fallen = self.history.fallen(t) if rod < self.history.contact else 0.0
            return self._length_unit * (chain.drift[rod] * t + moved / chain.impedance[rod] + fallen)

        return self._field(time, x, of_rod)
