"""What friction adds to an impulse between bodies in space: how they slide, what is restored, by each model."""

from typing import Any

import numpy as np

from ...bodies import in_space
from ...contact.friction import MODELS, SLIDING
from ...numerics.rigid.friction import Rubbed, jamming_friction, rub
from ...numerics.rigid.impulses import point_velocity
from ...numerics.rigid.sliding import STICK
from ...scene import Scene
from ...solution.solution import Sliding, final
from ...text.notes import Note, Severity

MADE = 1e-9  # of the energy before: so much more of it after an impact is no rounding


def rubbed(scene: Scene, restitution: float) -> dict[str, Rubbed]:
    """The impulse by each model of restitution."""
    before, normal = (in_space(scene.impactor), in_space(scene.target)), np.array(scene.normal)
    return {
        model: rub(*before, normal, float(scene.friction or 0.0), restitution, law) for law, model in enumerate(MODELS)
    }


def restored(scene: Scene, found: Rubbed) -> dict[str, float | None]:
    """Restitution by velocities of the centres of mass and of the touching points, by impulses and by work.

    They agree where nothing slides, or friction and the normal do not feel each other; None without an impact, and of
    velocities without an approach.
    """
    names = ("newton", "poisson", "newton_at_contact", "energetic")
    normal = np.array(scene.normal)
    impulse = float(found.impulse @ normal)
    if not impulse > 0.0:
        return dict.fromkeys(names)
    closing = float(normal @ (in_space(scene.impactor).velocity - in_space(scene.target).velocity))
    parting = float(normal @ (found.second.velocity - found.first.velocity))
    at_contact = float(normal @ (point_velocity(found.second) - point_velocity(found.first)))
    by_course = np.isfinite(found.compression)  # by Newton's law there is none
    return {
        "newton": parting / closing if closing > 0.0 else None,
        "poisson": impulse / float(found.compression) - 1.0 if by_course else None,
        "newton_at_contact": at_contact / float(found.approach) if found.approach > 0.0 else None,
        "energetic": float(np.sqrt(found.restored / found.compressed)) if by_course else None,
    }


def sliding(scene: Scene, found: Rubbed) -> list[Sliding]:
    """How the bodies slide, up to which normal impulse [N s]."""
    impulse, stopped = float(found.impulse @ np.array(scene.normal)), float(found.stopped)
    if not impulse > 0.0:
        return []
    if 0.0 < stopped < impulse:
        return [Sliding("slip", stopped), Sliding(SLIDING[int(found.follows)], impulse)]
    sticks = stopped == 0.0 and found.follows == STICK
    return [Sliding("stick" if sticks else "slip", impulse)]


def models(scene: Scene, by_model: dict[str, Rubbed]) -> dict[str, dict[str, Any]]:
    """What each model of restitution gives: impulse, velocities, restitution and losses."""
    return {
        model: {
            "impulse": found.impulse.tolist(),
            "impactor": final(found.first.velocity.tolist(), found.first.spin.tolist()),
            "target": final(found.second.velocity.tolist(), found.second.spin.tolist()),
            "restitution": restored(scene, found),
            "energy": {"dissipated": float(found.lost), "friction": float(found.rubbed)},
        }
        for model, found in by_model.items()
    }


def rubbing_notes(scene: Scene, by_model: dict[str, Rubbed], model: str) -> list[Note]:
    """Where a model makes energy, the chosen one or another, or its normal force does; and where friction jams."""
    notes = []
    for name, found in by_model.items():
        made = -float(found.lost + found.rubbed)
        if made > MADE * scene.initial_energy:
            severity = Severity.WARNING if name == model else Severity.REMARK
            share, chosen = made / scene.initial_energy, name == model
            notes.append(Note("friction-makes-energy", severity, model=name, energy=made, share=share, chosen=chosen))
        elif name == model and -found.lost > MADE * scene.initial_energy:
            share = -float(found.lost) / scene.initial_energy
            notes.append(Note("normal-force-makes-energy", Severity.WARNING, model=name, share=share))
    return notes + _jamming_notes(scene, by_model[model])


def _jamming_notes(scene: Scene, found: Rubbed) -> list[Note]:
    """Above which friction it jams, and what that makes of bodies that do not approach."""
    least = float(jamming_friction(in_space(scene.impactor), in_space(scene.target), np.array(scene.normal)))
    if found.approach > 0.0:
        above = least if least < np.inf else None  # else it jams once the sliding has turned
        return [Note("friction-jams", Severity.REMARK, least=above, friction=scene.friction)] if found.jams else []
    if found.approach < 0.0:
        return []
    if found.impulse.any():
        return [Note("impact-without-approach", Severity.WARNING, friction=least)]
    return [Note("slides-on", Severity.REMARK, friction=least)] if float(scene.friction or 0.0) < least < np.inf else []
