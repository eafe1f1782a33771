"""What the browser draws of a mechanism in the impact, besides its struck link, which stands for a beam.

Links are drawn where they are as the impact begins, and by how much their points have moved since.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from solvers import Modal, RigidImpulse, Scene, Solution
from solvers.bodies import Mechanism
from solvers.bodies.linkage.joints import Joint
from solvers.methods.mechanisms import MechanismMotion
from solvers.methods.multibody.method import Multibody
from solvers.methods.multibody.motion import MovingMotion
from solvers.studies.scattering import between_bars

from ..encoding import Stretch, instants, whole_numbers
from .links import along_normal, instants_for, link_arrays

RIGID_LINKS = "rigid-links"  # name of the solution beside, where it is not that of its method
LINK_PLACES = 31  # of the struck link, beside which there are others
PARTS = 10  # straight pieces of a link that bends
INSTANTS = 75
REACTIONS = 200  # instants
REACTIONS_OF_ONE = 600  # where there is one joint alone, and balances shake all modes
AMOUNTS_BESIDE = 3_000  # numbers that tell of links beside the struck one


def mechanism_fields(
    solution: Solution, rigid: Solution | None, stretch: Stretch
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Header and arrays. `rigid`: the same with rigid links, if there is that."""
    motion = solution.known_motion
    assert isinstance(motion, MechanismMotion)
    time = instants(solution.duration, INSTANTS)
    links = motion.link_points(time, PARTS)
    places = np.stack([links[name] for name in motion.names], axis=1)  # (instants, links, places, 2)
    arrays: dict[str, Any] = {
        "linkPoints": places[0],
        "linkTime": time,
        "linkMoves": whole_numbers(places - places[0]),
    }
    if motion.mechanism.joints:
        alone = len(motion.mechanism.joints) == 1 and solution.scene.rigid_contact
        count = REACTIONS_OF_ONE if alone else REACTIONS
        fine = instants(solution.duration, count, stretch)
        arrays |= {"reactionTime": fine, "reactions": whole_numbers(motion.reaction_forces(fine))}
        if rigid is not None and isinstance(rigid.motion, MechanismMotion):
            forces = whole_numbers(rigid.motion.reaction_forces(fine))
            arrays |= {"referenceReactionTime": fine, "referenceReactions": forces}
    arrays |= _others(motion, solution.duration, stretch)
    return {"mechanism": described(motion.mechanism), "moving": None}, arrays


def _others(motion: MechanismMotion, duration: float, stretch: Stretch) -> dict[str, Any]:
    """How links that are not struck move along the normal, and bend."""
    mechanism, offsets = motion.mechanism, motion.mechanism.system.offsets
    bent = {
        number: along_normal(mechanism, number)
        for number, link in enumerate(mechanism.links)
        if link.flexible and link.name != mechanism.struck.link
    }
    if not bent:
        return {}
    shapes = sum(len(fields.shape) for fields in bent.values())
    count = instants_for(shapes, AMOUNTS_BESIDE)
    ever, time = motion.coordinates(instants(duration, count)), instants(duration, count, stretch)
    coordinates, found = motion.coordinates(time), {"bendTime": time}
    for number, fields in bent.items():
        own = slice(offsets[number], offsets[number + 1])
        found |= link_arrays(number, coordinates[:, own], fields, ever[:, own])
    return found


def described(mechanism: Mechanism) -> dict[str, Any]:
    """Links, joints and where it is struck, as the browser draws them."""
    driven, bars = {drive.joint for drive in mechanism.drives}, between_bars(mechanism)
    names = [link.name for link in mechanism.links]
    return {
        "links": [
            {
                "name": link.name,
                "flexible": link.flexible,
                "nodes": [node / link.length for node in link.nodes],
                "depth": 2.0 * link.section.half_depth if link.section and link.section.second_moment else 0.0,
            }
            for link in mechanism.links
        ],
        "joints": [
            _joint(mechanism, joint) | {"driven": number in driven, "scatters": number in bars}
            for number, joint in enumerate(mechanism.joints)
        ],
        "struck": names.index(mechanism.struck.link),
        "at": mechanism.struck.at,
        "contact": mechanism.contact_point.tolist(),
        "normal": list(mechanism.struck.normal),
        "mass": mechanism.mass,
    }


def _joint(mechanism: Mechanism, joint: Joint) -> dict[str, Any]:
    """A joint is drawn on the first of its links that is no ground."""
    names = [link.name for link in mechanism.links]
    number = next(names.index(name) for name in joint.links if name in names)
    link = mechanism.links[number]
    arm = np.array(joint.at) - np.array(link.start)
    return {
        "kind": joint.kind,
        "links": list(joint.links),
        "link": number,
        "share": float(arm @ link.along) / link.length if link.length else 0.0,
        "axis": list(joint.axis) if joint.axis is not None else None,
    }


def struck_link(mechanism: Mechanism) -> dict[str, Any]:
    """The struck link as the page tells of a beam."""
    link = mechanism.struck_link
    bends = link.section is not None and link.section.second_moment is not None
    material = link.material
    return {
        "length": link.length,
        "mass": mechanism.mass,
        "support": "joined",
        "theory": link.theory,
        "place": mechanism.struck.at * link.length,
        "halfDepth": link.section.half_depth if bends and link.section else 0.0,
        "secondMoment": link.section.second_moment if bends and link.section else 1.0,
        "endMass": 0.0,
        "held": mechanism.held,
        "speedLimit": math.sqrt(material.young / material.density) if material else 0.0,
    }


def rigid_answer(solution: Solution) -> Solution | None:
    """The same impact on the same mechanism with rigid links, if any of them bends."""
    if not solution.scene.target.known_as(Mechanism).flexible:
        return None
    scene = with_rigid_links(solution.scene)
    if isinstance(solution.motion, MovingMotion):
        return Multibody(restitution=solution.method["restitution"], estimate=False).solve(scene, solution.duration)
    method = Modal(estimate=False) if not scene.rigid_contact else RigidImpulse()
    return method.solve(scene, solution.duration)


def with_rigid_links(scene: Scene) -> Scene:
    """The scene with a mechanism of which no link bends."""
    return replace(scene, target=scene.target.known_as(Mechanism).with_rigid_links)
