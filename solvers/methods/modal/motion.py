"""What the modal kernel has recorded, as a motion: fields and histories, and contacts apart from chatter."""

from functools import cached_property
from typing import Any

import numpy as np

from ...numerics import modal_contacts
from ...numerics.law_functions import constants_of
from ...numerics.oscillators import Bank, Record, carried, turned
from ...numerics.waves.laws import law_function
from ...scene import Scene
from ...solution.motion import TargetState
from ...solution.sampled_motion import given_up, growth
from ...solution.solution import ContactPeriod
from ...validation import SceneError, allowed
from ..parting import End
from .pair import Pair


class ModalMotion:
    """Fields and histories rebuilt from the force on the oscillators; between instants they move exactly too.

    The modes left out follow the contact force as if it were steady: displacements have their share, by which a struck
    face gives way, and moments and shear forces of a beam what they carry of it. Velocities and stresses along a rod
    are sums of the kept modes alone.
    An impactor that can bend is where x is negative; its position and velocity are those of its centre of mass.
    A beam that turns as it moves has one coordinate for both, the place where it is struck: the record holds that.
    """

    def __init__(self, scene: Scene, pair: Pair, step: float, stride: int, record: Record, end: End, resting: int = 0):
        self.scene, self.pair, self.step, self.stride, self.record = scene, pair, step, stride, record
        self.end, self.resting, self.target_modes = end, resting, pair.target
        self.steps = record.contact_force.size
        self.duration = self.steps * step
        self._instants = np.arange(self.steps + 1) * step
        self.deepest, self._impulses = np.empty((2, self.steps + 1))  # largest indentation so far [m]
        modal_contacts.gathered(record, step, self.deepest, self._impulses)
        self._law = pair.law(scene)[0]

    @cached_property
    def bank(self) -> Bank:
        return self.pair.bank(self.step)

    def _cell(self, time):
        return np.clip(np.floor(np.asarray(time, float) / self.step + 1e-9), 0, self.steps - 1).astype(int)

    def _at(self, time, values):
        return np.interp(np.asarray(time, float), self._instants, values)

    def force(self, time, after=True):
        """The raw force: it chatters at the shortest kept period."""
        return self.record.contact_force[self._cell(time)]

    def resolved_force(self, time):
        """The raw force averaged over the shortest kept period: the finest that these modes can resolve."""
        times = np.ascontiguousarray(time, float).ravel()
        found, window = np.empty_like(times), self.pair.resolved_time
        modal_contacts.resolve(times, self.step, window, self.record.contact_force, self._impulses, found)
        return found.reshape(np.shape(time))

    def force_history(self):
        """Times and raw forces, constant over each step: every instant stands twice."""
        return np.repeat(self._instants, 2)[1:-1], np.repeat(self.record.contact_force, 2)

    def impulse(self, time, after=True):
        return self._at(time, self._impulses)

    def amplitudes(self, time):
        """at_contact * q and what turns with it, see `Bank`, each (time, modes)."""
        time = np.atleast_1d(np.asarray(time, float))
        cells, record = self._cell(time), self.record
        displacement, velocity = np.empty((2, time.size, self.pair.frequencies.size))
        saved = record.checkpoint_displacement, record.checkpoint_velocity
        carried(self.bank, *saved, self.stride, record.contact_force, cells, displacement, velocity)
        later, push = time - cells * self.step, record.contact_force[cells]
        turned(self.pair.frequencies, self.pair.at_contact, self.pair.damping, later, push, displacement, velocity)
        return displacement, velocity

    def _coordinates(self, time):
        """at_contact * q and at_contact * q', each (time, modes)."""
        displacement, velocity = self.amplitudes(time)
        damping = self.pair.damping
        rates = self.pair.frequencies * (np.sqrt(1.0 - damping**2) * velocity - damping * displacement)
        return displacement, rates

    def _rates(self, time):
        """at_contact * q' (time, modes)."""
        return self._coordinates(time)[1]

    def target_state(self, time):
        """Coordinates of the target as a whole and of its modes."""
        split, at_contact = self.pair.split, self.pair.target.at_contact
        displacement, rates = (values[:, split:] / at_contact for values in self._coordinates(time))
        record = self.record
        return TargetState(
            self._at(time, record.rigid_position), self._at(time, record.rigid_velocity), displacement, rates
        )

    @property
    def final_velocity(self) -> float:
        """Of the impactor as a whole; of the target where the impactor is held [m/s]."""
        held = np.isinf(self.pair.impactor.rigid_mass)
        return float((self.record.rigid_velocity if held else self.record.velocity)[-1])

    @property
    def parting_velocity(self) -> float:
        """The same as they part for good: what falls speeds up again."""
        fall, contacts = self.scene.weight_acceleration, self.contacts()
        since = max(self.duration - contacts[-1].end, 0.0) if fall and contacts else 0.0
        return self.final_velocity - fall * since

    # --- the bodies as wholes, and their struck faces

    def impactor_position(self, time):
        time = np.asarray(time, float)
        return self.pair.impactor.mean_velocity(self._undisturbed(time)[0], self._at(time, self.record.position))

    def _undisturbed(self, time):
        """Position and velocity of the impactor under its weight alone."""
        begun, fall = self.scene.impactor.velocity, self.scene.weight_acceleration
        return time * (begun + 0.5 * fall * time), begun + fall * time

    def impactor_velocity(self, time, after=True):
        time = np.asarray(time, float)
        return self.pair.impactor.mean_velocity(self._undisturbed(time)[1], self._at(time, self.record.velocity))

    def rigid_velocity(self, time, after=True):
        """Mean velocity of the target; what is held moves by the mean of its modes."""
        modes, whole = self.pair.target, self._at(time, self.record.rigid_velocity)
        found = modes.mean_velocity(self.scene.target.velocity, whole)
        if modes.means is not None and modes.means.any():
            found = found + self._rates(time)[:, self.pair.split :] @ (modes.means / modes.at_contact)
        return found

    def end_position(self, time):
        """Of the struck face of the target [m]."""
        rigid, depth = self.scene.rigid_contact, self.record.indentation
        if self.pair.split == 0:
            # while they touch in rigid contact the struck face goes with the mass
            return self._at(time, self.record.position - (np.minimum(depth, 0.0) if rigid else depth))
        give = self.pair.target.residual_compliance * self._spring
        bent = self.amplitudes(time)[0][:, self.pair.split :].sum(axis=1)
        return self._at(time, self.record.rigid_position + give) + bent

    @cached_property
    def _spring(self) -> np.ndarray:
        """Force in the spring of the modes left out at every instant [N]; of a rigid contact all the depth is in it."""
        if not self.scene.rigid_contact:
            return self.record.spring_force
        return np.maximum(self.record.indentation, 0.0) / self.pair.residual_compliance

    def end_velocity(self, time, after=True):
        return self._at(time, self.record.rigid_velocity) + self._rates(time)[:, self.pair.split :].sum(axis=1)

    def impactor_end_velocity(self, time):
        """Of the striking face [m/s]."""
        return self._at(time, self.record.velocity) - self._rates(time)[:, : self.pair.split].sum(axis=1)

    # --- fields

    def _sum(self, values, x, name):
        """Sum over modes of values (time, modes) times shapes or slopes, bodies apart: (time, x)."""
        x, found = np.asarray(x, float), np.zeros((values.shape[0], np.size(x)))
        split = self.pair.split
        for modes, part, here, side in (
            (self.pair.impactor, values[:, :split], x < 0.0, -1.0),
            (self.pair.target, values[:, split:], x >= 0.0, 1.0),
        ):
            if modes.frequencies.size and here.any() and getattr(modes, name) is not None:
                found[:, here] = part @ (getattr(modes, name)(side * x[here]) / modes.at_contact[:, None])
        return found

    def _field(self, time, x, values, wholes):
        """Both bodies as wholes, and bent: wholes are (of the struck place, undisturbed) for either."""
        x = np.asarray(x, float)
        side = np.where(x < 0.0, -1.0, 1.0)
        found = side * self._sum(values, x, "shapes")
        for (struck, undisturbed), modes, here in zip(
            wholes, (self.pair.impactor, self.pair.target), (x < 0.0, x >= 0.0), strict=True
        ):
            moved = np.multiply.outer(struck - undisturbed, modes.rigid_shape(np.abs(x[here])))
            found[:, here] += np.asarray(undisturbed)[..., None] + moved
        return found

    def displacement(self, time, x):
        time, record = np.asarray(time, float), self.record
        drifts = self._drifts(time, 0)
        struck = self._at(time, record.position), self._at(time, record.rigid_position)
        found = self._field(time, x, self.amplitudes(time)[0], tuple(zip(struck, drifts, strict=True)))
        side = np.where(np.asarray(x, float) < 0.0, -1.0, 1.0)
        return found + np.multiply.outer(self._at(time, self._spring), side * self._row_left_out(x, "shapes"))

    def velocity(self, time, x):
        time, record = np.asarray(time, float), self.record
        drifts = self._drifts(time, 1)
        struck = self._at(time, record.velocity), self._at(time, record.rigid_velocity)
        return self._field(time, x, self._rates(time), tuple(zip(struck, drifts, strict=True)))

    def _drifts(self, time, rate: int) -> list[np.ndarray]:
        """How far both bodies move on, or how fast: of that an impact on the struck place does not change all, as the
        body turns about another point."""
        target = self.scene.target.velocity
        moved = self._undisturbed(time)[rate], (target * time, target + 0.0 * time)[rate]
        wholes = self.pair.impactor, self.pair.target
        return [move * (modes.rigid_mean != 1.0) for move, modes in zip(moved, wholes, strict=True)]

    def stress(self, time, x):
        """Compression positive [Pa]: along a rod, or of a beam on the side that is struck."""
        x, amplitudes = np.asarray(x, float), self.amplitudes(time)[0]
        found = np.zeros((amplitudes.shape[0], x.size))
        for body, here in ((self.scene.impactor, x < 0.0), (self.scene.target, x >= 0.0)):
            name, factor = body.stress_source
            if factor:
                found -= here * (self._sum(amplitudes, x, name) + self._left_out(time, x, name)) * factor
        return found

    def moment(self, time, x):
        """Bending moment E I y'' [N m] (time, x); none in a rod."""
        side = np.where(np.asarray(x, float) < 0.0, -1.0, 1.0)  # the impactor is pushed back
        return side * (self._sum(self.amplitudes(time)[0], x, "moments") + self._left_out(time, x, "moments"))

    def shear(self, time, x):
        """Shear force dM/dx [N] (time, x); it jumps where the beam is struck."""
        return self._sum(self.amplitudes(time)[0], x, "shears") + self._left_out(time, x, "shears")

    def _left_out(self, time, x, name):
        """That field of the modes left out (time, x), which follow the force as if it were steady.

        Source: the mode-acceleration method; what is left out is then of the order of (T_kept / T_force)^2.
        """
        row = self._row_left_out(x, name)
        return np.multiply.outer(self.smoothed_force(time) if row.any() else np.zeros(np.size(time)), row)

    def _row_left_out(self, x, name):
        """That field of the modes left out of both bodies under 1 N, (x,)."""
        x = np.asarray(x, float)
        row = np.zeros(x.size)
        for modes, here in ((self.pair.impactor, x < 0.0), (self.pair.target, x >= 0.0)):
            if here.any():
                row[here] = modes.left_out(name, np.abs(x[here]))
        return row

    @cached_property
    def smoothing(self) -> float:
        """Time over which the force is averaged for the modes left out [s].

        A step to either side, where the force is constant over each; the shortest kept period in rigid contact, where
        the raw force chatters.
        """
        rigid = self.scene.rigid_contact
        return max(2.0 * self.step, self.pair.resolved_time if rigid else 0.0)

    def smoothed_force(self, time):
        """The raw force averaged over `smoothing`."""
        return growth(time, self._instants, self._impulses, self.smoothing)

    def _ringing(self, time):
        """Strain and kinetic energy of every oscillator, each (time, modes) [J]."""
        displacement, rates = self._coordinates(time)
        return displacement**2 * self.bank.energy, (rates / self.pair.frequencies) ** 2 * self.bank.energy

    def _nearest(self, time):
        """Numbers of the instants nearest to `time`: energy is kept between instants, not within a step."""
        return np.clip(np.rint(np.asarray(time, float) / self.step), 0, self.steps).astype(int)

    def energies(self, time):
        """Energy split [J] at the instants nearest to `time`."""
        nearest, split = self._nearest(time), self.pair.split
        ringing = sum(self._ringing(nearest * self.step))
        law, residual = self.pair.law(self.scene)
        pairs = zip(self.record.indentation[nearest].tolist(), self.deepest[nearest].tolist(), strict=True)
        impactor, target = self.scene.impactor, self.scene.target
        damped = self._received[nearest] - ringing.sum(axis=1) if self.pair.damping.any() else 0.0
        stored = np.array([law.stored(a, most) for a, most in pairs])
        lost = given_up(law, stored, nearest, self.record.contact_force)
        instants, fall = nearest * self.step, self.scene.weight_acceleration
        freely = self._undisturbed(instants)[1] if fall else impactor.velocity
        moving = self.pair.impactor.moving_energy(impactor.mass, freely, self.record.velocity[nearest])
        weight = {"weight": -impactor.mass * fall * self.impactor_position(instants)} if fall else {}
        return {
            "impactor": moving + ringing[:, :split].sum(axis=1),
            "target_rigid": self.pair.target.moving_energy(
                target.mass, target.velocity, self.record.rigid_velocity[nearest]
            ),
            "target_vibration": ringing[:, split:].sum(axis=1),
            "local": stored - lost + 0.5 * residual * self.record.spring_force[nearest] ** 2,
            "dissipated": self.record.lost[nearest] + lost + damped,
            **weight,
        }

    @cached_property
    def _received(self) -> np.ndarray:
        """Work that the contact force has done on the oscillators so far, at every instant [J]."""
        record, (_, residual) = self.record, self.pair.law(self.scene)
        bent = record.position - record.rigid_position - record.indentation - residual * record.spring_force
        return np.append(0.0, np.cumsum(record.contact_force * np.diff(bent)))

    def target_energies(self, time):
        """Kinetic energy of the target, its motion as a whole with it, and strain energy [J]."""
        nearest, split = self._nearest(time), self.pair.split
        strain, kinetic = self._ringing(nearest * self.step)
        target = self.scene.target
        whole = self.pair.target.moving_energy(target.mass, target.velocity, self.record.rigid_velocity[nearest])
        return {"kinetic": whole + kinetic[:, split:].sum(axis=1), "strain": strain[:, split:].sum(axis=1)}

    # --- contacts

    @cached_property
    def _runs(self) -> np.ndarray:
        runs = np.empty((self.steps // 2 + 1, 2), np.int64)
        return runs[: modal_contacts.touches(self.record, self.step, self.deepest, *self._asked(), runs)]

    def raw_contacts(self) -> tuple[np.ndarray, np.ndarray]:
        """First step, and the one after the last, of every stretch of steps in touch, chatter and all."""
        return self._runs[:, 0], self._runs[:, 1]

    @cached_property
    def _resolves(self) -> modal_contacts.Resolved:
        """No contact can chatter where a law of its own acts on beams: no front runs whose steepness modes miss."""
        rings = [body for body in (self.scene.impactor, self.scene.target) if body.time_unit is not None]
        every = not self.scene.rigid_contact and all(body.bends for body in rings)
        window, compliance, opening = self.pair.resolved_time, self.pair.residual_compliance, 0.0
        if not every:
            pressed = self.record.contact_force, self._impulses
            opening = modal_contacts.least_opening(compliance, self.step, window, *pressed)
        parted = self.end is not End.FOLLOWED
        rigid, gives = self.scene.rigid_contact, compliance > 0.0
        return modal_contacts.Resolved(self.step, window, opening, every, rigid, gives, parted)

    def _asked(self) -> tuple[Any, np.ndarray, np.ndarray]:
        return asked(self._law)

    def uncertain_gaps(self, periods: float) -> int:
        """How many gaps of the raw force are not counted, and yet last longer than so many shortest kept periods."""
        longest = periods * self.pair.resolved_time / self.step
        return modal_contacts.unsure(self.record, self.deepest, self._runs, self._resolves, longest, *self._asked())

    def contacts(self) -> list[ContactPeriod]:
        """Contact periods as far as these modes resolve them, by the resolved force: the rest is chatter."""
        table = np.empty((self._runs.shape[0], modal_contacts.COLUMNS))
        histories = self.record, self.deepest, self._impulses, self._runs
        count = modal_contacts.contacts(*histories, self._resolves, *self._asked(), table)
        return [ContactPeriod(*row) for row in table[:count].tolist()]


def asked(law: Any) -> tuple[Any, np.ndarray, np.ndarray]:
    """The contact law as kernels of contacts take it."""
    return law_function(type(law)), constants_of([law])[0], np.empty(2)


def last_touch(scene: Scene, law: Any, record: Record, step: float, done: int) -> int:
    """Steps up to the end of the last touch among those that are done; `done` itself while a dent still closes.

    Raises SceneError if the target moves away before there is any.
    """
    pressed = modal_contacts.pressed(record.contact_force, done)
    if not pressed:
        raise SceneError("impactor.velocity", scene.impactor.velocity, allowed("touch-before-away"))
    return modal_contacts.closed(pressed, done, record, step, *asked(law))
