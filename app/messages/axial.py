"""What the browser needs of an impact on an axis, from which it rebuilds every picture.

Units of the message: time in round trips T, velocity in the impact speed v, displacement in v T, force in Z v, stress
in v sqrt(E rho).
"""

import math
from typing import Any

import numpy as np

from solvers import ContactPeriod, Modal, Rod, Scene, Solution, Waveguide
from solvers.bodies import AnyBody, Balls, FlexiblePendulum
from solvers.contact.duration import exponent_of
from solvers.contact.protocol import Damped
from solvers.contact.viscous import LEAST_RESTITUTION
from solvers.methods.modal.motion import ModalMotion
from solvers.methods.quasi_static.balls import RowMotion
from solvers.methods.theory_limits import OF_THEORY
from solvers.methods.validity import TWICE
from solvers.numerics.waves.chain_drawn import WAVE_NUMBERS
from solvers.scenes.saved import saved_head
from solvers.solution.motion import Balances, SendsWaves, knows_field
from solvers.solution.restitution import common_velocity
from solvers.text.notes import Note

from ..choices.cushions import cushions
from ..choices.kinds import own_options
from ..choices.request import Request
from .balances import balanced
from .encoding import (
    FORCE_POINTS,
    LARGEST_MASS,
    coded,
    cycle,
    figures_of,
    force_history,
    over,
    packed,
    refusals,
    whole_numbers,
)
from .fall import fall_fields
from .laws import followed
from .parts import common, taken_along
from .pendulum import pendulum_fields, pivot_moments, striker_arrays, waves_of_force
from .rotating import axis_moments, bent_shapes, rotation_fields, turning_fields, turning_rod, turns
from .solutions import both, by_modes

MOTION_POINTS = 300  # of the motions of the impactor and of the struck face
INSTANTS, PLACES = 110, 31  # of the fields of a method other than waves and modes


def axial_frame(request: Request) -> bytes:
    """The message for one scene on an axis, solved exactly and by the method shown beside it."""
    exact, other = both(request)
    scene, trip = request.scene, request.scene.time_unit
    force_unit, stress_unit = _units(scene)
    arrays: dict[str, Any]
    rods, arrays = _rods(scene, exact)
    carried = None if other is None else _carried_by_the_browser(other)
    arrays |= _histories(request, exact, other, carried is not None)
    if turns(scene.target):
        rods, arrays = turning_rod(scene.target), arrays | turning_fields(exact, stress_unit, scene.speed * trip)
    fall, falls = fall_fields(request, exact)
    arrays |= cycle(exact) | _balances(other, trip, force_unit) | falls
    balance, shapes = balanced(request, exact, other, PLACES)
    arrays |= shapes
    marched = carried or (None if other is None else _of_frame(other))
    if carried is not None:
        arrays["modalForce"] = carried.record.contact_force / force_unit
    elif marched is not None:
        arrays["fieldForce"] = whole_numbers(marched.record.contact_force / force_unit)
    elif other is not None and request.method == other.method["name"] and knows_field(other.known_motion):
        arrays |= _sampled_fields(other, stress_unit, scene.speed * trip)
    header = {
        "kind": "axial",
        **common(scene, request),
        "head": _head(taken_along(scene, request), exact, other),
        "refusals": refusals(scene),
        "trip": trip,
        "duration": exact.duration / trip,
        "rods": rods,
        "impactor": _impactor(scene),
        "target": _target(scene),
        "speed": scene.speed,
        "forceUnit": force_unit,
        "stressUnit": stress_unit,
        "modes": request.modes,
        **_marched(scene, other, marched),
        "exact": _figures(exact) | {"name": known_as(exact)},
        "gaps": _gaps(exact),
        "lastBall": _last_ball(exact),
        "other": None if other is None else _figures(other) | {"notes": coded(_once(other))},
        "prediction": None if scene.prescribed_force or in_row(scene) else rigid_prediction(scene, request.restitution),
        "match": exact.restitution["newton"],
        "rigid": scene.rigid_contact,
        "balance": balance,
        **followed(scene, request.chosen, exact, other),
        "damps": scene.contact.LOSSY,
        "nominal": _nominal(scene),
        "yields": scene.contact.PLASTIC,
        "exponent": exponent_of(scene.contact),
        "leastRestitution": LEAST_RESTITUTION,
        "cushions": [] if scene.prescribed_force else cushions(scene),
    } | fall
    return packed(header, arrays)


def _impactor(scene: Scene) -> dict[str, Any]:
    """What it is drawn by."""
    impactor = scene.impactor
    own = {
        "kind": "rod" if impactor.rods else impactor.kind,  # a chain is drawn as one
        "mass": min(impactor.mass, LARGEST_MASS),
        "radius": getattr(impactor, "radius", None),
    }
    return own | pendulum_fields(impactor)


def _head(scene: Scene, exact: Solution, other: Solution | None) -> str:
    """Of saved histories, in which each solution has columns of its own name."""
    named = {known_as(exact): exact.method} | ({} if other is None else {other.method["name"]: other.method})
    methods = {name.replace("-", "_"): method for name, method in named.items()}
    return saved_head(scene, exact.method, exact.duration, methods)


def _histories(request: Request, exact: Solution, other: Solution | None, carried: bool) -> dict[str, Any]:
    """Motions and forces over time of both solutions; `carried`: the browser finds the other's force by itself."""
    scene = request.scene
    force_unit, length_unit = _units(scene)[0], scene.speed * scene.time_unit
    time = over(request.stretch, exact.duration, MOTION_POINTS + 1)
    coarse = time[:: 5 if request.draft else 2]
    arrays: dict[str, Any] = {"motionTime": time / scene.time_unit}
    for name, solution in (("exact", exact), ("other", other)):
        if solution is None:
            continue
        arrays |= striker_arrays(name, solution, time, length_unit)
        moments = pivot_moments(name, solution, coarse) | axis_moments(name, solution, coarse)
        arrays |= moments | ({"momentTime": coarse / scene.time_unit} if moments else {})
        arrays |= {f"{name}End": solution.known_motion.end_position(time) / length_unit}
        if solution is exact and isinstance(scene.target, Waveguide) and not scene.target.held:
            arrays["exactWhole"] = _gone(solution, time) / length_unit
        if solution is exact and isinstance(solution.motion, RowMotion):
            before = np.cumsum([0.0, *scene.target.known_as(Balls).gaps])
            arrays["exactRow"] = (solution.motion.ball_positions(time) + before) / length_unit
            own = solution.motion.impactor_velocity(time)
            arrays["exactRowVelocity"] = np.column_stack((own, solution.motion.ball_velocities(time))) / scene.speed
            arrays["exactRowForce"] = solution.motion.contact_forces(time) / force_unit
        if solution is exact or not carried:
            touched, force = force_history(solution, request.stretch)
            arrays |= {f"{name}Time": touched / scene.time_unit, f"{name}Force": force / force_unit}
    return arrays | bent_shapes(exact, time, length_unit)


def _gone(solution: Solution, time: np.ndarray) -> np.ndarray:
    """How far the mass centre of a target has come [m] at each instant, by its velocities before."""
    before = np.union1d(np.linspace(0.0, time[0], MOTION_POINTS if time[0] else 1), time)
    velocity = solution.known_motion.rigid_velocity(before)
    gone = np.concatenate(([0.0], np.cumsum(np.diff(before) * 0.5 * (velocity[1:] + velocity[:-1]))))
    return gone[before >= time[0]]


def known_as(exact: Solution) -> str:
    """What the page calls the solution that others are measured by: modes are many, or those of bodies as wholes."""
    if exact.method["name"] != Modal.NAME:
        return exact.method["name"]
    return "converged" if by_modes(exact) else "compliant"


def in_row(scene: Scene) -> bool:
    """Whether what is struck is a row of balls, of which no rigid-body theory of two bodies says anything."""
    return isinstance(scene.target, Balls)


def _carrier(scene: Scene) -> Waveguide | None:
    """Whose waves are drawn: what is struck or, where that has none, what strikes."""
    return next((body for body in (scene.target, scene.impactor) if isinstance(body, Waveguide)), None)


def _units(scene: Scene) -> tuple[float, float]:
    """Of force [N] and stress [Pa]: those of the wave that sets out as rigid bodies touch."""
    target, carrier = scene.target, _carrier(scene)
    if carrier is not None:
        force = carrier.impedance * scene.speed
        return force, force / carrier.area
    if turns(target):
        force = target.impedance * scene.speed
        return force, force / target.section.area
    force = scene.reduced_mass / scene.time_unit * scene.speed
    return force, force


def _marched(scene: Scene, other: Solution | None, motion: ModalMotion | None) -> dict[str, Any]:
    """How modes are marched whose fields the browser rebuilds, and for how long the impact is followed."""
    trip = scene.time_unit
    return {
        "step": None if motion is None else motion.step / trip,
        "asked": scene.method["duration"] / trip if "duration" in scene.method else 0.0,
        "usualSteps": motion is not None and "steps" not in own_options(scene, Modal.NAME),
        "givesWay": motion is not None and bool(other and other.method["residual"]),
        "attached": other is not None and other.method.get("frame") == "attached",
    }


def _carried_by_the_browser(solution: Solution) -> ModalMotion | None:
    """The motion, if the browser rebuilds its fields from the modes of one rod and the forces on them."""
    scene, motion = solution.scene, solution.known_motion
    if not isinstance(motion, ModalMotion) or scene.impactor.rods or not isinstance(scene.target, Rod):
        return None
    return motion if solution.method["frame"] == "mean-axis" and solution.method["residual"] else None


def _of_frame(solution: Solution) -> ModalMotion | None:
    """Likewise where it rebuilds the fields alone: of a rod at rest, by modes without those left out or of a frame."""
    scene, motion = solution.scene, solution.known_motion
    if not isinstance(motion, ModalMotion) or scene.impactor.rods or not isinstance(scene.target, Rod):
        return None
    return motion if solution.method["frame"] != "attached-far" and not scene.target.velocity else None


def _nominal(scene: Scene) -> float | None:
    """The restitution that the usual formula of a law with damping names."""
    law = scene.contact
    return law.nominal(scene.reduced_mass, scene.speed) if law.LOSSY and isinstance(law, Damped) else None


def _is_ball(body: Any) -> bool:
    """Whether a compact body has the mass of a ball of its radius and material, to the digits that scenes give."""
    radius = getattr(body, "radius", None)
    if body.kind not in ("mass", "sphere") or radius is None:
        return False
    return math.isclose(body.mass, 4.0 / 3.0 * math.pi * radius**3 * body.material.density, rel_tol=1e-3)


def _target(scene: Scene) -> dict[str, Any]:
    target = scene.target
    return {
        "kind": target.kind,
        "shape": "ball" if _is_ball(target) else "block",
        "radius": getattr(target, "radius", None),
        "mass": min(target.mass, LARGEST_MASS),
        "length": target.length,
        "support": target.support if isinstance(target, Waveguide) or turns(target) else None,
        "held": target.held,
        "endMass": target.rods[-1].end_mass if target.rods else 0.0,
        **({"row": [ball.radius for ball in target.balls]} if isinstance(target, Balls) else {}),
    } | rotation_fields(target)


def _rods(scene: Scene, exact: Solution) -> tuple[list[dict[str, Any]], dict[str, Any]]:
    """Every rod from left to right, and the waves that its ends send: time and value, at a jump the time stands twice.

    A uniform rod that is fixed or free at its far end is its own mirror: one wave says all.
    """
    bodies, target, carrier = scene.rods, scene.target, _carrier(scene)
    motion, unit = exact.motion, 1.0
    if isinstance(scene.impactor, FlexiblePendulum) and isinstance(target, Waveguide):
        motion, unit = waves_of_force(exact)
    if carrier is None or not isinstance(motion, SendsWaves):
        return [], {}
    trip, reach = scene.time_unit, exact.duration / scene.time_unit
    fall = scene.weight_acceleration * trip / scene.speed if "weight" in exact.energy else 0.0
    first = len(bodies) - len(target.rods)
    joints = [None, *_joined(scene.impactor)[::-1], *([None] if first else []), *_joined(target)]
    mirrored = not first and len(bodies) == 1 and bodies[0].support != "anechoic" and not bodies[0].end_mass
    waves = len(bodies) * (1 if mirrored else 2)
    even = np.linspace(0.0, reach, WAVE_NUMBERS // (2 * waves))
    edge = -scene.impactor.length if first else 0.0
    rods, arrays = [], {}
    for number, body in enumerate(bodies):
        rods.append(
            {
                "from": edge,
                "to": edge + body.length,
                "transit": 0.5 * body.round_trip_time / trip,
                "impedance": body.impedance / carrier.impedance,
                "drift": body.velocity / scene.speed,
                "area": body.area / carrier.area,
                "joint": joints[number],
                **({"fall": fall} if fall and number < first else {}),
                "mirror": (1 if body.fixed else -1) if mirrored else 0,
            }
        )
        edge += body.length
        for way in (True,) if mirrored else (True, False):
            time, wave = _wave_history(motion, number, way, even)
            arrays |= {f"{'f' if way else 'g'}{number}Time": time, f"{'f' if way else 'g'}{number}": unit * wave}
    return rods, arrays


def _joined(chain: AnyBody) -> list[str]:
    """How its rods are joined, from the contact on."""
    joints = chain.joints if isinstance(chain, Waveguide) else ()
    return ["bonded" if joint.bonded else "touching" for joint in joints]


def _gaps(exact: Solution) -> list[list[float]]:
    """Of rods with a gap before them: their number, and when it is closed [T]."""
    trip = exact.scene.time_unit
    target = exact.scene.target
    joints = target.joints if isinstance(target, Waveguide) else ()
    return [
        [number + 1, period.start / trip, period.end / trip]
        for number, (joint, periods) in enumerate(zip(joints, exact.joints, strict=False), 1)
        if joint.gap > 0.0
        for period in periods
    ]


def _last_ball(exact: Solution) -> list[float] | None:
    """When the last ball of a row has parted for good [T], and its velocity [v]."""
    if not exact.ball_velocities or not exact.joints or not exact.joints[-1]:
        return None
    return [exact.joints[-1][-1].end / exact.scene.time_unit, exact.ball_velocities[-1] / exact.scene.speed]


def _wave_history(motion: SendsWaves, rod: int, right_going: bool, even: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    time = np.unique(np.concatenate([even, motion.jumps(rod, right_going, float(even[-1]))[: even.size // 3]]))
    before, after = motion.sent(rod, right_going, time, False), motion.sent(rod, right_going, time, True)
    after[-1] = before[-1]  # at the end of the time solved no value after a jump is known
    return _doubled(time, before, after, 1e-6)


def _doubled(time: np.ndarray, before: np.ndarray, after: np.ndarray, least: float) -> tuple[np.ndarray, np.ndarray]:
    """One history of values before and after each instant: where they differ the time stands twice."""
    jump = np.abs(after - before) > least
    order = np.argsort(np.concatenate([time[jump], time]), kind="stable")
    return np.concatenate([time[jump], time])[order], np.concatenate([before[jump], after])[order]


def _balances(other: Solution | None, trip: float, force_unit: float) -> dict[str, np.ndarray]:
    """Impulses over the step, of balances that stand at the ends of steps: the circles of thesis figure 6.5."""
    step = None if other is None else other.method.get("step")
    if other is None or step is None or not isinstance(other.motion, Balances):
        return {}
    time, impulse = (values[:FORCE_POINTS] for values in other.motion.impulses)
    return {"balanceTime": time / trip, "balanceForce": impulse / step / force_unit}


def _sampled_fields(solution: Solution, stress_unit: float, length_unit: float) -> dict[str, Any]:
    """Fields at (instant, place) for methods whose fields the browser cannot rebuild."""
    scene, motion = solution.scene, solution.known_motion
    start = -scene.impactor.length if scene.impactor.rods else 0.0
    if scene.target.length == start:
        return {}
    time, x = np.linspace(0.0, solution.duration, INSTANTS), np.linspace(start, scene.target.length, PLACES)
    return {
        "fieldStress": whole_numbers(motion.stress(time, x) / stress_unit),
        "fieldVelocity": whole_numbers(motion.velocity(time, x) / scene.speed),
        "fieldDisplacement": whole_numbers(motion.displacement(time, x) / length_unit),
    }


def _figures(solution: Solution) -> dict[str, Any]:
    swings = {} if solution.impactor_velocity is None else solution.swings
    trip, speed = solution.scene.time_unit, solution.scene.speed
    return {
        "name": solution.method["name"],
        "model": solution.method.get("model"),
        **figures_of(solution),
        "contacts": [
            [contact.start / trip, contact.end / trip, contact.impulse, contact.peak_force]
            for contact in solution.contacts
        ],
        "cutOff": [_cut_off(solution, contact) for contact in solution.contacts],
        "left": []
        if solution.impactor_velocity is None
        else [
            float(solution.known_motion.impactor_velocity(np.array([min(contact.end, solution.duration)]))[0]) / speed
            for contact in solution.contacts
        ],
        "final": None if solution.impactor_velocity is None else solution.impactor_velocity / speed,
        "targetFinal": solution.target_velocity / speed,
        "spins": [swings[body].spin if body in swings else None for body in ("impactor", "target")],
    }


def _once(other: Solution) -> list[Note]:
    """Without what the exact solution says of damping and of the bodies, with more figures."""
    return [note for note in other.notes if note.code not in (TWICE, *OF_THEORY)]


def _cut_off(solution: Solution, contact: ContactPeriod) -> bool:
    """Whether the force was taken away at once by an arriving wave, rather than fading to zero."""
    if contact.peak_force is None or contact.end < solution.scene.time_unit * (1.0 - 1e-9):
        return False  # one impulse, or no wave has come back yet
    shortly_before = contact.end - 0.02 * solution.scene.time_unit
    if shortly_before <= contact.start:
        return False
    return bool(solution.known_motion.force(np.array([shortly_before]))[0] > 0.1 * contact.peak_force)


def rigid_prediction(scene: Scene, restitution: float) -> dict[str, float]:
    """Velocities that rigid-body theory predicts, in units of the impact speed, (9.1); a fixed rod stays at rest."""
    common = common_velocity(scene)
    share = 1.0 if scene.target.held else scene.reduced_mass / scene.impactor.mass
    impactor = scene.impactor.velocity - share * (1.0 + restitution) * scene.speed
    target = 0.0 if scene.target.held else common + (common - impactor) / scene.mass_ratio
    return {"impactor": impactor / scene.speed, "target": target / scene.speed}
