"""What the browser needs of an impact across what bends, in the layout of app/messages/encoding.py.

SI units. For modes the browser carries the same oscillators through the same forces; for other methods it gets fields
at (instant, place), closer together at first, where most happens.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from solvers import METHODS, Method, Modal, RigidImpulse, Solution
from solvers.accuracy.reference import MODES_BESIDE
from solvers.contact.duration import exponent_of
from solvers.methods import usual_method
from solvers.methods.modal.motion import ModalMotion
from solvers.methods.multibody.method import Multibody
from solvers.methods.multibody.motion import MovingMotion
from solvers.scenes.saved import saved_head
from solvers.solution.motion import Bends
from solvers.studies.contact_times import contact_times
from solvers.studies.figures import only_for
from solvers.text.notes import Note

from ..choices.choices import SOLVED_BY
from ..choices.request import Request
from .encoding import LARGEST_MASS, Stretch, cycle, figures_of, instants, packed, refusals, whole_numbers
from .histories import force_arrays, motion_instants, paths, rates_at, rates_of_contacts
from .parts import common, taken_along
from .solutions import method_options

ROUNDING = 1e-9
FORCE_STEPS = 10_000  # of the modal force, from which the browser rebuilds the modes; of more some are averaged
DRAWN_MODES, PLACES = 48, 81  # of the fields that the browser rebuilds
INSTANTS = 120  # of fields of other methods
CONTACTS = 250  # of each solution, listed one by one
CYCLE_SAMPLES = 530


class Answer(NamedTuple):
    """An impact, why it is not by the method asked for, and the solution beside it; `named` is the name shown if
    its method has another."""

    main: Solution
    reason: Note | None
    beside: Solution | None
    named: str | None = None


def chosen_method(request: Request) -> tuple[Method, Note | None]:
    """The chosen method; if it cannot solve the scene, modes, or else one impulse; with the note why."""
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
    """The method for the impact alone, for who asks many times: the usual one in place of one that moves on."""
    if request.method == Multibody.NAME:
        request = replace(request, method=usual_method(request.scene))
    return chosen_method(request)[0]


def main_solution(request: Request, figures: Sequence[str] = ()) -> tuple[Solution, Note | None]:
    """The impact by `chosen_method`, with the note why that is not the one that was asked for; `figures`: all that is
    read of it, none: everything."""
    method, reason = chosen_method(request)
    method = only_for(method, figures) if figures else method
    own = request.scene.method
    known = own.get("name") in (None, *METHODS)  # else its duration is that of a mechanism that moves on
    return method.solve_in_full(request.scene, own.get("duration") if known else None), reason


def impact_frame(request: Request, answer: Answer, header: dict[str, Any], arrays: dict[str, Any]) -> bytes:
    """The message: what is the same for all that bends, and `header` and `arrays` of what the kind adds to it."""
    main, beside, scene = answer.main, answer.beside, request.scene
    time, after = motion_instants(main, request.stretch)
    arrays |= {"time": time} | paths(main, time, "")
    rates = [rates_at(main, time, each) for each in (False, True)]
    arrays |= dict(zip(("impactorRate", "struckRate"), np.where(after, rates[1], rates[0]), strict=True))
    arrays |= _contacts(main) | rates_of_contacts(main)
    if beside is not None:
        arrays |= paths(beside, time, "reference")
        arrays |= force_arrays(beside, "reference", request.stretch)
    moves = isinstance(main.motion, MovingMotion)
    header = {
        **common(scene, request),
        "head": saved_head(taken_along(main.scene if moves else scene, request), main.method, main.duration),
        "refusals": refusals(scene),
        "refused": answer.reason and answer.reason.table(),
        "trip": 1.0,
        "period": float(f"{scene.time_unit:.7g}"),  # all digits would take messages beyond their limit
        "duration": main.duration,
        "speed": scene.speed,
        "impactor": {"kind": scene.impactor.kind, "mass": min(scene.impactor.mass, LARGEST_MASS)},
        "law": {
            "name": scene.contact.NAME,
            "damps": scene.contact.LOSSY,
            "yields": scene.contact.PLASTIC,
            "rigid": scene.rigid_contact,
            "exponent": exponent_of(scene.contact),
        },
        "main": _figures(main),
        "reference": None if beside is None else _figures(beside, answer.named),
        "span": _span(main),
        **header,
    }
    return packed(header, arrays)


def _span(solution: Solution) -> dict[str, float | None]:
    """Times [s]: first touch to last parting, in true contact, and half a period with the impactor on the beam."""
    times = contact_times(solution)
    return {"apparent": times.apparent, "real": times.real, "half": times.half_period}


def _figures(solution: Solution, name: str | None = None) -> dict[str, Any]:
    return {
        "name": name or solution.method["name"],
        "model": None if name else solution.method.get("model"),
        **figures_of(solution),
        "modes": None if name else solution.method.get("modes"),
        "joints": solution.reactions,
        "elements": solution.method.get("elements"),
        "contacts": len(solution.contacts),
        "final": solution.impactor_velocity,
        "targetFinal": solution.target_velocity,
        "impulse": solution.impulse,
    }


def _contacts(solution: Solution) -> dict[str, np.ndarray]:
    """Start, end [s], impulse [N s] and peak force [N] of contacts, of very many the first and the last one; an impact
    of no duration has peak 0."""
    listed, rest = solution.contacts[:CONTACTS], solution.contacts[CONTACTS:]
    listed = [*listed[:-1], rest[-1]] if rest else listed
    return {"contacts": np.array([[c.start, c.end, c.impulse, c.peak_force or 0.0] for c in listed])}


def field_arrays(solution: Solution, stretch: Stretch, places: int) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Header and arrays of the fields along what is struck, sampled at so many places where they are not by modes."""
    motion, beam = solution.known_motion, solution.scene.target
    if isinstance(motion, ModalMotion):
        header, arrays = _modal_fields(motion)
        fine = stretch and motion.steps > FORCE_STEPS and not solution.scene.rigid_contact  # else averaged in groups
        return header, arrays | (force_arrays(solution, "main", stretch) if fine else {})
    assert isinstance(motion, Bends)
    time, x = instants(solution.duration, INSTANTS, stretch), np.linspace(0.0, beam.length, places)
    fields = {
        "Deflection": solution.known_motion.displacement,
        "Velocity": solution.known_motion.velocity,
        "Moment": motion.moment,
        "Shear": motion.shear,
    }
    push = solution.peak_force or 0.0
    usual = {"Moment": push * beam.length, "Shear": push}  # a tiny share is rounding: struck lengthwise
    arrays = {}
    for name, field in fields.items():
        values = field(time, x)
        there = np.abs(values).max(initial=0.0) > ROUNDING * usual.get(name, 0.0)
        arrays[f"field{name}"] = whole_numbers(values if there else np.zeros_like(values))
    return {"places": places}, {"fieldTime": time, **arrays} | force_arrays(solution, "main", stretch)


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


def comparisons(main: Solution, places: int) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Header and arrays of comparisons for the impact: the law's cycle; if it applies, the quasi-static estimate of the
    struck place [m] and its model, and the shape of the beam bent at rest there. One by which the place does not move
    says nothing of it, and is left out."""
    scene, estimate = main.scene, METHODS["quasi-static"].read({})
    found = cycle(main, CYCLE_SAMPLES)
    if estimate.refusal(scene):
        return {"staticModel": None}, found
    time = np.linspace(0.0, main.duration, 200)
    solved = estimate.solve(scene, main.duration)
    path = solved.known_motion.end_position(time)
    if not np.any(path):
        return {"staticModel": None}, found
    found |= {"staticTime": time, "staticPath": path}
    if scene.target.fixed:
        modes = scene.target.modes(MODES_BESIDE)
        weights = modes.at_contact / modes.frequencies**2
        bent = weights @ modes.shapes(np.linspace(0.0, scene.target.length, places))
        found["staticShape"] = bent / float(weights @ modes.at_contact)
    return {"staticModel": solved.method.get("model")}, found
