"""Blows on the edge of one contact more or less: a little more or less mass, and it is gained or lost."""

from ..numerics import rigid_waves

NEAR = 0.03  # relative change of the mass that counts as little
PIECES, TERMS = 400, 40  # of a history; blows that need more are far from simple, and not asked
HALVINGS = 40


def grazing_note(beta: float, reflection: float) -> str | None:
    """The sentence for a rigid mass on a uniform rod of mass ratio `beta`, target over impactor, or None.

    Source: thesis 4.5: at mass ratio 1 the second contact of the fixed rod is but 1 % from being lost.
    """
    here = _contacts(beta, reflection)
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


def _contacts(beta: float, reflection: float) -> int | None:
    status, *_, contacts = rigid_waves.strike(beta, reflection, rigid_waves.FOREVER, PIECES, TERMS, PIECES)
    return contacts.shape[0] if status == rigid_waves.PARTED else None


def _edge(beta: float, reflection: float, here: int | None, far: float) -> tuple[float, int] | None:
    """By what the mass must be multiplied, between 1 and `far`, for another number of contacts, and that number."""
    there = _contacts(beta / far, reflection)
    if there is None or there == here:
        return None
    near = 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (near + far)
        found = _contacts(beta / middle, reflection)
        near, far, there = (middle, far, there) if found == here else (near, middle, found)
    return far, there
