"""How far to trust an impact: the same one many times, each with a slightly different mass."""

import math
import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import validation
from ..methods import METHODS, FeModal, FeNodal, Modal
from ..methods.base import Method, SceneNotSupported
from ..methods.modal.march import again
from ..methods.modal.motion import ModalMotion
from ..numerics.processors import all_processors
from ..scene import Scene
from ..scenes.library import SceneOrName, scene_of
from ..solution.motion import Motion
from ..solution.solution import ContactPeriod, Solution
from ..solve import read_method
from ..text.notes import Note, Severity, coded
from ..validation import SceneError, allowed
from .sensitivity import FIGURES, Band, Spread, band_of, ill_conditioned, plain, spread_table, summary

if TYPE_CHECKING:
    from ..notebook.plots import Drawn

LEAST_RUNS, MOST_RUNS = 10, 10_000
SPREAD_RANGE = (1e-9, 0.3)
DECADES = 4.0  # that the perturbations span, downwards from the largest
BAND_INTERVALS = 800  # intervals of the bands


@dataclass(frozen=True, repr=False)
class Ensemble:
    """Many impacts that differ a little: figures of each, bands of histories, and what can be trusted.

    Arrays (runs,) in SI units, NaN where a figure does not exist; bands over `time` (instants,). The force is a mean
    over the interval between two instants, so that it keeps the impulse however short the peaks are.
    """

    key: str
    method: dict[str, Any]
    perturbations: np.ndarray  # relative, ascending
    first_parting: np.ndarray
    final_velocity: np.ndarray
    impulse: np.ndarray
    contacts: np.ndarray
    last_parting: np.ndarray
    contact_time: np.ndarray  # real: the sum of all contacts
    peak_force: np.ndarray
    peak_indentation: np.ndarray
    residual_indentation: np.ndarray
    dissipated: np.ndarray
    time: np.ndarray
    force: Band
    struck_position: Band  # of the struck face of the target
    impactor_velocity: Band
    spread: list[Spread]
    ill_conditioned: bool
    summary: Note  # cause and remedy, or why it can be trusted
    notes: list[Note]
    wall_time: float
    title: str = ""  # of the scene

    def dataset(self) -> Any:
        """An xarray.Dataset with units: figures over `change`, and bands over `time`, in which `lowest`,
        `low`, `median`, `high` and `highest` follow each other along `band`.

        Raises ImportError without the extra `notebook`.
        """
        from ..notebook import datasets  # loads xarray, which nothing else here needs

        return datasets.ensemble(self, FIGURES)

    def plot(self, what: str = "force") -> "Drawn":
        """A HoloViews object: bands of `force`, `struck_position` or `impactor_velocity` over time, in which all runs
        lie, and nine tenths of them; or a figure such as `final_velocity` over the changes.

        Raises SceneError for another word.
        """
        from ..notebook import plots  # loads HoloViews, which nothing else here needs

        return plots.ensemble(self, what, FIGURES)

    def __str__(self) -> str:
        from ..notebook import tables

        return tables.ensemble(self)

    def __repr__(self) -> str:
        return f"<Ensemble of {self.title[:60]!r} by {self.method['name']}: {self.perturbations.size} runs>"

    def _repr_html_(self) -> str:
        from ..notebook import cards

        return cards.ensemble_card(self)

    def table(self) -> dict[str, Any]:
        """As plain lists and numbers."""
        said = {"told": str(self.summary), "summary_code": self.summary.table()}
        known = asdict(self)
        del known["title"]
        return plain(known) | {"summary": str(self.summary)} | said | coded(self.notes)


def ensemble(
    scene: SceneOrName,
    method: str | Method | None = None,
    runs: int = 200,
    spread: float = 1e-2,
    key: str | None = None,
    seed: int = 0,
    progress: Callable[[int, int], None] | None = None,
    cancel: Callable[[], bool] | None = None,
) -> Ensemble:
    """The impact repeated with one number of the scene changed by up to `spread` of itself, either way.

    The magnitudes are spread evenly over the logarithm, four decades downwards from `spread`, at random within equal
    shares and with both signs in turn: so the runs distinguish a figure that follows the change in proportion from
    one that jumps at the least touch. Verdicts: "firm", where no change of the figure is more than FIRM times its
    cause; else "loose", where it stays within LOOSE in all, or jumps under changes beyond a tenth of `spread` only;
    else "not to be trusted".
    `key`: what is changed, by default the impactor's mass, or the length of an impactor that can bend. All runs have
    the duration of the unperturbed one, and its steps where the method marches. `method`: the scene's own by default,
    but finite elements leave the runs to `modal` where that knows the scene. `progress(done, runs)` is called from the
    threads that solve. `cancel()` true: runs that have not begun are left out, and a note says how many; fewer than
    10 show nothing and are refused.
    Error: what changes by less than 1e-5 may be the method's own steps.
    Cost: the solves on all processors; `modal` with a rigid impactor runs its bare kernel.
    """
    begun, scene = time.perf_counter(), scene_of(scene)
    runs = validation.whole_number("runs", runs, LEAST_RUNS, MOST_RUNS)
    spread = validation.number("spread", spread, *SPREAD_RANGE)
    seed = validation.whole_number("seed", seed, 0, 2**32 - 1)
    if scene.normal is not None or scene.prescribed_force:
        raise SceneNotSupported("scene", scene.title, allowed("two-on-axis"))
    key = key or _usual_key(scene)
    chosen, duration, notes = _method(scene, method)
    changes = perturbations(runs, spread, seed)
    scenes = _changed(scene, key, changes)  # all before any is solved
    base = chosen.solve(scene, duration)
    instants = np.linspace(0.0, base.duration, BAND_INTERVALS + 1)
    found: list[Any] = _Runs(base, chosen, instants, _lean(scene, chosen, key), cancel).solve(scenes, progress)
    done = [run is not None for run in found]
    changes, found = changes[done], [run for run in found if run is not None]
    figures = {name: np.array([row[i] for row, _ in found]) for i, name in enumerate(FIGURES)}
    table = spread_table(_figures(base), figures, changes, _scales(scene, base))
    notes += [*_left_out(len(found), runs), *_late(figures["last_parting"], base.duration)]
    force, struck_position, impactor_velocity = (band_of([histories[i] for _, histories in found]) for i in range(3))
    return Ensemble(
        key,
        chosen.table(),
        changes,
        **figures,
        time=instants,
        force=force,
        struck_position=struck_position,
        impactor_velocity=impactor_velocity,
        spread=table,
        ill_conditioned=ill_conditioned(table),
        summary=summary(scene, key, spread, table, ill_conditioned(table)),
        notes=notes,
        wall_time=time.perf_counter() - begun,
        title=scene.title,
    )


def perturbations(runs: int, spread: float, seed: int = 0) -> np.ndarray:
    """Relative changes (runs,), ascending: one in each equal share of the logarithm of its size, signs in turn."""
    shares = (np.arange(runs) + np.random.default_rng(seed).random(runs)) / runs
    sizes = spread * 10.0 ** (-DECADES * shares)
    return np.sort(np.where(np.arange(runs) % 2 == 0, sizes, -sizes))


def _usual_key(scene: Scene) -> str:
    """What is changed where nothing is named."""
    name, body = ("impactor", scene.impactor) if scene.struck is scene else ("target", scene.target)
    return f"{name}.{next(iter(body.of_mass(body.mass)), 'length')}"


def _left_out(done: int, runs: int) -> list[Note]:
    """That runs were cancelled; too few that are done are refused."""
    if done == runs:
        return []
    validation.whole_number("runs", done, LEAST_RUNS, runs)
    return [Note("runs-left-out", Severity.WARNING, done=done, runs=runs)]


def _late(last_parting: np.ndarray, duration: float) -> list[Note]:
    """That some runs have not ended by the end of the time that is solved."""
    late = int(np.sum(last_parting >= duration * (1.0 - 1e-12)))
    said = {"late": late, "runs": last_parting.size, "duration": duration}
    return [Note("runs-still-touching", Severity.WARNING, **said)] if late else []


def _method(scene: Scene, given: str | Method | None) -> tuple[Method, float | None, list[Note]]:
    """The method without its estimate of the error, which costs as much again; the duration; what must be said."""
    named, duration = read_method(scene.method, scene)  # of bodies on an axis
    notes = []
    if isinstance(given, Method):
        named = given
    elif given is not None and given != named.NAME:
        named = METHODS[validation.choice("method.name", given, METHODS)].read({})
    elif given is None and isinstance(named, (FeNodal, FeModal)) and Modal().refusal(scene) is None:
        notes.append(Note("runs-by-modal", Severity.REMARK, method=named.NAME))
        named = Modal()
    return named.without_estimate(), duration, notes


def _changed(scene: Scene, key: str, changes: np.ndarray) -> list[Scene]:
    """The scene with each relative change of one of its numbers."""
    value = _value(scene, key)
    return [scene.replace({key: value * (1.0 + change)}) for change in changes.tolist()]


def _value(scene: Scene, key: str) -> float:
    """The number of the scene that is changed."""
    found: Any = scene.table()
    for name in key.split("."):
        found = found.get(name) if isinstance(found, Mapping) else None
    if isinstance(found, bool) or not isinstance(found, (int, float)) or found == 0.0:
        raise SceneError("key", key, allowed("perturbed-number"))
    if isinstance(found, int):
        raise SceneError("key", key, allowed("perturbed-real"))
    return float(found)


def _lean(scene: Scene, method: Method, key: str) -> bool:
    """Whether a run differs from the unperturbed one by its impactor and law alone, so that nothing is built twice."""
    if scene.struck.at_contact is not scene:  # a mechanism
        return False
    rigid_impactor = not scene.impactor.modes(1).frequencies.size
    return isinstance(method, Modal) and rigid_impactor and key.partition(".")[0] in ("impactor", "contact")


class _Runs:
    """All runs of an ensemble, on as many threads as there are processors; kernels run side by side."""

    def __init__(
        self, base: Solution, method: Method, instants: np.ndarray, lean: bool, cancel: Callable[[], bool] | None
    ):
        self.cancelled = cancel or (lambda: False)
        self.base, self.method, self.instants, self.lean = base, method, instants, lean
        self.own = threading.local()  # of each thread: the record that its runs write over
        self.done = 0
        self.counting = threading.Lock()

    def solve(self, scenes: list[Scene], progress: Callable[[int, int], None] | None) -> list[tuple | None]:
        """Of each scene its figures and histories, or None; large and small changes in turn, until it is cancelled."""
        order = np.random.default_rng(0).permutation(len(scenes)).tolist()

        def run(scene: Scene) -> tuple | None:
            if self.cancelled():
                return None
            found = self._lean_run(scene) if self.lean else self._run(scene)
            with self.counting:
                self.done += 1
                if progress is not None:
                    progress(self.done, len(scenes))
            return found

        with all_processors() as pool:
            found = dict(zip(order, pool.map(run, [scenes[number] for number in order]), strict=True))
        return [found[number] for number in range(len(scenes))]

    def _run(self, scene: Scene) -> tuple:
        solution = self.method.solve(scene, self.base.duration)
        assert solution.motion is not None
        return tuple(_figures(solution).values()), self._histories(solution.motion)

    def _lean_run(self, scene: Scene) -> tuple:
        assert isinstance(self.base.motion, ModalMotion)
        motion, self.own.record = again(self.base.motion, scene, getattr(self.own, "record", None))
        contacts, record, law = motion.contacts(), motion.record, scene.contact
        depth = math.nan if scene.rigid_contact else float(record.indentation.max())
        figures = (
            *_of_contacts(contacts),
            max(contact.peak_force for contact in contacts),
            depth,
            math.nan if math.isnan(depth) else float(law.dent(depth)),
            float(motion.energies(self.instants[-1:])["dissipated"][0]),
        )
        impulse = motion.impulse(self.instants[-1:])[0]
        return (figures[0], float(record.velocity[-1]), impulse, *figures[1:]), self._histories(motion)

    def _histories(self, motion: Motion) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Force, position of the struck face, velocity of the impactor at the instants."""
        middles = 0.5 * (self.instants[1:] + self.instants[:-1])
        edges = np.concatenate((self.instants[:1], middles, self.instants[-1:]))
        force = np.diff(motion.impulse(edges)) / np.diff(edges)
        return force, motion.end_position(self.instants), motion.impactor_velocity(self.instants)


def _of_contacts(contacts: list[ContactPeriod]) -> tuple[float, float, float, float]:
    """First parting, number, last parting, real contact time."""
    return contacts[0].end, len(contacts), contacts[-1].end, sum(contact.duration for contact in contacts)


def _figures(solution: Solution) -> dict[str, float]:
    """The figures of one run, NaN where one does not exist."""
    first, number, last, real = _of_contacts(solution.contacts)
    given = {
        "first_parting": first,
        "final_velocity": solution.impactor_velocity,
        "impulse": solution.impulse,
        "contacts": number,
        "last_parting": last,
        "contact_time": real,
        "peak_force": solution.peak_force,
        "peak_indentation": solution.peak_indentation,
        "residual_indentation": solution.residual_indentation,
        "dissipated": solution.energy["dissipated"],
    }
    return {name: math.nan if value is None else value for name, value in given.items()}


def _scales(scene: Scene, base: Solution) -> dict[str, float]:
    """What changes are measured by, where that is not the figure itself."""
    return {
        "final_velocity": scene.speed,
        "residual_indentation": base.peak_indentation or math.nan,
        "dissipated": scene.initial_energy,
    }
