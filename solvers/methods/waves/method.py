"""Exact waves in a rod: every other method is measured against this one."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...bodies import Waveguide
from ...contact import Rigid
from ...provenance import clock
from ...scene import Scene
from ...solution.solution import ContactPeriod, Later, Solution, later
from ...solution.summary import balanced, summary, touching, velocities
from ...text.notes import Note, Severity
from ..base import AFTERGLOW, Method
from ..grazing import one_front
from ..options import option, real, whole
from ..parting import End, may_gain
from ..validity import MAX_TRUSTED_ERROR
from .chain_motion import ChainMotion
from .chain_scene import all_bonded
from .chain_solve import follow
from .histories import History, RigidHistory, SteppedHistory

FORCE_SAMPLES = 200  # per round trip, in `force_history`
RIGID_TOLERANCE = 1e-12  # where no law is at work: as good as exact, and cheap
FEW_RODS = 3  # in longer chains the echoes of echoes multiply, and only the tolerance ends them


@dataclass(frozen=True)
class Waves(Method):
    """Travelling waves in rods: of two bodies that meet one is a rod or a chain of rods, the other too, a mass,
    one on a spring, or a wall.

    A mass on one rod, rigid contact: exact, events to rounding; with `steps` over the whole duration, second order on a
    grid of times. Contact laws, rods against rods, chains with changes of section, joints that open: delay equations
    integrated by collocation of order 11, events located, to `tolerance` per step (1e-12 where all faces are rigid).
    Where the echoes in a chain multiply beyond what is affordable one by one (some 200 000 stretches between them), to
    a coarser tolerance and, where that is no help, second order on a grid of times; notes and estimated error say so.
    Source: thesis chapter 4; with a law, its 9.3 without the truncation to modes.
    """

    steps: int | None = option(None, whole(10, 1_000_000))
    tolerance: float = option(1e-9, real(1e-13, 1e-2))

    NAME = "waves"
    RESOLUTIONS = ("steps", "tolerance")
    TRUSTED_ERROR = MAX_TRUSTED_ERROR
    PULSES = True
    WEIGHT = True

    def why_not(self, scene: Scene) -> Note | None:
        target = scene.target
        whole = target.free_mass or target.half_swing is not None or (target.held and math.isinf(target.mass))
        if not (isinstance(target, Waveguide) or (isinstance(scene.impactor, Waveguide) and whole)):
            kinds = {"impactor": scene.impactor.kind, "target": scene.target.kind}
            return Note("refusals.not-rods", Severity.REFUSAL, **kinds)
        if self.steps is not None and not one_front(scene):
            return Note("refusals.steps-of-waves", Severity.REFUSAL)
        joints = (*scene.striker_laws, *scene.joint_laws)
        if len({type(law) for law in joints if law is not None and law.NAME != "rigid"}) > 1:
            return Note("refusals.unlike-joints", Severity.REFUSAL)
        return None

    def takes_weight(self, scene: Scene) -> bool:
        return all_bonded(scene)

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        begun = clock()
        trip = scene.time_unit
        until = math.inf if duration is None else duration / trip
        if not one_front(scene):
            return self._solve_chain(scene, until, begun)
        history = (
            RigidHistory.strike(scene, until) if self.steps is None else SteppedHistory.strike(scene, until, self.steps)
        )
        shown = until if duration is not None else min(history.contacts.end[-1] + AFTERGLOW, history.reach)
        shown = float(min(shown, history.reach))
        wall_time = clock() - begun
        motion = WaveMotion(scene, history)
        rod, speed = scene.target.known_as(Waveguide), scene.impactor.velocity
        contacts = [
            ContactPeriod(
                start=trip * row.start,
                end=trip * row.end,
                impulse=scene.impactor.mass * speed * (row.velocity_before - row.velocity_after),
                peak_force=rod.impedance * speed * row.peak_stress,
            )
            for row in history.contacts.rows()
        ]

        def figures() -> dict[str, Any]:
            if isinstance(history, RigidHistory):
                found = _figures(scene, history, shown, touching(contacts, trip * shown), wall_time)
            else:
                found = summary(scene, motion, contacts, trip * shown, wall_time)
            diagnostics = found["diagnostics"]
            diagnostics["steps"] = history.steps
            diagnostics["estimated_error"] = history.estimated_error(
                abs(diagnostics["energy_error"]) + abs(diagnostics["momentum_error"])
            )
            return found

        return Solution(
            scene=scene,
            method=self.table(),
            contacts=contacts,
            duration=trip * shown,
            motion=motion,
            peak_force=max(contact.peak_force for contact in contacts),
            peak_indentation=None,
            residual_indentation=None,
            notes=history.notes,
            **later(figures),
        )

    def _miscounts(self) -> str:
        return "steps"

    def _solve_chain(self, scene: Scene, until: float, begun: float) -> Solution:
        """Several rods, or a contact law, or a rod that strikes: see `numerics.waves.network`."""
        laws = (scene.contact, *scene.striker_laws, *scene.joint_laws)
        rigid = all(law is None or isinstance(law, Rigid) for law in laws)
        rigid = rigid and max(len(scene.impactor.rods), len(scene.target.rods)) <= FEW_RODS
        tolerance = min(self.tolerance, RIGID_TOLERANCE) if rigid else self.tolerance
        history = follow(scene, until, tolerance if rigid else 0.1 * tolerance)  # errors of some steps add up
        trip = history.trip
        joints = [history.periods(node) for node in range(history.contact + 1, len(history.rods))]
        shown = min(until, history.reach)
        if not math.isfinite(until):
            gaps = zip(scene.target.known_as(Waveguide).joints if joints else (), joints, strict=True)
            closing = [periods[0].start for joint, periods in gaps if joint.gap and periods]  # however late that is
            shown = min(max([history.contacts[-1].end, *closing]) / trip + AFTERGLOW, history.reach)
        wall_time = clock() - begun
        motion = ChainMotion(history)

        def figures() -> dict[str, Any]:
            found = summary(scene, motion, history.contacts, trip * shown, wall_time)
            diagnostics = found["diagnostics"]
            residual = abs(diagnostics["energy_error"]) + abs(diagnostics["momentum_error"])
            diagnostics["steps"] = history.steps
            diagnostics["estimated_error"] = history.estimated_error(
                residual, abs(diagnostics["momentum_error"]), tolerance
            )
            if history.doubtful:
                left = history.energy_left(history.reach) * scene.initial_energy - found["energy"]["impactor"]
                still = {
                    "energy": found["energy"] | {"target_vibration": min(found["energy"]["target_vibration"], left)}
                }
                diagnostics["estimated_error"] += may_gain(scene, found | still, End.MAY_TOUCH)
            return found

        return Solution(
            scene=scene,
            method=self.table(),
            contacts=history.contacts,
            duration=trip * shown,
            motion=motion,
            peak_force=max(contact.peak_force for contact in history.contacts),
            peak_indentation=Later(lambda _: history.deepest()),  # pyright: ignore[reportArgumentType]
            residual_indentation=Later(lambda _: history.dent()),  # pyright: ignore[reportArgumentType]
            joints=joints,
            notes=history.notes(),
            **later(figures, lambda: velocities(scene, motion, history.contacts, trip * shown)),
        )


def _figures(scene: Scene, history: RigidHistory, shown: float, touching: bool, wall_time: float) -> dict[str, Any]:
    """As `summary` gives them, from the pieces of the exact wave up to the time `shown` [T]."""
    rod, speed, last = scene.target.known_as(Waveguide), scene.impactor.velocity, history.contacts.at(-1)
    found = history.figures(shown)
    force, trip = rod.impedance * speed, rod.round_trip_time
    target = 0.0 if rod.held else speed * found.target
    rigid = 0.0 if rod.held else 0.5 * rod.mass * target**2
    final = speed * float(last.velocity_after)
    return balanced(
        scene,
        final,
        target,
        force * trip * found.impulse,
        {
            "impactor": 0.5 * scene.impactor.mass * final**2,
            "target_rigid": rigid,
            "target_vibration": force * speed * trip * found.energy - rigid,
            "local": 0.0,
            "dissipated": 0.0,
        },
        None
        if touching
        else {
            "newton": (target - final) / speed,
            "poisson": found.impulse / found.compressing - 1.0 if found.compressing > 0.0 else None,
            "newton_at_contact": float(last.face_velocity - last.velocity_after),
        },
        wall_time,
    )


class WaveMotion:
    """Fields and histories of a rod from the one wave its struck end has sent: see `numerics.waves.rigid`."""

    def __init__(self, scene: Scene, history: History):
        self.scene, self.history = scene, history
        rod = scene.target.known_as(Waveguide)
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
        start, end = self.history.contacts.start, self.history.contacts.end
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

    def impulse(self, time, after=True):
        sent, arriving = self._totals(time)
        return self._force_unit * self._trip * (sent + arriving)

    def impactor_position(self, time):
        return self._length_unit * self.history.mass_position(np.asarray(time, float) / self._trip)

    def impactor_velocity(self, time, after=True):
        return self._speed * self.history.mass_velocity(np.asarray(time, float) / self._trip)

    def rigid_velocity(self, time, after=True):
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

    # --- the waves themselves, as `ChainMotion` gives them: of the one rod, in units of Z v and T ---------------------

    def sent(self, rod, right_going, t, after=True):
        if right_going:
            return self.history.wave(t, after)
        return self._reflection * self.history.wave(np.asarray(t, float) - 0.5, after)

    def jumps(self, rod, right_going, until):
        """Times [T] at which a wave may jump or bend as it is sent."""
        jumps = self.history.jumps() + (0.0 if right_going else 0.5)
        return jumps[jumps <= until]

    def sent_total(self, rod, right_going, t):
        if right_going:
            return self.history.total(np.asarray(t, float))
        return self._reflection * self.history.total(np.asarray(t, float) - 0.5)

    def energies(self, time):
        """Energy split [J] at each time; the rod's own is what its waves hold, summed from the field."""
        time = np.asarray(time, float)
        t = time / self._trip
        unit = self._force_unit * self._speed * self._trip
        rod = unit * np.array([self.history.squares(max(0.0, now - 1.0), now) for now in t.tolist()])
        moving = self.rigid_velocity(time)
        rigid = np.zeros_like(rod) if self.scene.target.fixed else 0.5 * self.scene.target.mass * moving**2
        return {
            "impactor": 0.5 * self.scene.impactor.mass * self.impactor_velocity(time) ** 2,
            "target_rigid": rigid,
            "target_vibration": rod - rigid,
            "local": np.zeros_like(rod),
            "dissipated": np.zeros_like(rod),
        }
