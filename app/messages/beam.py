"""What the browser needs of an impact on a beam, in the layout of app/messages/encoding.py.

SI units, except that times are in milliseconds. For modes the browser carries the same oscillators through the
same forces; for other methods it gets fields at (instant, place), closer together at first, where most happens.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from solvers import METHODS, Bending, Method, Modal, RigidImpulse, Scene, SceneError, Solution
from solvers.accuracy.reference import MODES_BESIDE, modes_beside
from solvers.contact.duration import exponent_of
from solvers.methods import usual_method
from solvers.methods.modal.method import ModalMotion
from solvers.methods.multibody.method import Multibody
from solvers.methods.multibody.motion import MovingMotion
from solvers.numerics.beams.dispersion import dispersion
from solvers.scenes.saved import saved_head
from solvers.solution.motion import Bends
from solvers.studies.contact_times import compare_with_half_space, contact_times
from solvers.text.notes import Note

from ..choices.choices import SOLVED_BY
from ..choices.request import Request
from .encoding import (
    LARGEST_MASS,
    Stretch,
    coded,
    cycle,
    instants,
    packed,
    refusals,
    whole_numbers,
)
from .histories import MS, force_told, motion_instants, paths, rates_at, rates_of_contacts
from .mechanism import RIGID_LINKS, mechanism_fields, mechanism_of, rigid_answer, struck_link
from .moving import follow, moving_fields
from .parts import common
from .solutions import method_options

ROUNDING = 1e-9
FORCE_STEPS = (
    10_000  # of the modal force, from which the browser rebuilds the modes; longer ones are averaged in groups
)
DRAWN_MODES, PLACES = 48, 81  # of the fields that the browser rebuilds
INSTANTS, SAMPLED_PLACES = 120, 41  # of fields of other methods
LINK_PLACES = 31  # of a link, beside which there are others
CONTACTS = 250  # of each solution, listed one by one
HALF_SPACE_POINTS = 160
SPEEDS = 60  # points of the dispersion curve
CYCLE_SAMPLES = 700


def chosen_method(request: Request) -> tuple[Method, Note | None]:
    """The chosen method, or modes where that one cannot solve the scene, or one impulse; with the note why."""
    method = SOLVED_BY[request.method].read(method_options(request.method, request))
    reason = method.refusal(request.scene)
    if reason:
        method = Modal(modes=request.modes)
        if method.refusal(request.scene):  # nothing bends, nothing gives way
            method = RigidImpulse(restitution=request.restitution)
    if isinstance(method, Modal) or request.draft:  # another number of modes is shown beside it; a hand moves on
        method = method.without_estimate()
    if isinstance(method, Modal) and request.draft:
        method = replace(method, coarser=1.0 / request.share)
    return method, reason


def method_at_impact(request: Request) -> Method:
    """The same of the impact alone, for who asks for it many times: the usual one in place of one that moves on."""
    if request.method == Multibody.NAME:
        request = replace(request, method=usual_method(request.scene))
    return chosen_method(request)[0]


def main_solution(request: Request) -> tuple[Solution, Note | None]:
    """The impact by `chosen_method`, with the note why that is not the one that was asked for; of a mechanism that
    moves on, why links that bend are taken as rigid."""
    method, reason = chosen_method(request)
    if isinstance(method, Multibody):
        return follow(request, method)
    own = request.scene.method
    follows = own.get("name") in (None, *METHODS)  # else it is that of one that moves on
    return method.solve_in_full(request.scene, own.get("duration") if follows else None), reason


def _beside(request: Request, main: Solution) -> Solution | None:
    """What is shown beside it, unless a hand moves on: another number of modes, or rigid links."""
    if request.draft:
        return None
    if mechanism_of(main.scene) is None:
        return modes_beside(request.scene, main)
    return rigid_answer(main)


def _drawn(
    request: Request, main: Solution, reason: Note | None, reference: Solution | None
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Header and arrays of what the stage draws."""
    if isinstance(main.motion, MovingMotion):
        header, arrays = moving_fields(main, request, reason, reference)
        return header, arrays | force_told(main, "main", request.stretch)
    header, arrays = _fields(main, request.stretch)
    linkage, moved = mechanism_fields(main, reference, request.stretch)
    return header | linkage, arrays | moved


def beam_frame(request: Request) -> bytes:
    """The message for one impact on a beam."""
    main, reason = main_solution(request)
    scene, moves = request.scene, isinstance(main.motion, MovingMotion)
    mechanism, reference = mechanism_of(main.scene), _beside(request, main)
    header, arrays = _drawn(request, main, reason, reference)
    time, after = motion_instants(main, request.stretch)
    arrays |= {"time": MS * time} | paths(main, time, "")
    rates = [rates_at(main, time, each) for each in (False, True)]
    arrays |= dict(zip(("impactorRate", "struckRate"), np.where(after, rates[1], rates[0]), strict=True))
    arrays |= _contacts(main) | rates_of_contacts(main)
    if reference is not None:
        arrays |= paths(reference, time, "reference")
        arrays |= force_told(reference, "reference", request.stretch)
    refused = refusals(scene)
    if refused["quasi-static"] is None and not moves:
        arrays |= _static(scene, main)
    if mechanism is None:
        arrays |= _half_space(scene) | _speeds(scene, main)
    if not moves:  # which turns away from the line along which indentations are told
        arrays |= cycle(main, CYCLE_SAMPLES)
    header |= {
        "kind": "beam",
        **common(scene, request),
        "head": saved_head(main.scene if moves else scene, main.method, main.duration),
        "refusals": refused,
        "refused": None if moves else reason and reason.table(),
        "trip": 1e-3,
        "duration": MS * main.duration,
        "speed": scene.speed,
        "beam": _beam(scene.target) if mechanism is None else struck_link(mechanism),
        "impactor": {"kind": scene.impactor.kind, "mass": min(scene.impactor.mass, LARGEST_MASS)},
        "law": {
            "name": scene.contact.NAME,
            "damps": scene.contact.LOSSY,
            "yields": scene.contact.PLASTIC,
            "exponent": exponent_of(scene.contact),
        },
        "main": _figures(main),
        "reference": None if reference is None else _figures(reference, RIGID_LINKS if mechanism else None),
        "span": _span(main),
    }
    return packed(header, arrays)


def _span(solution: Solution) -> dict[str, float | None]:
    """Times [ms]: first touch to last parting, in true contact, and half a period with the impactor on the beam."""
    times = contact_times(solution)
    half = None if times.half_period is None else MS * times.half_period
    return {"apparent": MS * times.apparent, "real": MS * times.real, "half": half}


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


def _figures(solution: Solution, name: str | None = None) -> dict[str, Any]:
    return {
        "name": name or solution.method["name"],
        "model": None if name else solution.method.get("model"),
        "modes": None if name else solution.method.get("modes"),
        "joints": solution.reactions,
        "elements": solution.method.get("elements"),
        "contacts": len(solution.contacts),
        "stillTouching": bool(solution.contacts[-1].end >= solution.duration * (1.0 - 1e-9)),
        "final": solution.impactor_velocity,
        "targetFinal": solution.target_velocity,
        "impulse": solution.impulse,
        "peakForce": solution.peak_force,
        "peakIndentation": solution.peak_indentation,
        "residualIndentation": solution.residual_indentation,
        "restitution": solution.restitution,
        "energy": solution.energy,
        "diagnostics": solution.diagnostics,
        "notes": coded(solution.notes),
    }


def _contacts(solution: Solution) -> dict[str, np.ndarray]:
    """Start, end [ms], impulse [N s] and peak force [N] of every contact; an impact of no duration has peak 0."""
    rows = [[MS * c.start, MS * c.end, c.impulse, c.peak_force or 0.0] for c in solution.contacts[:CONTACTS]]
    return {"contacts": np.array(rows)}


def _places(solution: Solution) -> int:
    """Of the fields, along the beam or the struck link."""
    if isinstance(solution.motion, ModalMotion):
        return PLACES
    return SAMPLED_PLACES if mechanism_of(solution.scene) is None else LINK_PLACES


def _fields(solution: Solution, stretch: Stretch) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    motion, beam = solution.known_motion, solution.scene.target
    if isinstance(motion, ModalMotion):
        header, arrays = _modal_fields(motion)
        fine = stretch and motion.steps > FORCE_STEPS and not solution.scene.rigid_contact  # which it gets in groups
        return header, arrays | (force_told(solution, "main", stretch) if fine else {})
    assert isinstance(motion, Bends)
    places = _places(solution)
    time, x = instants(solution.duration, INSTANTS, stretch), np.linspace(0.0, beam.length, places)
    fields = {
        "Deflection": solution.known_motion.displacement,
        "Velocity": solution.known_motion.velocity,
        "Moment": motion.moment,
        "Shear": motion.shear,
    }
    push = solution.peak_force or 0.0
    usual = {
        "Moment": push * beam.length,
        "Shear": push,
    }  # a tiny share is rounding: struck lengthwise
    arrays = {}
    for name, field in fields.items():
        values = field(time, x)
        there = np.abs(values).max(initial=0.0) > ROUNDING * usual.get(name, 0.0)
        arrays[f"field{name}"] = whole_numbers(values if there else np.zeros_like(values))
    return {"places": places}, {"fieldTime": MS * time, **arrays} | force_told(solution, "main", stretch)


def _modal_fields(motion: ModalMotion) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    beam = motion.scene.target
    modes, x = motion.pair.target, np.linspace(0.0, beam.length, PLACES)
    group = -(-motion.steps // FORCE_STEPS)
    force = motion.record.contact_force
    force = np.pad(force, (0, -force.size % group)).reshape(-1, group).mean(axis=1)
    count = min(DRAWN_MODES, modes.frequencies.size)
    arrays = {
        "modalForce": whole_numbers(force),
        "modalFrequencies": modes.frequencies[:count],
        "modalAtContact": modes.at_contact[:count],
    }
    drawn = modes.lowest(count)
    for name, table in (("shape", drawn.shapes), ("moment", drawn.moments), ("shear", drawn.shears)):
        if table is None:  # modes of a beam have all three
            continue
        rows = table(x)
        scale = np.maximum(np.abs(rows).max(axis=1, initial=0.0), 1e-300)
        arrays |= {f"{name}Rows": whole_numbers(rows / scale[:, None]), f"{name}Scale": scale}
    arrays |= {"momentBeside": drawn.left_out("moments", x), "shearBeside": drawn.left_out("shears", x)}
    free = np.isfinite(modes.rigid_mass)
    if free:
        arrays["rigidShape"] = modes.rigid_shape(x)
    header = {
        "places": PLACES,
        "step": motion.step * group,
        "smoothing": motion.smoothing,  # [s]
        "damping": beam.damping,
        "rigidMass": modes.rigid_mass if free else None,
        "drift": beam.velocity,
        "drawnModes": count,
        "keptModes": modes.frequencies.size,
    }
    return header, arrays


def _static(scene: Scene, main: Solution) -> dict[str, np.ndarray]:
    """Struck place by the quasi-static estimate [m], and the shape of the beam bent at rest there."""
    estimate = METHODS["quasi-static"].read({}).solve(scene, main.duration)
    time = np.linspace(0.0, main.duration, 200)
    found = {"staticTime": MS * time, "staticPath": estimate.known_motion.end_position(time)}
    if scene.target.fixed:
        modes = scene.target.modes(MODES_BESIDE[0])
        weights = modes.at_contact / modes.frequencies**2
        bent = weights @ modes.shapes(np.linspace(0.0, scene.target.length, _places(main)))
        found["staticShape"] = bent / float(weights @ modes.at_contact)
    return found


def _half_space(scene: Scene) -> dict[str, np.ndarray]:
    """Contact force of the same impactor, by the same law, on a body too large to bend."""
    try:
        beside = compare_with_half_space(scene)
    except SceneError:
        return {}
    time = np.linspace(0.0, min(beside.duration, 1.05 * beside.contacts[-1].end), HALF_SPACE_POINTS)
    return {"halfTime": MS * time, "halfForce": beside.known_motion.force(time)}


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
