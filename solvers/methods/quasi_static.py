"""Quasi-static estimates: as if the force were put on slowly, in the structure or at the contact."""

import math
import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import checks
from ..method import AFTERGLOW, Method
from ..motion import SampledMotion, ShapeField
from ..numerics.quasi_static import Collision, damped_collision, path_collision, power_collision, sine_collision
from ..scene import Scene, contact_time
from ..solution import ContactPeriod, Solution, summary

MODELS = ("auto", "structural", "structural-massless", "structural-printed", "local", "hertz-sine")
EXPONENTS = {"linear": 1.0, "hertz": 1.5}
SAMPLES = 1_000  # instants of a contact, and of a round trip after it
COMPACT = ("mass", "sphere", "rod")  # what moves as a whole
UNSURE = 0.1, 10.0  # mass ratios in between: neither estimate holds, thesis 3.5


@dataclass(frozen=True)
class QuasiStatic(Method):
    """One degree of freedom: either the structure bends as under a static force, or only the contact gives way.

    "structural": a mass on the end of a fixed rod, which bends as a spring EA/L with a third of its mass on it, or on a
    mass with a spring; both go on as one from the first instant, and part when the force on the impactor is zero.
    "structural-massless": without that mass. Two equal rods, or a rod on a rigid stop: each bends as a hanging rod does
    under its own weight; "structural-printed" starts them as the thesis prints it.
    "local": both bodies move as a whole, rods too, and the contact law is all that gives way; any law, closed form for
    powers of the indentation, work integrals for laws with memory, a differential equation for laws with damping.
    "hertz-sine": the half sine that approximates it.
    "auto": structural if the contact is rigid; with a law, structural for a fixed rod lighter than the impactor, and
    local for anything else (thesis 3.5). The two are never put in series, as the thesis has no such model.
    Source: thesis 3.3, 3.4. Differs: (3.20) lets the contact force drop by kappa = 1 / sqrt(1 + beta / 3); kappa is the
    drop of the force at the root, that on the impactor drops by kappa^3, after an impulse m1 v (beta/3) / (1 + beta/3)
    at the first instant. (3.21) starts with v; the projection that (3.19) uses gives 15 v / 16, and only that the
    impulse 2 m v.
    """

    model: str = "auto"

    NAME = "quasi-static"

    @classmethod
    def read(cls, given: Mapping[str, object]) -> "QuasiStatic":
        given = checks.table("method", given, ("model",))
        return cls(checks.choice("method.model", given.get("model", "auto"), MODELS))

    def why_not(self, scene: Scene) -> str | None:
        model = self._model(scene)
        target, kinds = scene.target, f"got {scene.impactor.kind} and {scene.target.kind}"
        if target.kind == "rods" or getattr(target, "support", None) == "anechoic":
            return "the target must be one body of finite length, for chains and endless rods use 'waves'"
        if not model.startswith("structural"):
            return self._why_not_local(scene, model)
        if _equal_rods(scene):
            return None if model != "structural-massless" else "two rods without mass have nothing to strike with"
        if model == "structural-printed":
            return f"'structural-printed' is for two equal rods, or a rod on a stop, {kinds}; use 'structural'"
        fixed_rod = target.kind == "rod" and target.fixed
        if scene.impactor.kind not in ("mass", "sphere") or not (fixed_rod or target.kind == "spring-mass"):
            return (
                "a mass must strike a fixed rod or a mass on a spring, or a rod its equal or a stop, "
                f"{kinds}; use 'waves', or a contact law and the model 'local'"
            )
        return None

    def _why_not_local(self, scene: Scene, model: str) -> str | None:
        if scene.contact.NAME == "rigid":
            return "the contact must have a law, as nothing else gives way; use 'rigid' or the model 'structural'"
        if scene.target.kind == "spring-mass":
            return "the target must move as a whole, got a mass on a spring; use 'modal' or the model 'structural'"
        if model == "hertz-sine" and scene.contact.NAME != "hertz":
            return f"'hertz-sine' is for Hertz contact, got {scene.contact.NAME}; use 'local'"
        return None

    def _model(self, scene: Scene) -> str:
        if self.model != "auto":
            return self.model
        if scene.contact.NAME == "rigid":
            return "structural"
        light = scene.target.kind == "rod" and scene.target.fixed and scene.mass_ratio < 1.0
        return "structural" if light and scene.impactor.kind != "rod" else "local"

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        begun = time.perf_counter()
        model = self._model(scene)
        if not model.startswith("structural"):
            found = _local(scene, model, duration)
        elif _equal_rods(scene):
            found = _two_rods(scene, model == "structural-printed", duration)
        else:
            found = _on_spring(scene, model == "structural", duration)
        wall_time = time.perf_counter() - begun
        motion, duration, contact, depth, dent, extra = found
        results = summary(scene, motion, [contact], duration, wall_time)
        results["diagnostics"] |= {"steps": motion.time.size - 1, "model": model} | extra
        return Solution(
            scene=scene,
            method=self.table(),
            contacts=[contact],
            duration=duration,
            motion=motion,
            peak_force=contact.peak_force,
            peak_indentation=depth,
            residual_indentation=dent,
            notes=_notes(scene, model, contact.end >= duration * (1.0 - 1e-12)),
            **results,
        )


def _notes(scene: Scene, model: str, touching: bool) -> list[str]:
    notes = []
    if touching:
        notes.append("The bodies are still in contact at the end of the time solved.")
    if scene.target.kind == "rod" and UNSURE[0] < scene.mass_ratio < UNSURE[1]:
        notes.append(
            "Masses alike: no quasi-static estimate holds, as waves matter (thesis 3.5); compare with 'waves'."
        )
    if model.startswith("structural") and scene.contact.NAME != "rigid":
        notes.append("The contact law is left out: only the structure gives way; compare with 'modal'.")
    if model == "hertz-sine":
        notes.append("The half sine gives 6.7 % too much impulse and 8.8 % too little peak; 'local' is exact.")
    if model == "structural-printed":
        notes.append("Started as (3.21) prints it, the impulse is 32/15 m v, more than 2 m v; 'structural' repairs it.")
    return notes


def _equal_rods(scene: Scene) -> bool:
    """Whether a rod strikes its equal, or a rigid stop, which is the same by symmetry."""
    rod, other = scene.impactor, scene.target
    if rod.kind != "rod" or rod.end_mass:
        return False
    if other.kind == "stop":
        return True
    if other.kind != "rod" or other.support != "free" or other.end_mass:
        return False
    pairs = ((rod.length, other.length), (rod.mass, other.mass), (rod.wave_speed, other.wave_speed))
    return all(math.isclose(a, b, rel_tol=1e-9) for a, b in pairs)


class _Course:
    """Instants of contact and flight, and the contact period up to the end of the solution."""

    def __init__(self, contact_time: float, after: float, unit: float, duration: float | None):
        self.parting = contact_time
        self.duration = contact_time + after if duration is None else duration
        flight = max(self.duration - contact_time, 0.0)
        count = 2 + int(min(SAMPLES * flight / unit, 20 * SAMPLES))
        self.contact = np.linspace(0.0, contact_time, SAMPLES + 1)
        self.flight = contact_time + np.linspace(0.0, max(flight, 1e-9 * contact_time), count)
        self.time = np.concatenate((self.contact, self.flight))

    def joined(self, during: np.ndarray, after: np.ndarray | float) -> np.ndarray:
        return np.concatenate((during, np.broadcast_to(after, self.flight.shape)))

    def period(self, force: np.ndarray, impulse: np.ndarray) -> ContactPeriod:
        end = min(self.parting, self.duration)
        within = self.time <= end
        peak = float(max(force[within].max(), np.interp(end, self.contact, force[: self.contact.size])))
        return ContactPeriod(0.0, end, float(np.interp(end, self.contact, impulse[: self.contact.size])), peak)


def _on_spring(scene: Scene, with_mass: bool, duration: float | None) -> tuple:
    """A mass on a spring of the structure's stiffness, with some of the structure's mass or none. (3.13)-(3.20)"""
    rod = scene.target.kind == "rod"
    mass, target, speed = scene.impactor.mass, scene.target, scene.speed
    carried = (target.mass / 3.0 if rod else target.mass) if with_mass else 0.0  # (3.18)
    frequency = math.sqrt(target.stiffness / (mass + carried))
    start = speed * mass / (mass + carried)  # (3.19)
    course = _Course(math.pi / frequency, AFTERGLOW * scene.time_unit, scene.time_unit, duration)
    angle = frequency * course.contact
    depth, rate = start / frequency * np.sin(angle), start * np.cos(angle)
    force = mass * frequency * start * np.sin(angle)
    first = mass * (speed - start)
    impulse = first + mass * start * 2.0 * np.sin(0.5 * angle) ** 2
    since, swing, swing_rate = (
        course.flight - course.parting,
        np.zeros_like(course.flight),
        np.zeros_like(course.flight),
    )
    if carried:
        own = math.sqrt(target.stiffness / carried)
        swing, swing_rate = -start / own * np.sin(own * since), -start * np.cos(own * since)
    position, velocity = course.joined(depth, -start * since), course.joined(rate, -start)
    end, end_rate = course.joined(depth, swing), course.joined(rate, swing_rate)
    force, impulse = course.joined(force, 0.0), course.joined(impulse, impulse[-1])
    lost = 0.5 * mass * speed * (speed - start)
    field = None
    if rod:
        shapes = lambda x: (1.0 - x / target.length)[None, :]  # noqa: E731
        slopes = lambda x: np.full((1, x.size), -1.0 / target.length)  # noqa: E731
        field = ShapeField(course.time, end[:, None], end_rate[:, None], shapes, slopes, target.material.young)
    motion = SampledMotion(
        time=course.time,
        force=force,
        impulse=impulse,
        impactor_position=position,
        impactor_velocity=velocity,
        end_position=end,
        end_velocity=end_rate,
        rigid_velocity=0.5 * end_rate if rod else end_rate,
        energies={
            "impactor": 0.5 * mass * velocity**2,
            "target_rigid": np.zeros_like(end),
            "target_vibration": 0.5 * target.stiffness * end**2 + 0.5 * carried * end_rate**2,
            "local": np.zeros_like(end),
            "dissipated": np.full_like(end, lost),
        },
        field=field,
    )
    extra = {"initial_impulse": first, "peak_root_force": target.stiffness * start / frequency}
    return motion, course.duration, course.period(force, impulse), None, None, extra


def _two_rods(scene: Scene, printed: bool, duration: float | None) -> tuple:
    """Two equal rods, each with the shape u = (8/3) x1 (xi - xi^2 / 2), x1 the approach of its middle. (3.21)-(3.23)

    The centres of mass follow from the impulse of the force; what they do not hold of the energy is in the bending.
    """
    rod, target = scene.impactor, scene.target
    stop = target.kind == "stop"
    mass, speed = rod.mass, scene.speed if stop else 0.5 * scene.speed
    centre = 0.0 if stop else 0.5 * (rod.velocity + target.velocity)
    frequency = math.sqrt(2.5 * rod.stiffness / mass)  # (3.22): 135/54
    start = speed if printed else 15.0 / 16.0 * speed
    course = _Course(math.pi / frequency, AFTERGLOW * rod.round_trip_time, rod.round_trip_time, duration)
    angle = frequency * course.contact
    force = 8.0 / 3.0 * rod.stiffness * start / frequency * np.sin(angle)  # (3.23)
    impulse = 8.0 / 3.0 * rod.stiffness * start / frequency**2 * 2.0 * np.sin(0.5 * angle) ** 2
    since = course.flight - course.parting
    after = speed - impulse[-1] / mass  # of the impactor, as seen from the common centre
    travel = speed * course.contact - 8.0 / 3.0 * rod.stiffness * start / (frequency**2 * mass) * (
        course.contact - np.sin(angle) / frequency
    )
    approach = course.joined(speed - impulse / mass, after)
    moved = course.joined(travel, travel[-1] + after * since)
    bent = course.joined(start / frequency * np.sin(angle), 0.0)
    bent_rate = course.joined(start * np.cos(angle), 0.0)
    force, impulse = course.joined(force, 0.0), course.joined(impulse, impulse[-1])
    away = course.joined(np.zeros_like(course.contact), -after * since) if not stop else np.zeros_like(bent)
    leaving = course.joined(np.zeros_like(course.contact), -after) if not stop else np.zeros_like(bent)
    velocity, mean = centre + approach, centre - (0.0 if stop else 1.0) * approach
    energies = {
        "impactor": 0.5 * mass * velocity**2,
        "target_rigid": np.zeros_like(mean) if stop else 0.5 * mass * mean**2,
    }
    held = sum(energies.values())
    energies |= {
        "target_vibration": np.maximum(scene.initial_energy - held, 0.0),
        "local": np.zeros_like(held),
        "dissipated": np.zeros_like(held),
    }
    field = None
    if not stop:
        length = target.length
        shapes = lambda x: np.stack((np.ones(x.size), -8.0 / 3.0 * (x / length - 0.5 * (x / length) ** 2)))  # noqa: E731
        slopes = lambda x: np.stack((np.zeros(x.size), -8.0 / 3.0 * (1.0 - x / length) / length))  # noqa: E731
        coordinates = np.stack((centre * course.time + away, bent), axis=1)
        rates = np.stack((centre + leaving, bent_rate), axis=1)
        field = ShapeField(course.time, coordinates, rates, shapes, slopes, target.material.young)
    motion = SampledMotion(
        time=course.time,
        force=force,
        impulse=impulse,
        impactor_position=centre * course.time + moved,
        impactor_velocity=velocity,
        end_position=centre * course.time + away,
        end_velocity=centre + leaving,
        rigid_velocity=mean if not stop else np.zeros_like(mean),
        energies=energies,
        field=field,
    )
    return motion, course.duration, course.period(force, impulse), None, None, {}


def _local(scene: Scene, model: str, duration: float | None) -> tuple:
    """Two bodies that move as a whole, with the contact law between them. (3.28)-(3.34)"""
    mass, speed, law = scene.reduced_mass, scene.speed, scene.contact
    found = _collision(law, model, mass, speed)
    parting = float(found.time[-1])
    duration = parting + AFTERGLOW * scene.time_unit if duration is None else duration
    last = max(duration, parting * (1.0 + 1e-9))
    indentation, force, impulse, stored, lost = (
        np.append(values, values[-1])
        for values in (found.indentation, found.force, found.impulse, found.stored, found.lost)
    )
    force[-2:] = 0.0
    instants = np.append(found.time, last)
    indentation[-1] += found.rate[-1] * (last - parting)
    target, impactor = scene.target, scene.impactor
    share = 0.0 if target.held else impactor.mass / (impactor.mass + target.mass)  # of the target in the approach
    drift = 0.0 if target.held else share * impactor.velocity + (1.0 - share) * target.velocity
    velocity = impactor.velocity - impulse / impactor.mass
    mean = np.zeros_like(impulse) if target.held else target.velocity + impulse / target.mass
    moving = 0.0 if target.held else 0.5 * target.mass * mean**2
    dent = max(float(found.indentation[-1]), 0.0)
    motion = SampledMotion(
        time=instants,
        force=force,
        impulse=impulse,
        impactor_position=drift * instants + (1.0 - share) * indentation,
        impactor_velocity=velocity,
        end_position=drift * instants - share * indentation,
        end_velocity=mean,
        rigid_velocity=mean,
        energies={
            "impactor": 0.5 * impactor.mass * velocity**2,
            "target_rigid": np.zeros_like(mean) + moving,
            "target_vibration": np.zeros_like(mean),
            "local": stored,
            "dissipated": lost,
        },
    )
    end = min(parting, duration)
    within = found.time <= end
    contact = ContactPeriod(
        0.0, end, float(np.interp(end, found.time, found.impulse)), float(found.force[within].max())
    )
    if law.PLASTIC:
        dent = float(law.dent(found.indentation[within].max()))
    elif not law.LOSSY:
        dent = 0.0
    extra = {"delivered_restitution": float(-found.rate[-1] / speed)}
    return motion, duration, contact, float(found.indentation[within].max()), dent, extra


def _collision(law: Any, model: str, mass: float, speed: float) -> Collision:
    if model == "hertz-sine":
        return sine_collision(law.stiffness, mass, speed, SAMPLES)
    exponent = EXPONENTS.get(law.NAME, getattr(law, "exponent", None) if law.NAME == "power" else None)
    if exponent is not None:
        return power_collision(law.stiffness, exponent, mass, speed, SAMPLES)
    if law.LOSSY:
        return damped_collision(law, mass, speed, contact_time(law, mass, speed))
    return path_collision(law, mass, speed)
