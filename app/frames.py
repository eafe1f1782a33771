"""What the browser needs of a solve, as one small binary message: physics, from which it rebuilds every picture.

Units of the message: time in round trips T, velocity in the impact speed v, displacement in v T, force in Z v, stress
in v sqrt(E rho). Layout: length of the header (4 bytes, little endian), header (JSON), zeros up to a multiple of four,
then float32 arrays in the order and length that the header states; where it states a unit besides, whole numbers of
two bytes of that unit, filled up with zeros to a multiple of four bytes.
"""

import json
from dataclasses import replace
from typing import Any

import numpy as np

from solvers import METHODS, Balance, ContactPeriod, Modal, RigidImpulse, Scene, SceneError, Solution, Waves
from solvers.contact.viscous import LEAST_RESTITUTION
from solvers.doubts import TWICE
from solvers.methods.modal import STEPS_PER_PERIOD, ModalMotion
from solvers.restitution import common_velocity

from .state import acting_choices, chosen_scene, on_beam, own_options, resolutions

WAVE_NUMBERS = 4_800  # of the histories of all waves together
FORCE_POINTS = 1_200  # of a contact force
MOTION_POINTS = 300  # of the motions of the impactor and of the struck face
MAX_FORCE_STEPS = 10_000  # of the modal force, all of which the browser needs to rebuild the modes
INSTANTS, PLACES = 110, 31  # of the fields of a method other than waves and modes
LEAST_SWITCHED = 2  # modes that can change with the contact
LARGEST_MASS = 1e12  # [kg] told of what has none or is infinite
CYCLE_POINTS, BLOW_POINTS = 60, 300  # of the contact law's cycle, and of the blow in it


def solve_frame(chosen: dict[str, Any]) -> bytes:
    """Solve what is chosen, exactly and by the method shown beside it, and pack what the page draws."""
    scene = chosen_scene(chosen)
    if scene.normal is not None:
        from .bodies_frame import bodies_frame

        return bodies_frame(RigidImpulse(restitution=chosen["restitution"]).solve(scene), chosen)
    if on_beam(scene):
        from .beam_frame import beam_frame

        return beam_frame(scene, chosen)
    exact = exact_solution(scene, chosen["restitution"])
    return pack(chosen, scene, exact, beside(scene, chosen, exact))


def exact_solution(scene: Scene, restitution: float) -> Solution:
    """The solution that the others are measured by: waves; for bodies without waves one integrated to rounding.

    Where nothing gives way at the contact of bodies without waves, the restitution stands for it. Raises SceneError for
    beams, of which no exact solution is known.
    """
    if "beam" in (scene.impactor.kind, scene.target.kind):
        raise SceneError("target.kind", scene.target.kind, "a body other than a beam, whose blow has no exact solution")
    for method in (Waves(), Modal(modes=1), RigidImpulse(restitution), Balance(restitution=restitution)):
        if not method.refusal(scene):
            return method.solve_in_full(scene, scene.method.get("duration"))
    raise SceneError("method.name", None, "a scene that some method can solve")


def beside(scene: Scene, chosen: dict[str, Any], exact: Solution) -> Solution | None:
    """The chosen method, or modes if waves are chosen; None if it cannot solve this scene or is the exact one."""
    name = chosen["method"] if chosen["method"] != "waves" else "modal"
    if name == exact.method["name"]:
        name = "quasi-static"
    method = METHODS[name].read(method_options(name, scene, chosen, exact))
    if method.refusal(scene):
        return None
    if isinstance(method, Modal):
        method = replace(method, estimate=False)  # the exact solution tells the error
    return method.solve(scene, exact.duration)


def method_options(name: str, scene: Scene, chosen: dict[str, Any], exact: Solution | None = None) -> dict[str, Any]:
    """Those of a method's options that the page sets."""
    own = own_options(scene, name)
    if name == "modal":
        options = own | {"modes": chosen["modes"]}
        if scene.target.kind == "rod" and "steps" not in own:
            period = scene.target.modes(chosen["modes"]).shortest_period
            touching = exact.contacts[-1].end
            steps = max(STEPS_PER_PERIOD * exact.duration / period, 500 * exact.duration / touching, 1_000)
            options["steps"] = int(min(steps, MAX_FORCE_STEPS))
        return options
    options = own | {option: chosen[option] for option in resolutions(scene, name)}
    if name == "mode-switch":
        options["modes"] = max(options["modes"], LEAST_SWITCHED)
    if name in ("balance", "rigid"):
        options["restitution"] = chosen["restitution"]
    return options


def pack(chosen: dict[str, Any], scene: Scene, exact: Solution, other: Solution | None) -> bytes:
    """The message for one scene."""
    speed, trip = scene.speed, scene.time_unit
    force_unit = getattr(scene.target, "impedance", scene.reduced_mass / trip) * speed
    reach = exact.duration
    even = np.linspace(0.0, reach, MOTION_POINTS + 1)
    length_unit = speed * trip
    rods, arrays = _rods(scene, exact)
    carried = other is not None and _carried_by_the_browser(other)
    for name, solution in (("exact", exact), ("other", other)):
        if solution is None:
            continue
        arrays |= {
            f"{name}Mass": solution.motion.impactor_position(even) / length_unit,
            f"{name}End": solution.motion.end_position(even) / length_unit,
        }
        if solution is exact or not carried:
            time, force = force_history(solution)
            arrays |= {f"{name}Time": time / trip, f"{name}Force": force / force_unit}
    arrays |= cycle(exact) | _balances(other, trip, force_unit)
    steps = None
    if carried:
        arrays["modalForce"] = other.motion.record.contact_force / force_unit
        steps = other.motion.step / trip
    elif other is not None and chosen["method"] == other.method["name"]:
        arrays |= _sampled_fields(other, force_unit, length_unit)
    header = {
        "kind": "axial",
        "chosen": chosen,
        "acting": acting_choices(chosen),
        "refusals": {name: method().refusal(scene) for name, method in METHODS.items()},
        "title": scene.title,
        "source": scene.source,
        "note": scene.note,
        "trip": trip,
        "duration": reach / trip,
        "rods": rods,
        "impactor": {"kind": scene.impactor.kind, "mass": min(scene.impactor.mass, LARGEST_MASS)},
        "target": _target(scene),
        "speed": speed,
        "forceUnit": force_unit,
        "stressUnit": force_unit / getattr(scene.target, "area", 1.0),
        "modes": chosen["modes"],
        "step": steps,
        "exact": _figures(exact),
        "other": None if other is None else _figures(other) | {"notes": [n for n in other.notes if TWICE not in n]},
        "ghost": None if scene.impactor.kind == "pulse" else ghost(scene, chosen["restitution"]),
        "match": exact.restitution["newton"],
        "damps": scene.contact.LOSSY,
        "nominal": scene.contact.nominal(scene.reduced_mass, scene.speed) if scene.contact.LOSSY else None,
        "yields": scene.contact.PLASTIC,
        "leastRestitution": LEAST_RESTITUTION,
    }
    return packed(header, arrays)


def _carried_by_the_browser(solution: Solution) -> bool:
    """Whether the browser rebuilds the fields from the modes of one rod and the forces on them."""
    scene = solution.scene
    if not isinstance(solution.motion, ModalMotion) or scene.impactor.kind == "rod" or scene.target.kind != "rod":
        return False
    return solution.method["frame"] == "mean-axis" and solution.method["residual"]


def _target(scene: Scene) -> dict[str, Any]:
    target = scene.target
    return {
        "kind": target.kind,
        "mass": min(target.mass, LARGEST_MASS),
        "length": target.length,
        "support": getattr(target, "support", None),
        "held": target.held,
        "endMass": getattr(target, "end_mass", 0.0) or getattr(target.rods[-1], "end_mass", 0.0)
        if target.kind in ("rod", "rods")
        else 0.0,
    }


def _rods(scene: Scene, exact: Solution) -> tuple[list[dict[str, Any]], dict[str, np.ndarray]]:
    """Every rod from left to right, and the waves that its ends send: time and value, at a jump the time stands twice.

    A uniform rod that is fixed or free at its far end is its own mirror: one wave says all.
    """
    bodies = ([scene.impactor] if scene.impactor.kind == "rod" else []) + list(getattr(scene.target, "rods", ()))
    if not bodies or not hasattr(exact.motion, "sent"):
        return [], {}
    trip, reach = scene.time_unit, exact.duration / scene.time_unit
    first = len(bodies) - len(scene.target.rods)
    joints = [None] * (first + 1) + ["bonded" if joint.bonded else "touching" for joint in scene.target.joints]
    mirrored = len(bodies) == 1 and bodies[0].support != "anechoic" and not bodies[0].end_mass
    waves = len(bodies) * (1 if mirrored else 2)
    even = np.linspace(0.0, reach, WAVE_NUMBERS // (2 * waves))
    edge = -bodies[0].length if first else 0.0
    rods, arrays = [], {}
    for number, body in enumerate(bodies):
        rods.append(
            {
                "from": edge,
                "to": edge + body.length,
                "transit": 0.5 * body.round_trip_time / trip,
                "impedance": body.impedance / scene.target.impedance,
                "drift": body.velocity / scene.speed,
                "area": body.area / scene.target.area,
                "joint": joints[number],
                "mirror": (1 if body.fixed else -1) if mirrored else 0,
            }
        )
        edge += body.length
        for way in (True,) if mirrored else (True, False):
            time, wave = _wave_history(exact.motion, number, way, even)
            arrays |= {f"{'f' if way else 'g'}{number}Time": time, f"{'f' if way else 'g'}{number}": wave}
    return rods, arrays


def _wave_history(motion: Any, rod: int, right_going: bool, even: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    time = np.unique(np.concatenate([even, motion.jumps(rod, right_going, float(even[-1]))[: even.size // 3]]))
    before, after = motion.sent(rod, right_going, time, False), motion.sent(rod, right_going, time, True)
    after[-1] = before[-1]  # at the end of the time solved no value after a jump is known
    return _doubled(time, before, after, 1e-6)


def _doubled(time: np.ndarray, before: np.ndarray, after: np.ndarray, least: float) -> tuple[np.ndarray, np.ndarray]:
    """One history of values before and after each instant: where they differ the time stands twice."""
    jump = np.abs(after - before) > least
    order = np.argsort(np.concatenate([time[jump], time]), kind="stable")
    return np.concatenate([time[jump], time])[order], np.concatenate([before[jump], after])[order]


def force_history(solution: Solution) -> tuple[np.ndarray, np.ndarray]:
    """Times [s] and contact forces [N], thinned so that every stretch keeps its highest and lowest."""
    time, force = solution.motion.force_history()
    inside = time <= solution.duration
    time, force = time[inside], force[inside]
    if time.size <= FORCE_POINTS:
        return time, force
    edges = np.linspace(0, time.size, FORCE_POINTS // 2 + 1).astype(int)
    kept = {0, time.size - 1}
    for low, high in zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True):
        kept |= {low + int(np.argmin(force[low:high])), low + int(np.argmax(force[low:high]))}
    rows = np.array(sorted(kept))
    return time[rows], force[rows]


def _balances(other: Solution | None, trip: float, force_unit: float) -> dict[str, np.ndarray]:
    """Impulses over the step, of balances that stand at the ends of steps: the circles of thesis figure 6.5."""
    step = None if other is None else other.method.get("step")
    if step is None or not hasattr(other.motion, "impulses"):
        return {}
    time, impulse = (values[:FORCE_POINTS] for values in other.motion.impulses)
    return {"balanceTime": time / trip, "balanceForce": impulse / step / force_unit}


def _sampled_fields(solution: Solution, force_unit: float, length_unit: float) -> dict[str, np.ndarray]:
    """Fields at (instant, place), flat, for methods whose fields the browser cannot rebuild."""
    scene, motion = solution.scene, solution.motion
    start = -scene.impactor.length if scene.impactor.kind == "rod" else 0.0
    if scene.target.length == start:
        return {}
    time, x = np.linspace(0.0, solution.duration, INSTANTS), np.linspace(start, scene.target.length, PLACES)
    return {
        "fieldStress": (motion.stress(time, x) / (force_unit / scene.target.area)).ravel(),
        "fieldVelocity": (motion.velocity(time, x) / scene.speed).ravel(),
        "fieldDisplacement": (motion.displacement(time, x) / length_unit).ravel(),
    }


def cycle(exact: Solution, samples: int = BLOW_POINTS) -> dict[str, np.ndarray]:
    """The contact law's cycle, slowly to the depth of this blow and back, and what this blow did [m, N]."""
    law, deepest = exact.scene.contact, exact.peak_indentation
    if deepest is None or deepest <= 0.0:
        return {}
    time = np.linspace(0.0, min(exact.duration, 1.02 * exact.contacts[-1].end), samples)
    if isinstance(exact.motion, ModalMotion):  # its force is constant over each step: tell it in the middle
        time = (np.floor(time / exact.motion.step) + 0.5) * exact.motion.step
    depth = exact.motion.impactor_position(time) - exact.motion.end_position(time)
    force = exact.motion.force(time)
    force[depth <= law.dent(0.0)] = 0.0
    down = np.linspace(0.0, deepest, CYCLE_POINTS)
    return {
        "cycleDepth": down,
        "cycleLoading": np.array([law.force(a, 0.0, 0.0) for a in down.tolist()]),
        "cycleUnloading": np.array([law.force(a, 0.0, deepest) for a in down.tolist()]),
        "blowDepth": depth,
        "blowForce": force,
    }


def packed(header: dict[str, Any], arrays: dict[str, Any]) -> bytes:
    """One message from a header and its arrays: float32, or whole numbers of two bytes given as (numbers, unit)."""
    sizes, parts = [], []
    for name, values in arrays.items():
        if isinstance(values, tuple):
            numbers, unit = values
            sizes.append([name, int(numbers.size), unit])
            parts.append(numbers.astype("<i2").tobytes() + b"\0" * (2 * (numbers.size % 2)))
        else:
            sizes.append([name, int(values.size)])
            parts.append(values.astype("<f4").tobytes())
    text = json.dumps(header | {"arrays": sizes}, allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    return len(text).to_bytes(4, "little") + text + b"".join(parts)


def _figures(solution: Solution) -> dict[str, Any]:
    trip, speed = solution.scene.time_unit, solution.scene.speed
    return {
        "name": solution.method["name"],
        "contacts": [
            [contact.start / trip, contact.end / trip, contact.impulse, contact.peak_force]
            for contact in solution.contacts
        ],
        "stillTouching": bool(solution.contacts[-1].end >= solution.duration * (1.0 - 1e-9)),
        "cutOff": [_cut_off(solution, contact) for contact in solution.contacts],
        "left": []
        if solution.impactor_velocity is None
        else [
            float(solution.motion.impactor_velocity(np.array([min(contact.end, solution.duration)]))[0]) / speed
            for contact in solution.contacts
        ],
        "final": None if solution.impactor_velocity is None else solution.impactor_velocity / speed,
        "targetFinal": solution.target_velocity / speed,
        "peakForce": solution.peak_force,
        "peakIndentation": solution.peak_indentation,
        "residualIndentation": solution.residual_indentation,
        "restitution": solution.restitution,
        "energy": solution.energy,
        "diagnostics": solution.diagnostics,
        "notes": solution.notes,
    }


def _cut_off(solution: Solution, contact: ContactPeriod) -> bool:
    """Whether the force was taken away at once by an arriving wave, rather than fading to zero."""
    if contact.peak_force is None or contact.end < solution.scene.time_unit * (1.0 - 1e-9):
        return False  # one impulse, or no wave has come back yet
    shortly_before = contact.end - 0.02 * solution.scene.time_unit
    if shortly_before <= contact.start:
        return False
    return bool(solution.motion.force(np.array([shortly_before]))[0] > 0.1 * contact.peak_force)


def ghost(scene: Scene, restitution: float) -> dict[str, float]:
    """Velocities after a classical rigid-body blow, in units of the impact speed, (9.1); a fixed rod stays at rest."""
    common = common_velocity(scene)
    share = 1.0 if scene.target.held else scene.reduced_mass / scene.impactor.mass
    impactor = scene.impactor.velocity - share * (1.0 + restitution) * scene.speed
    target = 0.0 if scene.target.held else common + (common - impactor) / scene.mass_ratio
    return {"impactor": impactor / scene.speed, "target": target / scene.speed}


def read_header(message: bytes) -> dict[str, Any]:
    """The header of a message, for tests and tools."""
    length = int.from_bytes(message[:4], "little")
    return json.loads(message[4 : 4 + length])
