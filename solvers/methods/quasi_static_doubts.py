"""How far a quasi-static estimate may be trusted: sentences with the number that decides, and what to use instead."""

import math

import numpy as np

from ..motion import SampledMotion
from ..scene import Scene, contact_time
from ..solution import ContactPeriod
from .springs import spring_of

UNSURE = 0.1, 10.0  # mass ratios in between: the structural estimate does not hold, thesis 3.5
SLOW = 5.0  # round trips of a wave that a slow contact outlasts
NEGLIGIBLE = 0.01  # share of the energy
SHORT = 0.5  # of half a fundamental period: a shorter contact does not follow the swing of a beam
RINGING = 60  # modes of a beam that a contact is asked to leave ringing
FINEST = 100.0  # radians of a contact, of which a thousand instants still tell the force


def equal_rods(scene: Scene) -> bool:
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


def rod_doubts(scene: Scene) -> list[str]:
    """Of the structural estimate."""
    if UNSURE[0] < scene.mass_ratio < UNSURE[1]:
        return ["Masses alike: no quasi-static estimate holds, as waves matter (thesis 3.5); compare with 'waves'."]
    if scene.mass_ratio >= UNSURE[1] and not equal_rods(scene):
        blow = scene.blow / scene.target.round_trip_time
        return [
            f"The rod is {scene.mass_ratio:.3g} times as heavy as the impactor: waves stop that within {blow:.2g} "
            "round trips, long before the rod has bent as a whole. Not structural (thesis 3.5): give the contact "
            "a law and use 'local', or use 'waves'."
        ]
    return []


def beam_doubts(scene: Scene) -> list[str]:
    """Of the structural estimate: a contact far shorter than the swing of the beam with the mass breaks and resumes."""
    spring, mass = spring_of(scene.target), scene.impactor.mass
    half, share = spring.half_swing(mass), spring.carried / mass
    notes = []
    if scene.contact.NAME != "rigid":
        alone = contact_time(scene.contact, 1.0 / (1.0 / mass + 1.0 / spring.felt), scene.speed)
        if alone < SHORT * half:
            notes.append(
                f"By itself the contact would last {alone:.2g} s, {alone / half:.2g} of half the fundamental period of "
                f"the beam with the mass on it, {half:.3g} s: too short to be structural. It breaks and resumes; trust "
                "the deflection, not the force (thesis 8.4.3); compare with 'modal'."
            )
    if share >= 1.0:
        notes.append(
            f"The beam bends with {share:.2g} times the mass of the impactor: the blow is over before the beam has "
            "swung. Not structural (thesis 8.4.4): give the contact a law and use 'local', or use 'modal'."
        )
    elif share > UNSURE[0]:
        notes.append(
            f"The beam bends with {share:.2g} of the mass of the impactor: contact breaks and resumes, so that forces "
            "are several times higher; only the deflection is near, within some 10 % (thesis 8.4.3)."
        )
    return notes


def waves_left_out(scene: Scene, motion: SampledMotion, contact: ContactPeriod) -> list[str]:
    """A doubt for each rod that the contact does not outlast: what the force would send into it and not get back; and
    for each beam that the force would leave ringing.
    """
    notes = _spring_left_out(scene, motion, contact)
    for name, body in (("impactor", scene.impactor), ("target", scene.target)):
        if body.kind == "beam":
            notes += _ringing_left_out(scene, name, motion, contact)
        if body.kind != "rod" or contact.end > SLOW * body.round_trip_time:
            continue
        times, forces = motion.force_history()
        share = float(np.trapezoid(forces**2, times)) / (body.impedance * scene.initial_energy)
        if share > NEGLIGIBLE:
            notes.append(
                f"The contact lasts {contact.end / body.round_trip_time:.2g} round trips of the {name}, too few to be "
                f"slow: its waves take up to {min(share, 1.0):.0%} of the energy (thesis 3.5); compare with 'waves'."
            )
    return notes


def _spring_left_out(scene: Scene, motion: SampledMotion, contact: ContactPeriod) -> list[str]:
    """A held body that a slow contact bends as a spring, in series with the contact law."""
    target = scene.target
    if target.kind not in ("rod", "beam") or not target.fixed:
        return []
    share = 0.5 * contact.peak_force**2 / spring_of(target).stiffness / scene.initial_energy
    slow = target.time_unit if target.kind == "beam" else SLOW * target.round_trip_time
    if contact.end < slow or share <= NEGLIGIBLE:
        return []
    return [
        f"The contact is slow enough for the held {target.kind} to give way as a spring, which takes up to "
        f"{min(share, 1.0):.0%} of the energy and is left out here: the true contact is longer and its peak lower; "
        "use 'structural' where the contact is much stiffer than that, else 'modal'."
    ]


def _ringing_left_out(scene: Scene, name: str, motion: SampledMotion, contact: ContactPeriod) -> list[str]:
    """As if the force were that on a half-space, q_i = phi_i F(omega_i) / omega_i, thesis 8.4.4."""
    beam, other = (scene.target, scene.impactor) if name == "target" else (scene.impactor, scene.target)
    modes, (times, forces) = beam.modes(RINGING), motion.force_history()
    angle = np.multiply.outer(modes.frequencies, times)
    sent = [np.trapezoid(forces * wave(angle), times, axis=1) for wave in (np.cos, np.sin)]
    shares = 0.5 * modes.at_contact**2 * (sent[0] ** 2 + sent[1] ** 2) / scene.initial_energy
    share = float(shares[modes.frequencies * contact.end < FINEST].sum())
    if share <= NEGLIGIBLE:
        return []
    mass = other.modes(1).rigid_mass
    half = spring_of(beam).half_swing(mass) if math.isfinite(mass) else 0.5 * beam.time_unit
    return [
        f"The contact lasts {contact.end / half:.2g} of half the fundamental period of the {name} with the mass on it, "
        f"too long for a half-space that does not move: its vibration takes up to {min(share, 1.0):.0%} of the energy "
        "(thesis 8.4.4); compare with 'modal'."
    ]
