"""What the browser needs of an impact on a beam, besides what it needs of whatever bends."""

import math
from typing import Any

import numpy as np

from solvers import Bending, Scene, SceneError, Solution
from solvers.accuracy.reference import MODES_BESIDE, modes_beside
from solvers.numerics.beams.dispersion import dispersion
from solvers.studies.contact_times import compare_with_half_space

from ..choices.request import Request
from .transverse import Answer, comparison_arrays, field_arrays, impact_frame, main_solution

SAMPLED_PLACES = 41  # of fields that are not by modes
HALF_SPACE_POINTS = 160
SPEEDS = 60  # points of the dispersion curve


def beam_frame(request: Request) -> bytes:
    """The message for one impact on a beam, beside it by another number of modes unless a hand moves on."""
    main, reason = main_solution(request)
    scene, beside = request.scene, None if request.draft else modes_beside(request.scene, main)
    header, arrays = field_arrays(main, request.stretch, SAMPLED_PLACES)
    arrays |= _half_space(scene) | _speeds(scene, main) | comparison_arrays(main, header["places"])
    header |= {"kind": "beam", "beam": _beam(scene.target)}
    return impact_frame(request, Answer(main, reason, beside), header, arrays)


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
    modes = scene.target.modes(main.method.get("modes") or MODES_BESIDE[0])
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
