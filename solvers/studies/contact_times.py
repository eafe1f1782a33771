"""How long the bodies touch: apparent and real, beside the swing of the struck body and the impact on a half-space."""

import math
from dataclasses import asdict, dataclass
from typing import Any

from ..methods import Modal
from ..methods.base import SceneNotSupported
from ..numerics.modes import half_period
from ..scene import Scene
from ..scenes.library import SceneOrName, scene_of
from ..solution.solution import Solution, apparent_time
from ..text.notes import Note, Severity
from ..validation import allowed

MODES = 200  # from which the half period with the mass attached is worked out
STUCK = 0.7, 1.3  # half periods from first touch to last parting: the impactor swings with the body as if stuck to it


@dataclass(frozen=True)
class ContactTimes:
    """All in seconds; `half_period` of the struck body with the impactor's mass on it, None where nothing swings."""

    contacts: int
    apparent: float  # from first touch to last parting
    real: float  # the sum of all contacts
    half_period: float | None
    half_period_alone: float | None  # of the struck body without the mass
    summary: Note

    def table(self) -> dict[str, Any]:
        words = {"summary": str(self.summary), "told": str(self.summary), "summary_code": self.summary.table()}
        return asdict(self) | words


def contact_times(solution: Solution) -> ContactTimes:
    """Apparent and real contact time, and the half period of the struck body with the impactor's mass attached.

    Source: thesis 5.5, 8.3, 8.4.2. Differs: 8.4.2 compares with the half period of the free bar; it is that of the bar
    with the mass attached that the apparent time comes near.
    """
    contacts = solution.contacts
    apparent, real = apparent_time(contacts) or 0.0, solution.contact_time
    with_mass, alone = half_periods(solution.scene.at_contact)
    return ContactTimes(
        len(contacts), apparent, real, with_mass, alone, _summary(len(contacts), apparent, real, with_mass)
    )


def half_periods(scene: Scene) -> tuple[float | None, float | None]:
    """Half the longest period of vibration of the struck body [s], with a rigid impactor attached and without.

    Source: see `numerics.modes.half_period`. Error: 1e-9, by what the modes left out do not bend.
    """
    target = scene.target
    if scene.normal is not None or not scene.impactor.free_mass or target.no_modes:
        return None, None
    modes = target.modes(MODES).excited()
    if not modes.frequencies.size:
        return None, None
    mobility = 1.0 / scene.impactor.mass + 1.0 / modes.rigid_mass
    with_mass = half_period(modes.frequencies, modes.at_contact, modes.residual_compliance, mobility)
    return (with_mass if with_mass > 0.0 else None), math.pi / float(modes.frequencies[0])


def _summary(contacts: int, apparent: float, real: float, half_period: float | None) -> Note:
    values: dict[str, Any] = {"contacts": contacts, "apparent": apparent, "share": 100.0 * real / (apparent or 1.0)}
    if half_period is None:
        return Note("contact-times", Severity.REMARK, **values, swings=None, half_period=None, case="none")
    swings = apparent / half_period
    case = "plain" if contacts == 1 or swings > STUCK[1] else "stuck"
    case = "before" if swings < STUCK[0] else case
    return Note("contact-times", Severity.REMARK, **values, swings=swings, half_period=half_period, case=case)


def compare_with_half_space(scene: SceneOrName) -> Solution:
    """The same impactor and contact law on a half-space of the target's material: what the contact alone would do.

    Beside the scene's own solution it shows how much of the impact is local. Source: thesis 8.4.4.
    """
    scene = scene_of(scene)
    if scene.rigid_contact:
        raise SceneNotSupported("contact.law", "rigid", allowed("yielding-law"))
    if not scene.impactor.free_mass or scene.target.material is None:
        raise SceneNotSupported("impactor.kind", scene.impactor.kind, allowed("rigid-impactor"))
    material, radius = scene.target.material, scene.target.radius
    target: dict[str, Any] = {"kind": "half-space", "material": material.table()}
    beside = Scene.from_table(
        {
            "title": f"The same impact on a half-space: {scene.title}"[:300],
            "impactor": scene.impactor.table() | scene.impactor.of_velocity(scene.speed),
            "target": target | ({} if radius is None else {"radius": radius}),
            "contact": {"law": scene.contact.NAME} | scene.contact.table(scene.speed),
        }
    )
    return Modal(estimate=False).solve(beside)
