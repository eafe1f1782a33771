"""What the browser draws of a mechanism that moves on: where links and mass go, how links bend, joints, energies."""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from solvers import Scene, Solution
from solvers.bodies import Mechanism
from solvers.methods.multibody.method import Multibody
from solvers.methods.multibody.motion import MovingMotion
from solvers.text.notes import Note

from ...choices.request import Request
from ..encoding import Stretch, over, whole_numbers
from .links import PLACES, across, instants_for, link_arrays
from .resting import described, with_rigid_links

INSTANTS, HISTORY = 501, 301  # of the picture, besides impacts; of reactions and energies
TURN_INSTANTS = 24  # in a turn of the fastest link, if that is more
MOST_INSTANTS = 1_500
MOST_AVERAGED = 8  # steps, of the reactions of one instant: in vibrations each differs from the next
MOST_RIGID_STEPS = 50_000  # which take some three seconds
MOST_STEPS = 10_000  # of links that bend, which take some two seconds; for longer they are followed as rigid ones
MOST_CONTACT_STEPS = {False: 20_000, True: 10_000}  # of links that are rigid, and of such as bend: some three seconds
# That a draft takes, if as many are needed, each of second order; more where that were too few for each turn. They take
# 3 to 5 us each.
DRAFT_STEPS, DRAFT_SHARE = 1_000, 0.2
LEAST_CONTACT_STEPS = 25  # of its shortest contact
IMPACTS = 100  # one by one
JOLTS = 8  # of these, the first of which it is said what every joint gets


def follow(request: Request, method: Multibody) -> tuple[Solution, Note | None]:
    """The motion for as long as is asked, or as is usual, and why links that bend are taken as rigid, or None.

    A draft takes them as rigid, and simpler and fewer steps.
    """
    scene, reason = request.scene, None
    asked = request.chosen["motion_seconds"] or None
    method = replace(method, most_contact_steps=MOST_CONTACT_STEPS[scene.target.bends])
    seconds, steps = method.lasts(scene, asked)
    if scene.target.known_as(Mechanism).flexible:
        if asked is None and steps > MOST_STEPS:
            seconds *= MOST_STEPS / steps
        elif not request.draft and request.chosen["motion_links"] == "flexible":
            reason = method.too_long(scene, seconds, MOST_STEPS)
        if reason or request.draft or request.chosen["motion_links"] == "rigid":
            scene = with_rigid_links(scene)
        else:
            return method.without_estimate().solve(scene, seconds), None
    _, steps = method.lasts(scene, seconds)
    if steps > MOST_RIGID_STEPS:
        seconds, steps = seconds * MOST_RIGID_STEPS / steps, MOST_RIGID_STEPS
    if request.draft:
        fewer = max(min(DRAFT_STEPS, steps), math.ceil(DRAFT_SHARE * steps))
        of_contact = max(math.ceil(request.share * method.contact_steps), LEAST_CONTACT_STEPS)
        method = replace(method, steps=fewer, contact_steps=of_contact, quick=True).without_estimate()
    return method.solve(scene, seconds), reason


def moving_fields(
    solution: Solution, request: Request, rigid: Note | None, reference: Solution | None
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Header and arrays; `rigid`: why links that bend are followed as rigid ones."""
    motion = solution.known_motion
    assert isinstance(motion, MovingMotion)
    mechanism = motion.mechanism
    edges = [edge for contact in solution.contacts[:IMPACTS] for edge in (contact.start, contact.end)]
    time = np.unique([*np.linspace(0.0, solution.duration, _instants(motion)), *edges])
    bends = _bends(motion, time, request.stretch)
    links = motion.link_points(time)
    ends = np.stack([links[link.name] for link in mechanism.links], axis=1)  # (instants, links, ends, 2)
    ends -= bends.pop("beside")
    arrays: dict[str, Any] = {
        "linkTime": time,
        "linkPoints": ends[0],
        "linkMoves": whole_numbers(ends - ends[0]),
        "massPlaces": whole_numbers(motion.impactor_places(time)),
        "normals": _normals(motion, links, np.array(edges), time),
        **bends,
    }
    names, histories = _energies(motion, solution.scene, request.stretch)
    arrays |= histories | _reactions(motion, "", request.stretch)
    if reference is not None:
        assert isinstance(reference.motion, MovingMotion)
        arrays |= _reactions(reference.motion, "reference", request.stretch)
    asked = request.chosen["motion_seconds"]
    cut = asked > solution.duration * (1.0 + 1e-9) and not any(note.code == "cut-short" for note in solution.notes)
    moving = {
        "restitution": solution.method["restitution"] if solution.scene.rigid_contact else None,
        "rigid": rigid and rigid.table(),
        "cut": cut,
        "energies": names,
        "jolts": _jolts(motion, solution),
    }
    return {"places": PLACES, "mechanism": described(mechanism), "moving": moving}, arrays


def _instants(motion: MovingMotion) -> int:
    """Of the picture: as many as the fastest link needs to go round in a circle."""
    spins = np.abs(motion.rates.reshape(motion.time.size, -1, 3)[:, :, 2]).max()
    turns = float(spins) * float(motion.time[-1]) / (2.0 * math.pi)
    return int(min(max(INSTANTS, TURN_INSTANTS * turns), MOST_INSTANTS))


def _bends(motion: MovingMotion, time: np.ndarray, stretch: Stretch) -> dict[str, Any]:
    """Of every link that bends its shapes and their amounts; "beside": by how much its ends are off the straight line
    that its deflection is drawn from, (instants, links, ends, 2) [m]."""
    mechanism, offsets = motion.mechanism, motion.mechanism.system.offsets
    bent = {n: across(mechanism, n) for n, link in enumerate(mechanism.links) if link.flexible}
    beside = np.zeros((time.size, len(mechanism.links), 2, 2))
    if not bent:
        return {"beside": beside}
    shapes = sum(len(fields.shape) for fields in bent.values())
    fine = over(stretch, float(motion.time[-1]), instants_for(shapes))
    coordinates, now = motion.coordinates(fine), motion.coordinates(time)
    found: dict[str, Any] = {"bendTime": fine}
    for number, fields in bent.items():
        first, angle = int(offsets[number]) + 3, now[:, int(offsets[number]) + 2]
        own = slice(first, first + len(fields.shape))
        found |= link_arrays(number, coordinates[:, own], fields, now[:, own])
        left = np.stack((-np.sin(angle), np.cos(angle)), axis=1)
        beside[:, number] = (now[:, own] @ fields.shape[:, [0, -1]])[:, :, None] * left[:, None]
    return found | {"beside": beside}


def _normals(motion: MovingMotion, links: dict[str, np.ndarray], edges: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Times [s] at which contacts begin and end, and angles of the normal of the struck link [rad], (2, edges)."""
    mechanism = motion.mechanism
    along = np.diff(links[mechanism.struck.link], axis=1)[:, 0]
    angle = np.unwrap(np.arctan2(along[:, 1], along[:, 0]))
    x, y = mechanism.struck.normal
    turned = (angle - angle[0])[np.searchsorted(time, edges)]
    return np.stack((edges, math.atan2(y, x) + turned))


def _jolts(motion: MovingMotion, solution: Solution) -> list[list[float]]:
    """Size of the impulse at every joint in the first impacts [N s], (impacts, joints)."""
    ends = [contact.end for contact in solution.contacts[:JOLTS]]
    sums = [[joint["impulse"] for joint in motion.reactions(end)] for end in ends]
    each = np.diff(np.array(sums).reshape(len(ends), -1, 2), axis=0, prepend=0.0)
    return np.hypot(each[..., 0], each[..., 1]).tolist()


def _reactions(motion: MovingMotion, name: str, stretch: Stretch) -> dict[str, Any]:
    """Force along x and y and moment of every joint, (instants, joints, 3), without the impacts."""
    steps, joints = _amid_steps(motion.time, stretch), len(motion.mechanism.joints)
    if not joints:
        return {}
    forces = motion.reaction_forces(steps.ravel()).reshape(*steps.shape, joints, 3).mean(axis=1)
    time, reactions = ("reactionTime", "reactions") if not name else (f"{name}ReactionTime", f"{name}Reactions")
    return {time: steps.mean(axis=1), reactions: whole_numbers(forces)}


def _energies(motion: MovingMotion, scene: Scene, stretch: Stretch) -> tuple[list[str], dict[str, Any]]:
    """Parts of the energy that there ever are, and the same over time (instants, parts) [J]."""
    ever = _parts(motion, scene, _amid_steps(motion.time, None).mean(axis=1))
    names = [name for name, values in ever.items() if np.abs(values).max() > 0.0]
    time = _amid_steps(motion.time, stretch).mean(axis=1)
    parts = _parts(motion, scene, time) if stretch else ever
    return names, {
        "energyTime": time,
        "energies": whole_numbers(np.stack([parts[name] for name in names], axis=1)),
    }


def _parts(motion: MovingMotion, scene: Scene, time: np.ndarray) -> dict[str, np.ndarray]:
    """Of the energy [J]. What the mass gains as it falls counts to it, as nothing comes of it but its own flight."""
    energies = motion.energies(time)
    fallen = (motion.impactor_places(time) - motion.impactor_places(motion.time[:1])) @ motion.mechanism.system.gravity
    height = -scene.impactor.mass * fallen
    return {
        "impactor": energies["impactor"] + height,
        "links": energies["target_rigid"] + energies["target_vibration"],
        "weight": energies["weight"] - height,
        "springs": energies.get("springs", np.zeros(time.size)),
        "local": energies["local"],
        "drives": energies["drives"],
        "dissipated": energies["dissipated"],
    }


def _amid_steps(time: np.ndarray, stretch: Stretch) -> np.ndarray:
    """Middles of steps, over which reactions are averages, (instants, steps): of many some, spread evenly; all in a
    stretch that has few."""
    starts = np.flatnonzero(np.diff(time) > 0.0)
    if stretch:
        middles = 0.5 * (time[starts] + time[starts + 1])
        within = (middles >= stretch[0]) & (middles <= stretch[1])
        starts = starts[within if within.any() else [np.abs(middles - stretch[0]).argmin()]]
    instants = min(HISTORY, starts.size)
    each = min(MOST_AVERAGED, starts.size // instants)
    chosen = starts[np.linspace(0, starts.size - 1, instants * each).round().astype(int)]
    return 0.5 * (time[chosen] + time[chosen + 1]).reshape(instants, each)
