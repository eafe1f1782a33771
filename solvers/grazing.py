"""Contacts of a rigid mass on a uniform rod, which are known exactly: which a method misses, which are slight."""

from collections.abc import Sequence

import numpy as np

from .numerics import rigid_waves
from .scene import Scene
from .solution import ContactPeriod

NEAR = 0.03  # relative change of the mass that counts as little
PIECES, TERMS = (64, 400), 40  # of a history; blows that need more are far from simple, and not asked
HALVINGS, TOLD = 40, 1e-3  # of the change of the mass: the sentence gives two digits of it
TOO_SOON = 0.05  # round trips before the end of the time solved in which a contact is not missed
SLIGHT = 1e-4  # of the impulse: what is no contact worth a word


def grazing_note(beta: float, reflection: float) -> str | None:
    """The sentence for a rigid mass on a uniform rod of mass ratio `beta`, target over impactor, or None.

    Source: thesis 4.5: at mass ratio 1 the second contact of the fixed rod is but 1 % from being lost.
    """
    here = _count(beta, reflection)
    edges = [_edge(beta, reflection, here, 1.0 + way * NEAR) for way in (1.0, -1.0)]
    edges = [edge for edge in edges if edge is not None]
    if here is None or not edges:
        return None
    factor, there = min(edges, key=lambda edge: abs(edge[0] - 1.0))
    change = 100.0 * abs(factor - 1.0)
    way = "heavier" if factor > 1.0 else "lighter"
    contacts = "one contact" if there == 1 else f"{there} contacts"
    return (
        f"Near grazing: with the mass {change:.2g} % {way} there would be {contacts} instead of {here}. A method that "
        "is not exact may miss one or add one: trust rebound and impulse, not the count."
    )


def miscounted(scene: Scene, contacts: Sequence[ContactPeriod], duration: float, remedy: str) -> str | None:
    """What the exact waves say of these contacts, if it is another number, in a sentence with cause and remedy."""
    if not one_front(scene):
        return None
    true = _contacts(scene.mass_ratio, 1.0 if scene.target.fixed else -1.0)
    if true is None:
        return None
    trip, shares = scene.time_unit, (true[:, 2] - true[:, 3]) / (true[0, 2] - true[-1, 3])
    told = (shares > SLIGHT) & (true[:, 0] < duration / trip - TOO_SOON)
    true, shares = true[told], shares[told]
    found = np.array([[contact.start, contact.end] for contact in contacts]) / trip
    if len(found) == len(true):
        return None
    if len(found) < len(true):
        gaps = np.abs(true[:, 0, None] - found[None, :, 0]).min(axis=1)
        missed = int(np.argmax(gaps))
        return (
            f"Missed re-contact: exact waves touch again from {true[missed, 0]:.4g} to {true[missed, 1]:.4g} round "
            f"trips, with {100.0 * shares[missed]:.2g} % of the impulse. {remedy}"
        )
    apart = np.array([np.abs(true[:, 1] - end).min() for end in found[:-1, 1]])
    return (
        f"False separation: the contact breaks off at {found[int(np.argmax(apart)), 1]:.4g} round trips, where exact "
        f"waves hold it: {len(found)} contacts instead of {len(true)}. {remedy}"
    )


def one_front(scene: Scene) -> bool:
    """Whether this is St. Venant's problem: a rigid mass against one rod at rest, rigid contact."""
    rod = scene.target
    return (
        scene.normal is None
        and scene.impactor.kind in ("mass", "sphere")
        and rod.kind == "rod"
        and scene.contact.NAME == "rigid"
        and rod.support != "anechoic"
        and rod.velocity == rod.end_mass == 0.0
    )


def _contacts(beta: float, reflection: float) -> np.ndarray | None:
    """Of each contact start, end, velocity before and after, and more; None if the blow is far from simple."""
    for pieces in PIECES:
        status, *_, contacts = rigid_waves.strike(beta, reflection, rigid_waves.FOREVER, pieces, TERMS, pieces)
        if status == rigid_waves.PARTED:
            return contacts
    return None


def _count(beta: float, reflection: float) -> int | None:
    contacts = _contacts(beta, reflection)
    return None if contacts is None else contacts.shape[0]


def _edge(beta: float, reflection: float, here: int | None, far: float) -> tuple[float, int] | None:
    """By what the mass must be multiplied, between 1 and `far`, for another number of contacts, and that number."""
    there = _count(beta / far, reflection)
    if there is None or there == here:
        return None
    near = 1.0
    for _ in range(HALVINGS):
        if abs(far - near) <= TOLD * abs(far - 1.0):
            break
        middle = 0.5 * (near + far)
        found = _count(beta / middle, reflection)
        near, far, there = (middle, far, there) if found == here else (near, middle, found)
    return far, there
