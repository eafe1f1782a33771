"""What the browser needs to draw an impact between bodies in space, in the layout of app/messages/encoding.py.

SI units. Places are from the point of impact; times run from -1 to 1, in units of `duration`, zero being the impact.
The picture is seen along `across` x `up`: no perspective, the normal and the largest movement lie in its plane.
"""

from dataclasses import asdict
from typing import Any

import numpy as np

from solvers import Body, RigidImpulse, Scene, Solution, Wall
from solvers.bodies import in_space
from solvers.contact.friction import MODELS
from solvers.numerics.rigid.friction import NEWTON, sliding_path
from solvers.numerics.rigid.impulses import inverse_inertia, principal, strike
from solvers.numerics.rigid.rotation import rotations
from solvers.scenes.saved import saved_head

from ..choices.built_in import base_of
from ..choices.request import Request
from ..choices.space import equivalent_box, own_frame
from .encoding import coded, packed
from .parts import common, taken_along

STEPS = 60  # samples of the movement on either side of the impact
LARGEST_TURN = 1.2  # [rad] shown on either side
LARGEST_MOVE = 0.7  # of the size of the bodies
RESTORED = ("newton_at_contact", "poisson", "energetic")
COURSE_POINTS = 400  # of sliding, at most
ALIKE = 1e-6  # relative difference of the principal moments of what is drawn as a ball


def space_frame(request: Request) -> bytes:
    """The message for what is chosen."""
    return bodies_frame(space_solution(request), request)


def space_solution(request: Request) -> Solution:
    """The impact that is chosen."""
    method = RigidImpulse(restitution=request.restitution, model=request.chosen["restitution_model"])
    return method.solve(request.scene)


def bodies_frame(solution: Solution, request: Request | None = None) -> bytes:
    """The message for one impact between bodies in space."""
    scene = solution.scene
    after = {
        "impactor": (solution.impactor_velocity, solution.impactor_spin),
        "target": (solution.target_velocity, solution.target_spin),
    }
    size, duration = _scale(scene, after)
    across, up = _plane(*_seen(scene, after, request), size)
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
        **common(scene, request, solution.notes),
        "head": saved_head(taken_along(scene, request), solution.method, solution.duration),
        "refusals": {},
        "duration": duration,
        "size": size,
        "across": _listed(across),
        "up": _listed(up),
        "normal": list(scene.normal),
        "ownFrame": own_frame(_scene_of(request) or scene).tolist(),
        "impulse": float(np.linalg.norm(solution.impulse)),
        "push": _listed(np.multiply(solution.impulse, scene.normal) if scene.friction is None else solution.impulse),
        "friction": scene.friction or 0.0,
        "sliding": [asdict(each) for each in solution.sliding or []],
        "bodies": bodies,
        "figures": figures(solution),
        "notes": coded(solution.notes),
    }
    return packed(header, _movements(scene, after, duration) | _course(solution, across, up))


def _scene_of(request: Request | None) -> Scene | None:
    """The scene that was chosen, before what the hand changes in it."""
    return base_of(request.chosen["scene"], request.chosen["bodies"]) if request else None


def _seen(scene: Scene, after: dict[str, tuple[Any, Any]], request: Request | None) -> tuple[Scene, Any]:
    """The scene, and its movement, from which the plane of the picture follows: on the page always as built in, so that
    the picture stands still under the hand that changes it.
    """
    own = _scene_of(request)
    if own is None:
        return scene, after
    found = RigidImpulse().solve(own)
    return own, {
        name: (getattr(found, f"{name}_velocity"), getattr(found, f"{name}_spin")) for name in ("impactor", "target")
    }


def _course(solution: Solution, across: np.ndarray, up: np.ndarray) -> dict[str, np.ndarray]:
    """How the contact slides over the normal impulse; nothing without friction, or without an impact."""
    scene, method = solution.scene, solution.method
    if not solution.sliding:
        return {}
    normal, toward = np.array(scene.normal), np.cross(across, up)
    along = np.cross(toward, normal)
    if np.linalg.norm(along) < 1e-6:  # the normal points at who looks
        along = across
    along = along - (along @ normal) * normal
    along /= np.linalg.norm(along)
    aside = np.cross(normal, along)
    aside *= 1.0 if aside @ toward >= 0.0 else -1.0
    law = MODELS.index(method["model"])
    before = in_space(scene.impactor), in_space(scene.target)
    path, frame = sliding_path(*before, normal, float(scene.friction or 0.0), method["restitution"], law, COURSE_POINTS)
    slides = -path[:, 1:] @ frame
    press, pushes = path[:, 0], _pushes(*before, slides - slides[0])
    if law == NEWTON:  # which knows no course: in proportion, to the impulse that is its own
        pushes = np.outer(press / press[-1], solution.impulse)
        press = pushes @ normal * (np.sign(pushes[-1] @ normal) or 1.0)
    return {
        "slideImpulse": pushes,
        "slidePush": np.linalg.norm(pushes - np.outer(pushes @ normal, normal), axis=1),
        "slideSpins": np.stack([_spins(before[0], -pushes), _spins(before[1], pushes)], axis=1),
        "slidePress": press,
        "slideParting": path[:, 1],
        "slideAlong": slides @ along,
        "slideAside": slides @ aside,
    }


def _pushes(impactor: Any, target: Any, change: np.ndarray) -> np.ndarray:
    """Impulses on the target [N s], (course, 3), by which the points that touch move otherwise by `change` (course, 3)
    [m/s]."""
    inverse = sum(np.eye(3) / body.mass - _arm(body) @ _turns(body) for body in (target, impactor))
    return -np.linalg.solve(inverse, change.T).T


def _spins(body: Any, pushes: np.ndarray) -> np.ndarray:
    """Spins [rad/s], (course, 3), of a body that is given these impulses [N s] where it is touched."""
    return np.array(body.spin) + pushes @ _turns(body).T


def _turns(body: Any) -> np.ndarray:
    """By how much an impulse at the contact changes the spin, (3, 3)."""
    return inverse_inertia(body) @ _arm(body)


def _arm(body: Any) -> np.ndarray:
    """The cross product of the arm of the contact, from the centre, and what follows, (3, 3) [m]."""
    x, y, z = -np.array(body.centre, float)
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def _masses(scene: Scene) -> list[list[Any]]:
    """Of each body, and what of it is felt where it is struck: of a rod, on its end, a quarter."""
    normal, wall, rows = np.array(scene.normal), in_space(Wall("stop")), []
    for name in ("impactor", "target"):
        body = getattr(scene, name)
        if isinstance(body, Body):
            felt = strike(in_space(body), wall, normal, 1.0).effective_mass
            rows += [[f"{name}-mass", body.mass, "kg"], [f"{name}-felt-mass", float(felt), "kg"]]
    return rows


def figures(solution: Solution) -> list[list[Any]]:
    """The numbers beside the picture: code of the name (`space.row`), a number or a vector, unit."""
    found, scene = solution.diagnostics, solution.scene
    rows: list[list[Any]] = [
        ["approach", solution.scene.speed, "m/s"],
        ["effective-mass", solution.effective_mass, "kg"],
        *_masses(scene),
        ["impulse", solution.impulse if scene.friction is None else list(solution.impulse), "N s"],
        ["restitution", solution.method["restitution"], ""],
        ["energy-before", solution.energy["initial"], "J"],
        ["energy-lost", solution.energy["dissipated"], "J"],
    ]
    if scene.friction is not None:
        rows.append(["energy-rubbed", solution.energy["friction"], "J"])
        rows += [[f"restitution-{name}", solution.restitution[name], ""] for name in RESTORED]
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
        *_model_rows(solution),
        ["momentum-error", found["momentum_error"], ""],
        ["angular-momentum-error", found["angular_momentum_error"], ""],
        ["energy-error", found["energy_error"], ""],
    ]


def _model_rows(solution: Solution) -> list[list[Any]]:
    """The impulse by each model of restitution, and what it leaves of the energy."""
    initial = solution.energy["initial"] or 1.0
    rows: list[list[Any]] = []
    for name, found in (solution.models or {}).items():
        left = 1.0 - sum(found["energy"].values()) / initial
        rows += [[f"{name}-impulse", found["impulse"], "N s"], [f"{name}-energy", 100.0 * left, "%"]]
    return rows


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
