"""What the theory of rods and beams leaves out, where it matters: yield, buckling of rods, and their motion across."""

import math
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np

from ..bodies import Beam, Bending, Material, Rod
from ..contact.duration import contact_time
from ..scene import Scene
from ..solution.motion import Bends, SendsWaves
from ..solution.solution import ContactPeriod, Solution
from ..text.notes import Note, Severity
from .fronts import front_force

OF_THEORY = (
    "stress-beyond-yield",
    "strain-large",
    "beam-stretches",
    "beam-bends-far",
    "rod-buckles",
    "pulse-short",
)  # codes of its notes
LARGE_STRAIN = 1e-3  # reported where no yield strength is given: most metals yield between it and some 5e-3
MAX_SPEED_ERROR = 0.05  # of waves as long as the pulse; less is not reported
LAST_SPEED_ERROR = 0.3  # beyond which the correction itself is no longer known
MIN_GROWTH = 20.0  # of a slight bend during the impact; less is not reported
INSTANTS = 250  # at which waves are looked at, besides their jumps
BENDING_INSTANTS, BENDING_PLACES = 120, 9  # at which a beam is; they miss some tenth of the largest moment
DEFLECTION_PLACES = 41
MAX_SLOPE = 0.1  # of a beam whose ends are not held; what is left out is of its square
MAX_DEPTHS = 0.5  # by which a beam deflects that is held at both ends: beyond it, tension carries some 20 % and more
TENSION = {"clamped-clamped": 1.0 / 16.0, "pinned-pinned": 0.25}  # force by it over that of bending, in (w / r)^2
REFLECTIONS = 4.0  # times which its supports may raise the stress at once


class Loaded(NamedTuple):
    """A rod of a scene."""

    body: str  # "impactor" or "target"
    number: int  # among all rods of the scene, from the left
    struck: bool  # whether it is one of the two that meet
    rod: Rod


class Stressed(NamedTuple):
    """A rod or a beam, its largest stress of either sign [Pa], and how notes name it."""

    stress: float
    material: Material
    said: dict[str, Any]


def notes_on_theory(solution: Solution, waves: bool) -> list[Note]:
    """Of the rods and beams of a scene, each kind of note once, of the one that needs it most; `waves`: whether it is
    solved for theirs.
    """
    scene, rods = solution.scene, _loaded(solution.scene)
    if solution.peak_force is None or not solution.contacts:
        return []
    stressed = [Stressed(peak_stress(solution, each), each.rod.material, _said(rods, each)) for each in rods]
    if isinstance(scene.target, Bending) and isinstance(solution.motion, Bends):
        said = {"body": "target", "rod": 0, "kind": "beam"}
        stressed.append(Stressed(_bending_stress(solution, scene.target), scene.target.material, said))
    found = _strength(stressed, scene.speed)
    if isinstance(scene.target, Beam) and isinstance(solution.motion, Bends):
        found += _large_deflection(solution, scene.target)
    if rods:
        found += _buckling(solution, rods)
    return found + (_radial_motion(scene, rods) if waves and rods else [])


def _loaded(scene: Scene) -> list[Loaded]:
    first = len(scene.impactor.rods)
    names = ["impactor"] * first + ["target"] * len(scene.target.rods)
    return [Loaded(names[n], n, n in (first - 1, first), rod) for n, rod in enumerate(scene.rods)]


def _said(rods: list[Loaded], each: Loaded) -> dict[str, Any]:
    """Which rod it is: its number in its chain, 0 where it is alone."""
    chain = [other.number for other in rods if other.body == each.body]
    chain = chain[::-1] if each.body == "impactor" else chain  # the first is the one that meets the other body
    return {"body": each.body, "rod": 1 + chain.index(each.number) if len(chain) > 1 else 0, "kind": "rod"}


def _strength(stressed: list[Stressed], speed: float) -> list[Note]:
    """Where stress goes beyond what the material bears elastically, or may do so."""
    found = []
    known = [(each.stress / each.material.yield_strength, each) for each in stressed if each.material.yield_strength]
    share, worst = max(known, key=itemgetter(0), default=(0.0, None))
    if worst is not None and share > 1.0:
        values = {"stress": worst.stress, "strength": worst.stress / share, "slower": speed / share}
        found.append(Note("stress-beyond-yield", Severity.WARNING, **worst.said, **values))
    unknown = [(each.stress / each.material.young, each) for each in stressed if not each.material.yield_strength]
    strain, worst = max(unknown, key=itemgetter(0), default=(0.0, None))
    if worst is not None and strain > LARGE_STRAIN:
        found.append(Note("strain-large", Severity.REMARK, **worst.said, stress=worst.stress, strain=strain))
    return found


def _bending_stress(solution: Solution, beam: Bending) -> float:
    """Largest in the outer fibre of a beam [Pa]; nothing where that cannot be large, as it is not worth the search.

    A place of a long beam that is struck rigidly at v is stressed by v sqrt(E rho) h / 2 r, r being the radius of
    gyration of its section, however long that lasts.
    """
    material, fibre = beam.material, beam.half_depth / beam.second_moment
    at_once = solution.scene.speed * math.sqrt(
        material.young * material.density * beam.section.area / beam.second_moment
    )
    bearable = material.yield_strength or LARGE_STRAIN * material.young
    if REFLECTIONS * at_once < bearable or not isinstance(solution.motion, Bends):
        return 0.0
    times = np.linspace(0.0, solution.duration, BENDING_INSTANTS)
    moment = solution.motion.moment(times, np.linspace(0.0, beam.length, BENDING_PLACES))
    return fibre * float(np.abs(moment).max())


def _large_deflection(solution: Solution, beam: Beam) -> list[Note]:
    """Where a beam bends so far that its theory, of small deflections, leaves out much.

    Held at both ends along its length it is stretched by a deflection w: as w (1 - cos(2 pi x / L)) / 2 between clamps
    and w sin(pi x / L) between pins tension adds the shares (w / r)^2 of `TENSION` to the force, r being the radius
    of gyration of its section. Else shortening is of the square of the slope.
    """
    x = np.linspace(0.0, beam.length, DEFLECTION_PLACES)
    times = np.linspace(0.0, solution.duration, BENDING_INSTANTS)
    moved = solution.known_motion.displacement(times, x)
    if beam.support in TENSION:
        deflection = float(np.abs(moved).max())
        depths = deflection / (2.0 * beam.half_depth)
        if depths <= MAX_DEPTHS:
            return []
        share = TENSION[beam.support] * deflection**2 * beam.section.area / beam.second_moment
        values = {"deflection": deflection, "depths": depths, "share": share}
        return [Note("beam-stretches", Severity.WARNING, **values)]
    if beam.support == "free-free":  # which may turn as it goes off
        line = np.polynomial.polynomial.polyfit(x, moved.T, 1)
        moved = moved - (line[0][:, np.newaxis] + np.multiply.outer(line[1], x))
    slope = float(np.abs(np.gradient(moved, x, axis=1)).max())
    return [Note("beam-bends-far", Severity.WARNING, slope=slope, allowed=MAX_SLOPE)] if slope > MAX_SLOPE else []


def peak_stress(solution: Solution, each: Loaded) -> float:
    """Of either sign in a rod [Pa]: where its waves are known exactly, at its ends and in its middle; else of the
    first front in a rigid contact, of the contact force in one that gives way, and nothing where it is not struck.
    """
    scene, rod = solution.scene, each.rod
    if isinstance(solution.motion, SendsWaves):
        unit = scene.impedance * scene.speed / rod.area
        lag, reach = 0.5 * rod.round_trip_time / scene.time_unit, solution.duration / scene.time_unit
        return unit * _largest_sum(solution.motion, each.number, lag, reach)
    if not each.struck:
        return 0.0
    force = front_force(scene) if scene.rigid_contact else solution.peak_force
    return (force or 0.0) / rod.area


def _largest_sum(motion: SendsWaves, number: int, lag: float, reach: float) -> float:
    """Of the waves of both ends of a rod, where they meet [Z v]; `lag` and `reach` [T]: of the rod and of the time."""
    sent = np.union1d(np.linspace(0.0, reach, INSTANTS), motion.jumps(number, True, reach)[:INSTANTS])
    met = np.add.outer((-lag, 0.0, lag), sent)  # at the left end, in the middle, at the right one
    inside = met <= reach
    sent, met = np.broadcast_to(sent, met.shape)[inside], met[inside]
    stress = [
        motion.sent(number, True, sent, after) + motion.sent(number, False, met, after) for after in (True, False)
    ]
    return float(np.abs(stress).max(initial=0.0))


def _buckling(solution: Solution, rods: list[Loaded]) -> list[Note]:
    """Where a struck rod is so slender that a slight bend grows many times while the impact presses.

    Under a force P a bend of wavenumber k grows as exp(s t), s^2 = (k^2 / rho A) (P - E I k^2); fastest where
    k^2 = P / 2 E I, unless the rod is too short for that.
    """
    contact = max(solution.contacts, key=lambda each: each.impulse)
    found = [(bend_growth(each.rod, contact), each) for each in rods if each.struck and each.rod.second_moment]
    growth, worst = max(found, key=itemgetter(0), default=(0.0, rods[0]))
    if growth < math.log(MIN_GROWTH):
        return []
    force = contact.impulse / (contact.end - contact.start)
    length = worst.rod.length * math.sqrt(euler_load(worst.rod) / force)
    times = math.exp(min(growth, 50.0))
    values = {"force": force, "length": length, "lasts": contact.end - contact.start, "times": times}
    return [Note("rod-buckles", Severity.WARNING, **_said(rods, worst), **values)]


def euler_load(rod: Rod) -> float:
    """Under which it buckles in the end [N]: pi^2 E I / L^2, of a rod fixed at its far end pi^2 E I / 4 L^2."""
    return rod.material.young * (rod.second_moment or math.inf) * _longest_wave(rod) ** 2


def _longest_wave(rod: Rod) -> float:
    """Wavenumber of the longest bend that its ends allow [1/m]; the struck end is free to move across."""
    return math.pi / rod.length * (0.5 if rod.support == "fixed" else 1.0)


def bend_growth(rod: Rod, contact: ContactPeriod) -> float:
    """Logarithm of how many times a slight bend grows during a contact, under its mean force."""
    seconds = contact.end - contact.start
    stiffness = rod.material.young * (rod.second_moment or math.inf)
    force = contact.impulse / seconds if seconds > 0.0 else 0.0
    wave = max(math.sqrt(0.5 * force / stiffness), _longest_wave(rod))
    square = wave**2 * (force - stiffness * wave**2) / (rod.material.density * rod.area)
    return seconds * math.sqrt(square) if square > 0.0 else 0.0


def _radial_motion(scene: Scene, rods: list[Loaded]) -> list[Note]:
    """Where the pulse is so short that the rod's motion across slows its waves down.

    Source: Rayleigh's correction of the speed, c (1 - nu^2 pi^2 (a / wavelength)^2), a wave as long as the pulse.
    """
    seconds = pulse_seconds(scene)
    found = [(_slower(each.rod, seconds), each) for each in rods if each.struck]
    error, worst = max(found, key=itemgetter(0), default=(0.0, rods[0]))
    if error < MAX_SPEED_ERROR:
        return []
    radii = worst.rod.wave_speed * seconds / math.sqrt(worst.rod.area / math.pi)
    values = {"radii": radii, "error": error, "far": error > LAST_SPEED_ERROR}
    return [Note("pulse-short", Severity.REMARK, **_said(rods, worst), **values)]


def pulse_seconds(scene: Scene) -> float:
    """How long the main part of the contact force lasts [s]: in a rigid contact until a mass is halted, or a rod's end
    is back; else at least as long as the contact of two rigid bodies.
    """
    if scene.prescribed_force:
        return math.inf
    impactor = scene.impactor.round_trip_time
    halted = scene.halting_time if impactor is None else impactor
    if scene.rigid_contact:
        return halted
    return max(halted if math.isfinite(halted) else 0.0, contact_time(scene.contact, scene.reduced_mass, scene.speed))


def _slower(rod: Rod, seconds: float) -> float:
    """Share of the speed of its waves that motion across takes from one so long [s]."""
    radius = math.sqrt(rod.area / math.pi)
    return (rod.material.poisson * math.pi * radius / (rod.wave_speed * seconds)) ** 2
