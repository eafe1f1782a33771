"""How long the bodies touch: apparent and real, beside the swing of the struck body and the blow on a half-space."""

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from .contact import Rigid
from .method import SceneNotSupported
from .methods import Modal
from .scene import Scene
from .solution import Solution, apparent_time

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
    told: str

    def table(self) -> dict[str, Any]:
        return asdict(self)


def contact_times(solution: Solution) -> ContactTimes:
    """Apparent and real contact time, and the half period of the struck body with the impactor's mass attached.

    Source: thesis 5.5, 8.3, 8.4.2. Differs: 8.4.2 compares with the half period of the free bar; it is that of the bar
    with the mass attached that the apparent time comes near.
    """
    contacts = solution.contacts
    apparent, real = apparent_time(contacts) or 0.0, sum(contact.end - contact.start for contact in contacts)
    with_mass, alone = half_periods(solution.scene)
    return ContactTimes(
        len(contacts), apparent, real, with_mass, alone, _told(len(contacts), apparent, real, with_mass)
    )


def half_periods(scene: Scene) -> tuple[float | None, float | None]:
    """Half the longest period of vibration of the struck body [s], with a rigid impactor attached and without.

    With the mass m attached the body's receptance at the contact is that of the mass with the sign turned,
    sum phi_i^2 / (omega_i^2 - omega^2) - 1 / (M omega^2) = 1 / (m omega^2); the modes left out bend as under a load at
    rest. Error: 1e-9, by what they do not.
    """
    target = scene.target
    if scene.normal is not None or scene.impactor.kind not in ("mass", "sphere") or target.kind == "rods":
        return None, None
    if (getattr(target, "end_mass", 0.0) and target.kind == "rod") or getattr(target, "support", None) == "anechoic":
        return None, None  # no modes of these are known
    modes = target.modes(MODES).felt()
    if not modes.frequencies.size:
        return None, None
    mobility = 1.0 / scene.impactor.mass + 1.0 / modes.rigid_mass
    squares, softness = modes.frequencies**2, modes.at_contact**2

    def balance(part: float) -> float:  # of omega^2, as a part of the lowest one without the mass; grows with it
        square = part * squares[0]
        return float(np.sum(softness / (squares - square))) + modes.residual_compliance - mobility / square

    from scipy.optimize import brentq  # here, as it costs a fifth of the time allowed for importing the library

    tiny = 1e-13
    part = brentq(balance, tiny, 1.0 - tiny, xtol=1e-16) if balance(tiny) < 0.0 < balance(1.0 - tiny) else math.nan
    lowest = math.pi / float(modes.frequencies[0])
    return (lowest / math.sqrt(part) if part > 0.0 else None), lowest


def _told(contacts: int, apparent: float, real: float, half_period: float | None) -> str:
    told = f"The bodies touch once, for {apparent:.4g} s."
    if contacts > 1:
        told = (
            f"The bodies touch {contacts} times within {apparent:.4g} s, {100.0 * real / apparent:.3g} % of that time."
        )
    if half_period is None:
        return told
    swings = apparent / half_period
    told += (
        f" That is {swings:.3g} times the half period of the struck body with the impactor's mass on it,"
        f" {half_period:.4g} s"
    )
    if swings < STUCK[0]:
        return told + ": the blow is over before the body as a whole has swung back."
    if contacts == 1 or swings > STUCK[1]:
        return told + "."
    return told + ": the two swing together as if stuck to each other, and part when the body has swung back."


def compare_with_half_space(scene: Scene) -> Solution:
    """The same impactor and contact law on a half-space of the target's material: what the contact alone would do.

    Beside the scene's own solution it tells how much of the blow is local. Source: thesis 8.4.4.
    """
    if isinstance(scene.contact, Rigid):
        raise SceneNotSupported("contact.law", "rigid", "a law that gives way: nothing else does on a half-space")
    if scene.impactor.kind not in ("mass", "sphere") or not hasattr(scene.target, "material"):
        raise SceneNotSupported("impactor.kind", scene.impactor.kind, "a rigid impactor on a body of some material")
    material, radius = scene.target.material, scene.target.radius
    target: dict[str, object] = {"kind": "half-space", "material": material.table()}
    beside = Scene.from_table(
        {
            "title": f"The same blow on a half-space: {scene.title}"[:300],
            "impactor": scene.impactor.table() | {"velocity": scene.speed},
            "target": target | ({} if radius is None else {"radius": radius}),
            "contact": {"law": scene.contact.NAME} | scene.contact.table(scene.speed),
        }
    )
    return Modal(estimate=False).solve(beside)
