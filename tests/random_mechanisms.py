"""Random impacts on mechanisms with links that bend, the same for the same numbers."""

import math
from typing import Any

import numpy as np

import solvers
from bench.random_scenes import STEEL, random_contact
from solvers import Scene
from tests.random_chains import between

LAWS = tuple(name for name in solvers.LAWS if name != "rigid")
MOST = 12  # modes of a link
GRAVITY = [0.0, -9.81]


def random_mechanism(chance: np.random.Generator, most: int = MOST) -> Scene:
    """A mass on a link of a bar on one pin, driven or not, of a slider-crank or of a four-bar; any contact law.

    Links by 1 to `most` shapes of any kind, half of them with as many of stretching; the mass 0.03 to 3 times that of
    the struck link, the contact 1 to 300 times as stiff as its bending.
    """
    target = (_bar, _slider_crank, _four_bar)[int(chance.integers(3))](chance, most)
    struck = next(link for link in target["links"] if link["name"] == target["struck"]["link"])
    length, width = math.dist(struck["from"], struck["to"]), struck["section"]["height"]
    weight = STEEL["density"] * length * width**2
    if chance.random() < 0.3:
        target["gravity"] = GRAVITY
    stiffness = 4.0 * STEEL["young"] * width**4 / length**3 * between(chance, 1.0, 300.0)
    contact = random_contact(chance, str(chance.choice(LAWS)), stiffness, 1e-3 * length)
    impactor = {"mass": weight * between(chance, 0.03, 3.0), "velocity": 1.0}
    still = Scene.from_table({"impactor": impactor | {"velocity": 50.0}, "target": target, "contact": contact})
    impactor["velocity"] = still.target.velocity + between(chance, 0.3, 3.0)
    return Scene.from_table({"impactor": impactor, "target": target, "contact": contact})


def _link(
    chance: np.random.Generator, most: int, name: str, start: tuple, end: tuple, shapes: tuple[str, ...]
) -> dict[str, Any]:
    """A square steel bar 20 to 200 times as long as it is wide."""
    width = math.dist(start, end) / between(chance, 20.0, 200.0)
    modes = round(between(chance, 1.0, most))
    found: dict[str, Any] = {"name": name, "from": list(start), "to": list(end), "material": STEEL, "modes": modes}
    found |= {"section": {"width": width, "height": width}, "shapes": str(chance.choice(shapes))}
    return found | ({"axial": modes} if chance.random() < 0.5 else {})


def _across(chance: np.random.Generator, link: dict[str, Any]) -> dict[str, Any]:
    """Where it is struck, along a normal within 45 degrees of square to it."""
    angle = math.atan2(link["to"][1] - link["from"][1], link["to"][0] - link["from"][0])
    angle += math.pi / 2.0 * float(chance.choice((-1.0, 1.0))) + chance.uniform(-0.5, 0.5)
    at = 1.0 if link["name"] == "bar" and chance.random() < 0.5 else chance.uniform(0.3, 0.9)
    return {"link": link["name"], "at": at, "normal": [math.cos(angle), math.sin(angle)]}


def _joint(at: tuple, *links: str, **more: Any) -> dict[str, Any]:
    return {"kind": "revolute", "links": list(links), "at": list(at)} | more


def _bar(chance: np.random.Generator, most: int) -> dict[str, Any]:
    """One that hangs or is turned."""
    bar = _link(chance, most, "bar", (0.0, 0.0), (0.0, -between(chance, 0.2, 2.0)), ("pinned-free", "clamped-free"))
    found = {"kind": "mechanism", "links": [bar], "joints": [_joint((0.0, 0.0), "ground", "bar")]}
    if chance.random() < 0.4:
        found["drives"] = [{"joint": 0, "speed": chance.uniform(-3.0, 3.0)}]
    return found | {"struck": _across(chance, bar)}


def _slider_crank(chance: np.random.Generator, most: int) -> dict[str, Any]:
    crank, angle = between(chance, 0.1, 0.4), chance.uniform(0.4, 2.7)
    pin = (crank * math.cos(angle), crank * math.sin(angle))
    slide = (pin[0] + math.sqrt((between(chance, 2.0, 5.0) * crank) ** 2 - pin[1] ** 2), 0.0)
    rod = _link(chance, most, "rod", pin, slide, ("pinned-pinned", "clamped-free", "mean-axis"))
    links = [_link(chance, most, "crank", (0.0, 0.0), pin, ("clamped-free",)), rod]
    links.append(
        {"name": "piston", "from": list(slide), "to": [slide[0] + 0.05, 0.0], "mass": between(chance, 0.1, 2.0)}
    )
    joints = [_joint((0.0, 0.0), "ground", "crank"), _joint(pin, "crank", "rod"), _joint(slide, "rod", "piston")]
    joints.append(_joint(slide, "ground", "piston", kind="prismatic", axis=[1.0, 0.0]))
    drives = [{"joint": 0, "speed": chance.uniform(-5.0, 5.0)}]
    found = {"kind": "mechanism", "links": links, "joints": joints, "drives": drives}
    return found | {"struck": _across(chance, rod)}


def _four_bar(chance: np.random.Generator, most: int) -> dict[str, Any]:
    """Much as that of thesis 6.4.3; the crank driven or not, the bar longer than its joint is far."""
    crank, far = between(chance, 0.15, 0.4), between(chance, 0.3, 0.8)
    pin, foot = (0.0, crank), (far, 0.0)
    joint = (far + chance.uniform(-0.05, 0.05), crank + chance.uniform(0.05, 0.4))
    longer = chance.uniform(1.0, 1.6)
    tip = (foot[0] + longer * (joint[0] - foot[0]), longer * joint[1])
    bar = _link(chance, most, "bar", foot, tip, ("pinned-pinned", "clamped-free", "mean-axis"))
    coupler = _link(chance, most, "coupler", pin, joint, ("pinned-pinned", "clamped-free"))
    links = [{"name": "crank", "from": [0.0, 0.0], "to": list(pin), "mass": between(chance, 0.3, 3.0)}, coupler, bar]
    joints = [_joint((0.0, 0.0), "ground", "crank"), _joint(pin, "crank", "coupler")]
    joints += [_joint(joint, "coupler", "bar"), _joint(foot, "ground", "bar")]
    found = {"kind": "mechanism", "links": links, "joints": joints, "struck": _across(chance, bar)}
    return found | {"drives": [{"joint": 0, "speed": chance.uniform(-5.0, 5.0)}]}
