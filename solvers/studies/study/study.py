"""One scene over many values of its keys, as labelled arrays that say where they come from."""

import json
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from ... import validation
from ...methods.base import Method, never
from ...numerics.processors import MOST, processors
from ...provenance import version
from ...scenes.library import SceneOrName, as_given, scene_of
from ...validation import SceneError, allowed
from ..figures import FIGURES, asked_for
from ..varied import unit_of
from .crew import Crew, crew_of, solved
from .design import Design, design_of
from .parts import Held, Parts, left_of, same_study
from .work import Work

LOOKED_AT = 33  # points before any is solved
ENDINGS = {".nc": "", ".zarr": "zarr", ".parquet": "pyarrow", ".csv": ""}  # with the package that each needs


@dataclass(frozen=True)
class Progress:
    """How far a study is."""

    done: int  # points, those of before among them
    resumed: int  # that were there already
    points: int  # in all
    seconds: float  # since it has begun

    @property
    def left(self) -> float | None:
        """Seconds that the rest will take, as it goes; None before it is known."""
        fresh = self.done - self.resumed
        return (self.points - self.done) * self.seconds / fresh if fresh else None


def study(
    scene: SceneOrName,
    vary: Mapping[Any, Any],
    *,
    sample: str | None = None,
    points: int | None = None,
    seed: int = 0,
    method: str | Method | None = None,
    figures: Sequence[str] | None = None,
    notes: bool = True,
    out: str | Path | None = None,
    resume: bool = False,
    workers: int | None = None,
    cluster: Any = None,
    progress: Callable[[Progress], Any] | None = None,
    cancelled: Callable[[], bool] = never,
) -> Any:
    """The figures of a scene at many points of its values, as an xarray.Dataset.

    `vary`: by key an array or list of numbers or words, "LOW..HIGH:COUNT[:log]", or a distribution to draw from:
    "normal(mean, deviation)", "uniform", "loguniform", "triangular(low, mode, high)", "lognormal(median, deviation)",
    "5%" about the scene's own value, or a frozen one of `scipy.stats`. Keys with commas between them are varied
    together. Any key of a scene file: bodies, materials, laws, methods. `sample`: "grid", each with each; or `points`
    of them "random", "lhs" (the usual one) or "sobol", from `seed` on.
    Variables: `figures` (those of `Figures` that cost nothing, unless they are named), NaN where there is none;
    `refused`, the code of a refusal, and `reason`, its sentence; `notes`, codes with spaces between; `notes=False`:
    they are not looked for, and a rigid mass on one rod takes 20 microseconds. Dimensions: the keys, or `point`.
    Attributes: what makes another study of it. No point is left out, whatever it raises, or if it ends its process.
    `out`: a file .nc, .zarr, .parquet or .csv; what is done is kept beside it in `OUT.parts`, from where it goes on
    with `resume`. `workers`: processes, one on each processor unless it says otherwise; or `cluster`: of Dask,
    "tcp://HOST:PORT", "local:N" or a `distributed.Client`. No result hangs on who solves it. `cancelled()` true: what
    is left is refused as "not-solved". At most 1e7 points; of a grid in .zarr, which is written by region as it is
    solved and beyond 1e6 points read as it is asked for, 1e10. Raises SceneError naming what cannot be: ranges, files
    of another study, clusters; OSError where nothing can be written; ImportError without the extra `notebook`.
    """
    from ...notebook import datasets  # loads xarray, which nothing else here needs

    scene = scene_of(scene)
    path = None if out is None else file_of(out)
    design = design_of(scene, vary, sample, points, seed, path is not None and path.suffix == ".zarr")
    names = asked_for(figures)
    work = Work(scene, design.keys, names, method, notes)
    if resume and path is None:
        raise SceneError("resume", True, allowed("with-file"))
    none_allowed(work, design)
    about, crew = _about(work, design), _crew(workers, cluster, design.size)
    if path is not None and path.exists():
        same_study(datasets.study_in(path), about, str(path)) if resume else _refuse(path)
        if progress is not None:
            progress(Progress(design.size, design.size, design.size, 0.0))
        return datasets.read_study(path)
    parts = _parts(work, design, about, path)
    with closing(crew()) as solving:
        parts.begin(about, resume)
        _finish(work, design, parts, solving, cancelled, progress)
    return _written(work, design, parts, about, path)


def _written(work: Work, design: Design, parts: Any, about: dict[str, Any], path: Path | None) -> Any:
    """The Dataset of all that is there; in its file, if there is one, once it is whole."""
    from ...notebook import datasets

    whole = not left_of(design.size, parts.spans())
    if path is not None and path.suffix == ".zarr":
        return datasets.held_study(parts.finish(path, whole))
    found = _dataset(work, design, parts, about)
    if path is not None and whole:
        datasets.write_study(found, path)
        parts.end()
    return found


def _parts(work: Work, design: Design, about: dict[str, Any], path: Path | None) -> Any:
    """Where what is done is kept: in memory, in files beside the one that all will be in, or in that itself."""
    if path is None:
        return Held()
    folder = path.with_name(f"{path.name}.parts")
    if path.suffix != ".zarr":
        return Parts(folder)
    from ...notebook.datasets import begin_store
    from .stored import Regions

    kinds, units = _units(work, design)

    def create(store: Path, blocks: Any) -> None:
        begin_store(store, design, blocks, kinds, units, about)

    return Regions(folder, work, design, create)


def _units(work: Work, design: Design) -> tuple[dict[str, str], dict[str, str]]:
    """Of figures, and of keys, by name."""
    return {name: FIGURES[name][0] for name in work.figures}, {key: unit_of(work.scene, key) for key in design.keys}


def none_allowed(work: Work, design: Design) -> None:
    """Raises SceneError, that of the first, where none of some points all over the design can be solved, as when a key
    is misspelt."""
    first: SceneError | None = None
    for point in sorted({round(share * (design.size - 1)) for share in np.linspace(0.0, 1.0, LOOKED_AT)}):
        try:
            work.allow(design.rows(point, point + 1)[0])
        except SceneError as refused:
            first = first or refused
        else:
            return
    assert first is not None
    raise first


def crew_size(workers: int | None) -> int:
    """How many processes: one on each processor unless it is given. Raises SceneError for what is no such number."""
    return processors() if workers is None else validation.whole_number("workers", workers, 1, MOST)


def points_of(work: Work, design: Design, workers: int, progress: Callable[[Progress], Any] | None = None) -> Any:
    """The Dataset of a design, all of it solved, in memory alone."""
    parts = Held()
    with closing(crew_of(min(workers, design.size))) as crew:
        _finish(work, design, parts, crew, never, progress)
    return _dataset(work, design, parts, _about(work, design))


def _dataset(work: Work, design: Design, parts: Parts | Held, about: dict[str, Any]) -> Any:
    from ...notebook import datasets

    return datasets.study(design, parts.read(), *_units(work, design), about)


def _finish(
    work: Work,
    design: Design,
    parts: Any,
    crew: Crew,
    cancelled: Callable[[], bool],
    progress: Callable[[Progress], Any] | None,
) -> None:
    """Solve and keep what is not there yet."""
    begun, there = time.perf_counter(), parts.spans()
    done = resumed = sum(stop - start for start, stop in there)

    def report() -> None:
        if progress is not None:
            progress(Progress(done, resumed, design.size, time.perf_counter() - begun))

    report()
    for (start, stop), part in solved(work, design, left_of(design.size, there), crew, cancelled, parts):
        parts.keep((start, stop), part)
        done += stop - start
        report()


def _crew(workers: int | None, cluster: Any, points: int) -> Callable[[], Crew]:
    """Who is to solve it, once that begins. Raises SceneError for both at once."""
    if cluster is not None and workers is not None:
        raise SceneError("workers", workers, allowed("workers-or-cluster"))
    if cluster is not None:
        from .cluster import cluster_of  # loads asyncio, which nothing else here needs

        return partial(cluster_of, cluster)
    return partial(crew_of, min(crew_size(workers), points))


def file_of(out: str | Path, option: str = "out") -> Path:
    """Where it is written. Raises SceneError for what can be no such file."""
    path = Path(out)
    if path.suffix not in ENDINGS:
        raise SceneError(option, str(out), allowed("study-file", options=list(ENDINGS)))
    package = ENDINGS[path.suffix]
    if package and find_spec(package) is None:
        raise SceneError(option, str(out), allowed("study-package", package=package))
    if not path.parent.is_dir():
        raise SceneError(option, str(out), allowed("study-folder"))
    return path


def _refuse(path: Path) -> None:
    raise SceneError("out", str(path), allowed("new-study"))


def _about(work: Work, design: Design) -> dict[str, Any]:
    """What makes another study of it, as plain tables."""
    method = work.method.table() if isinstance(work.method, Method) else work.method
    return {
        "scene": as_given(work.scene),
        "design": json.dumps(design.table()),
        "method": json.dumps(method),
        "figures": " ".join(work.figures),
        "notes": "looked for" if work.notes else "not looked for",
        "version": f"Strikewave {version()}",
    }
