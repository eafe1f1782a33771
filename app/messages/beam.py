"""What the browser needs of an impact on a beam, besides what it needs of whatever bends."""

import math
from typing import Any

import numpy as np

from solvers import Beam, Bending, Modal, Scene, SceneError, Solution
from solvers.accuracy.reference import MODES_BESIDE, modes_beside
from solvers.bodies import RigidMass
from solvers.contact.viscous import LEAST_RESTITUTION
from solvers.methods.modal.motion import ModalMotion
from solvers.numerics.beams.dispersion import dispersion
from solvers.studies.contact_times import compare_with_half_space

from ..choices.kinds import own_options
from ..choices.request import Request
from .laws import Units, law_fields
from .transverse import DRAWN_MODES, Answer, comparisons, field_arrays, impact_frame, main_solution

SAMPLED_PLACES = 41  # of fields that are not by modes
HALF_SPACE_POINTS = 160
SPEEDS = 60  # points of the dispersion curve


def beam_frame(request: Request) -> bytes:
    """The message for one impact on a beam, beside it by another number of modes unless a hand moves on."""
    main, reason = main_solution(request)
    scene, beside = request.scene, None if request.draft else modes_beside(request.scene, main)
    header, arrays = field_arrays(main, request.stretch, SAMPLED_PLACES)
    beside_it, compared = comparisons(main, header["places"])
    header |= beside_it
    arrays |= _half_space(scene) | _speeds(scene, main) | compared
    march = march_of(request, main)
    laws = law_fields(scene, request.chosen, Units(1.0, 1.0)) if march else []
    if march and not march["compliance"]:  # nothing would give way in a rigid contact
        laws = [law for law in laws if law["constants"]]
    header |= {"kind": "beam", "beam": _beam(scene.target), "march": march, "laws": laws}
    header |= {"leastRestitution": LEAST_RESTITUTION}
    return impact_frame(request, Answer(main, reason, beside), header, arrays)


def march_of(request: Request, main: Solution) -> dict[str, Any] | None:
    """What a browser needs to march the same modes by itself; None where it cannot, or has not all that is drawn."""
    scene, motion = request.scene, main.known_motion
    target, own = scene.target, own_options(scene, Modal.NAME)
    if not isinstance(motion, ModalMotion) or not isinstance(scene.impactor, RigidMass) or not isinstance(target, Beam):
        return None
    modes, usual = motion.pair.target, {"modes", "residual"} >= own.keys()
    still = not target.velocity and not target.acceleration and not target.swings
    if not usual or not still or request.stretch or request.draft or modes.frequencies.size > DRAWN_MODES:
        return None
    if scene.rigid_contact and not own.get("residual", True):  # which a rigid contact gives way by all the same
        return None
    return {
        "frequencies": modes.frequencies.tolist(),
        "atContact": modes.at_contact.tolist(),
        "compliance": modes.residual_compliance,
        "whole": None if target.held else target.mass,
        "mean": modes.rigid_mean,
        "longest": scene.time_unit,
        "turns": target.turns,
        "duration": scene.method.get("duration"),
    }


def _beam(beam: Any) -> dict[str, Any]:
    return {
        "length": beam.length,
        "mass": beam.mass,
        "support": beam.support,
        "theory": beam.theory,
        "place": beam.place,
        "halfDepth": beam.half_depth,
        "secondMoment": beam.second_moment,
        "endMass": beam.end_mass,
        "held": beam.held,
        "speedLimit": math.sqrt(beam.material.young / beam.material.density),
    }


def _half_space(scene: Scene) -> dict[str, np.ndarray]:
    """Contact force of the same impactor, by the same law, on a body too large to bend."""
    try:
        beside = compare_with_half_space(scene)
    except SceneError:
        return {}
    time = np.linspace(0.0, min(beside.duration, 1.05 * beside.contacts[-1].end), HALF_SPACE_POINTS)
    return {"halfTime": time, "halfForce": beside.known_motion.force(time)}


def _speeds(scene: Scene, main: Solution) -> dict[str, np.ndarray]:
    """Angular frequency over wavenumber by the theory in use, and the kept modes on that curve [rad/s, 1/m]."""
    modes = scene.target.modes(main.method.get("modes") or MODES_BESIDE)
    line, highest = scene.target.known_as(Bending).line, float(modes.frequencies[-1])
    reach = 1.0 / scene.target.length
    while float(dispersion(line, np.array([reach]))[0][0]) < 1.15 * highest:
        reach *= 1.3
    fine = np.linspace(0.0, reach, 2_000)
    found = {
        "modeFrequencies": modes.frequencies,
        "modeWavenumbers": np.interp(modes.frequencies, dispersion(line, fine)[0], fine),
    }
    wavenumbers = np.linspace(0.0, reach, SPEEDS)
    lower, upper = dispersion(line, wavenumbers)
    found |= {"wavenumbers": wavenumbers, "lower": lower}
    if upper is not None and np.all(np.isfinite(upper)):
        found["upper"] = upper
    return found
