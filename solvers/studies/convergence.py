"""What more modes, elements or steps do to each figure of an impact: whether it converges, and how fast.

Of repeated balances also what a restitution at each of them does.
"""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ..bodies import Mechanism, Rod
from ..bodies.linkage.links import GROUND
from ..methods import METHODS
from ..methods.base import Method
from ..methods.grazing import one_front
from ..numerics.processors import all_processors
from ..scene import Scene
from ..scenes.library import SceneOrName, scene_of
from ..solution.motion import Balances, Bends
from ..solution.solution import Solution
from ..text.notes import Note
from .levels import Levels, levels_of
from .orders import WHOLES, orders_of, rate
from .sensitivity import plain

if TYPE_CHECKING:
    from ..notebook.plots import Drawn

INSTANTS, PLACES = 2_000, 41  # at which largest values of fields are looked for


@dataclass(frozen=True, repr=False)
class Convergence:
    """One figure per count of modes or elements, and what becomes of it; arrays (counts,), SI units.

    `differences` are those to the finest count, relative to the largest value, for velocities to the speed of approach,
    for the energy lost to the initial energy and for the impulse at a joint to that of the contact. `order` p: the
    differences fall as counts^-p; None where they do not, where p is above what the method has, where there are fewer
    than four levels, of the peak stress of a rod, and of a rigid contact with what bends, where there is none: a change
    of a mass in its last digits makes another rebound. `reference`: the
    method that gives the impact without balances, and `reference_values` its figures: exact waves of a mass on a rod,
    rigid links of a mechanism.
    """

    method: str
    kind: str  # "modes", "elements", "step" or "restitution"
    counts: np.ndarray  # or steps [s], or restitutions
    units: dict[str, str]
    values: dict[str, np.ndarray]
    differences: dict[str, np.ndarray]
    order: dict[str, float | None]
    summary: dict[str, Note]
    wall_time: float
    reference: str | None = None
    reference_values: dict[str, float] | None = None
    title: str = ""  # of the scene

    def dataset(self) -> Any:
        """An xarray.Dataset with units: values over what is varied (`modes`, `elements`, `step` or `restitution`),
        with what becomes of each and its order, if it has one; and as `NAME_difference` the differences to the last.

        Raises ImportError without the extra `notebook`.
        """
        from ..notebook import datasets  # loads xarray, which nothing else here needs

        return datasets.convergence(self)

    def plot(self, what: str = "differences") -> "Drawn":
        """A HoloViews object over the counts: all `differences` to the finest, or the values of one figure.

        Raises SceneError for another word.
        """
        from ..notebook import plots  # loads HoloViews, which nothing else here needs

        return plots.convergence(self, what)

    def __str__(self) -> str:
        from ..notebook import tables

        return tables.convergence(self)

    def __repr__(self) -> str:
        return f"<Convergence of {self.title[:60]!r} by {self.method}: {self.counts.size} levels>"

    def _repr_html_(self) -> str:
        from ..notebook import cards

        return cards.convergence_card(self)

    def table(self) -> dict[str, Any]:
        """As plain lists and numbers."""
        table = plain({option.name: getattr(self, option.name) for option in fields(self) if option.name != "title"})
        words = {name: f"{name.replace('_', ' ')}: {note}" for name, note in self.summary.items()}
        codes = {name: note.table() for name, note in self.summary.items()}
        if self.reference is None:
            del table["reference"], table["reference_values"]
        return table | {"summary": words, "told": words, "summary_codes": codes}


def convergence(
    scene: SceneOrName,
    modes: Sequence[int] | None = None,
    method: str | Method | None = None,
    *,
    elements: Sequence[int] | None = None,
    steps: Sequence[float] | None = None,
    restitutions: Sequence[float] | None = None,
) -> Convergence:
    """The impact solved with each of these numbers of `modes`, or of `elements`.

    `method`: usually "modal"; with `elements` the scene's own if it has any, else "fe-nodal". Where a method is finer
    by elements, `modes` are numbers of elements too, as older scripts ask for them. Of repeated balances also with
    each of these `steps` [s], which fall, or `restitutions`, which fall as well. Bodies that say themselves how many
    modes they have, links and pendulums that bend, are given as many.
    All are followed for as long as the finest one; balances until the bodies part for good. What is compared: velocity
    and impulse, peak force, first parting, contacts, deepest position of the struck point, energy lost, and of the
    fields the largest shear force of a beam, of a rod the largest stress: where it is held, and anywhere. Of balances
    their number, the mean jump of the impactor's velocity, its velocity after the first contact, the share of the
    energy that is lost, and the sums of the sudden impulses at the joint of the struck link.
    Error: peaks of fields are sampled at 2 000 instants.
    Cost: the solves, side by side on all processors.
    Source: thesis tables 6.2 to 6.6 and 6.8.
    """
    scene = scene_of(scene)
    begun = time.perf_counter()
    levels = levels_of(scene, method, modes, {"elements": elements, "step": steps, "restitution": restitutions})
    kind = levels.kind
    finest, rows = _solve_all(levels)
    reference, beside = _reference(scene, levels)
    numbers = np.array(levels.values, float)
    values = {name: np.array([row[name] for row in rows]) for name in rows[-1]}
    values = {name: column for name, column in values.items() if np.isfinite(column).all() and column.any()}
    largest = {name: float(np.abs(column).max()) for name, column in values.items()}
    wholes = {"speed": scene.speed, "energy": scene.initial_energy, "impulse": largest.get("impulse", math.nan)}
    scales = {name: wholes.get(WHOLES.get(name, ""), largest[name]) for name in values}
    if "energy_lost_share" in values:
        scales["energy_lost_share"] = 100.0
    steps_taken = finest.duration / numbers if kind == "step" else numbers
    chaotic, known = scene.rigid_contact and scene.bends, orders_of(scene, kind)
    rated = {
        name: rate(name, steps_taken, column, scales[name], kind, known, chaotic) for name, column in values.items()
    }
    return Convergence(
        method=levels.method.NAME,
        kind=kind,
        counts=np.array(levels.values),
        units={name: UNITS[name] for name in values},
        values=values,
        differences={name: found[0] for name, found in rated.items()},
        order={name: found[1] for name, found in rated.items()},
        summary={name: found[2] for name, found in rated.items()},
        wall_time=time.perf_counter() - begun,
        title=scene.title,
        reference=reference,
        reference_values=beside and {name: value for name, value in beside.items() if name in values},
    )


UNITS = {
    "final_velocity": "m/s",
    "first_velocity": "m/s",
    "balances": "",
    "mean_jump": "m/s",
    "energy_lost_share": "%",
    "joint_impulse": "N s",
    "joint_moment_impulse": "N m s",
    "impulse": "N s",
    "peak_force": "N",
    "contacts": "",
    "first_parting": "s",
    "last_parting": "s",
    "peak_deflection": "m",
    "support_shear": "N",
    "peak_shear": "N",
    "support_stress": "Pa",
    "peak_stress": "Pa",
    "energy_lost": "J",
}


def _solve_all(levels: Levels) -> tuple[Solution, list[dict[str, float]]]:
    """The last solution, and the figures of all."""
    finest = _solved(levels.each[-1], levels.duration)
    duration = levels.duration if isinstance(finest.motion, Balances) else finest.duration
    with all_processors() as pool:
        others = list(pool.map(lambda level: _solved(level, duration), levels.each[:-1]))
        return finest, list(pool.map(_figures, [*others, finest]))


def _reference(scene: Scene, levels: Levels) -> tuple[str | None, dict[str, float] | None]:
    """What balances are compared with: its method and its figures."""
    target = scene.target
    if levels.method.NAME != "balance":
        return None, None
    if isinstance(target, Mechanism) and target.flexible and scene.rigid_contact and levels.kind != "restitution":
        rigid = METHODS["rigid"].read({"restitution": getattr(levels.method, "restitution", 1.0)})
        solution = rigid.solve(replace(scene, target=target.with_rigid_links, given={}))
    elif one_front(scene):
        solution = METHODS["waves"].read({}).without_estimate().solve(scene)
    else:
        return None, None
    found = _figures(solution)
    return solution.method["name"], {name: value for name, value in found.items() if math.isfinite(value)}


def _solved(level: tuple[Method, Scene], duration: float | None) -> Solution:
    method, scene = level
    return method.solve(scene, duration)


def _figures(solution: Solution) -> dict[str, float]:
    """What is compared, NaN where it does not exist."""
    given: dict[str, float | None] = {
        "final_velocity": solution.impactor_velocity,
        "impulse": solution.impulse,
        "peak_force": solution.peak_force,
        "contacts": len(solution.contacts),
        "first_parting": solution.contacts[0].end,
        "last_parting": solution.contacts[-1].end,
        "energy_lost": solution.energy["dissipated"],
    }
    target, motion = solution.scene.target, solution.known_motion
    if isinstance(motion, Balances) or solution.method["name"] in ("rigid", "waves"):
        given |= _of_balances(solution)
    instants = np.linspace(0.0, solution.duration, INSTANTS + 1)
    given["peak_deflection"] = float(motion.end_position(instants).max())
    if target.bends or isinstance(target, Rod):
        name, held, of = "stress", PLACES - 1, motion.stress
        if target.bends and isinstance(motion, Bends):
            name, held, of = "shear", 0, motion.shear
        field = np.abs(of(instants, np.linspace(0.0, target.length, PLACES)))
        given[f"peak_{name}"] = float(field.max())
        given[f"support_{name}"] = float(field[:, held].max()) if target.held else None
    return {name: math.nan if (value := given.get(name)) is None else value for name in UNITS}


def _of_balances(solution: Solution) -> dict[str, float | None]:
    """What thesis 6.4 tells of repeated balances; one impulse of rigid bodies is one of them."""
    scene, motion, found = solution.scene, solution.known_motion, {}
    found["energy_lost_share"] = 100.0 * solution.energy["dissipated"] / scene.initial_energy
    if scene.target.rods and scene.impactor.free_mass:
        end = min(solution.contacts[0].end, solution.duration)
        found["first_velocity"] = float(motion.impactor_velocity(np.array([end]))[0])
    if solution.method["name"] == "waves":
        return found
    found["balances"] = motion.impulses[1].size if isinstance(motion, Balances) else len(solution.contacts)
    if scene.impactor.free_mass:
        found["mean_jump"] = abs(solution.impulse) / scene.impactor.mass / found["balances"]
    if solution.reactions and isinstance(scene.target, Mechanism):
        held = [GROUND in joint.links for joint in scene.target.joints]
        joints = [scene.target.struck.link in joint.links for joint in scene.target.joints]
        both = [a and b for a, b in zip(held, joints, strict=True)]
        reaction = solution.reactions[(both if any(both) else joints).index(True)]
        found["joint_impulse"] = math.hypot(*reaction["impulse"])
        found["joint_moment_impulse"] = abs(reaction["moment_impulse"])
    return found
