"""The choices that set the constants of a contact law, and the table of the law that they describe."""

from typing import Any

from solvers import LAWS, Scene
from solvers.contact.constants import STIFFNESS_RANGE
from solvers.contact.viscous import LEAST_RESTITUTION

from .choices import Choices

DEPTH = 1e-5  # [m] at which `force_at_depth` says how stiff a power law is: its stiffness has no unit of its own
OF_ANOTHER_NAME = ("stiffness", "restitution", "nominal_restitution", "damping")  # constants set by other choices
STIFFNESS = {  # by law: the choice that sets it, as its unit follows from the exponent
    name: {1.0: "linear_stiffness", 1.5: "hertz_stiffness"}.get(law.EXPONENT or 0.0, "force_at_depth")
    for name, law in LAWS.items()
    if "stiffness" in law.KEYS
}


def law_choices(law: str) -> list[str]:
    """The choices that set the constants of a contact law."""
    keys = LAWS[law].KEYS
    names = [STIFFNESS[law]] if "stiffness" in keys else []
    return names + _of_own_name(law)


def law_values(scene: Scene) -> dict[str, Any]:
    """The contact law of a scene, and what the sliders of the laws show for it."""
    law, found = scene.contact, {}
    if scene.target.softness and not scene.target.bends and len(scene.target.rods) < 2:
        found["linear_stiffness"] = float(f"{20.0 / scene.target.softness:.2g}")
    table = law.table(scene.speed)
    if "stiffness" in table:
        name = STIFFNESS[law.NAME]
        found[name] = table["stiffness"]
        if name == "force_at_depth":
            found[name] *= DEPTH ** (law.EXPONENT or table["exponent"])
    for name in (*_of_own_name(law.NAME), "restitution"):
        if name in table:
            found[name] = table[name]
    return {"law": law.NAME} | found


def contact_table(chosen: dict[str, Any]) -> dict[str, Any]:
    """The table `[contact]` that these choices describe."""
    law = chosen["law"]
    keys, table = LAWS[law].KEYS, {"law": law}
    unset = {name: value for name, value in LAWS[law].EXAMPLE.items() if name not in OF_ANOTHER_NAME}
    table |= unset | {name: chosen[name] for name in _of_own_name(law)}
    if "stiffness" in keys:
        table["stiffness"] = chosen[STIFFNESS[law]]
        if STIFFNESS[law] == "force_at_depth":
            exponent = LAWS[law].EXPONENT or chosen["exponent"]
            table["stiffness"] = min(table["stiffness"] / DEPTH**exponent, STIFFNESS_RANGE[1])
    if "restitution" in keys:
        table["restitution"] = max(chosen["restitution"], LEAST_RESTITUTION)
    return table


def _of_own_name(law: str) -> list[str]:
    """The constants of a law that are choices by the same name."""
    return [name for name in LAWS[law].KEYS if name in Choices.CHOSEN and name not in OF_ANOTHER_NAME]
