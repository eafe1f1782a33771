"""Only what a scene requires: the smallest model that answers a question, by limits of validity that were measured."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import checks
from .bodies import in_space
from .checks import SceneError
from .methods import METHODS
from .numerics.impulses import strike
from .regime_contours import contour
from .regime_models import FULL_MODES, LOSSES, MODELS, QUESTIONS, contact_duration, family_of, models_of
from .regime_tables import Table, lossy_table, models_table, modes_table, plastic_curve, theory_table
from .scene import Scene

LEVELS = (0.01, 0.05, 0.2)  # of error, drawn on the maps
FALLBACKS = ("waves", "modal", "fe-nodal", "balance", "quasi-static", "rigid")
USUAL_PLACES = {"cantilever": 1.0}
CAUSES = {
    "rigid-impulse": "neither waves nor bending take a share of the blow that matters",
    "local-quasi-static": "the contact gives way far more than the body behind it",
    "structural-quasi-static": "the body bends as under a slow force while the impactor pushes on",
    "waves": "waves come back while the bodies still touch, or before they would part",
    "modal": "the body rings, and so many modes carry what is asked",
}


@dataclass(frozen=True)
class Candidate:
    """A model for this scene. `changes` turn the scene into the one to solve; expected_error: of the answer, relative
    (of the final velocity as a share of the speed of approach); infinite where the model does not tell, NaN where
    nobody has measured."""

    model: str
    changes: dict[str, Any]
    expected_error: float

    def table(self) -> dict[str, Any]:
        error = self.expected_error if math.isfinite(self.expected_error) else None
        return {"model": self.model, "changes": self.changes, "expected_error": error}


@dataclass(frozen=True)
class Plan:
    """The smallest adequate model, why, and what would do better."""

    scene: Scene
    question: str
    tolerance: float
    groups: dict[str, float]  # without unit, as far as the scene has them
    chosen: Candidate
    next_better: Candidate | None
    candidates: list[Candidate]  # from the smallest up
    reason: str
    measured: bool  # whether sweeps cover this scene
    modes: int | None  # with which `modal` would do, too

    @property
    def model(self) -> str:
        return self.chosen.model

    @property
    def expected_error(self) -> float:
        return self.chosen.expected_error

    @property
    def planned(self) -> Scene:
        """The scene as planned, ready for `solve`."""
        return self.scene.replace(self.chosen.changes)

    def table(self) -> dict[str, Any]:
        """For JSON."""
        return {
            "question": self.question,
            "tolerance": self.tolerance,
            "groups": self.groups,
            "chosen": self.chosen.table(),
            "next_better": None if self.next_better is None else self.next_better.table(),
            "candidates": [candidate.table() for candidate in self.candidates],
            "reason": self.reason,
            "measured": self.measured,
            "modes": self.modes,
        }


@dataclass(frozen=True)
class RegimeMap:
    """Errors of each model over mass ratio and contact time, as measured; for a page to draw.

    mass_ratio (n,), target over impactor; relative_time (m,), duration of the contact of two rigid bodies over the
    round trip of a wave in the rod, or over the period of the slowest vibration of the beam, 0 being a rigid contact;
    errors (models, n, m), infinite where the model does not tell. contours[model][level]: arrays of relative time and
    mass ratio along the lines of that error, NaN between the lines; models are better on the side of smaller errors.
    smallest (n, m): index of the first model within the tolerance, len(models): none of them is.
    """

    question: str
    family: str
    law: str
    tolerance: float
    models: list[str]
    mass_ratio: np.ndarray
    relative_time: np.ndarray
    errors: np.ndarray
    contours: dict[str, dict[float, tuple[np.ndarray, np.ndarray]]]
    smallest: np.ndarray


def plan(scene: Scene, question: str = "final-velocities", tolerance: float = 0.05) -> Plan:
    """The smallest model that answers the question within the tolerance, from what was measured on scenes around it.

    Questions: final-velocities, peak-force, contact-times (first touch to last parting), stresses (the largest
    anywhere). From the smallest up: rigid impulse, local quasi-static, structural quasi-static, then travelling waves
    in rods or so many modes of a beam, by Euler and Bernoulli or by Timoshenko; each with the law as it is or, where
    speed allows, elastic instead of elastoplastic. Where none is within the tolerance the best is taken, and says so.
    Error: the largest of the four measured points around the scene; sweeps are of elastic contacts of a compact body on
    a uniform rod's end, or on a beam where it is usually struck; see `measured`.
    Source: the validity that thesis 3.5 names in words, and its future work, measured by bench/measure_regimes.py.
    """
    checks.choice("question", question, QUESTIONS)
    tolerance = checks.number("tolerance", tolerance, 1e-6, 1.0)
    family = family_of(scene)
    if family is None:
        return _unmeasured(scene, question, tolerance)
    number, groups = QUESTIONS.index(question), _groups(scene)
    candidates, modes = list(_candidates(scene, family, number, groups, tolerance)), None
    if family.endswith("-rod"):
        count, error = _modes_needed(family, number, groups, tolerance)
        modes = count if error <= tolerance else None
    good = [k for k, candidate in enumerate(candidates) if candidate.expected_error <= tolerance]
    errors = [candidate.expected_error for candidate in candidates]
    chosen = good[0] if good else int(np.argmin(errors))
    better = [k for k in range(len(candidates)) if k > chosen and errors[k] < errors[chosen]]
    found = Plan(
        scene, question, tolerance, groups, candidates[chosen],
        candidates[better[0]] if better else None, candidates, "", _covered(scene, family, groups), modes,
    )  # fmt: skip
    return _with_reason(found, candidates[:chosen])


def regime_map(
    question: str = "final-velocities", family: str = "fixed-rod", law: str = "linear", tolerance: float = 0.05
) -> RegimeMap:
    """What each cheap model misses, for a family: fixed-rod, free-rod (law linear or hertz), or a beam's support."""
    number = QUESTIONS.index(checks.choice("question", question, QUESTIONS))
    checks.choice("family", family, FAMILIES)
    checks.choice("law", law, ("linear", "hertz") if family.endswith("-rod") else ("linear",))
    tolerance = checks.number("tolerance", tolerance, 1e-6, 1.0)
    table = models_table(family, law)
    errors = np.moveaxis(table.errors[:, :, :, number], 2, 0)
    shown = table.time > 0.0
    contours = {
        name: {level: contour(table.time[shown], table.ratio, errors[k][:, shown], level) for level in LEVELS}
        for k, name in enumerate(MODELS)
    }
    within = np.concatenate((errors <= tolerance, np.ones((1, *errors.shape[1:]), bool)))
    return RegimeMap(
        question, family, law, tolerance, list(MODELS), table.ratio, table.time, errors, contours, within.argmax(axis=0)
    )


FAMILIES = ("fixed-rod", "free-rod", "cantilever", "pinned-pinned", "clamped-clamped", "free-free")


# --- groups -----------------------------------------------------------------------------------------------------------


def _groups(scene: Scene) -> dict[str, float]:
    target = scene.target
    found = {"mass_ratio": scene.mass_ratio, "contact_time": contact_duration(scene) / target.time_unit}
    if scene.contact.PLASTIC:
        found["impact_parameter"] = _impact_parameter(scene)
    if target.kind == "beam":
        found["slenderness"] = target.slenderness
    return {name: float(value) for name, value in found.items()}


def scene_rotation(scene: Scene) -> float:
    """Share of the closing speed that a blow takes away by turning the bodies: 0 of a central one, 1 of spin alone."""
    bodies = [in_space(body) for body in (scene.impactor, scene.target)]
    struck = strike(*bodies, np.array(scene.normal), 1.0)
    return float(1.0 - struck.effective_mass * sum(1.0 / float(body.mass) for body in bodies))


def _impact_parameter(scene: Scene) -> float:
    """Speed of approach over that at which yield begins."""
    law = scene.contact
    begins = law.stored(law.yield_indentation, law.yield_indentation)
    return scene.speed / math.sqrt(2.0 * begins / scene.reduced_mass)


def law_of(scene: Scene) -> str:
    """The nearer of the two laws that were swept."""
    exponent = getattr(scene.contact, "exponent", 1.0 if scene.contact.NAME in ("linear", "kelvin-voigt") else 1.5)
    return "linear" if exponent < 1.25 or scene.contact.NAME == "rigid" else "hertz"


def _covered(scene: Scene, family: str, groups: dict[str, float]) -> bool:
    target, law = scene.target, scene.contact
    if target.kind == "beam" and abs(target.at - USUAL_PLACES.get(family, 0.5)) > 1e-6:
        return False
    tables = [(models_table(family, law_of(scene)), False), *_lossy_tables(scene, family, groups)]
    inside = all(table.covers(groups["mass_ratio"], groups["contact_time"]) for table, _ in tables)
    return inside and not law.JUMPS and not any(beyond for _, beyond in tables)


def _lossy_tables(scene: Scene, family: str, groups: dict[str, float]) -> list[tuple[Table, bool]]:
    """Of a law that loses energy, those measured with a little less and a little more of it, and whether the scene
    loses more than any; none for elastic blows.
    """
    law = scene.contact
    if law.PLASTIC and groups["impact_parameter"] > 1.0:
        name, losses, here = "plastic-linear", LOSSES["plastic-linear"], groups["impact_parameter"]
    elif law.LOSSY:
        name = "hunt-crossley"
        losses, here = [1.0 / e for e in LOSSES[name]], 1.0 / law.delivered(scene.reduced_mass, scene.speed)
    else:
        return []
    after = int(np.searchsorted(losses, here))
    beside = sorted({max(after - 1, 0), min(after, len(losses) - 1)})
    return [(lossy_table(family, name, LOSSES[name][k]), here > losses[-1]) for k in beside]


# --- candidates -------------------------------------------------------------------------------------------------------


def _candidates(scene: Scene, family: str, number: int, groups: dict, tolerance: float) -> Iterator[Candidate]:
    """From the smallest up."""
    table = models_table(family, law_of(scene))
    tables = [table, *(lossy for lossy, _ in _lossy_tables(scene, family, groups))]
    errors = np.max([each.around(groups["mass_ratio"], groups["contact_time"])[:, number] for each in tables], axis=0)
    yielding = _elastic_error(scene, number, groups)
    for (name, method), error in zip(models_of(scene).items(), errors.tolist(), strict=True):
        own, changes = error, {"method": method.table()}
        if name == "local-quasi-static" and yielding is not None:
            yield Candidate(f"{name}, elastic", changes | _elastic(scene), own + yielding)
            yield Candidate(f"{name}, elastoplastic", changes, own)
            continue
        yield Candidate(name, changes, own)  # neither an impulse nor the structure alone knows of yield: so measured
    if scene.target.kind == "beam":
        yield from _beam_candidates(scene, family, number, groups, tolerance)
        return
    if yielding is not None:
        yield Candidate("waves, elastic", {"method": {"name": "waves"}} | _elastic(scene), yielding)
    yield Candidate("waves, elastoplastic" if yielding is not None else "waves", {"method": {"name": "waves"}}, 0.0)


def _beam_candidates(scene: Scene, family: str, number: int, groups: dict, tolerance: float) -> Iterator[Candidate]:
    theory = float(theory_table(family).around(groups["slenderness"], groups["contact_time"])[number])
    yielding = _elastic_error(scene, number, groups)
    for name, missed in (("euler-bernoulli", theory), ("timoshenko", 0.0)):
        for elastic in (True, False) if yielding is not None else (False,):
            more = missed + (yielding if elastic else 0.0)
            count, error = _modes_needed(family, number, groups, max(tolerance - more, 0.0), scene.contact.NAME)
            changes = {"target.theory": name, "method": {"name": "modal", "modes": count}}
            law = "" if yielding is None else ", elastic" if elastic else ", elastoplastic"
            label = f"modal, {count} modes, {name}{law}"
            yield Candidate(label, changes | (_elastic(scene) if elastic else {}), error + more)


def _modes_needed(family: str, number: int, groups: dict, tolerance: float, law: str = "linear") -> tuple[int, float]:
    """The smallest number of modes from which on all are within the tolerance, and its error; else the largest.

    Measured under a linear law: others may reach higher modes, and get the next number.
    """
    counts, table = modes_table(family)
    errors = table.around(groups["mass_ratio"], groups["contact_time"])[:, number]
    errors = np.maximum.accumulate(errors[::-1])[::-1]  # few modes may be right by chance
    good = np.flatnonzero(errors <= tolerance)
    if good.size and law == "linear":
        return int(counts[good[0]]), float(errors[good[0]])
    if good.size:
        return int([*counts, FULL_MODES][good[0] + 1]), float(errors[good[0]])
    return max(int(counts[-1]), FULL_MODES), float(errors[-1])


def _elastic_error(scene: Scene, number: int, groups: dict[str, float]) -> float | None:
    """What an elastic law misses of this plastic one, from blows of two compact bodies; None for other laws."""
    law = scene.contact
    if not law.PLASTIC:
        return None
    ratios, missed = plastic_curve(law.NAME)
    after = int(np.clip(np.searchsorted(ratios, groups["impact_parameter"]), 1, ratios.size - 1))
    error = float(missed[after - 1 : after + 1, min(number, 2) if number < 3 else 1].max())
    share = 1.0 if scene.target.held else scene.mass_ratio / (1.0 + scene.mass_ratio)
    return error * share if number == 0 else error


def _elastic(scene: Scene) -> dict[str, Any]:
    return {"contact": {"law": "hertz", "stiffness": scene.contact.stiffness}}


# --- words ------------------------------------------------------------------------------------------------------------


def _share(error: float) -> str:
    if math.isinf(error):
        return "it does not tell"
    return "nothing" if error == 0.0 else f"{100.0 * error:.2g} %"


def _with_reason(found: Plan, smaller: list[Candidate]) -> Plan:
    chosen, groups = found.chosen, found.groups
    unit = "round trips of a wave" if found.scene.target.kind == "rod" else "periods of the slowest vibration"
    lasts = f"{groups['contact_time']:.3g} {unit}" if groups["contact_time"] else "no time by itself"
    cause = CAUSES[chosen.model.partition(",")[0]]
    what = found.question.replace("-", " ")
    reason = (
        f"At mass ratio {groups['mass_ratio']:.3g} and with a local contact that lasts {lasts}, {cause}: "
        f"{chosen.model} is expected to miss the {what} by {_share(chosen.expected_error)}"
    )
    if chosen.expected_error > found.tolerance:
        reason += f", more than the {_share(found.tolerance)} allowed, but nothing here does better"
    told = [c for c in smaller if math.isfinite(c.expected_error)]
    if told:
        closest = min(told, key=lambda c: c.expected_error)
        reason += f"; {closest.model} would miss {_share(closest.expected_error)}"
    if not found.measured:
        reason += "; the scene lies beside what was measured, so take the figures as a guess"
    return Plan(**{**found.__dict__, "reason": reason + "."})


def _unmeasured(scene: Scene, question: str, tolerance: float) -> Plan:
    """Bodies in which nothing rings are known in closed form; for the rest, the first method that can solve them."""
    bodies = scene.impactor, scene.target
    whole = all(body.time_unit is None and body.kind not in ("spring-mass", "half-space") for body in bodies)
    compact, names = scene.normal is not None or whole, FALLBACKS
    if compact:
        names = ("rigid", "quasi-static") if question == "final-velocities" else ("quasi-static", "rigid")
        if scene.contact.PLASTIC:
            names = ("quasi-static", "rigid")
    usable = [name for name in names if METHODS[name]().refusal(scene) is None]
    if not usable:
        raise SceneError("scene", scene.target.kind, "bodies that one of the methods can solve")
    name, changes = usable[0], {"method": {"name": usable[0]}}
    model = {"rigid": "rigid-impulse", "quasi-static": "local-quasi-static"}.get(name, name)
    told = name != "rigid" or question == "final-velocities"
    exact = compact or (name == "waves" and scene.target.kind in ("rod", "rods"))
    error = (0.0 if told else math.inf) if exact else math.nan
    if name == "rigid" and scene.contact.LOSSY:
        changes["method"]["restitution"] = scene.contact.delivered(scene.reduced_mass, scene.speed)
    struck = {"rods": "a chain of rods", "body": "another body"}.get(scene.target.kind, f"a {scene.target.kind}")
    pair = f"a {scene.impactor.kind} on {struck}"
    if not told:
        reason = f"Nothing gives way between {pair} in rigid contact, so there is no {question}: give a contact law."
    elif compact:
        reason = f"Nothing rings in {pair}: {model} leaves out nothing that these bodies have."
    else:
        reason = f"No sweep covers {pair}; {name} is the first method that solves it."
    chosen = Candidate(model, changes, error)
    groups = {"mass_ratio": float(scene.mass_ratio)} if math.isfinite(scene.mass_ratio) else {}
    groups |= {} if scene.normal is None else {"rotation": scene_rotation(scene)}
    return Plan(scene, question, tolerance, groups, chosen, None, [chosen], reason, False, None)
