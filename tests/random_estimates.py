"""Whether methods own to their errors, and no more than that: random impacts, their estimates against the true errors.

Impacts on rods are measured by the exact waves, those of beams and pendulums by many more modes of 'modal'.
A share of them runs with the tests; all by `python -m bench --only estimates`.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

import solvers
from bench.random_scenes import BEAM_SUPPORTS, STEEL, random_contact
from solvers import Mechanism, Method, Modal, Multibody, Scene, Solution
from solvers.text.notes import Severity
from tests.random_chains import between, random_rod
from tests.random_mechanisms import random_mechanism

FIRST = 100_000  # seed; whoever looks into one of these scenes, to mend what it shows, moves it on
NOTHING = 2e-4  # of the speed of approach: errors so small are left out of the shares
LAWS = tuple(name for name in solvers.LAWS if name != "rigid")
RIGID = 0.25  # share of the impacts on rods, of methods that know laws
REFERENCE_MODES = 120  # of a beam
WIDE = (1e-3, 1e3)  # mass ratios, target over impactor
LINK_MODES, MOVING_LINK_MODES, MOVING_STEPS = 40, 14, 8_000  # of links, struck and moving


@dataclass(frozen=True)
class Rated:
    """Of the final velocity of the impactor, relative to the speed of approach."""

    seed: int
    estimate: float | None  # None: it says that it does not know, or that the result is not valid
    error: float

    def within(self, factor: float) -> bool:
        """Whether the true error is within so many times the estimate."""
        return self.error <= factor * (self.estimate or 0.0)

    def exceeds(self, factor: float) -> bool:
        """Whether the estimate is more than so many times the true error."""
        return (self.estimate or 0.0) > factor * self.error


def rated(kind: str, seeds: Sequence[int]) -> Iterator[Rated]:
    """The impacts of these seeds, by a method on a family of scenes, one of KINDS."""
    name, family = kind.split(" of ")
    for seed in seeds:
        chance = np.random.default_rng(seed)
        scene = FAMILIES[family](chance, name in RIGID_ONLY)
        method = _method(chance, name, family)
        if method.refusal(scene):
            continue
        found = solvers.solve(scene, method)
        known = not any(note.severity is Severity.INVALID for note in found.notes)
        true = _truth(found, method).impactor_velocity
        estimate = found.diagnostics["estimated_error"] if known else None
        yield Rated(seed, estimate, abs(found.impactor_velocity - true) / scene.speed)


def shares(seen: Sequence[Rated]) -> dict[str, float]:
    """Of these impacts: how many, of how many the method says nothing, how many are compared, and of these, whose error
    is not NOTHING, the shares that are to be large.
    """
    told = [impact for impact in seen if impact.estimate is not None]
    compared = [impact for impact in told if impact.error >= NOTHING]
    count = max(len(compared), 1)
    return {
        "impacts": len(seen),
        "unknown": (len(seen) - len(told)) / max(len(seen), 1),
        "compared": len(compared),
        "within": sum(impact.within(1.0) for impact in compared) / count,
        "within 3": sum(impact.within(3.0) for impact in compared) / count,
        "not beyond 5": 1.0 - sum(impact.exceeds(5.0) for impact in compared) / count,
        "largest": max((impact.error / max(impact.estimate or 0.0, 1e-300) for impact in compared), default=0.0),
    }


def _impact(
    chance: np.random.Generator, target: Mapping, impactor: Mapping, stiffness: float, depth: float, law: str
) -> Scene:
    contact = random_contact(chance, law, stiffness, depth)
    return Scene.from_table({"impactor": impactor, "target": target, "contact": contact})


def _law(chance: np.random.Generator, rigid: bool) -> str:
    return "rigid" if rigid or chance.random() < RIGID else str(chance.choice(LAWS))


def _rod(chance: np.random.Generator, rigid: bool, ratios: tuple[float, float] | None = None) -> Scene:
    """A mass on a fixed or a free steel rod so many times as heavy: 0.02 to 200, or 30 if the contact is rigid."""
    width = chance.uniform(0.01, 0.05)
    length = chance.uniform(10.0, 30.0) * width
    target = {"kind": "rod", "length": length, "section": {"width": width, "height": width}, "material": STEEL}
    target["support"] = str(chance.choice(("fixed", "free")))
    law = _law(chance, rigid)
    least, most = ratios or (0.02, 30.0 if law == "rigid" else 200.0)
    mass = STEEL["density"] * length * width**2 / between(chance, least, most)
    stiffness = STEEL["young"] * width**2 / length / between(chance, 0.03, 100.0)
    round_trip = 2.0 * length / math.sqrt(STEEL["young"] / STEEL["density"])
    return _impact(chance, target, {"mass": mass, "velocity": 1.0}, stiffness, round_trip, law)


def _two_rods(chance: np.random.Generator, rigid: bool) -> Scene:
    """A rod on another one, of any lengths, sections and materials."""
    impactor, target = ({"kind": "rod"} | random_rod(chance) for _ in range(2))
    target["support"] = str(chance.choice(("fixed", "free")))
    law = _law(chance, rigid)
    return _impact(chance, target, impactor | {"velocity": 1.0}, 1e9 / between(chance, 0.1, 30.0), 8e-5, law)


def _chain(chance: np.random.Generator, rigid: bool, ratios: tuple[float, float] = (0.03, 30.0)) -> Scene:
    """A mass or a rod on 2 to 4 rods bonded to each other, so many times as heavy as the mass."""
    rods = [random_rod(chance) for _ in range(int(chance.integers(2, 5)))]
    target = {"kind": "rods", "rods": rods, "support": str(chance.choice(("fixed", "free")))}
    weight = sum(7900.0 * rod["length"] * rod["section"]["area"] for rod in rods)
    impactor: dict = {"mass": weight / between(chance, *ratios)}
    if chance.random() < 0.2:
        impactor = {"kind": "rod"} | random_rod(chance)
    law = _law(chance, rigid)
    return _impact(chance, target, impactor | {"velocity": 1.0}, 1e9 / between(chance, 0.1, 30.0), 8e-5, law)


def _beam(chance: np.random.Generator, rigid: bool) -> Scene:
    """A mass on a steel beam 0.1 to 30 times as heavy, with a law: a rigid one has no limit."""
    width = chance.uniform(0.01, 0.05)
    length = chance.uniform(10.0, 30.0) * width
    target = {"kind": "beam", "length": length, "section": {"width": width, "height": width}, "material": STEEL}
    target["support"] = str(chance.choice(BEAM_SUPPORTS))
    target["theory"] = str(chance.choice(("euler-bernoulli", "timoshenko")))
    target["at"] = chance.uniform(0.3, 0.7)
    mass = STEEL["density"] * length * width**2 / between(chance, 0.1, 30.0)
    stiffness = 4.0 * STEEL["young"] * width**4 / length**3 / between(chance, 0.03, 100.0)
    period = 2.0 * length**2 / (width * math.sqrt(STEEL["young"] / STEEL["density"]))
    return _impact(chance, target, {"mass": mass, "velocity": 1.0}, stiffness, period, str(chance.choice(LAWS)))


def _pendulum(chance: np.random.Generator, rigid: bool) -> Scene:
    """A steel pendulum that bends, by 3 to 15 shapes, on a stop or a free bronze rod, with a law."""
    width = chance.uniform(0.01, 0.03)
    length = chance.uniform(10.0, 30.0) * width
    at = chance.uniform(0.4, 1.0)
    impactor = {"kind": "pendulum", "length": length, "section": {"width": width, "height": width}, "at": at}
    impactor |= {"material": STEEL, "spin": 1.0 / (at * length), "modes": int(chance.integers(3, 16))}
    impactor["shapes"] = str(chance.choice(("pinned-free", "clamped-free")))
    target: dict = {"kind": "stop"}
    if chance.random() < 0.5:
        target = {"kind": "rod", "length": between(chance, 0.2, 2.0), "section": {"area": width**2}}
        target |= {"material": "bronze", "support": "free"}
    stiffness = 4.0 * STEEL["young"] * width**4 / length**3 * between(chance, 1.0, 300.0)
    return _impact(chance, target, impactor, stiffness, 1e-3 * length, str(chance.choice(LAWS)))


def _mechanism(chance: np.random.Generator, rigid: bool) -> Scene:
    """A mass on a mechanism whose links bend by up to 12 shapes, with a law."""
    return random_mechanism(chance)


def _moving_mechanism(chance: np.random.Generator, rigid: bool) -> Scene:
    """The same, by up to 4 shapes: to follow more as they move takes minutes."""
    return random_mechanism(chance, 4)


FAMILIES: dict[str, Callable[[np.random.Generator, bool], Scene]] = {
    "rods": _rod,
    "wide rods": partial(_rod, ratios=WIDE),
    "two rods": _two_rods,
    "chains": _chain,
    "wide chains": partial(_chain, ratios=WIDE),
    "beams": _beam,
    "pendulums": _pendulum,
    "mechanisms": _mechanism,
    "moving mechanisms": _moving_mechanism,
}
FAMILIES_OF: dict[str, tuple[str, ...]] = {
    "modal": ("rods", "wide rods", "two rods", "beams", "pendulums", "mechanisms"),
    "fe-nodal": ("rods", "wide rods", "two rods", "chains", "wide chains", "beams"),
    "fe-modal": ("rods", "wide rods", "two rods", "chains", "wide chains", "beams"),
    "balance": ("rods", "wide rods", "chains", "wide chains"),
    "mode-switch": ("rods",),
    "waves": ("rods", "wide rods"),  # by steps
    "multibody": ("moving mechanisms",),
}
RIGID_ONLY = ("balance", "mode-switch", "waves")
KINDS = tuple(f"{name} of {family}" for name, families in FAMILIES_OF.items() for family in families)


def _method(chance: np.random.Generator, name: str, family: str) -> Method:
    beam = family == "beams"
    options: dict[str, object] = {}
    if "mechanisms" in family:  # whose links have modes of their own
        return Multibody() if name == Multibody.NAME else Modal()
    if name == "modal":
        options["modes"] = round(between(chance, 5.0, 40.0 if beam else 100.0))
        options["residual"] = family != "pendulums" or chance.random() < 0.5
    elif name == "mode-switch":
        options["modes"] = round(between(chance, 30.0, 120.0))
    elif name == "waves":
        options["steps"] = round(between(chance, 20.0, 2000.0))
    else:
        options["elements"] = elements = round(between(chance, 6.0, 60.0 if beam else 120.0))
        if name == "balance":
            options["restitution"] = float(chance.choice((0.0, 0.5, 0.9, 1.0)))
        elif name == "fe-modal" and beam:
            options["modes"] = max(3, elements // 2)
    return solvers.METHODS[name].read(options)


def _truth(found: Solution, method: Method) -> Solution:
    scene, steps = found.scene, found.diagnostics["steps"]
    if isinstance(scene.target, Mechanism):
        return _truth_of_links(found, method)
    if scene.target.rods and scene.impactor.kind != "pendulum":
        return solvers.solve(scene, "waves", duration=found.duration)
    steps = min(max(2 * steps, 8_000), 60_000)
    if scene.impactor.kind == "pendulum":
        assert isinstance(method, Modal)
        fine = replace(method, modes=min(400, 6 * max(method.modes, 20)), steps=steps, estimate=False)
        return fine.solve(replace(scene, impactor=scene.impactor.with_share_of_modes(12.0)), found.duration)
    return Modal(modes=REFERENCE_MODES, steps=steps, estimate=False).solve(scene, found.duration)


def _truth_of_links(found: Solution, method: Method) -> Solution:
    """By several times as many modes of each link."""
    mechanism = found.scene.target.known_as(Mechanism)
    moves = method.NAME == "multibody"
    most = max(MOVING_LINK_MODES, 3 * mechanism.most_modes) if moves else LINK_MODES
    fine = replace(found.scene, target=mechanism.with_own_modes(most), given={})
    if isinstance(method, Multibody):
        steps = min(MOVING_STEPS, method.lasts(fine, found.duration)[1])
        return replace(method, steps=steps, estimate=False).solve(fine, found.duration)
    steps = max(2 * found.diagnostics["steps"], 8_000)
    return Modal(steps=steps, estimate=False).solve(fine, found.duration)
