"""What the browser needs of a body that is dropped on what is held: its bounces, and its height over time."""

import math
from time import thread_time
from typing import Any

import numpy as np

from solvers import METHODS, Bounces, Scene, Solution, bounces
from solvers.bodies.drop import height_and_gravity
from solvers.solution.solution import apparent_time

from ..choices.built_in import base_of
from ..choices.request import Request
from .encoding import LARGEST_MASS, force_history

FINE, INSTANTS = 20, (33, 9)  # flights that are drawn finely; instants of these, and of later ones
CUT, MOST = 2e-4, 24  # of the first height; impacts that are solved
BUDGET = 0.3  # seconds of the processor that they may take, after which the later ones are summed up
CLOSER = 121  # instants of the force of an impact
ALIKE = 1e-6  # restitutions of impacts after which all that follow give as much back


def fall_fields(request: Request, exact: Solution) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Header and arrays, SI units, times from the release on; nothing where the scene drops no body."""
    scene = request.scene
    dropped = _dropped(request)
    if dropped is None or not scene.target.held or not scene.impactor.free_mass:
        return {}, {}
    _, gravity = height_and_gravity(dropped)
    options = dict(exact.method)
    method = METHODS[options.pop("name")].read(options).without_estimate()
    latest = thread_time() + BUDGET
    forces: list[np.ndarray | None] = []
    found = bounces(
        scene, method, CUT, MOST, gravity, lambda: thread_time() > latest, lambda each: forces.append(closer(each))
    )
    time, height = flights(found)
    mass = min(scene.impactor.mass, LARGEST_MASS)
    rows = [
        (each.time, mass * (each.speed + max(each.rebound, 0.0)), each.height, each.restitution)
        for each in found.bounces
    ]
    header = {"height": found.height, "gravity": gravity, "rest": _rest(found, gravity)}
    arrays = {"fallTime": time, "fallHeight": height, "bounces": np.array(rows)}
    shown = [force for force in forces if force is not None]
    if len(shown) == len(rows):
        arrays["touches"] = np.array([(each.contact_time, each.peak_force) for each in found.bounces])
        arrays["touchForce"] = np.array(shown)
    return {"fall": header}, arrays


def closer(solution: Solution) -> np.ndarray | None:
    """The contact force [N] of one impact, evenly over its time; None if it takes none."""
    lasts = apparent_time(solution.contacts)
    if not lasts or solution.peak_force is None:
        return None
    start = solution.contacts[0].start
    return np.interp(np.linspace(start, start + lasts, CLOSER), *force_history(solution))


def _rest(found: Bounces, gravity: float) -> float | None:
    """When it lies still [s], also where no more impacts are solved but all give as much back; None: never."""
    if found.ended != "count" or len(found.bounces) < 2:
        return found.rest_time
    before, last = found.bounces[-2:]
    if last.restitution >= 1.0 or abs(last.restitution - before.restitution) > ALIKE:
        return None
    return last.time + (last.contact_time or 0.0) + 2.0 * last.rebound / gravity / (1.0 - last.restitution)


def _dropped(request: Request) -> dict[str, Any] | None:
    """The table of the impactor where the scene gives it a height."""
    chosen = request.chosen
    scene: Scene = base_of(chosen["scene"], chosen["bodies"])
    given = scene.given.get("impactor", {})
    return given if "height" in given else None


def flights(found: Bounces) -> tuple[np.ndarray, np.ndarray]:
    """Times since the release [s] and heights [m], parabola by parabola, at nought while it touches and after rest."""
    fall = np.linspace(0.0, found.bounces[0].time, INSTANTS[0])
    times, heights = [fall], [found.height - 0.5 * found.gravity * fall**2]
    heights[0][-1] = 0.0  # to rounding
    for number, bounce in enumerate(found.bounces):
        if bounce.rebound <= 0.0:
            break
        shares = np.linspace(0.0, 1.0, INSTANTS[number >= FINE])
        begin = bounce.time + (bounce.contact_time or 0.0)
        lasts = (bounce.rebound + math.sqrt(2.0 * found.gravity * bounce.height)) / found.gravity
        below = bounce.height - 0.5 * bounce.rebound**2 / found.gravity  # it may leave before it is back at nought
        since = lasts * shares
        times.append(begin + since)
        heights.append(np.maximum(below + since * (bounce.rebound - 0.5 * found.gravity * since), 0.0))
    if found.rest_time is not None and found.rest_time > times[-1][-1]:
        times.append(np.array([found.rest_time]))
        heights.append(np.zeros(1))
    return np.concatenate(times), np.concatenate(heights)
