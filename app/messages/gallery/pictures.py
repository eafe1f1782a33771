"""Pictures of scenes as they move, made of their solutions: what is small is drawn large, by one factor a picture."""

from collections.abc import Iterable
from typing import Any

import numpy as np

from solvers import Bending, Bounces, Solution, Waveguide, bounces
from solvers.bodies import Pendulum
from solvers.methods.quasi_static.balls import RowMotion
from solvers.solution.motion import Bends

from ...choices.request import Request
from ...choices.scene_of import own_choices
from ..encoding import arrays_of, read_header
from ..solutions import both
from ..solve import solve_frame
from ..transverse import main_solution
from .drawn import FRAMES, HEIGHT, WIDTH, Part, block, disc, fitted, line, outline

LEAD = 0.16  # of the time that is shown, before they touch
AROUND = 3.0  # contacts of compact bodies that are shown before and after theirs
LEFT, RIGHT, MIDDLE = 96.0, 600.0, HEIGHT / 2
MOVED = 56.0  # the largest movement of what hardly moves
MASS = 30.0  # half of a mass that strikes
ROD, THICKEST = 74.0, 130.0
PLACES = 49  # along rods and beams
GROUND = 12.0
AWAY = 0.35  # of the size of a mechanism, as far as a mass is followed that it has struck


def picture_of(name: str) -> list[dict[str, Any]]:
    """The parts of the picture of a built-in scene, as they are stored."""
    request = Request.of(own_choices(name))
    draw = {"axial": _axial, "beam": _beam, "mechanism": _mechanism, "bodies": _bodies}[request.kind]
    return [part.table() for part in draw(request)]


def _axial(request: Request) -> Iterable[Part]:
    solution = both(request)[0]
    if isinstance(solution.motion, RowMotion):
        return _row(solution)
    if isinstance(solution.scene.target, Waveguide):
        return _rods(solution)
    if solution.scene.target.held and solution.method["name"] == "rigid":
        return _bouncing(bounces(solution.scene, None))
    return _compact(solution)


def _times(duration: float) -> np.ndarray:
    return np.linspace(-LEAD / (1.0 - LEAD) * duration, duration, FRAMES)


def _rods(solution: Solution) -> list[Part]:
    """Rods on an axis, coloured by their stress; of what comes before the impact only that they fly."""
    scene, motion = solution.scene, solution.known_motion
    striking = scene.impactor.rods
    bodies, edge = scene.rods, -sum(rod.length for rod in striking)
    whole = scene.target.length - edge
    time = _times(solution.duration)
    within, flown = np.maximum(time, 0.0), np.minimum(time, 0.0)
    hits = not striking and not scene.prescribed_force
    left = LEFT if hits else 40.0
    unit = (RIGHT - left) / whole
    drawn, most = [], 0.0
    for number, rod in enumerate(bodies):
        count = max(round(PLACES * rod.length / whole), 6)
        inset = 1e-6 * rod.length  # the place of a joint belongs to one of its rods
        x = np.linspace(edge + inset, edge + rod.length - inset, count)
        stress = np.where(time[:, None] < 0.0, 0.0, motion.stress(within, 0.5 * (x[1:] + x[:-1])))
        moved = motion.displacement(within, x) + rod.velocity * flown[:, None]
        drawn.append((x, moved, stress, rod, number >= len(striking)))
        most = max(most, float(np.abs(moved).max()))
        edge += rod.length
    face = motion.impactor_position(within) + scene.impactor.velocity * flown if hits else np.zeros(1)
    scale = MOVED / max(most, float(np.abs(face).max()))
    largest = max(float(np.abs(stress).max()) for _, _, stress, _, _ in drawn) or 1.0
    start = bodies[0].length if striking else 0.0
    parts = []
    for x, moved, stress, rod, _ in drawn:
        thick = min(ROD * (rod.area / bodies[-1].area) ** 0.5, THICKEST)
        place = left + unit * (x + start) + scale * moved
        parts.append(line(place, np.full(x.size, MIDDLE), thick, stress / largest))
    if hits:
        ball = scene.impactor.kind == "sphere"
        place = left + scale * face - MASS
        parts.append(disc(place, MIDDLE, MASS) if ball else block(place, MIDDLE, MASS, 2.0 * MASS))
    if scene.target.held:
        parts.append(block(RIGHT + GROUND, MIDDLE, GROUND, 2.0 * ROD, "ground"))
    return parts


def _flight(time: np.ndarray, end: float, before: float, after: float, within: np.ndarray) -> np.ndarray:
    """Displacement before, in and after a contact: `within` at the instants, which stand still outside it."""
    return within + before * np.minimum(time, 0.0) + after * np.maximum(time - end, 0.0)


def _compact(solution: Solution) -> list[Part]:
    """Two bodies, or one on a half-space; an impact in no time is seen within a second of it."""
    scene, motion = solution.scene, solution.known_motion
    end = min(solution.contacts[-1].end, solution.duration)
    around = AROUND * end or 1.0
    time = np.linspace(-around, around + end, FRAMES)
    inside = np.clip(time, 0.0, end)
    final = [float(solution.impactor_velocity or 0.0), float(solution.target_velocity)]
    striker = _flight(time, end, scene.impactor.velocity, final[0], motion.impactor_position(inside))
    struck = _flight(time, end, scene.target.velocity, final[1], motion.end_position(inside))
    sizes = [getattr(body, "radius", None) for body in (scene.impactor, scene.target)]
    largest = max((size for size in sizes if size), default=1.0)
    first, second = (76.0 * size / largest if size else None for size in sizes)
    first = first or MASS
    scale = 120.0 / float(np.abs(np.concatenate((striker, struck))).max())
    hit, away = WIDTH / 2 + scale * striker, WIDTH / 2 + scale * struck
    if scene.target.held:
        other = block(WIDTH / 2 + 80.0, MIDDLE, 80.0, 200.0, "ground")
    elif second:
        other = disc(away + second, MIDDLE, second, "body")
    else:
        other = block(away + 2.0 * MASS, MIDDLE + 50.0, 2.0 * MASS, 100.0, "body")
    if isinstance(scene.impactor, Pendulum):  # on its bar, which is drawn no longer than there is room
        pivot, foot = (WIDTH / 2 - first, 24.0), MIDDLE + 50.0
        x = np.stack((np.full(FRAMES, pivot[0]), hit - first), axis=1)
        bar = line(x, np.array([pivot[1], foot]), 14.0, ink="striker")
        return [bar, disc(hit - first, foot, first), disc(*pivot, 12.0, "ground"), other]
    return [disc(hit - first, MIDDLE, first), other]


def _row(solution: Solution) -> list[Part]:
    """Balls in a row."""
    motion, scene = solution.known_motion, solution.scene
    assert isinstance(motion, RowMotion)
    end = min(solution.joints[-1][-1].end, solution.duration)
    time = np.linspace(-AROUND * end, (AROUND + 1.0) * end, FRAMES)
    inside = np.clip(time, 0.0, end)
    first = _flight(
        time, end, scene.impactor.velocity, float(solution.impactor_velocity or 0.0), motion.impactor_position(inside)
    )
    others = motion.ball_positions(inside)
    after = np.array(solution.ball_velocities)
    others = others + after * np.maximum(time - end, 0.0)[:, None]
    moved = np.column_stack((first, others))
    scale = 150.0 / float(np.abs(moved).max())
    size = 40.0
    begin = WIDTH / 2 - size * (moved.shape[1] - 1)
    return [
        disc(begin + 2.0 * size * number + scale * moved[:, number], MIDDLE, size, "body" if number else "striker")
        for number in range(moved.shape[1])
    ]


def _bouncing(found: Bounces) -> list[Part]:
    """A ball over the floor, and the way that it has gone over time."""
    end = found.bounces[5].time
    time = np.linspace(0.0, end, FRAMES)
    fine = np.linspace(0.0, end, 4 * FRAMES)

    def height(t: np.ndarray) -> np.ndarray:
        h = found.height - 0.5 * found.gravity * t**2
        for bounce in found.bounces[:6]:
            gone = np.maximum(t - bounce.time, 0.0)
            h = np.where(t >= bounce.time, bounce.rebound * gone - 0.5 * found.gravity * gone**2, h)
        return np.maximum(h, 0.0)

    floor, size = HEIGHT - 2.0 * GROUND - 8.0, 20.0
    tall = (floor - 2.0 * size - 12.0) / found.height
    across = 50.0 + (WIDTH - 100.0) / end * time
    return [
        line(50.0 + (WIDTH - 100.0) / end * fine, floor - size - tall * height(fine), 3.0, ink="faint"),
        disc(across, floor - size - tall * height(time), size),
        block(WIDTH / 2, floor + GROUND, WIDTH / 2, 2.0 * GROUND, "ground"),
    ]


def _beam(request: Request) -> list[Part]:
    """A beam that is struck from above, coloured by its bending moment."""
    solution = main_solution(request)[0]
    scene, motion, beam = solution.scene, solution.known_motion, solution.scene.target.known_as(Bending)
    assert isinstance(motion, Bends)
    time = _times(solution.duration)
    within = np.maximum(time, 0.0)
    x = np.linspace(0.0, beam.length, PLACES)
    bent = np.where(time[:, None] < 0.0, 0.0, motion.displacement(within, x))
    moment = np.where(time[:, None] < 0.0, 0.0, motion.moment(within, 0.5 * (x[1:] + x[:-1])))
    striker = motion.impactor_position(within) + scene.impactor.velocity * np.minimum(time, 0.0)
    scale = 60.0 / max(float(np.abs(bent).max()), 0.6 * float(np.abs(striker).max()))
    thick, size, level = 16.0, 26.0, MIDDLE + 30.0
    place = 40.0 + (WIDTH - 80.0) * x / beam.length
    struck = 40.0 + (WIDTH - 80.0) * beam.place / beam.length
    parts = [line(place, level + scale * bent, thick, moment / np.abs(moment).max())]
    parts.append(disc(np.full(FRAMES, struck), level - thick / 2 - size + scale * striker, size))
    held = ("clamped", "free") if beam.support == "cantilever" else beam.support.split("-")
    for support, end in zip(held, (place[0], place[-1]), strict=True):
        if support == "clamped":
            parts.append(block(end + (GROUND if end > struck else -GROUND), level, GROUND, 90.0, "ground"))
        elif support == "pinned":
            corners = np.array([0.0, -18.0, 18.0]), np.array([8.0, 40.0, 40.0])
            parts.append(outline(end + corners[0], level + corners[1], "ground"))
    return parts


def _mechanism(request: Request) -> list[Part]:
    """Links and joints; of an impact in which it stands still movements are drawn larger."""
    message = solve_frame(request.chosen)
    header, arrays = read_header(message), arrays_of(message)
    mechanism, scene = header["mechanism"], request.scene
    known, points = arrays["linkTime"], arrays["linkPoints"]
    time = np.linspace(0.0, float(known[-1]), FRAMES)
    moves = _at(time, known, arrays["linkMoves"])
    size = float(np.ptp(points.reshape(-1, 2), axis=0).max())
    contact, normal = np.array(mechanism["contact"]), np.array(mechanism["normal"])
    if "massPlaces" in arrays:
        larger, striker = 1.0, _at(time, known, arrays["massPlaces"])
    else:
        way = np.interp(time, arrays["time"], arrays["impactorPath"])
        larger = 0.22 * size / max(float(np.abs(moves).max()), float(np.abs(way).max()))
        striker = contact + larger * way[:, None] * normal
    places = points + larger * moves  # (frames, links, places, 2)
    parts = [line(places[:, k, :, 0], places[:, k, :, 1], 12.0) for k in range(points.shape[0])]
    for joint in mechanism["joints"]:
        own = places[:, joint["link"]]
        along = joint["share"] * (own.shape[1] - 1)
        first = min(int(along), own.shape[1] - 2)
        at = own[:, first] + (along - first) * (own[:, first + 1] - own[:, first])
        ground = "ground" in joint["links"]
        parts.append(disc(at[:, 0], at[:, 1], 14.0 if ground else 9.0, "ground" if ground else "joint"))
    if scene.impactor.rods:
        ends = striker[:, None] - np.array([0.45 * size, 0.0])[:, None] * normal
        parts.append(line(ends[..., 0], ends[..., 1], 30.0, ink="striker"))
    else:
        away = 0.09 * size  # of its middle from the line on which the link is drawn
        parts.append(disc(striker[:, 0] - away * normal[0], striker[:, 1] - away * normal[1], 18.0))
    return fitted(parts, AWAY)


def _at(time: np.ndarray, known: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values (known instants, ...) at others, straight between."""
    flat = values.reshape(known.size, -1)
    found = np.stack([np.interp(time, known, column) for column in flat.T], axis=1)
    return found.reshape(time.size, *values.shape[1:])


CORNERS = np.array([[a, b, c] for a in (-0.5, 0.5) for b in (-0.5, 0.5) for c in (-0.5, 0.5)])
EDGES = [(k, k | bit) for k in range(8) for bit in (1, 2, 4) if not k & bit]


def _bodies(request: Request) -> list[Part]:
    """Bodies in space, seen as the page shows them."""
    message = solve_frame(request.chosen)
    header, arrays = read_header(message), arrays_of(message)
    plane = np.array([header["across"], header["up"]])
    known = np.linspace(-1.0, 1.0, len(arrays["impactorPath"]))
    time = np.linspace(-1.0, 1.0, FRAMES)
    size, normal = header["size"], np.array(header["normal"])
    unit = 2.4 * size / HEIGHT  # about so many metres are a unit of the picture
    parts: list[Part] = []
    for name in ("impactor", "target"):
        body = header["bodies"][name]
        path = _at(time, known, arrays[f"{name}Path"])
        turn = _at(time, known, arrays[f"{name}Turn"].reshape(-1, 9)).reshape(-1, 3, 3)
        at = path @ plane.T
        ink = "striker" if name == "impactor" else "body"
        if body["shape"] == "stop":
            along = plane @ np.cross(normal, np.cross(plane[0], plane[1]))
            behind = (plane @ normal) * 12.0 * unit * (1.0 if name == "target" else -1.0)
            ends = np.array([[-1.3], [1.3]]) * size * along + behind
            parts.append(line(ends[:, 0], ends[:, 1], 24.0, ink="ground"))
        elif body["shape"] == "box":
            axes = np.array(body["axes"]) * np.array(body["sides"])[:, None]  # rows
            corners = np.einsum("fij,kj->fki", turn, CORNERS @ axes) @ plane.T + at[:, None]
            thick = 10.0 if np.count_nonzero(np.array(body["sides"]) > 1e-9) < 2 else 4.0
            edges = EDGES if thick < 10.0 else [(0, 7)]
            parts += [line(corners[:, edge, 0], corners[:, edge, 1], thick, ink=ink) for edge in map(list, edges)]
        elif body["shape"] == "ball":
            radius = body["radius"]
            spoke = np.einsum("fij,j->fi", turn, plane[1] * radius) @ plane.T
            parts.append(disc(at[:, 0], at[:, 1], radius / unit, ink))
            ends = np.stack((at - spoke, at + spoke), axis=1)
            parts.append(line(ends[..., 0], ends[..., 1], 3.0, ink="panel"))
        else:
            parts.append(disc(at[:, 0], at[:, 1], 10.0, ink))
    return fitted(parts)
