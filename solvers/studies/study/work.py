"""What is done at the points of a study, in whichever process: figures, notes, or why there are none."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np

from ...methods.base import Method, SceneNotSupported, never
from ...numerics.processors import all_processors
from ...scene import Scene
from ...solution.solution import Solution
from ...solve import chosen_method
from ...text.notes import Severity
from ...validation import SceneError, allowed
from ..figures import figures_of, only_for
from ..varied import columns_of
from . import rigid_bulk

FAILED, CRASHED = "failed", "crashed"  # beside the codes of refusals

Span = tuple[int, int]  # of points, from the first up to the second


@dataclass(frozen=True)
class Part:
    """Of points that follow each other: figures (points, figures), NaN where there is none, and words (points,)."""

    figures: np.ndarray
    refused: np.ndarray  # code of the refusal; empty where it is solved
    reason: np.ndarray  # its sentence
    notes: np.ndarray  # codes of the notes, with spaces between
    said: dict[str, str] = field(default_factory=dict)  # by code, the sentence of the first point that has the note
    seconds: float = 0.0  # that it took

    @property
    def size(self) -> int:
        return len(self.figures)


@dataclass(frozen=True)
class Work:
    """Solves the scene with rows of values for its keys."""

    scene: Scene
    keys: tuple[str, ...]
    figures: tuple[str, ...]
    method: str | Method | None
    notes: bool  # whether they are looked for
    trusted: bool = False  # figures of which a note says that they are not to be trusted stand as refused

    def __post_init__(self) -> None:
        named = next((key for key in self.keys if key.partition(".")[0] == "method"), None)
        if named is not None and self.method is not None:  # which would be solved by, whatever the key says
            name = self.method.NAME if isinstance(self.method, Method) else self.method
            raise SceneError("method", name, allowed("nothing-beside", other=named))

    def __reduce__(self) -> tuple[Any, ...]:
        """To another process the scene goes as tables, of which `Scene.replace` makes others here, too."""
        _, *others = (getattr(self, field.name) for field in fields(self))
        return _read, (self.scene.given or self.scene.table(), *others)

    def __call__(self, rows: Sequence[tuple[Any, ...]]) -> Part:
        """Of each row; nothing that it raises ends the study."""
        begun = time.perf_counter()
        found = self._quick(rows)
        if found is None:
            said: dict[str, str] = {}
            solved = [self._solved(row, said) for row in rows]
            figures, refused, reason, notes = zip(*solved, strict=True)
            found = Part(np.array(figures, float), np.array(refused), np.array(reason), np.array(notes), said)
        return replace(found, seconds=time.perf_counter() - begun)

    def _quick(self, rows: Sequence[tuple[Any, ...]]) -> Part | None:
        """All at once, where that can be done and each of them is allowed."""
        if self.notes or not rigid_bulk.columns_fit(self.scene, self.keys, self.method, self.figures):
            return None
        try:
            columns = columns_of(dict(zip(self.keys, zip(*rows, strict=True), strict=True)))
            found = rigid_bulk.of_columns(self.scene, columns, self.figures, 1)
        except SceneError:
            return None
        nothing = np.full(len(rows), "")
        return Part(np.stack(list(found.values()), 1), nothing, nothing, nothing)

    def _solved(self, row: tuple[Any, ...], said: dict[str, str]) -> tuple[list[float], str, str, str]:
        try:
            solution = self._solve(row)
            found = [np.nan if value is None else float(value) for value in figures_of(solution, self.figures)]
            codes = self._codes(solution, said)
            wrong = [note for note in solution.notes if note.severity is Severity.INVALID] if self.trusted else []
        except SceneError as refused:
            return [np.nan] * len(self.figures), refused.reason.code, str(refused), ""
        except Exception as error:  # the others are to be solved all the same
            return [np.nan] * len(self.figures), FAILED, f"{type(error).__name__}: {error}"[:300], ""
        if wrong:
            return [np.nan] * len(self.figures), wrong[0].code, str(wrong[0]), codes
        return found, "", "", codes

    def _codes(self, solution: Solution, said: dict[str, str]) -> str:
        """Of its notes, the sentences of which are kept once each."""
        notes = solution.notes if self.notes else []
        for note in notes:
            if note.code not in said:
                said[note.code] = str(note)
        return " ".join(dict.fromkeys(note.code for note in notes))

    def read(self, row: tuple[Any, ...]) -> tuple[Scene, Method, float | None]:
        """The scene with these values, and by what it is solved, up to which duration [s]. Raises SceneError."""
        scene = self.scene.replace(dict(zip(self.keys, row, strict=True)))
        if scene.normal is not None:
            raise SceneError("scene", scene.title, allowed("scenes-on-axis"))
        return scene, *chosen_method(scene, self.method)

    def allow(self, row: tuple[Any, ...]) -> None:
        """Raises SceneError for what can be seen to be refused before it is solved."""
        scene, method, _ = self.read(row)
        reason = method.refusal(scene)
        if reason is not None:
            raise SceneNotSupported("method.name", method.NAME, reason)

    def _solve(self, row: tuple[Any, ...]) -> Solution:
        scene, method, duration = self.read(row)
        return (method if self.notes else only_for(method, self.figures)).solve_in_full(scene, duration)


def each(
    scenes: Sequence[Scene],
    method: str | Method | None,
    figures: Sequence[str],
    workers: int | None = None,
    cancelled: Callable[[], bool] = never,
) -> list[list[Any] | None]:
    """The figures of every scene, solved on threads of this process; None for what has not begun when it is cancelled,
    which the first always has. Raises what the first of them is refused for."""

    def solve(scene: Scene) -> list[Any] | None:
        if scene is not scenes[0] and cancelled():
            return None
        chosen, duration = chosen_method(scene, method)
        return figures_of(only_for(chosen, figures).solve_in_full(scene, duration), figures)

    with all_processors(workers) as pool:
        return list(pool.map(solve, scenes))


def _read(tables: Mapping[str, Any], *others: Any) -> Work:
    return Work(Scene.from_table(tables), *others)


def crashed(figures: Sequence[str], reason: str) -> Part:
    """Of a point whose process ended."""
    return Part(np.full((1, len(figures)), np.nan), np.array([CRASHED]), np.array([reason]), np.array([""]))


def joined(parts: Sequence[Part]) -> Part:
    """All in one."""
    arrays = ([getattr(part, name) for part in parts] for name in ("figures", "refused", "reason", "notes"))
    said = {code: text for part in reversed(parts) for code, text in part.said.items()}
    return Part(*map(np.concatenate, arrays), said=said, seconds=sum(part.seconds for part in parts))
