"""Random impacts of all kinds that meet along a line, against a solution that shares nothing with the library.

What falls, strikers with ends, spring-masses, moving frames, bodies exchanged; halved elements and steps say how far
the other solution may be off itself. A few run with the tests; `python -m tests.random_kinds 3000` tries that many.
"""

import math
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

import solvers
from solvers import Scene, SceneError, SceneNotSupported, Solution
from solvers.methods.quasi_static.validity import NEGLIGIBLE_ENERGY
from tests.independent import EXPONENTS, Found, independent
from tests.random_chains import between

FIRST = 700_000  # seed
NOTHING = 1e-3  # of the speed of approach, that is no error
SLOW = 4.0  # times the change by halved elements, of what they follow slowly: jumps of the force, to order one half
MANY = 30  # contacts, of which finer elements tell no more
PEAK = 0.01  # of the peak of the force, likewise
METHODS = ("waves", "modal", "fe-modal", "fe-nodal", "quasi-static")
STEEL = {"young": 210e9, "density": 7900.0, "poisson": 0.3}
SUPPORTS = ("cantilever", "pinned-pinned", "clamped-clamped", "free-free", "pinned-free")
# Of notes that say that the numbers are not to be relied on, or what of them is not.
TOLD = {
    "cut-short", "mesh-chatter", "modal-chatter", "front-unresolved", "ill-conditioned-mesh", "front-ripples",
    "law-ripples", "law-left-out", "weight-left-out", "weight-left-out-later", "modes-too-fast",
    "waves-matter", "vibration-left-out", "spring-left-out", "yielding-left-out",
}  # fmt: skip


def random_kind(seed: int) -> Scene | None:
    """None where the chosen pair is no scene."""
    chance = np.random.default_rng(seed)
    width = chance.uniform(0.01, 0.05)
    size = {"length": width * chance.uniform(10.0, 30.0), "section": {"width": width, "height": width}}
    striker = _striker(chance, size)
    target = _target(chance, size)
    bends = "beam" in (striker.get("kind"), target["kind"])
    length = size["length"]
    stiffness = STEEL["young"] * width**2 / length / between(chance, 0.1, 30.0)
    period = 2.0 * length / math.sqrt(STEEL["young"] / STEEL["density"])
    if bends:
        stiffness, period = 4.0 * stiffness * (width / length) ** 2, period * length / width
    speed = between(chance, 0.02, 10.0)
    _start(chance, striker, target, speed)
    contact = _law(chance, stiffness, speed * period, speed, stiffness * period)
    try:
        return Scene.from_table({"impactor": striker, "target": target, "contact": contact})
    except SceneError:
        return None


def _piece(chance: np.random.Generator, size: dict[str, Any]) -> dict[str, Any]:
    return {"length": size["length"] * between(chance, 0.3, 2.0), "section": size["section"], "material": STEEL}


def _end_mass(chance: np.random.Generator, size: dict[str, Any]) -> dict[str, Any]:
    if chance.random() < 0.5:
        return {}
    return {"end_mass": _weight(size) * between(chance, 0.05, 20.0)}


def _weight(size: dict[str, Any]) -> float:
    return STEEL["density"] * size["length"] * size["section"]["width"] ** 2


def _striker(chance: np.random.Generator, size: dict[str, Any]) -> dict[str, Any]:
    kind = chance.choice(("mass", "mass", "rod", "rod", "rods", "beam"))
    if kind == "mass":
        return {"mass": _weight(size) * between(chance, 0.03, 30.0)}
    if kind == "rod":
        return {"kind": "rod"} | _piece(chance, size) | _end_mass(chance, size)
    if kind == "rods":
        rods = [_piece(chance, size) for _ in range(int(chance.integers(2, 5)))]
        return {"kind": "rods", "rods": rods} | _end_mass(chance, size)
    return {"kind": "beam", "at": chance.uniform(0.2, 0.8)} | _piece(chance, size)


def _target(chance: np.random.Generator, size: dict[str, Any]) -> dict[str, Any]:
    kind = chance.choice(("stop", "mass", "spring-mass", "spring-mass", "rod", "rods", "beam"))
    if kind == "stop":
        return {"kind": "stop"}
    mass = _weight(size) * between(chance, 0.05, 20.0)
    if kind == "mass":
        return {"kind": "mass", "mass": mass}
    if kind == "spring-mass":
        stiffness = STEEL["young"] * size["section"]["width"] ** 2 / size["length"] * between(chance, 1e-4, 3.0)
        return {"kind": "spring-mass", "mass": mass, "stiffness": stiffness}
    if kind == "beam":
        support = str(chance.choice(SUPPORTS))
        beam = {"kind": "beam", "support": support, "at": chance.uniform(0.3, 0.7)} | _piece(chance, size)
        return beam | (_end_mass(chance, size) if support == "cantilever" else {})
    support = str(chance.choice(("fixed", "free")))
    target = {"kind": "rod"} | _piece(chance, size)
    if kind == "rods":
        target = {"kind": "rods", "rods": [_piece(chance, size) for _ in range(int(chance.integers(2, 5)))]}
    return target | {"support": support} | (_end_mass(chance, size) if support == "free" else {})


def _free(target: dict[str, Any]) -> bool:
    return target["kind"] == "mass" or target.get("support") in ("free", "free-free")


def _start(chance: np.random.Generator, striker: dict[str, Any], target: dict[str, Any], speed: float) -> None:
    """At this speed; dropped or thrown on what is held, or both move where nothing holds the target."""
    if _free(target):
        moving = chance.uniform(-3.0, 3.0) * speed if chance.random() < 0.5 else 0.0
        striker["velocity"] = speed + moving
        if moving:
            target["velocity"] = moving
        return
    start = chance.choice(("height", "thrown", "velocity"))
    if start == "height":
        striker["height"] = speed**2 / (2.0 * 9.80665)
        return
    striker["velocity"] = speed
    if start == "thrown":
        striker["gravity"] = between(chance, 0.1, 1000.0)


def _law(chance: np.random.Generator, stiffness: float, depth: float, speed: float, damping: float) -> dict[str, Any]:
    law = str(chance.choice([*EXPONENTS, "power"]))
    exponent = EXPONENTS.get(law) or chance.uniform(1.0, 2.0)
    table: dict[str, Any] = {"law": law, "stiffness": stiffness * depth ** (1.0 - exponent)}
    if law == "power":
        table["exponent"] = exponent
    elif law == "kelvin-voigt":
        table["damping"] = damping * between(chance, 0.01, 1.0)
    elif law == "hunt-crossley":
        table["damping"] = between(chance, 0.05, 2.0) / speed
    return table


@dataclass(frozen=True)
class Compared:
    seed: int
    method: str
    error: float  # of the final velocity of the impactor, by the speed of approach
    own: float  # by which the independent solution may be off
    estimate: float
    peak: float  # relative error of the peak of the force
    own_peak: float
    codes: frozenset[str]
    jumps: bool  # whether the force of a dashpot jumps as waves start, which no elements follow

    @property
    def sure(self) -> bool:
        """Whether the other solution is near enough, and the method means its own."""
        return not TOLD & self.codes and self.own <= 5.0 * NOTHING

    @property
    def silent(self) -> bool:
        """Off by more than the estimate and what the other solution may be off, without a note."""
        if not self.sure:
            return False
        nothing = NEGLIGIBLE_ENERGY if self.method == "quasi-static" else NOTHING
        off = self.error > 2.0 * self.estimate + 2.0 * self.own + nothing
        return off or (not self.jumps and self.peak > PEAK + 3.0 * self.own_peak + 2.0 * self.estimate)


def compared(seed: int, methods: tuple[str, ...] = METHODS) -> Iterator[Compared]:
    """By each method that solves this scene."""
    scene = random_kind(seed)
    if scene is None:
        return
    found: dict[str, Solution] = {}
    for name in methods:
        try:
            found[name] = solvers.solve(scene, name)
        except (SceneNotSupported, SceneError):
            continue
    known: dict[float, tuple[Found, float, float]] = {}
    for name, solution in found.items():
        duration = solution.duration
        if not (duration > 0.0 and solution.peak_force):
            continue
        if duration not in known:
            known[duration] = _true(scene, duration)
        true, own, own_peak = known[duration]
        jumps = scene.contact.NAME == "kelvin-voigt"
        yield Compared(
            seed,
            name,
            abs(solution.impactor_velocity - true.velocity) / scene.speed,
            SLOW * own if jumps else own,
            solution.diagnostics["estimated_error"] or 0.0,
            abs(solution.peak_force / true.peak - 1.0) if true.peak else math.inf,
            own_peak,
            frozenset(note.code for note in solution.notes),
            jumps,
        )


def _true(scene: Scene, duration: float) -> tuple[Found, float, float]:
    elements = 60
    coarse = independent(scene, duration, elements)
    while True:
        elements *= 2
        fine = independent(scene, duration, elements)
        own = (abs(fine.velocity - coarse.velocity) + fine.late) / scene.speed
        own_peak = abs(fine.peak - coarse.peak) / max(fine.peak, 1e-300)
        alike = fine.touches == coarse.touches
        good = own < NOTHING / 2.0 and own_peak < PEAK / 2.0 and alike
        if good or elements >= (480 if fine.touches < MANY else 240) or math.isinf(own):
            return fine, own if alike else math.inf, own_peak
        coarse = fine


def main(count: int = 300, first: int = FIRST) -> None:
    seen: Counter[str] = Counter()
    for each in (each for seed in range(first, first + count) for each in compared(seed)):
        seen[each.method] += 1
        if each.silent:
            seen[f"{each.method}, silent"] += 1
            print(each, flush=True)
    print(dict(seen))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
