"""Whether the methods that discretise own to their errors: random impacts, their estimates against the true errors.

Impacts on rods are measured by the exact waves, those on beams by twice as fine a solution with four times the modes of
'modal'. A share of them runs with the tests; all by `python -m bench --only random-estimates`.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

import solvers
from bench.random_scenes import BEAM_SUPPORTS, STEEL, random_contact
from solvers import Method, Modal, Scene

SCENES = 300  # of each kind
FIRST = 50_000  # seed; whoever looks into one of these scenes, to mend what it shows, moves it on
TWICE = 2.0  # times the estimate, within which the true error should be ...
SHARE = 0.95  # ... in so many scenes
NOTHING = 2e-4  # of the speed of approach: errors so small need no estimate
LAWS = tuple(name for name in solvers.LAWS if name != "rigid")
KINDS = ("fe-nodal", "fe-modal", "balance", "fe-nodal on beams", "fe-modal on beams")


@dataclass(frozen=True)
class Rated:
    """Of the final velocity of the impactor, relative to the speed of approach."""

    seed: int
    estimate: float
    error: float

    @property
    def owned(self) -> bool:
        return self.error <= max(TWICE * self.estimate, NOTHING)


def rated(kind: str, seeds: range) -> Iterator[Rated]:
    """The impacts of these seeds, by one of KINDS; those whose error the method says it does not know are left out."""
    for seed in seeds:
        chance = np.random.default_rng(seed)
        name, _, where = kind.partition(" ")
        scene = _beam(chance) if where else _rod(chance, name == "balance")
        method = _method(chance, name, bool(where))
        found = solvers.solve(scene, method)
        estimate = found.diagnostics["estimated_error"]
        if estimate is None:
            continue
        true = solvers.solve(scene, _truth(found), duration=found.duration).impactor_velocity
        yield Rated(seed, estimate, abs(found.impactor_velocity - true) / scene.speed)


def measure(scenes: int = SCENES) -> dict[str, dict[str, float]]:
    """All of them: the share that owns to its error, and the quotient of true error and estimate."""
    found = {}
    for kind in KINDS:
        seen = list(rated(kind, range(FIRST, FIRST + scenes)))
        reported = [impact for impact in seen if impact.error > NOTHING]
        quotients = np.array([impact.error / max(impact.estimate, NOTHING) for impact in reported])
        found[kind] = {
            "impacts": len(seen),
            "owned": sum(impact.owned for impact in seen) / len(seen),
            "half": float(np.median(quotients)),
            "95 %": float(np.percentile(quotients, 95.0)),
            "largest": float(quotients.max()),
        }
    return found


def _log_uniform(chance: np.random.Generator, low: float, high: float) -> float:
    return math.exp(chance.uniform(math.log(low), math.log(high)))


def _impact(chance: np.random.Generator, target: dict, mass: float, stiffness: float, depth: float, law: str) -> Scene:
    impactor = {"mass": mass, "velocity": 1.0}
    contact = random_contact(chance, law, stiffness / _log_uniform(chance, 0.03, 100.0), depth)
    return Scene.from_table({"impactor": impactor, "target": target, "contact": contact})


def _rod(chance: np.random.Generator, rigid: bool) -> Scene:
    """A mass on a fixed or a free steel rod 0.01 to 1000 times as heavy; any law, one in four of them rigid."""
    width = chance.uniform(0.01, 0.05)
    length = chance.uniform(10.0, 30.0) * width
    target = {"kind": "rod", "length": length, "section": {"width": width, "height": width}, "material": STEEL}
    target["support"] = str(chance.choice(("fixed", "free")))
    mass = STEEL["density"] * length * width**2 / _log_uniform(chance, 0.01, 30.0 if rigid else 1000.0)
    law = "rigid" if rigid or chance.random() < 0.25 else str(chance.choice(LAWS))
    stiffness = STEEL["young"] * width**2 / length
    round_trip = 2.0 * length / math.sqrt(STEEL["young"] / STEEL["density"])
    return _impact(chance, target, mass, stiffness, round_trip, law)


def _beam(chance: np.random.Generator) -> Scene:
    """A mass on a steel beam 0.1 to 30 times as heavy, with a law."""
    width = chance.uniform(0.01, 0.05)
    length = chance.uniform(10.0, 30.0) * width
    target = {"kind": "beam", "length": length, "section": {"width": width, "height": width}, "material": STEEL}
    target["support"] = str(chance.choice(BEAM_SUPPORTS))
    target["theory"] = str(chance.choice(("euler-bernoulli", "timoshenko")))
    target["at"] = chance.uniform(0.3, 0.7)
    mass = STEEL["density"] * length * width**2 / _log_uniform(chance, 0.1, 30.0)
    stiffness = 4.0 * STEEL["young"] * width**4 / length**3
    period = 2.0 * length**2 / (width * math.sqrt(STEEL["young"] / STEEL["density"]))
    return _impact(chance, target, mass, stiffness, period, str(chance.choice(LAWS)))


def _method(chance: np.random.Generator, name: str, beam: bool) -> Method:
    elements = round(_log_uniform(chance, 6.0, 60.0 if beam else 120.0))
    options: dict[str, object] = {"elements": elements}
    if name == "balance":
        options["restitution"] = float(chance.choice((0.0, 0.5, 0.9, 1.0)))
    elif name == "fe-modal" and beam:
        options["modes"] = max(3, elements // 2)
    return solvers.METHODS[name].read(options)


def _truth(found: solvers.Solution) -> Method:
    if found.scene.target.kind == "rod":
        return solvers.METHODS["waves"].read({})
    steps = min(4 * max(found.diagnostics["steps"], 2_000), 400_000)
    return replace(Modal(modes=80, steps=steps), estimate=False)
