"""Contacts of a rigid mass on a uniform rod, which are known exactly: which a method misses, which are slight."""

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from ..bodies import Rod
from ..numerics.waves import rigid as rigid_waves
from ..numerics.waves.contact_table import ContactTable
from ..scene import Scene
from ..solution.solution import ContactPeriod
from ..text.notes import Note, Severity

NEAR_MASS = 0.03  # relative change of the mass within which another number of contacts is worth a note
HISTORY_PIECES, HISTORY_TERMS = (64, 400), 40  # of a history; impacts that need more are far from simple, and not asked
HALVINGS, EDGE_TOLERANCE = 40, 1e-3  # of the change of the mass: the note gives two digits of it
END_MARGIN = 0.05  # round trips before the end of the time solved; a contact that begins within is not missed
# Share of the whole impulse: slighter contacts are not reported as missed. Larger, and a method may drop a contact that
# is seen; see `tests/solvers/methods/test_grazing.py`.
MIN_REPORTED_IMPULSE = 1e-4


@lru_cache
def grazing_note(beta: float, reflection: float) -> Note | None:
    """The note for a rigid mass on a uniform rod of mass ratio `beta`, target over impactor, or None.

    Source: thesis 4.5: at mass ratio 1 the second contact of the fixed rod is but 1 % from being lost.
    """
    here = _count(beta, reflection)
    edges = [_edge(beta, reflection, here, 1.0 + way * NEAR_MASS) for way in (1.0, -1.0)]
    edges = [edge for edge in edges if edge is not None]
    if here is None or not edges:
        return None
    factor, there = min(edges, key=lambda edge: abs(edge[0] - 1.0))
    change = 100.0 * abs(factor - 1.0)
    return Note("near-grazing", Severity.WARNING, change=change, heavier=factor > 1.0, others=there, contacts=here)


def miscounted(scene: Scene, contacts: Sequence[ContactPeriod], duration: float, cause: str) -> Note | None:
    """What the exact waves say of these contacts, if it is another number; on the cause depends the remedy."""
    if not one_front(scene):
        return None
    true = _contacts(scene.mass_ratio, 1.0 if scene.target.fixed else -1.0)
    if true is None:
        return None
    trip, shares = scene.time_unit, true.impulse_share
    counts = (shares > MIN_REPORTED_IMPULSE) & (true.start < duration / trip - END_MARGIN)
    found = np.array([[contact.start, contact.end] for contact in contacts]) / trip
    begun = np.count_nonzero(true.start < duration / trip)
    if np.count_nonzero(counts) <= len(found) <= begun:  # who finds the slight ones too is right
        return None
    true, shares = true.at(counts), shares[counts]
    if len(found) < true.count:
        gaps = np.abs(true.start[:, None] - found[None, :, 0]).min(axis=1)
        missed = int(np.argmax(gaps))
        start, end, impulse = true.start[missed], true.end[missed], 100.0 * shares[missed]
        return Note("contact-missed", Severity.WARNING, start=start, end=end, impulse=impulse, cause=cause)
    apart = np.array([np.abs(true.end - end).min() for end in found[:-1, 1]])
    end = found[int(np.argmax(apart)), 1]
    return Note("contact-broken", Severity.WARNING, end=end, contacts=len(found), true=true.count, cause=cause)


def one_front(scene: Scene) -> bool:
    """Whether this is St. Venant's problem: a rigid mass against one rod at rest, rigid contact, without weight."""
    rod = scene.target
    return (
        scene.normal is None
        and scene.impactor.free_mass
        and isinstance(rod, Rod)
        and scene.rigid_contact
        and rod.support != "anechoic"
        and rod.velocity == rod.end_mass == scene.weight_acceleration == 0.0
    )


@lru_cache
def _contacts(beta: float, reflection: float) -> ContactTable[np.ndarray] | None:
    """None if the impact is far from simple."""
    for pieces in HISTORY_PIECES:
        sent = rigid_waves.Pieces.of(pieces, HISTORY_TERMS, pieces)
        status, _, count = rigid_waves.strike(beta, reflection, rigid_waves.FOREVER, sent)
        if status == rigid_waves.PARTED:
            return ContactTable.of(sent.contacts[:count])
    return None


def _count(beta: float, reflection: float) -> int | Any:
    contacts = _contacts(beta, reflection)
    return None if contacts is None else contacts.count


def _edge(beta: float, reflection: float, here: int | None, far: float) -> tuple[float, int] | None:
    """By what the mass must be multiplied, between 1 and `far`, for another number of contacts, and that number."""
    there = _count(beta / far, reflection)
    if there is None or there == here:
        return None
    near = 1.0
    for _ in range(HALVINGS):
        if abs(far - near) <= EDGE_TOLERANCE * abs(far - 1.0):
            break
        middle = 0.5 * (near + far)
        found = _count(beta / middle, reflection)
        near, far, there = (middle, far, there) if found == here else (near, middle, found)
    return far, there
