"""The table `[contact]` of a scene: its law, those of the joints of a chain, and how bodies in space meet."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from . import validation
from .bodies import AnyBody, Balls, Body, Rods, Wall, check_struck, read_normal
from .contact import LAWS, check_law
from .contact.friction import read_friction
from .contact.protocol import Law
from .validation import SceneError, allowed

IN_SPACE = ("normal", "friction")  # keys of a contact between bodies in space


def read_contact_normal(impactor: AnyBody, target: AnyBody, contact: object) -> tuple[Any, float | None]:
    """The normal and the friction of bodies in space, which meet each other or a stop only; None on an axis."""
    if not isinstance(impactor, Body) and not isinstance(target, Body):
        return None, None
    if not isinstance(impactor, Body):
        raise SceneError("impactor.kind", impactor.kind, allowed("body-strikes"))
    if not isinstance(target, Body) and (not isinstance(target, Wall) or target.endless):
        raise SceneError("target.kind", target.kind, allowed("body-or-stop"))
    contact = validation.table("contact", {} if contact is None else contact, ("law", *IN_SPACE))
    given = validation.required("contact", contact, "normal", allowed("normal"))
    normal, friction = read_normal("contact.normal", given), read_friction(contact)
    check_struck("impactor", impactor, normal, bool(friction))
    check_struck("target", target, normal, bool(friction))
    return normal, friction


def read_law(key: str, given: object, impactor: AnyBody, target: AnyBody, spatial: bool = False) -> Law:
    """The contact law of two bodies from a table with the key law; bodies in space meet in one impulse."""
    if not isinstance(given, Mapping):
        raise SceneError(key, given, allowed("law-table"))
    law: Any = LAWS[validation.choice(f"{key}.law", given.get("law", "rigid"), ("rigid",) if spatial else LAWS)]
    check_law(law, f"{key}.law")
    validation.table(key, given, ("law", *law.KEYS, *(IN_SPACE if spatial else ())))
    try:
        return law.read(given, impactor, target)
    except SceneError as refused:  # laws name their keys as those of the impactor's contact
        name = refused.key.removeprefix("contact.")
        raise refused if name == refused.key else SceneError(f"{key}.{name}", refused.value, refused.reason) from None


def read_joint_laws(impactor: AnyBody, target: AnyBody, contact: object) -> tuple[Law | None, ...]:
    """Of a chain; where a law's constants depend on the speed of approach, that of the impact is taken.

    Between balls it is that of the contact, with constants of their own where they follow from radii and materials.
    """
    if isinstance(target, Balls):
        coming = [replace(ball, velocity=impactor.velocity) for ball in target.balls]
        return tuple(
            read_law("contact", contact, front, behind)
            for front, behind in zip(coming[:-1], target.balls[1:], strict=True)
        )
    return chain_laws("target", target, impactor.velocity - target.velocity) if target.rods else ()


def chain_laws(key: str, chain: AnyBody, speed: float) -> tuple[Law | None, ...]:
    """Of the joints of a chain of rods; `speed` [m/s]: of the approach that laws may hang on."""
    if not isinstance(chain, Rods):
        return ()
    coming = [replace(rod, velocity=rod.velocity + speed) for rod in chain.rods]
    pairs = zip(chain.joints, coming[:-1], chain.rods[1:], strict=True)
    return tuple(
        None if joint.bonded else read_law(f"{key}.rods[{number}].contact", joint.contact or {}, front, behind)
        for number, (joint, front, behind) in enumerate(pairs, 2)
    )
