"""Quasi-static estimates: as if the force were put on slowly, in the structure or at the contact."""

import math
from dataclasses import dataclass

import numpy as np

from ...bodies import Balls, Bending, Rod, Wall, Waveguide
from ...contact import Hertz
from ...numerics.single_degree import (
    SAMPLES,
    SQUARE,
    Response,
    against_equal,
    energy_of_spring,
    half_swing,
    instants_of,
    on_spring,
    on_spring_under_weight,
    spread,
    sway,
)
from ...provenance import clock
from ...scene import Scene
from ...solution.sampled_motion import SampledMotion, ShapeField
from ...solution.solution import ContactPeriod, Solution
from ...solution.summary import summary, touching
from ...text.notes import Note, Severity
from ..base import AFTERGLOW, Method
from ..options import option, word
from ..springs import is_spring, spring_of
from ..validity import STILL_TOUCHING
from .balls import solve_balls
from .balls import why_not as why_not_balls
from .local import Estimate, local
from .validity import beam_notes, equal_rods, rod_notes, waves_left_out

SWINGS = 5.0  # for which a mass that never leaves a spring is followed
MODELS = ("auto", "structural", "structural-massless", "structural-printed", "local", "hertz-sine")


@dataclass(frozen=True)
class QuasiStatic(Method):
    """One degree of freedom: either the structure bends as under a static force, or only the contact gives way.

    "structural": a mass on the end of a fixed rod, which bends as a spring EA/L with a third of its mass on it, or on a
    mass with a spring, or on a beam, which bends in its static shape with the equivalent mass of that; both go on as
    one from the first instant, and part when the force on the impactor is zero.
    "structural-massless": without that mass. Two equal rods, or a rod on a rigid stop: each bends as a hanging rod does
    under its own weight; "structural-printed" starts them as the thesis prints it.
    "local": both bodies move as a whole, rods too, and the contact law is all that gives way; any law, closed form for
    powers of the indentation, work integrals for laws with memory, a differential equation for laws with damping.
    A row of balls is followed as one differential equation, by "local" whatever is asked for.
    "hertz-sine": the half sine that approximates it.
    "auto": structural if the contact is rigid; with a law, structural for a fixed rod lighter than the impactor or a
    beam whose equivalent mass is, and local for anything else (thesis 3.5). The two are never put in series, as the
    thesis has no such model.
    Source: thesis 3.3, 3.4, (8.13)-(8.15). Differs: (3.20) lets the contact force drop by kappa = 1 / sqrt(1 + beta /
    3); kappa is the drop of the force at the root, that on the impactor drops by kappa^3, after an impulse
    m1 v (beta / 3) / (1 + beta / 3) at the first instant. (3.21) starts with v; the projection that (3.19) uses gives
    15 v / 16, and only that the impulse 2 m v.
    """

    model: str = option("auto", word(MODELS))

    NAME = "quasi-static"
    WEIGHT = True
    WAVES = False
    BEAMS = ROWS = True

    def why_not(self, scene: Scene) -> Note | None:
        model = self.model_of(scene)
        target, kinds = scene.target, {"impactor": scene.impactor.kind, "target": scene.target.kind}
        for body in (scene.impactor, target):
            if isinstance(body, Waveguide) and (body.endless or not isinstance(body, Rod)):
                return Note("refusals.no-finite-body", Severity.REFUSAL)
        if isinstance(target, Balls):
            return why_not_balls(scene)
        if not model.startswith("structural"):
            return self._why_not_local(scene, model)
        if equal_rods(scene):
            return None if model != "structural-massless" else Note("refusals.massless-rods", Severity.REFUSAL)
        if model == "structural-printed":
            return Note("refusals.not-as-printed", Severity.REFUSAL, **kinds)
        if not (scene.impactor.free_mass and is_spring(target)):
            return Note("refusals.no-structure", Severity.REFUSAL, **kinds)
        return None

    def _why_not_local(self, scene: Scene, model: str) -> Note | None:
        if scene.rigid_contact:
            return Note("refusals.no-law", Severity.REFUSAL)
        if scene.target.half_swing is not None:
            return Note("refusals.spring-not-local", Severity.REFUSAL)
        if model == "hertz-sine" and not isinstance(scene.contact, Hertz):
            return Note("refusals.not-hertz", Severity.REFUSAL, law=scene.contact.NAME)
        return None

    def takes_weight(self, scene: Scene) -> bool:
        model = self.model_of(scene)
        return model != "hertz-sine" and not (model.startswith("structural") and equal_rods(scene))

    def _miscounts(self) -> str:
        return "one-contact"

    def model_of(self, scene: Scene) -> str:
        """The model that is taken: the one that is asked for, or by "auto" the one that suits the scene."""
        if self.model != "auto":
            return self.model
        if scene.rigid_contact:
            return "structural"
        if not scene.impactor.free_mass:
            return "local"
        if isinstance(scene.target, Bending):
            return "structural" if spring_of(scene.target).carried < scene.impactor.mass else "local"
        light = isinstance(scene.target, Rod) and scene.target.fixed and scene.mass_ratio < 1.0
        return "structural" if light else "local"

    def _solve(self, scene: Scene, duration: float | None) -> Solution:
        if isinstance(scene.target, Balls):
            return solve_balls(scene, self.table() | {"model": "local"}, duration)
        begun = clock()
        model = self.model_of(scene)
        if not model.startswith("structural"):
            found = local(scene, model, duration)
        elif equal_rods(scene):
            found = _two_rods(scene, model == "structural-printed", duration)
        else:
            found = _on_spring(scene, model == "structural", duration)
        wall_time = clock() - begun
        motion, contacts = found.motion, found.contacts
        results = summary(scene, motion, contacts, found.duration, wall_time)
        results["diagnostics"] |= {"steps": motion.time.size - 1, "model": model} | found.diagnostics
        return Solution(
            scene=scene,
            method=self.table() | {"model": model},
            contacts=contacts,
            duration=found.duration,
            motion=motion,
            peak_force=max(contact.peak_force for contact in contacts),
            peak_indentation=found.peak_indentation,
            residual_indentation=found.residual_indentation,
            notes=found.notes + _notes(scene, model, found),
            **results,
        )


def _notes(scene: Scene, model: str, found: Estimate) -> list[Note]:
    notes = []
    if touching(found.contacts, found.duration) and not found.notes:
        notes.append(STILL_TOUCHING)
    structural = model.startswith("structural")
    if structural and isinstance(scene.target, Rod):
        notes += rod_notes(scene)
    if structural and scene.target.bends:
        notes += beam_notes(scene)
    if not structural:
        notes += waves_left_out(scene, found.motion, found.contacts[0])
    if structural and not scene.rigid_contact:
        notes.append(Note("law-left-out", Severity.WARNING))
    if model == "hertz-sine":
        notes.append(Note("half-sine", Severity.REMARK))
    if model == "structural-printed":
        notes.append(Note("impulse-as-printed", Severity.WARNING))
    return notes


class _Instants:
    """Of the contact and of the flight after it, and the contact period up to the end of the solution."""

    def __init__(self, contact_time: float, unit: float, duration: float | None):
        self.parting = contact_time
        self.duration = contact_time + AFTERGLOW * unit if duration is None else duration
        self.time = np.empty(instants_of(contact_time, self.duration, unit))
        spread(contact_time, self.duration, self.time)
        self.contact, self.flight = self.time[: SAMPLES + 1], self.time[SAMPLES + 1 :]

    def period(self, response: Response) -> ContactPeriod:
        end = min(self.parting, self.duration)
        time, force, impulse = (
            values[: self.contact.size] for values in (response.time, response.force, response.impulse)
        )
        peak = max(float(force[time <= end].max()), float(np.interp(end, time, force)))
        return ContactPeriod(0.0, end, float(np.interp(end, time, impulse)), peak)


def _on_spring(scene: Scene, with_mass: bool, duration: float | None) -> Estimate:
    """A mass on a spring of the structure's stiffness, with some of the structure's mass or none. (3.13)-(3.20)

    A structure that is free to move goes off as a whole besides: then the reduced mass swings on the spring.
    """
    mass, target, speed, fall = scene.impactor.mass, scene.target, scene.speed, scene.weight_acceleration
    spring = spring_of(target)
    reduced, carried = 1.0 / (1.0 / mass + 1.0 / spring.whole_mass), spring.carried if with_mass else 0.0
    instants, notes = _swing(scene, reduced, carried, spring.stiffness, duration)
    if fall:
        known = reduced, carried, spring.stiffness, speed, fall
        response = on_spring_under_weight(*known, instants.time, SAMPLES)
    else:
        response = Response.of(instants.time)
        on_spring(reduced, carried, spring.stiffness, speed, response)
    moving = response.impulse / spring.whole_mass
    freely = response.time * (speed + 0.5 * fall * response.time)
    moved = (freely - response.position) * reduced / spring.whole_mass
    drift, gained = target.velocity * response.time, speed - response.impulse / mass + fall * response.time
    start = 0.5 * target.mass * target.velocity**2 if target.velocity else 0.0
    whole_mass = 0.0 if math.isinf(spring.whole_mass) else spring.whole_mass
    energies = {
        "impactor": 0.5 * mass * (target.velocity + gained) ** 2,
        "target_rigid": start + whole_mass * moving * (target.velocity + 0.5 * moving),
        "target_vibration": energy_of_spring(spring.stiffness, carried, response.bent, response.bent_rate),
        "local": np.zeros_like(moving),
        "dissipated": np.full_like(moving, 0.5 * speed * response.impulse[0]),  # as two bodies become one
    }
    position = drift + moved + response.position
    if fall:
        energies["weight"] = -mass * fall * position
    motion = SampledMotion(
        time=response.time,
        force=response.force,
        impulse=response.impulse,
        impactor_position=position,
        impactor_velocity=target.velocity + gained,
        end_position=drift + moved + response.bent,
        end_velocity=target.velocity + moving + response.bent_rate,
        rigid_velocity=target.velocity + spring.rigid_mean * moving + spring.mean * response.bent_rate,
        energies=energies,
        field=None if spring.field is None else spring.field(response, moved, moving),
    )
    extra = {
        "initial_impulse": float(response.impulse[0]),
        "peak_root_force": float(spring.stiffness * response.bent[: SAMPLES + 1].max()),
    }
    if target.bends:
        extra |= {
            "equivalent_mass": spring.carried,
            "peak_deflection": float(response.bent[: SAMPLES + 1].max()),
        }
    return Estimate(motion, instants.duration, [instants.period(response)], diagnostics=extra, notes=notes)


def _swing(
    scene: Scene, mass: float, carried: float, stiffness: float, duration: float | None
) -> tuple[_Instants, list[Note]]:
    """The instants of a mass on a spring; under its weight it may never leave, and it comes back where it does."""
    fall = scene.weight_acceleration
    if not fall:
        return _Instants(half_swing(mass, carried, stiffness), scene.time_unit, duration), []
    known = sway(mass, carried, stiffness, scene.speed, fall)
    if math.isinf(known.parting):
        lasts = 2.0 * math.pi * SWINGS / known.frequency if duration is None else duration
        note = Note("never-leaves", Severity.REMARK, time=lasts, damped=False)
        return _Instants(lasts, scene.time_unit, lasts), [note]
    angle = known.frequency * known.parting - known.lag
    down, left = known.sag + known.reach * math.sin(angle), -known.reach * known.frequency * math.cos(angle)
    flight = (left + math.sqrt(max(left**2 - 2.0 * fall * down, 0.0))) / fall
    if duration is None:
        duration = known.parting + min(AFTERGLOW * scene.time_unit, 0.5 * flight)
    back = known.parting + flight
    notes = [Note("weight-brings-back", Severity.WARNING, time=back)] if duration > back else []
    return _Instants(known.parting, scene.time_unit, duration), notes


def _two_rods(scene: Scene, printed: bool, duration: float | None) -> Estimate:
    """Two equal rods, as seen from their common centre, or one on a stop. (3.21)-(3.23)

    What the centres of mass do not hold of the energy is in the bending.
    """
    rod, target = scene.impactor.known_as(Rod), scene.target
    stop = isinstance(target, Wall)
    speed = scene.speed if stop else 0.5 * scene.speed
    centre = rod.velocity - speed
    start = speed if printed else 15.0 / 16.0 * speed
    contact_time = math.pi * math.sqrt(rod.mass / (SQUARE * rod.stiffness))
    instants = _Instants(contact_time, rod.round_trip_time, duration)
    response = against_equal(rod.mass, rod.stiffness, speed, start, instants.contact, instants.flight)
    mirrored = 0.0 if stop else 1.0
    after = response.time >= instants.parting
    after[: instants.contact.size] = False
    leaving = np.where(after, -mirrored * response.velocity, 0.0)  # of the touching faces
    away = leaving * (response.time - instants.parting)
    mean = centre - mirrored * response.velocity if not stop else np.zeros_like(response.velocity)
    impactor = 0.5 * rod.mass * (centre + response.velocity) ** 2
    rigid = 0.5 * rod.mass * mean**2
    motion = SampledMotion(
        time=response.time,
        force=response.force,
        impulse=response.impulse,
        impactor_position=centre * response.time + response.position,
        impactor_velocity=centre + response.velocity,
        end_position=centre * response.time + away,
        end_velocity=centre + leaving,
        rigid_velocity=mean,
        energies={
            "impactor": impactor,
            "target_rigid": rigid,
            "target_vibration": np.maximum(scene.initial_energy - impactor - rigid, 0.0),
            "local": np.zeros_like(mean),
            "dissipated": np.zeros_like(mean),
        },
        field=_bent_rod(target, response, centre * response.time + away, centre + leaving)
        if isinstance(target, Rod)
        else None,
    )
    return Estimate(motion, instants.duration, [instants.period(response)])


def _bent_rod(rod: Rod, response: Response, face: np.ndarray, face_rate: np.ndarray) -> ShapeField:
    """The touching face, and the shape u = (8/3) x1 (xi - xi^2 / 2) of a rod that hangs from it."""

    def shapes(x):
        place = x / rod.length
        return np.stack((np.ones_like(place), -8.0 / 3.0 * (place - 0.5 * place**2)))

    def slopes(x):
        place = x / rod.length
        return np.stack((np.zeros_like(place), -8.0 / 3.0 * (1.0 - place) / rod.length))

    coordinates, rates = np.stack((face, response.bent), axis=1), np.stack((face_rate, response.bent_rate), axis=1)
    return ShapeField(response.time, coordinates, rates, shapes, slopes, rod.material.young)
