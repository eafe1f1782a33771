"""What the browser needs of contact laws to answer other choices by itself: see app/wasm."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from solvers import LAWS, Balance, Modal, QuasiStatic, Rod, Scene, SceneError, Solution, Waves
from solvers.bodies import RigidMass, SpringMass, Wall
from solvers.contact import Hertz, Rigid
from solvers.contact.constants import STIFFNESS_RANGE
from solvers.contact.damping import OF_KERNELS
from solvers.contact.duration import exponent_of
from solvers.methods.springs import is_spring, spring_of

from ..choices.built_in import base_of
from ..choices.choices import Choices
from ..choices.kinds import own_options
from ..choices.laws import DEPTH, STIFFNESS, contact_table, law_choices
from .chain import chain_fields

DAMPED = 0.5  # a restitution at which it shows how damping grows
SINE = "hertz-sine"  # model of the quasi-static method
STRUCTURAL = "structural"  # model of the quasi-static method; others whose names begin so leave a mass out
SAME = 1e-9  # relative difference of constants that are the same but for rounding


def followed(scene: Scene, chosen: Mapping[str, Any], exact: Solution, other: Solution | None) -> dict[str, Any]:
    """What a browser needs of an impact along an axis, and of the method beside it, to follow other choices."""
    compact = laws_of_compact_bodies(scene, chosen, other)
    chain = chain_fields(scene, exact, other)
    alone = chain or (isinstance(scene.target, SpringMass) and scene.rigid_contact)  # no other law is followed
    laws = [_record(scene, scene.contact, {}, {}, Units(1.0, 1.0))] if alone else laws_of_a_rod(scene, chosen)
    return {
        "laws": compact or laws,
        "chain": chain,
        "compact": {"sine": other is not None and other.method["model"] == SINE} if compact else None,
        "springCarries": carried_by_spring(other),
    }


def laws_of_a_rod(scene: Scene, chosen: Mapping[str, Any]) -> list[dict[str, Any]]:
    """`law_fields` of a mass on a uniform rod; none for others."""
    target = scene.target
    if not isinstance(scene.impactor, RigidMass) or not isinstance(target, Rod):
        return []
    if target.support == "anechoic" or target.end_mass or target.velocity:
        return []
    if chosen["method"] not in (Waves.NAME, Modal.NAME, QuasiStatic.NAME, Balance.NAME):
        return []
    found = law_fields(scene, chosen, Units(scene.time_unit, target.impedance))
    if chosen["method"] == QuasiStatic.NAME and "model" not in own_options(scene, QuasiStatic.NAME):
        return [law for law in found if not law["constants"]]  # by others the rod bends no more as a spring
    return found


def laws_of_compact_bodies(scene: Scene, chosen: Mapping[str, Any], other: Solution | None) -> list[dict[str, Any]]:
    """`law_fields` of a mass on one at rest or on a wall, by laws that are no spring, in s, kg and the speed; none for
    others. The contact of a spring takes a whole number of steps: rounding decides whether one more.
    """
    target, known = scene.target, own_options(scene, QuasiStatic.NAME).keys() <= {"model"}
    if not isinstance(scene.impactor, RigidMass) or not isinstance(target, (RigidMass, Wall)) or target.velocity:
        return []
    if chosen["method"] != QuasiStatic.NAME or not known or other is None or "duration" in scene.method:
        return []
    sine = other.method["model"] == SINE
    closed = {Hertz.NAME} if sine else LAWS.keys()
    if scene.contact.NAME not in closed or exponent_of(scene.contact) == 1.0:
        return []
    found = law_fields(scene, chosen, Units(1.0, 1.0))
    return [law for law in found if law["name"] in closed and law["exponent"] != 1.0]


def carried_by_spring(other: Solution | None) -> float | None:
    """The share of the mass of a fixed rod that goes with its end, where the rod bends as a spring."""
    if other is None or other.method["name"] != QuasiStatic.NAME or not other.method["model"].startswith(STRUCTURAL):
        return None
    target = other.scene.target
    if not isinstance(other.scene.impactor, RigidMass) or not isinstance(target, Rod) or not is_spring(target):
        return None
    return spring_of(target).carried / target.mass if other.method["model"] == STRUCTURAL else 0.0


class Units(NamedTuple):
    """In which the browser has the constants of a law, besides the speed v of the impact."""

    time: float  # [s]
    impedance: float  # [kg/s], of forces


def law_fields(scene: Scene, chosen: Mapping[str, Any], units: Units) -> list[dict[str, Any]]:
    """Every contact law that can be chosen for a mass that strikes, the scene's own with its own constants.

    They are products of powers, so that what doubling does to them tells how they grow. A damping grows where it
    follows from a restitution, which stays. One that is found by integration is left out unless it acts.
    """
    impactor, target, own = scene.impactor, scene.target, scene.contact
    opened: Any = base_of(chosen["scene"], chosen["bodies"]).contact
    found = []
    for name, kind in LAWS.items():
        if name == own.NAME:
            found.append(_record(scene, own, scene.given.get("contact", {}), _table(chosen, name), units))
        elif not kind.LOSSY or kind.EXPONENT is not None:
            table = _table(chosen, name)
            try:
                law = kind.read(table, impactor, target)
            except SceneError:  # a choice that is not in view is beyond what this law takes
                continue
            if name != opened.NAME or _alike(law, opened):  # else the scene comes back to more than the choices say
                found.append(_record(scene, law, table, table, units))
    return found


def _table(chosen: Mapping[str, Any], name: str) -> dict[str, Any]:
    return contact_table({**chosen, "law": name})


def _record(scene: Scene, law: Any, given: Mapping[str, Any], table: dict[str, Any], units: Units) -> dict[str, Any]:
    """A law, `given` as it is and set by the table of the choices."""
    record: dict[str, Any] = {
        "name": law.NAME,
        "choices": law_choices(law.NAME),
        "damps": law.LOSSY,
        "yields": law.PLASTIC,
        "exponent": exponent_of(law),
        "nominal": law.nominal(scene.reduced_mass, scene.speed) if law.LOSSY else None,
        **{"constants": [], "bySpeed": [], "byMass": [], "byStiffness": [], "stiffness": None, "damping": None},
    }
    if isinstance(law, Rigid):
        return record
    kind, impactor, target = LAWS[law.NAME], scene.impactor.known_as(RigidMass), scene.target
    follows = law.LOSSY and {"restitution", "nominal_restitution"} & set(given)
    damped = dict(given) | (
        {"restitution": DAMPED} if "restitution" in given else {}
    )  # a damping of nought has no power

    def constants(times: float = 1.0, mass: float | None = None) -> list[float]:
        """Those at a speed so many times as high, or of another mass that strikes."""
        other = replace(impactor, velocity=target.velocity + times * scene.speed, mass=mass or impactor.mass)
        return _scaled(scene, kind.read(damped, other, target) if follows else law, times, units)

    heavy = target.mass if math.isfinite(target.mass) else impactor.mass
    felt_with_half = heavy / (2.0 if target.held else 3.0)
    record["constants"] = _scaled(scene, law, 1.0, units)
    record["bySpeed"] = _powers(constants(), constants(2.0))
    record["byMass"] = _powers(constants(mass=felt_with_half), constants(mass=heavy))
    set_by = _scaled(scene, kind.read(table, impactor, target), 1.0, units)
    if _alike(set_by, record["constants"]):
        other = table | ({"restitution": DAMPED} if "restitution" in table else {})
        usual, softer = (
            _scaled(scene, kind.read(other | {"stiffness": times * table["stiffness"]}, impactor, target), 1.0, units)
            for times in (1.0, 0.5)
        )
        record["byStiffness"] = _powers(softer, usual)
        record["stiffness"] = None if _capped(table, law) else STIFFNESS[law.NAME]
        if law.NAME in OF_KERNELS:
            place, (number_for, _) = law._fields.index("damping"), OF_KERNELS[law.NAME]
            record["damping"] = [place, usual[place] / number_for(DAMPED)]
    return record


def _alike(one: Sequence[float], other: Sequence[float]) -> bool:
    return all(math.isclose(a, b, rel_tol=SAME) for a, b in zip(one, other, strict=True))


def _capped(table: Mapping[str, Any], law: Any) -> bool:
    """Whether the stiffest that can be chosen is more than a scene may have."""
    name = STIFFNESS[law.NAME]
    most = Choices.param[name].bounds[1]
    if name == "force_at_depth":
        most /= DEPTH ** (law.EXPONENT or table["exponent"])
    return most > STIFFNESS_RANGE[1]


def _scaled(scene: Scene, law: Any, times: float, units: Units) -> list[float]:
    """Its constants, at a speed that is so many times as high."""
    speed = times * scene.speed
    return list(law.scaled(speed * units.time, speed, units.impedance * speed))


def _powers(before: list[float], after: list[float]) -> list[float]:
    return [math.log2(b / a) if a and b else 0.0 for a, b in zip(before, after, strict=True)]
