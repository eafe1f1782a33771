"""How far a quasi-static estimate may be trusted: notes with the number that decides, and what to use instead."""

import math

import numpy as np

from ...bodies import Bending, Rod, Wall
from ...contact.duration import contact_time
from ...scene import Scene
from ...solution.sampled_motion import SampledMotion
from ...solution.solution import ContactPeriod
from ...text.notes import Note, Severity
from ..springs import spring_of

COMPARABLE_MASSES = 0.1, 10.0  # mass ratios between which the structural estimate does not hold, thesis 3.5
SLOW_ROUND_TRIPS = 5.0  # that a slow contact outlasts; shorter ones leave waves behind, thesis 3.5
NEGLIGIBLE_ENERGY = 0.01  # share of it that an estimate may leave out without a word
SHORT_CONTACT = 0.5  # of half a fundamental period: a shorter contact does not follow the swing of a beam
RINGING_MODES = 60  # of a beam that a contact is asked to leave ringing; more are beyond MAX_RADIANS
MAX_RADIANS = 100.0  # of a mode during a contact, of which a thousand instants still give the force


def equal_rods(scene: Scene) -> bool:
    """Whether a rod strikes its equal, or a rigid stop, which is the same by symmetry."""
    rod, other = scene.impactor, scene.target
    if not isinstance(rod, Rod) or rod.end_mass:
        return False
    if isinstance(other, Wall) and not other.endless:
        return True
    if not isinstance(other, Rod) or other.support != "free" or other.end_mass:
        return False
    pairs = ((rod.length, other.length), (rod.mass, other.mass), (rod.wave_speed, other.wave_speed))
    return all(math.isclose(a, b, rel_tol=1e-9) for a, b in pairs)


def rod_notes(scene: Scene) -> list[Note]:
    """Of the structural estimate."""
    if COMPARABLE_MASSES[0] < scene.mass_ratio < COMPARABLE_MASSES[1]:
        return [Note("masses-alike", Severity.WARNING)]
    if scene.mass_ratio >= COMPARABLE_MASSES[1] and not equal_rods(scene):
        trips = scene.halting_time / scene.time_unit
        return [Note("rod-too-heavy", Severity.WARNING, ratio=scene.mass_ratio, trips=trips)]
    return []


def beam_notes(scene: Scene) -> list[Note]:
    """Of the structural estimate: a contact far shorter than the swing of the beam with the mass breaks and resumes."""
    spring, mass = spring_of(scene.target), scene.impactor.mass
    half, share = spring.half_swing(mass), spring.carried / mass
    notes = []
    if not scene.rigid_contact:
        alone = contact_time(scene.contact, 1.0 / (1.0 / mass + 1.0 / spring.whole_mass), scene.speed)
        if alone < SHORT_CONTACT * half:
            notes.append(Note("contact-too-short", Severity.WARNING, lasts=alone, share=alone / half, half=half))
    if share >= 1.0:
        notes.append(Note("beam-too-heavy", Severity.WARNING, share=share))
    elif share > COMPARABLE_MASSES[0]:
        notes.append(Note("beam-heavy", Severity.WARNING, share=share))
    return notes


def waves_left_out(scene: Scene, motion: SampledMotion, contact: ContactPeriod) -> list[Note]:
    """A note for each rod that the contact does not outlast: what the force would send into it and not get back; for
    each other body that can ring: what the force would leave in its modes; and for what a slow contact bends.
    """
    notes = _springs_left_out(scene, motion, contact)
    for name, body in (("impactor", scene.impactor), ("target", scene.target)):
        if body.time_unit is not None and not isinstance(body, Rod):
            notes += _ringing_left_out(scene, name, motion, contact)
        if not isinstance(body, Rod) or contact.end > SLOW_ROUND_TRIPS * body.round_trip_time:
            continue
        times, forces = motion.force_history()
        share = float(np.trapezoid(forces**2, times)) / (body.impedance * _given(scene))
        if share > NEGLIGIBLE_ENERGY:
            trips = contact.end / body.round_trip_time
            notes.append(Note("waves-matter", Severity.WARNING, trips=trips, body=name, share=min(share, 1.0)))
    return notes


def _springs_left_out(scene: Scene, motion: SampledMotion, contact: ContactPeriod) -> list[Note]:
    """Bodies that a slow contact bends, in series with the contact law: as a spring, or by their own inertia."""
    notes = []
    for name, body in (("impactor", scene.impactor), ("target", scene.target)):
        if not isinstance(body, (Rod, Bending)):
            continue
        held = name == "target" and body.fixed
        softness = 1.0 / spring_of(body).stiffness if held or isinstance(body, Bending) else _softness(body)
        share = 0.5 * contact.peak_force**2 * softness / _given(scene)
        slow = body.time_unit if isinstance(body, Bending) else SLOW_ROUND_TRIPS * body.round_trip_time
        if contact.end < slow or share <= NEGLIGIBLE_ENERGY:
            continue
        share = min(share, 1.0)
        if held:
            notes.append(Note("spring-left-out", Severity.WARNING, body=body.kind, share=share))
        else:
            notes.append(Note("yielding-left-out", Severity.WARNING, body=body.kind, side=name, share=share))
    return notes


def _softness(rod: Rod) -> float:
    """Twice the strain energy of a free rod over the square of a force that speeds up all of it [m/N]."""
    behind = rod.end_mass / rod.mass  # the push falls to this share of the force along the rod
    return (1.0 + behind + behind**2) / (3.0 * rod.stiffness)


def _given(scene: Scene) -> float:
    """The energy that shares are of [J]: that of the approach, the same from wherever it is seen, of the masses that
    the bodies have where they meet while they move as a whole: a beam turns, too.
    """
    bodies = scene.impactor, scene.target
    if not any(isinstance(body, Bending) for body in bodies):
        return 0.5 * scene.reduced_mass * scene.speed**2
    ease = 0.0
    for body in bodies:
        held = body is scene.target and body.held
        ease += 1.0 / spring_of(body).whole_mass if isinstance(body, Bending) else 0.0 if held else 1.0 / body.mass
    return 0.5 * scene.speed**2 / ease


def _ringing_left_out(scene: Scene, name: str, motion: SampledMotion, contact: ContactPeriod) -> list[Note]:
    """As if the force were that on a half-space, q_i = phi_i F(omega_i) / omega_i, thesis 8.4.4."""
    body, other = (scene.target, scene.impactor) if name == "target" else (scene.impactor, scene.target)
    if body.no_modes is not None:
        return [Note("ringing-unknown", Severity.WARNING, body=name)]
    modes, (times, forces) = body.modes(RINGING_MODES), motion.force_history()
    angle = np.multiply.outer(modes.frequencies, times)
    sent = [np.trapezoid(forces * wave(angle), times, axis=1) for wave in (np.cos, np.sin)]
    whole = _given(scene)
    shares = 0.5 * modes.at_contact**2 * (sent[0] ** 2 + sent[1] ** 2) / whole
    share = float(shares[modes.frequencies * contact.end < MAX_RADIANS].sum())
    energy = min(share, 1.0)
    if energy <= NEGLIGIBLE_ENERGY:
        return []
    if not isinstance(body, Bending):
        return [Note("ringing-left-out", Severity.WARNING, body=name, energy=energy)]
    mass = other.modes(1).rigid_mass
    half = spring_of(body).half_swing(mass) if math.isfinite(mass) else 0.5 * body.time_unit
    return [Note("vibration-left-out", Severity.WARNING, share=contact.end / half, body=name, energy=energy)]
