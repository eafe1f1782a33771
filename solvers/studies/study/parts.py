"""Parts of a study that are done, kept in a folder beside its file until all are: it goes on from there."""

import json
import os
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from ...validation import SceneError, allowed
from .design import Design
from .work import Part, Span, Work

ABOUT = "about.json"
NAME = "{:012d}-{:012d}.npz"  # first point, and the first after it
SPAN = re.compile(r"\d{12}-\d{12}", re.ASCII)
ARRAYS = ("figures", "refused", "reason", "notes")


@dataclass(frozen=True)
class Receipt:
    """Instead of a part, from a process that has written it where it is to stay."""

    size: int
    said: dict[str, str] = field(default_factory=dict)  # as a Part has it
    seconds: float = 0.0


class InPieces:
    """How a study is cut: in parts of any size, which come back to the process that calls."""

    def task(self, work: Work, design: Design, span: Span) -> tuple[Callable[..., Any], Any]:
        """What is to be called to solve a part, and with what."""
        return work, design.rows(*span)

    def end_of(self, point: int, size: int) -> int:
        """Where a part of some `size` ends that begins at a point."""
        return point + size


class Parts(InPieces):
    """Those of one study. Each is a file of its own, which is there wholly or not at all."""

    def __init__(self, folder: Path):
        self.folder = folder

    def path(self, span: Span) -> Path:
        """Of the file of a part."""
        return self.folder / NAME.format(*span)

    def begin(self, about: Mapping[str, Any], resume: bool) -> None:
        """Raises SceneError where parts of another study are there, or of this one, which is not to go on."""
        known = self.folder / ABOUT
        if known.exists():
            if not resume:
                raise SceneError("out", str(self.folder), allowed("new-study"))
            try:
                before = json.loads(known.read_text("utf-8"))
            except ValueError:  # written by something else
                before = {}
            same_study(before, about, str(self.folder))
            return
        if self.folder.exists() and (not self.folder.is_dir() or any(self.folder.iterdir())):
            raise SceneError("out", str(self.folder), allowed("own-parts"))
        self.folder.mkdir(parents=True, exist_ok=True)
        written = self.folder / f"{ABOUT}.new"
        written.write_text(json.dumps(about), "utf-8")
        written.replace(known)

    def keep(self, span: Span, part: Any) -> None:
        """Raises OSError where nothing can be written."""
        path = self.path(span)
        written = path.with_suffix(f".{os.getpid()}")
        try:
            with written.open("wb") as file:
                arrays = {name: getattr(part, name) for name in ARRAYS}
                np.savez(file, **arrays, said=np.array([*part.said.items()], str).reshape(-1, 2))
            written.replace(path)
        except OSError:
            written.unlink(missing_ok=True)
            raise

    def spans(self) -> list[Span]:
        """Of all that are there, in order."""
        names = sorted(path.stem for path in self.folder.glob("*-*.npz") if SPAN.fullmatch(path.stem))
        return [(int(start), int(stop)) for start, _, stop in (name.partition("-") for name in names)]

    def read(self) -> Iterator[tuple[Span, Part]]:
        """All that are there, one at a time."""
        for span in self.spans():
            yield span, self.read_one(span)

    def read_one(self, span: Span) -> Part:
        """Raises SceneError for a file that is damaged."""
        path = self.path(span)
        try:
            with np.load(path) as found:
                return Part(*(found[name] for name in ARRAYS), said=dict(found["said"].tolist()))
        except (ValueError, KeyError, EOFError, BadZipFile):
            raise SceneError("resume", str(path), allowed("whole-part")) from None

    def end(self) -> None:
        """All is in its file now. What is of somebody else stays."""
        for path in self.folder.iterdir():
            if path.name.startswith(ABOUT) or SPAN.match(path.name):
                path.unlink()
        with suppress(OSError):
            self.folder.rmdir()


class Held(InPieces):
    """The same in memory, for a study without a file."""

    def __init__(self):
        self.found: dict[Span, Part] = {}

    def begin(self, about: Mapping[str, Any], resume: bool) -> None:
        """Nothing is there before."""

    def keep(self, span: Span, part: Part) -> None:
        self.found[span] = part

    def spans(self) -> list[Span]:
        return sorted(self.found)

    def read(self) -> Iterator[tuple[Span, Part]]:
        yield from sorted(self.found.items())

    def end(self) -> None:
        """Nothing is there after."""


def left_of(size: int, done: list[Span]) -> list[Span]:
    """What is between these spans, which are in order, of so many points."""
    ends = [0, *(stop for _, stop in done)]
    starts = [*(start for start, _ in done), size]
    return [(end, start) for end, start in zip(ends, starts, strict=True) if end < start]


def same_study(before: Mapping[str, Any], now: Mapping[str, Any], where: str) -> None:
    """Raises SceneError with what differs."""
    differs = [name for name in now if before.get(name) != now[name]]
    if differs:
        raise SceneError("resume", where, allowed("same-study", differs=differs))
