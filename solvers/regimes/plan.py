"""Only what a scene requires: the smallest model that answers a question, by limits of validity that were measured."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .. import validation
from ..accuracy.reference import SWEEP_MODES
from ..bodies import Bending, Mechanism, in_space
from ..contact.duration import exponent_of
from ..contact.protocol import Damped, Yielding
from ..methods import METHODS
from ..numerics.rigid.impulses import strike
from ..scene import Scene
from ..scenes.library import SceneOrName, scene_of
from ..solution.solution import Solution
from ..text.notes import Note, Severity
from ..validation import SceneError, allowed
from .candidate import Candidate
from .models import LOSSES, QUESTIONS, contact_duration, errors, family_of, figures, models_of
from .solved import is_solved, reference_of, solved_candidates
from .tables import Table, lossy_table, models_table, modes_table, plastic_curve, theory_table

FALLBACKS = ("waves", "modal", "fe-nodal", "balance", "quasi-static", "rigid")
WHOLE = "rigid-impulse", "local-quasi-static", "rigid-pendulum"  # models in which nothing bends or rings
USUAL_PLACES = {"cantilever": 1.0}
UNKNOWN = Note("plan-unknown", Severity.REMARK)  # until it is said why


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
    why: Note  # it was chosen
    measured: bool  # whether sweeps cover this scene
    modes: int | None  # with which `modal` would do, too

    @property
    def model(self) -> str:
        return self.chosen.model

    @property
    def reason(self) -> str:
        """`why`, in a sentence."""
        return str(self.why)

    @property
    def expected_error(self) -> float:
        return self.chosen.expected_error

    @property
    def planned(self) -> Scene:
        """The scene as planned, ready for `solve`."""
        return self.scene.replace(self.chosen.changes)

    def _repr_html_(self) -> str:
        from ..notebook import cards

        return cards.plan_card(self)

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
            "reason_code": self.why.table(),
            "measured": self.measured,
            "modes": self.modes,
        }


def plan(
    scene: SceneOrName, question: str = "final-velocities", tolerance: float = 0.05, *, solve: bool = False
) -> Plan:
    """The smallest model that answers the question within the tolerance, from what was measured on scenes around it.

    Questions: final-velocities, peak-force, contact-times (first touch to last parting), stresses (the largest
    anywhere). From the smallest up: rigid impulse, local quasi-static, structural quasi-static, then travelling waves
    in rods or so many modes of a beam, by Euler and Bernoulli or by Timoshenko; each with the law as it is or, where
    speed allows, elastic instead of elastoplastic. Where none is within the tolerance the best is taken, and says so.
    Error: the largest of the four measured points around the scene; sweeps are of elastic contacts of a compact body on
    a uniform rod's end, or on a beam where it is usually struck; see `measured`.
    With links or a pendulum that bend, and of rods that turn, each model is solved, and one of many modes to compare;
    with `solve` so is every scene that waves or modes can solve, by exact waves where they can: some tens of ms.
    Source: the validity that thesis 3.5 names in words, and its future work, measured by bench/measure_regimes.py.
    """
    scene = scene_of(scene)
    validation.choice("question", question, QUESTIONS)
    tolerance = validation.number("tolerance", tolerance, 1e-6, 1.0)
    if scene.struck is not scene:
        found = plan(scene.struck, question, tolerance, solve=solve)
        candidates = [_of_impactor(each) for each in found.candidates]
        chosen, better = _smallest(candidates, tolerance)
        groups = found.groups | {"mass_ratio": scene.mass_ratio}
        return replace(
            found, scene=scene, groups=groups, chosen=candidates[chosen], next_better=better, candidates=candidates
        )
    if is_solved(scene) or (solve and reference_of(scene)):
        return _solved(scene, question, tolerance)
    family = family_of(scene)
    if family is None:
        return _unmeasured(scene, question, tolerance)
    number, groups = QUESTIONS.index(question), _groups(scene)
    candidates, modes = list(_candidates(scene, family, number, groups, tolerance)), None
    if family.endswith("-rod"):
        count, error = _modes_needed(family, number, groups, tolerance)
        modes = count if error <= tolerance else None
    chosen, better = _smallest(candidates, tolerance)
    found = Plan(
        scene, question, tolerance, groups, candidates[chosen], better, candidates, UNKNOWN,
        _covered(scene, family, groups), modes,
    )  # fmt: skip
    return _with_reason(found, candidates[:chosen])


def _of_impactor(candidate: Candidate) -> Candidate:
    """Its changes of the links of what is struck, as those of what strikes."""
    changes = {key.replace("target.links.", "impactor.links."): value for key, value in candidate.changes.items()}
    return replace(candidate, changes=changes)


def _smallest(candidates: list[Candidate], tolerance: float) -> tuple[int, Candidate | None]:
    """The first within the tolerance, or the best where none is, and the next that does better."""
    errors = [candidate.expected_error for candidate in candidates]
    good = [k for k, error in enumerate(errors) if error <= tolerance]
    chosen = good[0] if good else int(np.argmin(errors))
    better = [k for k in range(chosen + 1, len(candidates)) if errors[k] < errors[chosen]]
    return chosen, candidates[better[0]] if better else None


# --- groups -----------------------------------------------------------------------------------------------------------


def _groups(scene: Scene) -> dict[str, float]:
    target = scene.target
    found = {"mass_ratio": scene.mass_ratio, "contact_time": contact_duration(scene) / scene.time_unit}
    if scene.contact.PLASTIC:
        found["impact_parameter"] = _impact_parameter(scene)
    if isinstance(target, Bending):
        found["slenderness"] = target.slenderness
    return {name: float(value) for name, value in found.items()}


def scene_rotation(scene: Scene) -> float:
    """Share of the closing speed that an impact takes away by turning the bodies: 0 if central, 1 if spin alone."""
    impactor, target = in_space(scene.impactor), in_space(scene.target)
    struck = strike(impactor, target, np.array(scene.normal), 1.0)
    return float(1.0 - struck.effective_mass * (1.0 / float(impactor.mass) + 1.0 / float(target.mass)))


def _impact_parameter(scene: Scene) -> float:
    """Speed of approach over that at which yield begins."""
    law = scene.contact
    assert isinstance(law, Yielding)
    begins = law.stored(law.yield_indentation, law.yield_indentation)
    return scene.speed / math.sqrt(2.0 * begins / scene.reduced_mass)


def law_of(scene: Scene) -> str:
    """The nearer of the two laws that were swept."""
    return "linear" if scene.rigid_contact or exponent_of(scene.contact) < 1.25 else "hertz"


def _covered(scene: Scene, family: str, groups: dict[str, float]) -> bool:
    target, law = scene.target, scene.contact
    if isinstance(target, Bending) and abs(target.at - USUAL_PLACES.get(family, 0.5)) > 1e-6:
        return False
    tables = [(models_table(family, law_of(scene)), False), *_lossy_tables(scene, family, groups)]
    inside = all(table.covers(groups["mass_ratio"], groups["contact_time"]) for table, _ in tables)
    return inside and not law.JUMPS and not any(beyond for _, beyond in tables)


def _lossy_tables(scene: Scene, family: str, groups: dict[str, float]) -> list[tuple[Table, bool]]:
    """Of a law that loses energy, those measured with a little less and a little more of it, and whether the scene
    loses more than any; none for elastic impacts.
    """
    law = scene.contact
    if law.PLASTIC and groups["impact_parameter"] > 1.0:
        name, losses, here = "plastic-linear", LOSSES["plastic-linear"], groups["impact_parameter"]
    elif isinstance(law, Damped):
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
            yield Candidate(name, changes | _elastic(scene), own + yielding, contact="elastic")
            yield Candidate(name, changes, own, contact="elastoplastic")
            continue
        yield Candidate(name, changes, own)  # neither an impulse nor the structure alone knows of yield: so measured
    if scene.target.bends:
        yield from _beam_candidates(scene, family, number, groups, tolerance)
        return
    if yielding is not None:
        yield Candidate("waves", {"method": {"name": "waves"}} | _elastic(scene), yielding, contact="elastic")
    contact = None if yielding is None else "elastoplastic"
    yield Candidate("waves", {"method": {"name": "waves"}}, 0.0, contact=contact)


def _beam_candidates(scene: Scene, family: str, number: int, groups: dict, tolerance: float) -> Iterator[Candidate]:
    theory = float(theory_table(family).around(groups["slenderness"], groups["contact_time"])[number])
    yielding = _elastic_error(scene, number, groups)
    for name, missed in (("euler-bernoulli", theory), ("timoshenko", 0.0)):
        for elastic in (True, False) if yielding is not None else (False,):
            more = missed + (yielding or 0.0) * elastic
            count, error = _modes_needed(family, number, groups, max(tolerance - more, 0.0), scene.contact.NAME)
            changes = {"target.theory": name, "method": {"name": "modal", "modes": count}}
            contact = None if yielding is None else "elastic" if elastic else "elastoplastic"
            changes |= _elastic(scene) if elastic else {}
            yield Candidate("modal", changes, error + more, modes=count, theory=name, contact=contact)


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
        return int([*counts, SWEEP_MODES][good[0] + 1]), float(errors[good[0]])
    return max(int(counts[-1]), SWEEP_MODES), float(errors[-1])


def _elastic_error(scene: Scene, number: int, groups: dict[str, float]) -> float | Any:
    """What an elastic law misses of this plastic one, from impacts of two compact bodies; None for other laws."""
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


# --- why ------------------------------------------------------------------------------------------------------------


def _with_reason(found: Plan, smaller: list[Candidate]) -> Plan:
    chosen, groups = found.chosen, found.groups
    predicting = [candidate for candidate in smaller if math.isfinite(candidate.expected_error)]
    closest = min(predicting, key=lambda candidate: candidate.expected_error, default=None)
    why = Note(
        "plan-reason",
        Severity.REMARK if chosen.expected_error <= found.tolerance else Severity.WARNING,
        ratio=groups["mass_ratio"],
        lasting=groups["contact_time"] > 0.0,
        lasts=groups["contact_time"],
        waves=bool(found.scene.target.rods),
        cause=chosen.name,
        model=chosen.parts,
        question=found.question,
        error=_finite(chosen.expected_error),
        enough=chosen.expected_error <= found.tolerance,
        tolerance=found.tolerance,
        closest=closest and closest.parts,
        closest_error=closest and _finite(closest.expected_error),
        measured=found.measured,
    )
    return replace(found, why=why)


def _finite(error: float) -> float | None:
    return error if math.isfinite(error) else None


def _solved(scene: Scene, question: str, tolerance: float) -> Plan:
    """Each model is solved: see `is_solved`."""
    asked = QUESTIONS.index(question)

    def missed(found: Solution, true: Solution) -> float:
        both = (figures(each, question == "stresses") for each in (found, true))
        return float(errors(*both)[asked])

    candidates, reference = solved_candidates(scene, missed)
    number, better = _smallest(candidates, tolerance)
    chosen, rigid = candidates[number], [each for each in candidates if each.name in WHOLE][-1]
    body = "link" if isinstance(scene.target, Mechanism) else "pendulum" if scene.impactor.bends else "rod"
    why = Note(
        "plan-solved",
        Severity.REMARK if chosen.expected_error <= tolerance else Severity.WARNING,
        model=chosen.parts,
        question=question,
        error=_finite(chosen.expected_error),
        enough=chosen.expected_error <= tolerance,
        tolerance=tolerance,
        rigid=None if chosen is rigid else _finite(rigid.expected_error),
        modes=reference.modes,
        body=body,
    )
    groups = {"mass_ratio": float(scene.mass_ratio)} if math.isfinite(scene.mass_ratio) else {}
    return Plan(scene, question, tolerance, groups, chosen, better, candidates, why, True, None)


def _unmeasured(scene: Scene, question: str, tolerance: float) -> Plan:
    """Bodies in which nothing rings are known in closed form; for the rest, the first method that can solve them."""
    bodies = scene.impactor, scene.target
    whole = all(body.time_unit is None and body.half_swing is None and not body.endless for body in bodies)
    compact, names = scene.normal is not None or whole, FALLBACKS
    if compact:
        names = ("rigid", "quasi-static") if question == "final-velocities" else ("quasi-static", "rigid")
        if scene.contact.PLASTIC:
            names = ("quasi-static", "rigid")
    usable = [name for name in names if METHODS[name]().refusal(scene) is None]
    if not usable:
        raise SceneError("scene", scene.target.kind, allowed("solvable"))
    name = usable[0]
    options: dict[str, Any] = {"name": name}
    model = {"rigid": "rigid-impulse", "quasi-static": "local-quasi-static"}.get(name, name)
    predicts = name != "rigid" or question == "final-velocities"
    exact = compact or name == "waves"
    error = (0.0 if predicts else math.inf) if exact else math.nan
    if name == "rigid" and isinstance(scene.contact, Damped):
        options["restitution"] = scene.contact.delivered(scene.reduced_mass, scene.speed)
    chosen = Candidate(model, {"method": options}, error)
    case = "rigid" if not predicts else "compact" if compact else "other"
    bodies = {"impactor": scene.impactor.kind, "target": scene.target.kind}
    why = Note(
        "plan-beside-sweeps", Severity.REMARK, case=case, **bodies, question=question, model=chosen.parts, method=name
    )
    groups = {"mass_ratio": float(scene.mass_ratio)} if math.isfinite(scene.mass_ratio) else {}
    groups |= {} if scene.normal is None else {"rotation": scene_rotation(scene)}
    return Plan(scene, question, tolerance, groups, chosen, None, [chosen], why, False, None)
