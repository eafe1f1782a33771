"""One impact by every method, each against the exact waves or many modes: what it misses, and what it costs."""

import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from .. import validation
from ..methods import METHODS, usual_method
from ..methods.base import Method
from ..methods.fronts import RIPPLES
from ..scene import Scene
from ..scenes.library import SceneOrName, scene_of
from ..solution.motion import ResolvesForce
from ..solution.solution import ContactPeriod, Solution
from ..text.notes import Note
from ..validation import SceneError
from .reference import rebound, reference

VARIANTS: tuple[dict[str, Any], ...] = (  # shown besides every method with its defaults
    {"name": "waves", "steps": 500},
    {"name": "fe-nodal", "scheme": "central-difference"},
    {"name": "fe-nodal", "status": "frozen"},
    {"name": "fe-modal", "boundary": "consistent"},
    {"name": "balance", "restitution": 0.0},
    {"name": "balance", "restitution": 0.0, "modes": 50},
)
FORCE_SAMPLES = 20_000  # of the force, over the whole impact
TIMED = 0.3  # [s] of repeated solves at most


@dataclass(frozen=True)
class Row:
    """One method on one scene. Errors are found minus `reference`; None: the method does not know such a thing.

    A true contact is found if the method has a contact of its own that overlaps it. The error of a force is
    |found - exact| / |exact| in the L2 norm over time; that of a resolved force is of its average over the finest that
    the method can resolve. Neither is known where the reference itself ripples behind a front.
    """

    method: dict[str, Any]  # name and options, as in a scene file
    reason: Note | None = None  # why it cannot solve the scene; then all below is None
    rebound_error: float | Any = None  # of the final velocity that `rebound` gives, in approach speeds
    duration_error: float | Any = None  # of the first contact, in units of `scene.time_unit`
    contacts: int | None = None  # that it reports
    true_contacts: int | None = None
    true_contacts_found: int | None = None
    second_contact_found: bool | None = None  # None: there is no second contact
    raw_contacts: int | None = None  # before chatter was set apart from contacts; of balances every single one
    force_error: float | None = None
    resolved_force_error: float | None = None
    wall_time: float | None = None  # of a whole solve, kernels compiled, median of repeats [s]

    @property
    def label(self) -> str:
        """Name of the method with the options that are not the usual ones."""
        usual = METHODS[self.method["name"]].read({}).table()
        options = [f"{key}={value}" for key, value in self.method.items() if value not in (usual[key], None)]
        return " ".join([self.method["name"], *options])

    def table(self) -> dict[str, Any]:
        return asdict(self) | {"reason": self.reason and str(self.reason)}


class Comparison(list[Row]):
    """The rows of a comparison, with the solution that all are compared with; printed as a table."""

    def __init__(self, exact: Solution, rows: Iterable[Row]):
        super().__init__(rows)
        self.exact = exact

    @property
    def rebound(self) -> float:
        """The final velocity [m/s] that errors are those of."""
        return rebound(self.exact)

    def __str__(self) -> str:
        from ..notebook import tables

        return tables.comparison(self)

    def _repr_html_(self) -> str:
        from ..notebook import cards

        return cards.comparison_card(self)


def compare(
    scene: SceneOrName,
    methods: Sequence[str | Method] | None = None,
    repeats: int = 5,
    duration: float | None = None,
) -> Comparison:
    """Every method on one scene, with its usual resolution, or with the one that the scene gives; or those named.

    duration: of every solve [s]; else until the bodies have parted by that method.
    Raises SceneNotSupported where not even `reference` has a solution.
    """
    scene = scene_of(scene)
    exact = reference(scene)
    if methods is None:
        chosen = chosen_methods(scene)
    else:
        chosen = [given if isinstance(given, Method) else _named(given) for given in methods]
    return Comparison(exact, [_row(scene, exact, method, repeats, duration) for method in chosen])


def _named(name: str) -> Method:
    return METHODS[validation.choice("methods", name, METHODS)].read({})


def chosen_methods(scene: Scene) -> list[Method]:
    """All methods and their variants, each with its usual options or, where the scene names it, with those given."""
    options = {key: value for key, value in scene.method.items() if key not in ("name", "duration")}
    named = scene.method.get("name") or usual_method(scene)
    usual = [method.read(options if name == named else {}) for name, method in METHODS.items()]
    variants = [METHODS[table["name"]].read({key: table[key] for key in table if key != "name"}) for table in VARIANTS]
    chosen = usual + [variant for variant in variants if variant not in usual]
    return sorted(chosen, key=lambda method: list(METHODS).index(method.NAME))


def _row(scene: Scene, exact: Solution, method: Method, repeats: int, duration: float | None) -> Row:
    try:
        found = method.solve(scene, duration)
    except SceneError as refusal:
        return Row(method.table(), reason=method.refusal(scene) or refusal.note)
    seen = overlapping(exact.contacts, found.contacts)
    first, true = (solution.contacts[0].end if solution.contacts else 0.0 for solution in (found, exact))
    resolved = found.motion.resolved_force if isinstance(found.motion, ResolvesForce) else None
    counted = found.diagnostics.get("balances", len(found.contacts))
    until = max(contact.end for contact in [*exact.contacts, *found.contacts])
    instant = any(contact.peak_force is None for contact in [*exact.contacts, *found.contacts])
    unknown = instant or any(note.code in RIPPLES for note in exact.notes)
    return Row(
        method=found.method,
        rebound_error=(rebound(found) - rebound(exact)) / scene.speed,
        duration_error=(first - true) / scene.time_unit,
        contacts=len(found.contacts),
        true_contacts=len(exact.contacts),
        true_contacts_found=sum(seen),
        second_contact_found=seen[1] if len(seen) > 1 else None,
        raw_contacts=found.diagnostics.get("raw_contacts", counted),
        force_error=None if unknown else force_error(exact, until, _until_the_end(found, found.known_motion.force)),
        resolved_force_error=(
            None if unknown or resolved is None else force_error(exact, until, _until_the_end(found, resolved))
        ),
        wall_time=_wall_time(lambda: method.solve(scene, duration).complete(), repeats),
    )


def overlapping(true: Sequence[ContactPeriod], found: Sequence[ContactPeriod]) -> list[bool]:
    """For each true contact, whether a found one overlaps it that is not already an earlier one's."""
    seen, rest = [], list(found)
    for contact in true:
        match = next((own for own in rest if own.start <= contact.end and own.end >= contact.start), None)
        seen.append(match is not None)
        if match is not None:
            rest = rest[rest.index(match) + 1 :]
    return seen


def force_error(exact: Solution, until: float, force: Callable[[np.ndarray], np.ndarray]) -> float | None:
    """Relative L2 error of a force history up to a time [s]; None where the true one is an impulse without duration."""
    time = (np.arange(FORCE_SAMPLES) + 0.5) * until / FORCE_SAMPLES
    true = _until_the_end(exact, exact.known_motion.force)(time)
    size = float(np.linalg.norm(true))
    return float(np.linalg.norm(force(time) - true)) / size if size else None


def _until_the_end(solution: Solution, force: Callable[[np.ndarray], np.ndarray]) -> Callable[[np.ndarray], np.ndarray]:
    """After the end of a solution there is no force."""
    return lambda time: np.where(time < solution.duration, force(time), 0.0)


def _wall_time(work: Callable[[], object], repeats: int) -> float:
    begun, times = time.perf_counter(), []
    while len(times) < repeats and (not times or time.perf_counter() - begun < TIMED):
        before = time.perf_counter()
        work()
        times.append(time.perf_counter() - before)
    return float(np.median(times))
