"""What the browser needs to draw an impact between bodies in space, in the layout of app/messages/encoding.py.

SI units. Places are from the point of impact; times run from -1 to 1, in units of `duration`, zero being the impact.
The picture is seen along `across` x `up`: no perspective, the normal and the largest movement lie in its plane.
"""

from typing import Any

import numpy as np

from solvers import Body, Scene, Solution
from solvers.bodies import in_space
from solvers.numerics.rigid.impulses import principal
from solvers.numerics.rigid.rotation import rotations

from ..choices.request import Request
from ..choices.space import equivalent_box
from .encoding import coded, packed, unshown
from .parts import parts_told

STEPS = 60  # samples of the movement on either side of the impact
LARGEST_TURN = 1.2  # [rad] shown on either side
LARGEST_MOVE = 0.7  # of the size of the bodies
ALIKE = 1e-6  # relative difference of the principal moments of what is drawn as a ball


def bodies_frame(solution: Solution, request: Request | None = None) -> bytes:
    """The message for one impact between bodies in space."""
    scene = solution.scene
    after = {
        "impactor": (solution.impactor_velocity, solution.impactor_spin),
        "target": (solution.target_velocity, solution.target_spin),
    }
    size, duration = _scale(scene, after)
    across, up = _plane(scene, after, size)
    bodies = {}
    final: Any  # velocity and spin
    for name, final in after.items():
        body = getattr(scene, name)
        bodies[name] = _drawn(body) | {
            "before": {"velocity": _listed(in_space(body).velocity), "spin": _listed(in_space(body).spin)},
            "after": {"velocity": list(final[0]), "spin": list(final[1])},
        }
    header = {
        "kind": "bodies",
        "chosen": request and request.chosen,
        "own": request.own if request else None,
        "draft": False,
        "acting": request.acting if request else [],
        "refusals": {},
        "title": scene.title,
        "source": scene.source,
        "note": scene.note,
        "parts": parts_told(request),
        "unshown": unshown(scene),
        "duration": duration,
        "size": size,
        "across": _listed(across),
        "up": _listed(up),
        "normal": list(scene.normal),
        "impulse": float(np.linalg.norm(solution.impulse)),
        "bodies": bodies,
        "figures": figures(solution),
        "notes": coded(solution.notes),
    }
    return packed(header, _movements(scene, after, duration))


def figures(solution: Solution) -> list[list[Any]]:
    """The numbers beside the picture: code of the name (`space.row`), a number or a vector, unit."""
    found, scene = solution.diagnostics, solution.scene
    rows: list[list[Any]] = [
        ["approach", solution.scene.speed, "m/s"],
        ["effective-mass", solution.effective_mass, "kg"],
        ["impulse", list(solution.impulse) if scene.friction is not None else solution.impulse, "N s"],
        ["restitution", solution.method["restitution"], ""],
        ["energy-before", solution.energy["initial"], "J"],
        ["energy-lost", solution.energy["dissipated"], "J"],
    ]
    for name in ("impactor", "target"):
        body = in_space(getattr(solution.scene, name))
        rows += [
            [f"{name}-velocity-before", _listed(body.velocity), "m/s"],
            [f"{name}-velocity-after", list(getattr(solution, f"{name}_velocity")), "m/s"],
            [f"{name}-spin-before", _listed(body.spin), "rad/s"],
            [f"{name}-spin-after", list(getattr(solution, f"{name}_spin")), "rad/s"],
        ]
    return [
        *rows,
        ["momentum-error", found["momentum_error"], ""],
        ["angular-momentum-error", found["angular_momentum_error"], ""],
        ["energy-error", found["energy_error"], ""],
    ]


def _drawn(body: Any) -> dict[str, Any]:
    """What to draw: a stop, a point, a ball, or a box, of which a rod has only one side."""
    if not isinstance(body, Body):
        return {"shape": "stop"}
    if body.is_point:
        return {"shape": "point", "mass": body.mass}
    moments, _ = principal(np.array(body.inertia))
    if moments[2] - moments[0] <= ALIKE * moments[2]:
        return {"shape": "ball", "mass": body.mass, "radius": float(np.sqrt(2.5 * moments[2] / body.mass))}
    sides, axes = equivalent_box(body)
    return {"shape": "box", "mass": body.mass, "sides": sides.tolist(), "axes": axes.T.tolist()}


def _movements(scene: Scene, after: dict[str, tuple[Any, Any]], duration: float) -> dict[str, np.ndarray]:
    """Paths of the centres (time, 3) and turns from the instant of the impact (time, 3, 3), flat, from -1 to 1."""
    bodies = {name: in_space(getattr(scene, name)) for name in after}
    times = np.linspace(-duration, duration, 2 * STEPS + 1)
    arrays = {}
    inertia = np.array([[body.inertia] * 2 for body in bodies.values()])
    spins = np.array([[body.spin, final[1]] for body, final in zip(bodies.values(), after.values(), strict=True)])
    turned = rotations(inertia, spins, np.array([-duration, duration]), STEPS)  # (step, body, before or after, 3, 3)
    for number, (name, body) in enumerate(bodies.items()):
        speeds = np.where(times[:, None] < 0.0, body.velocity, np.array(after[name][0]))
        arrays[f"{name}Path"] = body.centre + speeds * times[:, None]
        arrays[f"{name}Turn"] = np.concatenate([turned[:0:-1, number, 0], turned[:, number, 1]])
    return arrays


def _scale(scene: Scene, after: dict[str, tuple[Any, Any]]) -> tuple[float, float]:
    """Size of what is drawn [m], and how long its movement is followed on either side of the impact [s]."""
    size = 0.0
    for name in after:
        body = getattr(scene, name)
        if isinstance(body, Body):
            sides = np.zeros(3) if body.is_point else equivalent_box(body)[0]
            size = max(size, float(np.linalg.norm(body.centre) + 0.5 * np.linalg.norm(sides)))
    size = size or 1.0  # two point masses: any scale will do
    bodies = [in_space(getattr(scene, name)) for name in after]
    speed = max(np.linalg.norm(v) for v in [*(b.velocity for b in bodies), *(final[0] for final in after.values())])
    spin = max(np.linalg.norm(w) for w in [*(b.spin for b in bodies), *(final[1] for final in after.values())])
    rate = max(float(speed) / (LARGEST_MOVE * size), float(spin) / LARGEST_TURN)
    return size, 1.0 / rate if rate > 0.0 else 1.0


def _plane(scene: Scene, after: dict[str, tuple[Any, Any]], size: float) -> tuple[np.ndarray, np.ndarray]:
    """Two directions of the world that span the picture: it holds the normal and most of the movement."""
    normal = np.array(scene.normal)
    weights = 1e-9 * np.eye(3)
    for name, final in after.items():
        body = in_space(getattr(scene, name))
        moves = [body.velocity, np.array(final[0]), *(size * np.cross(w, normal) for w in (body.spin, final[1]))]
        weights += sum(np.outer(move, move) for move in moves) + 1e-6 * np.outer(body.centre, body.centre)
    flat = np.eye(3) - np.outer(normal, normal)
    _, directions = np.linalg.eigh(flat @ weights @ flat - 1e3 * np.trace(weights) * np.outer(normal, normal))
    second = directions[:, -1]
    shown = np.outer(normal, normal) + np.outer(second, second)
    lengths = np.sqrt(np.diag(shown))  # of the coordinate axes in the picture
    upward = int(np.argmax(lengths * [0.5, 1.0, 0.9]))
    up = shown[:, upward] / np.linalg.norm(shown[:, upward])
    across = np.cross(up, np.cross(normal, second))
    return across * (1.0 if across.sum() >= -1e-9 else -1.0) + 0.0, up


def _listed(vector: np.ndarray) -> list[float]:
    return np.asarray(vector, float).tolist()
