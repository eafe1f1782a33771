"""What the browser needs of a solve, as one small binary message: physics, from which it rebuilds every picture.

Units of the message: time in round trips T, velocity in the impact speed v, displacement in v T, force in Z v, stress
in v sqrt(E rho). Layout: length of the header (4 bytes, little endian), header (JSON), zeros up to a multiple of four,
then float32 arrays in the order and length that the header states.
"""

import json
from typing import Any

import numpy as np

from solvers import ContactPeriod, Modal, Scene, Solution, Waves
from solvers.contact.viscous import LEAST_RESTITUTION
from solvers.methods.modal import STEPS_PER_PERIOD

from .state import chosen_scene

WAVE_POINTS = 2_600  # of the wave's history
MOTION_POINTS = 400  # of the motions of mass and struck end
MAX_FORCE_STEPS = 10_000  # of the modal force, all of which the browser needs to rebuild the modes


def solve_frame(chosen: dict[str, Any]) -> bytes:
    """Solve what is chosen with both methods and pack what the page draws."""
    scene = chosen_scene(chosen)
    waves = Waves().solve(scene)
    period = scene.target.modes(chosen["modes"]).shortest_period
    steps = int(min(max(STEPS_PER_PERIOD * waves.duration / period, 1_000), MAX_FORCE_STEPS))
    modal = Modal(modes=chosen["modes"], steps=steps, estimate=False).solve(
        scene, waves.duration
    )  # waves tell the error
    return pack(chosen, scene, waves, modal)


def pack(chosen: dict[str, Any], scene: Scene, waves: Solution, modal: Solution) -> bytes:
    """The message for one pair of solutions."""
    rod, speed = scene.target, scene.impactor.velocity
    trip, force_unit = rod.round_trip_time, rod.impedance * speed
    reach = waves.duration
    even = np.linspace(0.0, reach, MOTION_POINTS + 1)
    length_unit = speed * trip
    arrays = {
        **_wave_history(waves),
        "waveMass": waves.motion.impactor_position(even) / length_unit,
        "modalForce": modal.motion.record.contact_force / force_unit,
        "modalMass": modal.motion.impactor_position(even) / length_unit,
        "modalEnd": modal.motion.end_position(even) / length_unit,
    }
    header = {
        "chosen": chosen,
        "title": scene.title,
        "source": scene.source,
        "trip": trip,
        "duration": reach / trip,
        "fixed": rod.fixed,
        "length": rod.length,
        "waveSpeed": rod.wave_speed,
        "targetMass": rod.mass,
        "impactorMass": scene.impactor.mass,
        "speed": speed,
        "forceUnit": force_unit,
        "stressUnit": force_unit / rod.area,
        "stiffness": rod.stiffness,
        "sphere": scene.impactor.kind == "sphere",
        "modes": chosen["modes"],
        "step": modal.motion.step / trip,
        "waves": _figures(waves),
        "modal": _figures(modal),
        "ghost": ghost(scene, chosen["restitution"]),
        "match": waves.restitution["newton"],
        "leastRestitution": LEAST_RESTITUTION,
    }
    return packed(header, arrays)


def packed(header: dict[str, Any], arrays: dict[str, np.ndarray]) -> bytes:
    """One message from a header and its arrays."""
    sizes = {"arrays": [[name, int(values.size)] for name, values in arrays.items()]}
    text = json.dumps(header | sizes, allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    return len(text).to_bytes(4, "little") + text + b"".join(a.astype("<f4").tobytes() for a in arrays.values())


def _wave_history(waves: Solution) -> dict[str, np.ndarray]:
    """Times, wave sent by the struck end, its integral, contact force; at a jump the time stands twice."""
    history, trip = waves.motion.history, waves.scene.target.round_trip_time
    unit = waves.scene.target.impedance * waves.scene.impactor.velocity
    reach = waves.duration / trip
    even = np.linspace(0.0, reach, WAVE_POINTS - 200)
    jumps = history.jumps()
    jumps = jumps[(jumps >= 0.0) & (jumps <= reach)][:200]
    time = np.unique(np.concatenate([even, jumps]))
    before, after, total = history.wave(time, False), history.wave(time, True), history.total(time)
    force_before, force_after = (waves.motion.force(time * trip, side) / unit for side in (False, True))
    doubled = (np.abs(after - before) > 1e-6) | (np.abs(force_after - force_before) > 1e-6)
    order = np.argsort(np.concatenate([time[doubled], time]), kind="stable")
    pairs = {
        "waveTime": (time, time),
        "wave": (before, after),
        "waveTotal": (total, total),
        "waveForce": (force_before, force_after),
    }
    return {name: np.concatenate([first[doubled], last])[order] for name, (first, last) in pairs.items()}


def _figures(solution: Solution) -> dict[str, Any]:
    trip, speed = solution.scene.target.round_trip_time, solution.scene.impactor.velocity
    return {
        "contacts": [
            [contact.start / trip, contact.end / trip, contact.impulse, contact.peak_force]
            for contact in solution.contacts
        ],
        "stillTouching": bool(solution.contacts[-1].end >= solution.duration * (1.0 - 1e-9)),
        "cutOff": [_cut_off(solution, contact) for contact in solution.contacts],
        "left": [
            float(solution.motion.impactor_velocity(np.array([min(contact.end, solution.duration)]))[0]) / speed
            for contact in solution.contacts
        ],
        "final": solution.impactor_velocity / speed,
        "targetFinal": solution.target_velocity / speed,
        "peakForce": solution.peak_force,
        "peakIndentation": solution.peak_indentation,
        "restitution": solution.restitution,
        "energy": solution.energy,
        "diagnostics": solution.diagnostics,
        "notes": solution.notes,
    }


def _cut_off(solution: Solution, contact: ContactPeriod) -> bool:
    """Whether the force was taken away at once by an arriving wave, rather than fading to zero."""
    shortly_before = contact.end - 0.02 * solution.scene.target.round_trip_time
    if shortly_before <= contact.start:
        return False
    return bool(solution.motion.force(np.array([shortly_before]))[0] > 0.1 * contact.peak_force)


def ghost(scene: Scene, restitution: float) -> dict[str, float]:
    """Velocities after a classical rigid-body blow, in units of the impact speed, (9.1); a fixed rod stays at rest."""
    if scene.target.fixed:
        return {"impactor": -restitution, "target": 0.0}
    beta = scene.mass_ratio
    velocity = (1.0 - restitution * beta) / (1.0 + beta)
    return {"impactor": velocity, "target": (1.0 + restitution) / (1.0 + beta)}


def read_header(message: bytes) -> dict[str, Any]:
    """The header of a message, for tests and tools."""
    length = int.from_bytes(message[:4], "little")
    return json.loads(message[4 : 4 + length])
