"""Dry friction between two bodies: Coulomb's coefficient, one for sticking and sliding, and what goes with it."""

from collections.abc import Mapping

from .. import validation

LARGEST_FRICTION = 1e6  # beyond some tens no contact is known; so rough a one never slides
MODELS = ("stronge", "poisson", "newton")  # of restitution: by energy, by impulses, by velocities
SLIDING = ("slip", "stick", "reversal")


def read_friction(given: Mapping[str, object]) -> float | None:
    """The coefficient from the table `[contact]`; None without one. Raises SceneError naming the key."""
    if "friction" not in given:
        return None
    return validation.number("contact.friction", given["friction"], 0.0, LARGEST_FRICTION)
