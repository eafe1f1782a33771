"""How a mechanism moves before it is struck, where its drives do not say it."""

from ..bodies import Mechanism
from ..numerics.multibody.system import PRISMATIC
from ..text.notes import Note, Severity


def note_on_start(mechanism: Mechanism) -> list[Note]:
    """What is assumed of the motion before the impact, where drives leave it open."""
    found = mechanism.open_start
    if found is None:
        return []
    values = {"settled": found.settled, "freedoms": found.freedoms, "count": len(found.joints)}
    if found.joints:
        joint = mechanism.joints[found.joints[0]]
        values |= {"links": list(joint.links), "slides": joint.kind == PRISMATIC, "rate": found.rate}
        values |= {"joint": found.joints[0], "joints": [str(number) for number in found.joints]}
    return [Note("start-open", Severity.WARNING, **values)]
