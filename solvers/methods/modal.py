"""Modal superposition: any linear structure known by its lowest natural modes, any contact law."""

import math
import time
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from .. import checks
from ..contact import Linear, Rigid
from ..method import AFTERGLOW, MAX_ROUND_TRIPS, Method
from ..numerics.modes import Modes
from ..numerics.oscillators import Record, Residual, advance, march, oscillator_bank
from ..scene import Scene
from ..solution import ContactPeriod, Solution, summary

STEPS_PER_PERIOD = 20  # of the highest kept mode
STEPS_PER_CONTACT = 200  # of the shortest contact there can be
EXPECTED_STEPS = 60_000  # more are not chosen unasked: energy is kept at any step
MAX_STEPS = 4_000_000
FRAMES = ("mean-axis", "attached", "attached-far")
FRAME_SAMPLES = 500  # at which the frame is watched after the contact
CHECKPOINT_NUMBERS = 1_000_000  # doubles kept of each kind, from which fields at any time are rebuilt


@dataclass(frozen=True)
class Modal(Method):
    """A rigid impactor against the lowest natural modes of the target, rigid-body motion on top.

    The modes left out act as a spring of their static compliance in series with the contact law; for rigid contact
    that spring is the whole law, so no stiffness is ever invented. Exact oscillators, energy-exact contact force.
    A free rod may be described in a frame on the mean of its sections, with the shapes of the free rod, or in one fixed
    to its struck or its far end, "attached" or "attached-far", with the shapes of a rod clamped there: thesis 10.2. The
    oscillators are then those of the coupled system; what the frame does is in the diagnostics.
    Error: second order in the step; in the number of modes about 1/modes, less where the contact is soft; without the
    residual compliance 1/modes for any contact, but modes^-3 in the frame on the struck end.
    Source: thesis 5.2, 5.3, 9.2 and 9.3; kernel: see `numerics.oscillators`.
    Differs: thesis 8.2 takes the stiffness of the neighbouring element and misses the second contact below 400 modes.
    """

    modes: int = 50
    steps: int | None = None  # over the whole duration
    frame: str = "mean-axis"  # of a free rod: floating frame and the shapes that go with it
    residual: bool = True  # whether the modes left out give way
    estimate: bool = field(default=True, repr=False)  # the error, which costs as much again

    NAME = "modal"

    @classmethod
    def read(cls, given: Mapping[str, object]) -> "Modal":
        given = checks.table("method", given, ("modes", "steps", "frame", "residual"))
        steps, residual = given.get("steps"), given.get("residual", True)
        if not isinstance(residual, bool):
            raise checks.SceneError("method.residual", residual, "true or false")
        return cls(
            checks.whole_number("method.modes", given.get("modes", 50), 1, 10_000),
            None if steps is None else checks.whole_number("method.steps", steps, 10, MAX_STEPS),
            checks.choice("method.frame", given.get("frame", "mean-axis"), FRAMES),
            residual,
        )

    def why_not(self, scene: Scene) -> str | None:
        if scene.impactor.kind not in ("mass", "sphere") or scene.target.kind != "rod":
            return f"a mass must strike a rod, got {scene.impactor.kind} and {scene.target.kind}"
        if scene.target.support == "anechoic" or scene.target.velocity or scene.target.end_mass:
            return "the rod must be at rest, fixed or free, with no mass on its far end; use 'waves'"
        if self.frame != "mean-axis" and scene.target.support != "free":
            return f"a frame fixed to an end ('{self.frame}') floats with a free rod, got {scene.target.support}"
        if not self.residual and isinstance(scene.contact, Rigid):
            return (
                "rigid contact needs the residual compliance, which is all that gives way; leave out residual = false"
            )
        return None

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        begun = time.perf_counter()
        motion = self._march(scene, duration)
        wall_time = time.perf_counter() - begun
        contacts = motion.contacts()
        found = summary(scene, motion, contacts, motion.duration, wall_time)
        found["diagnostics"] |= {
            "steps": motion.steps,
            "estimated_error": self._estimated_error(scene, motion) if self.estimate else None,
            "raw_contacts": len(motion.raw_contacts()[0]),
            "raw_peak_force": float(motion.record.contact_force.max()),
            "resolved_time": motion.modes.shortest_period,
        }
        if self.frame != "mean-axis":
            found["diagnostics"] |= motion.frame_figures(contacts[-1].end, self.frame == "attached")
        notes = []
        if motion.record.indentation[-1] > 0.0:
            notes.append("The bodies are still in contact at the end of the time solved.")
        elif duration is None and not motion.parted:
            notes.append("The solution stopped at its limit of steps before the bodies had parted for good.")
        depth = None if isinstance(scene.contact, Rigid) else float(max(motion.record.indentation.max(), 0.0))
        return Solution(
            scene=scene,
            method=self.table(),
            contacts=contacts,
            duration=motion.duration,
            motion=motion,
            peak_force=max(contact.peak_force for contact in contacts),
            peak_indentation=depth,
            residual_indentation=None if depth is None else 0.0,
            notes=notes,
            **found,
        )

    def _modes(self, scene: Scene) -> Modes:
        modes = scene.target.modes(self.modes)
        if self.frame != "mean-axis":
            modes = scene.target.attached_modes(self.modes, self.frame == "attached")
        return modes if self.residual else replace(modes, residual_compliance=0.0)

    def _estimated_error(self, scene: Scene, motion: "ModalMotion") -> float:
        """Of the final velocity, relative to the impact speed: against other numbers of modes and half the steps.

        Against two of them, as one coarse answer may agree with the fine one by chance.
        """
        others = {self.modes // 2, 2 * self.modes // 3} if self.modes > 4 else {2 * self.modes, 3 * self.modes}
        final = motion.record.velocity[-1]
        differences = []
        for modes in others:
            other = replace(self, modes=modes, steps=max(10, motion.steps // 2))._march(scene, motion.duration)
            differences.append(abs(final - other.record.velocity[-1]))
        estimated = float(max(differences) / scene.impactor.velocity)
        blow = scene.target.round_trip_time / (2.0 * scene.mass_ratio)
        if isinstance(scene.contact, Rigid) and blow < motion.modes.shortest_period:
            return max(estimated, 1.0)  # shorter than any mode kept: all numbers of modes are wrong alike
        return estimated

    def _march(self, scene: Scene, duration: float | None) -> "ModalMotion":
        modes = self._modes(scene)
        if duration is None and self.steps is not None:
            duration = replace(self, steps=None)._march(scene, None).duration
        step = duration / self.steps if self.steps is not None else _default_step(scene, modes)
        count = self.steps
        if duration is not None and count is None:
            count = min(max(10, math.ceil(duration / step)), MAX_STEPS)
            step = duration / count
        return _follow(scene, modes, step, count)


def _law(scene: Scene, modes: Modes) -> tuple[Any, float]:
    """The law for the kernel, and the compliance in series with it [m/N]."""
    if isinstance(scene.contact, Rigid):
        return Linear(1.0 / modes.residual_compliance), 0.0
    return scene.contact, modes.residual_compliance


def _default_step(scene: Scene, modes: Modes) -> float:
    """Fine enough for the highest mode and for the shortest contact; never a longer run than is worth it."""
    mass, trip = scene.impactor.mass, scene.target.round_trip_time
    law, residual = _law(scene, modes)
    reduced = mass / (1.0 + mass / modes.rigid_mass)
    depth = scene.impactor.velocity * trip  # the law's secant stiffness at the depth of a free collision
    for _ in range(60):
        stiffness = 2.0 * law.mean(0.0, depth, 0.0, 0.0)[0] / depth
        depth = 0.5 * (depth + scene.impactor.velocity * math.sqrt(reduced / stiffness))
    soft = 1.0 / stiffness
    shortest = math.pi * math.sqrt(reduced * (soft + residual))
    longest = trip + math.pi * math.sqrt(reduced * (soft + 1.0 / scene.target.stiffness))
    fine = min(modes.shortest_period / STEPS_PER_PERIOD, shortest / STEPS_PER_CONTACT)
    return max(fine, longest / EXPECTED_STEPS)


def _follow(scene: Scene, modes: Modes, step: float, count: int | None) -> "ModalMotion":
    """March `count` steps, or whole periods of the structure until one has passed without a touch and none can come."""
    law, residual = _law(scene, modes)
    settling = min(0.5, step / modes.shortest_period) if scene.contact.JUMPS or scene.contact.PLASTIC else 0.0
    trip = scene.target.round_trip_time
    period = 2.0 * trip if scene.target.fixed else trip
    bank = oscillator_bank(modes.frequencies, modes.at_contact, step)
    stride = max(1, (count or 3 * math.ceil(period / step)) * modes.frequencies.size // CHECKPOINT_NUMBERS)
    most = count or int(min(MAX_STEPS, math.ceil(MAX_ROUND_TRIPS * trip / step)))
    chunk = count or min(most, math.ceil(period / step))
    record = _record(chunk, stride, modes.frequencies.size)
    record.velocity[0] = scene.impactor.velocity
    displacement, velocity = np.zeros(modes.frequencies.size), np.zeros(modes.frequencies.size)
    done, parted = 0, False
    while done < most:
        until = min(done + chunk, most)
        if until > record.contact_force.size:
            record = _grown(record, min(2 * until, most), stride)
        march(
            law, Residual(residual, settling, scene.contact.JUMPS), scene.impactor.mass, modes.rigid_mass, step, bank,
            displacement, velocity, stride, done, until, record,
        )  # fmt: skip
        apart = not record.contact_force[done:until].any()
        done = until
        if count is None and apart and record.rigid_velocity[done] > record.velocity[done]:
            parted = True
            last = int(np.flatnonzero(record.contact_force[:done])[-1]) + 1
            done = min(done, last + math.ceil(AFTERGLOW * trip / step))
            break
    return ModalMotion(scene, modes, step, stride, _cut(record, done, stride), parted)


def _record(steps: int, stride: int, modes: int) -> Record:
    instants = [np.zeros(steps + 1) for _ in range(7)]
    return Record(np.zeros(steps), *instants, *(np.zeros((steps // stride + 1, modes)) for _ in range(2)))


def _grown(record: Record, steps: int, stride: int) -> Record:
    larger = _record(steps, stride, record.checkpoint_displacement.shape[1])
    for old, new in zip(record, larger, strict=True):
        new[: old.shape[0]] = old
    return larger


def _cut(record: Record, steps: int, stride: int) -> Record:
    force, *instants = record[:8]
    return Record(
        force[:steps], *(values[: steps + 1] for values in instants), *(c[: steps // stride + 1] for c in record[8:])
    )


class ModalMotion:
    """Fields and histories rebuilt from the force on the oscillators; between instants they move exactly too."""

    def __init__(self, scene: Scene, modes: Modes, step: float, stride: int, record: Record, parted: bool):
        self.scene, self.modes, self.step, self.stride, self.record = scene, modes, step, stride, record
        self.parted = parted
        self.steps = record.contact_force.size
        self.duration = self.steps * step
        self._instants = np.arange(self.steps + 1) * step
        self._impulses = np.concatenate(([0.0], np.cumsum(record.contact_force))) * step
        self._bank = oscillator_bank(modes.frequencies, modes.at_contact, step)
        self._softness = (modes.at_contact / modes.frequencies) ** 2

    def _cell(self, time):
        return np.clip(np.floor(np.asarray(time, float) / self.step + 1e-9), 0, self.steps - 1).astype(int)

    def _at(self, time, values):
        return np.interp(np.asarray(time, float), self._instants, values)

    def force(self, time, after=True):
        """The raw force: it chatters at the shortest kept period."""
        return self.record.contact_force[self._cell(time)]

    def resolved_force(self, time):
        """The raw force averaged over the shortest kept period: the finest that these modes can tell."""
        half = 0.5 * self.modes.shortest_period
        time = np.asarray(time, float)
        return (self._at(time + half, self._impulses) - self._at(time - half, self._impulses)) / (2.0 * half)

    def force_history(self):
        """Times and raw forces, constant over each step: every instant stands twice."""
        return np.repeat(self._instants, 2)[1:-1], np.repeat(self.record.contact_force, 2)

    def impactor_position(self, time):
        return self._at(time, self.record.position)

    def impactor_velocity(self, time, after=True):
        return self._at(time, self.record.velocity)

    def rigid_velocity(self, time, after=True):
        return self._at(time, self.record.rigid_velocity)

    def end_position(self, time):
        gap = self.record.indentation
        if isinstance(self.scene.contact, Rigid):
            gap = np.minimum(gap, 0.0)  # while they touch the struck end goes with the mass
        return self._at(time, self.record.position - gap)

    def impulse(self, time):
        return self._at(time, self._impulses)

    def amplitudes(self, time):
        """at_contact * q and at_contact * q' / omega, each (time, modes)."""
        time = np.asarray(time, float)
        cells = self._cell(time)
        found = np.empty((2, time.size, self.modes.frequencies.size))
        for row, (t, cell) in enumerate(zip(time.tolist(), cells.tolist(), strict=True)):
            saved = cell // self.stride
            displacement = self.record.checkpoint_displacement[saved].copy()
            velocity = self.record.checkpoint_velocity[saved].copy()
            advance(self._bank, displacement, velocity, self.record.contact_force[saved * self.stride : cell])
            angle = self.modes.frequencies * (t - cell * self.step)
            push = self._softness * self.record.contact_force[cell]
            cosine, sine = np.cos(angle), np.sin(angle)
            found[0, row] = cosine * displacement + sine * velocity + push * 2.0 * np.sin(0.5 * angle) ** 2
            found[1, row] = cosine * velocity - sine * displacement + push * sine
        return found

    def end_velocity(self, time, after=True):
        return self.rigid_velocity(time) + self.amplitudes(time)[1] @ self.modes.frequencies

    def displacement(self, time, x):
        shapes = self.modes.shapes(np.asarray(x, float)) / self.modes.at_contact[:, None]
        return self._at(time, self.record.rigid_position)[:, None] + self.amplitudes(time)[0] @ shapes

    def velocity(self, time, x):
        shapes = self.modes.shapes(np.asarray(x, float)) / self.modes.at_contact[:, None]
        return self.rigid_velocity(time)[:, None] + (self.amplitudes(time)[1] * self.modes.frequencies) @ shapes

    def stress(self, time, x):
        slopes = self.modes.slopes(np.asarray(x, float)) / self.modes.at_contact[:, None]
        return -self.scene.target.material.young * (self.amplitudes(time)[0] @ slopes)

    def energies(self, time):
        """Energy split [J] at the instants nearest to `time`."""
        nearest = np.clip(np.rint(np.asarray(time, float) / self.step), 0, self.steps).astype(int)
        displacement, velocity = self.amplitudes(nearest * self.step)
        law, residual = _law(self.scene, self.modes)
        depth = self.record.indentation
        deepest = np.maximum(np.maximum.accumulate(depth), 0.0)
        pairs = zip(depth[nearest].tolist(), deepest[nearest].tolist(), strict=True)
        rigid_mass = 0.0 if self.scene.target.fixed else self.scene.target.mass
        return {
            "impactor": 0.5 * self.scene.impactor.mass * self.record.velocity[nearest] ** 2,
            "target_rigid": 0.5 * rigid_mass * self.record.rigid_velocity[nearest] ** 2,
            "target_vibration": (displacement**2 + velocity**2) @ self._bank.energy,
            "local": np.array([law.stored(a, most) for a, most in pairs])
            + 0.5 * residual * self.record.spring_force[nearest] ** 2,
            "dissipated": self.record.lost[nearest],
        }

    def frame_figures(self, parting: float, struck_end: bool) -> dict[str, float | None]:
        """What a frame fixed to an end does after the contact: thesis 10.2.

        Its own velocity, which is that of its section and no velocity of the rod; and the largest stress on that end,
        which is free and has none, relative to the peak pressure of the contact: fictitious, from the clamped shapes.
        """
        end = np.array([0.0 if struck_end else self.scene.target.length])
        if self.duration <= parting + self.modes.shortest_period:
            return {"frame_velocity": None, "fictitious_end_stress": None}
        time = np.linspace(parting, self.duration, FRAME_SAMPLES)
        pressure = float(self.record.contact_force.max()) / self.scene.target.area
        return {
            "frame_velocity": float(self.velocity(time[-1:], end)[0, 0]),
            "fictitious_end_stress": float(np.abs(self.stress(time, end)).max()) / pressure,
        }

    def raw_contacts(self) -> tuple[np.ndarray, np.ndarray]:
        """Start and end [s] of every stretch of positive indentation, located inside the steps."""
        a, pressing = self.record.indentation, self.record.contact_force > 0.0
        near = np.append(pressing, False) | np.append(False, pressing)
        touching = (a > 0.0) & near  # a strongly damped surface may come back too slowly to press
        touching[0] = True
        rises = np.flatnonzero(~touching[:-1] & touching[1:])
        falls = np.flatnonzero(touching[:-1] & ~touching[1:])
        falls = falls[falls > 0] if a[1] > 0.0 else falls
        starts = np.concatenate(([0.0], self.step * (rises + _crossing(a, rises, -1))))
        ends = self.step * (falls + _crossing(a, falls, 2))
        if ends.size < starts.size:
            ends = np.append(ends, self.duration)
        return starts, ends

    def contacts(self) -> list[ContactPeriod]:
        """Contact periods as far as these modes can tell: gaps below the shortest kept period are chatter."""
        starts, ends = self.raw_contacts()
        parts = starts[1:] - ends[:-1] >= self.modes.shortest_period
        firsts, lasts = starts[np.append(True, parts)], ends[np.append(parts, True)]
        found = []
        for start, end in zip(firsts.tolist(), lasts.tolist(), strict=True):
            first, last = self._cell(start), self._cell(end) + 1
            force = self.record.contact_force[first:last]
            peak = force.max()
            if isinstance(self.scene.contact, Rigid):
                peak = self.resolved_force(self._instants[first : last + 1]).max()
            found.append(ContactPeriod(start, end, float(force.sum() * self.step), float(peak)))
        return found


def _crossing(a: np.ndarray, cells: np.ndarray, third: int) -> np.ndarray:
    """Where in its cell (0 to 1) the parabola through both ends and the instant `third` cells on is zero."""
    x, y, far = a[cells], a[cells + 1], np.clip(cells + third, 0, a.size - 1)
    line = x / np.where(x == y, 1.0, x - y)
    usable = (far != cells) & (far != cells + 1)
    z = a[far]
    # parabola x + b s + c s^2 through (0, x), (1, y), (third, z)
    c = np.where(usable, ((z - x) / third - (y - x)) / (third - 1), 0.0)
    b = (y - x) - c
    place = line
    for _ in range(4):
        slope = b + 2.0 * c * place
        place = place - np.where(slope != 0.0, (x + b * place + c * place**2) / np.where(slope == 0.0, 1.0, slope), 0.0)
    return np.where((place >= 0.0) & (place <= 1.0), place, np.clip(line, 0.0, 1.0))
