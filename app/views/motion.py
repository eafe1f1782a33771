"""A mechanism that moves on after the impact, for the page: where its links go, through as many impacts as come."""

import json
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import param

from solvers import Scene, Solution
from solvers.methods.multibody.method import Multibody
from solvers.methods.multibody.motion import MovingMotion
from solvers.text.notes import Note

from ..choices.mechanism import on_mechanism
from ..choices.questions import Question
from ..choices.request import Request
from ..choices.scene_of import base_of
from ..messages.mechanism import described, mechanism_of, with_rigid_links

LONGEST = 20.0  # [s] that can be asked for
INSTANTS, HISTORY = 361, 241  # of the picture, besides impacts; of reactions and energies
BENT_INSTANTS, BENT_PARTS = 121, 6  # of the picture of links that bend; straight pieces of each
MOST_AVERAGED = 8  # steps, of the reactions of one instant: in vibrations each differs from the next
MOST_RIGID_STEPS = 50_000  # which take some three seconds
MOST_STEPS = 10_000  # of links that bend, which take some two seconds; for longer they are followed as rigid ones
MOST_CONTACT_STEPS = {False: 20_000, True: 6_000}  # of links that are rigid, and of such as bend: some three seconds
IMPACTS = 100  # told one by one
JOLTS = 8  # of these, the first of which it is told what every joint gets
LINKS = "flexible", "rigid"  # as which links that bend are followed
QUESTIONS = {
    "motion_seconds": Question(
        param.Number(default=0.0, bounds=(0.0, LONGEST), doc="for which it is followed; 0: as the scene says"),
        "seconds",
    ),
    "motion_links": Question(param.Selector(default=LINKS[0], objects=list(LINKS)), "links"),
}


def of_mechanisms(asked: dict[str, Any]) -> tuple | None:
    """All that was asked, if a mechanism is struck; else None."""
    try:
        return tuple(asked.items()) if on_mechanism(base_of(asked["scene"], asked["bodies"])) else None
    except ValueError:  # which the visitor sees where it is solved
        return None


def motion_data(asked: dict[str, Any]) -> str:
    """The motion as JSON: `chosen`, which is all that was asked, picture, impacts, histories and figures; or `error`,
    a sentence, or `refused`, a note, why there is none.

    `rigid`: why links that bend are followed as rigid ones, or None; `cut`: whether they would be for longer, if that
    took no more than `MOST_RIGID_STEPS`. Times in ms, else SI units.
    """
    answer: dict[str, Any] = {"chosen": asked}
    try:
        solution, note, cut = followed(asked)
        told = note and note.table()
        answer |= {"refused": told} if solution is None else {"rigid": told, "cut": cut} | _told(solution)
    except ValueError as refusal:  # SceneError
        answer["error"] = str(refusal)
    return json.dumps(answer, allow_nan=False)


class Followed(NamedTuple):
    """The motion, or None; why there is none, or why links that bend are taken as rigid; whether it was cut short."""

    solution: Solution | None
    note: Note | None
    cut: bool = False


def followed(asked: dict[str, Any]) -> Followed:
    """The motion for as long as is asked, or as the scene says."""
    request = Request.of(asked)
    scene, method = request.scene, Multibody(restitution=restitution_of(request))
    seconds = asked["motion_seconds"] or scene.method.get("duration")
    mechanism, reason = mechanism_of(scene), method.refusal(scene)
    if mechanism is not None and mechanism.flexible:
        if asked["motion_links"] == "rigid":
            scene = with_rigid_links(scene)
        else:
            reason = reason or method.too_long(scene, seconds, MOST_STEPS)
            scene = with_rigid_links(scene) if reason else scene
    refusal = method.refusal(scene)
    if refusal:
        return Followed(None, refusal)
    method = replace(method, most_contact_steps=MOST_CONTACT_STEPS[scene.target.bends])
    reached = method.reach(scene, MOST_RIGID_STEPS)
    cut = seconds is not None and seconds > reached
    return Followed(method.solve(scene, reached if cut else seconds), reason, cut)


def restitution_of(request: Request) -> float:
    """That of the slider, where the page has it and impacts are impulses; else nothing is lost by it."""
    given = request.scene.rigid_contact and "restitution" in request.acting
    return request.restitution if given else Multibody.restitution


def _told(solution: Solution) -> dict[str, Any]:
    motion, scene = solution.known_motion, solution.scene
    assert isinstance(motion, MovingMotion)
    return {
        "mechanism": described(motion.mechanism),
        "impactor": {"kind": scene.impactor.kind, "mass": scene.impactor.mass},
        "restitution": solution.method["restitution"] if scene.rigid_contact else None,
        "duration": 1e3 * solution.duration,
        "contacts": len(solution.contacts),
        "impacts": [[1e3 * c.start, 1e3 * c.end, c.impulse] for c in solution.contacts[:IMPACTS]],
        "jolts": _jolts(motion, solution),
        "parting": _parting(solution, motion.mechanism.flexible),
        "figures": {
            name: solution.diagnostics[name] for name in ("energy_drift", "constraint_error", "estimated_error")
        },
        "notes": [note.table() for note in solution.notes],
        **_picture(motion, solution),
        **_histories(motion, scene),
    }


def _parting(solution: Solution, flexible: bool) -> dict[str, Any]:
    """What the stage shows, too: impulse [N s] and velocity of the mass along the normal [m/s] after the first impact;
    of links that bend after all, as they are what one impact is."""
    if flexible:
        return {
            "impulse": solution.impulse,
            "velocity": solution.impactor_velocity,
            "contacts": len(solution.contacts),
            "all": True,
        }
    impulse, mass = solution.contacts[0].impulse, solution.scene.impactor.mass
    velocity = solution.scene.impactor.velocity - impulse / mass
    return {"impulse": impulse, "velocity": velocity, "contacts": 1, "all": False}


def _jolts(motion: MovingMotion, solution: Solution) -> list[list[float]]:
    """Size of the impulse at every joint in the first impacts [N s], (impacts, joints)."""
    ends = [contact.end for contact in solution.contacts[:JOLTS]]
    sums = [[joint["impulse"] for joint in motion.reactions(end)] for end in ends]
    each = np.diff(np.array(sums).reshape(len(ends), -1, 2), axis=0, prepend=0.0)
    return [_listed(row) for row in np.hypot(each[..., 0], each[..., 1])]


def _picture(motion: MovingMotion, solution: Solution) -> dict[str, Any]:
    """`places` (instants, links, points from end to end, x and y), those of the mass, and `normals` as contacts begin
    and end."""
    ends = [edge for contact in solution.contacts[:IMPACTS] for edge in (contact.start, contact.end)]
    mechanism = motion.mechanism
    instants, parts = (BENT_INSTANTS, BENT_PARTS) if mechanism.flexible else (INSTANTS, 1)
    time = np.unique([*np.linspace(0.0, solution.duration, instants), *ends])
    links = motion.link_points(time, parts)
    places = np.stack([links[link.name] for link in mechanism.links], axis=1)
    turned = _turned(links[mechanism.struck.link], mechanism.struck.at)[np.searchsorted(time, ends)]
    x, y = mechanism.struck.normal
    return {
        "time": _listed(1e3 * time),
        "places": _listed(places.ravel()),
        "mass_places": _listed(motion.impactor_places(time).ravel()),
        "normals": {"time": _listed(1e3 * np.array(ends)), "angle": _listed(np.arctan2(y, x) + turned)},
    }


def _turned(places: np.ndarray, at: float) -> np.ndarray:
    """Turn of a link where it is struck [rad], (instants,), from places along it (instants, places, 2)."""
    piece = min(int(at * (places.shape[1] - 1)), places.shape[1] - 2)
    along = places[:, piece + 1] - places[:, piece]
    angle = np.unwrap(np.arctan2(along[:, 1], along[:, 0]))
    return angle - angle[0]


def _histories(motion: MovingMotion, scene: Scene) -> dict[str, Any]:
    """Reactions (instants, joints, force along x and y and moment), and parts of the energy over time [J].

    What the mass gains as it falls counts to it, as nothing comes of it but its own flight.
    """
    steps, joints = _amid_steps(motion.time), len(motion.mechanism.joints)
    time, forces = steps.mean(axis=1), np.zeros((len(steps), 0, 3))
    if joints:
        forces = motion.reaction_forces(steps.ravel()).reshape(*steps.shape, joints, 3).mean(axis=1)
    energies = motion.energies(time)
    fallen = (motion.impactor_places(time) - motion.impactor_places(time[:1])) @ motion.mechanism.system.gravity
    height = -scene.impactor.mass * fallen
    parts = {
        "impactor": energies["impactor"] + height,
        "links": energies["target_rigid"] + energies["target_vibration"],
        "weight": energies["weight"] - height,
        "springs": energies.get("springs", np.zeros(time.size)),
        "drives": energies["drives"],
        "dissipated": energies["dissipated"],
    }
    kept = {name: _listed(values) for name, values in parts.items() if np.abs(values).max() > 0.0}
    return {
        "history_time": _listed(1e3 * time),
        "reactions": _listed(forces.ravel()),
        "energies": kept,
    }


def _amid_steps(time: np.ndarray) -> np.ndarray:
    """Middles of steps, over which reactions are averages, (instants, steps): of many some, spread evenly."""
    starts = np.flatnonzero(np.diff(time) > 0.0)
    instants = min(HISTORY, starts.size)
    each = min(MOST_AVERAGED, starts.size // instants)
    chosen = starts[np.linspace(0, starts.size - 1, instants * each).round().astype(int)]
    return 0.5 * (time[chosen] + time[chosen + 1]).reshape(instants, each)


def _listed(values: np.ndarray) -> list[float]:
    return [float(f"{value:.5g}") for value in np.asarray(values).tolist()]
