"""A study kept in a zarr store whose regions are written by whoever solves them: no process holds all of it."""

import json
import os
import shutil
import socket
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any
from uuid import uuid4

import numpy as np

from ...notebook.regions import NOT_SOLVED, Blocks, add_attributes, blocks_of, write_region
from ...validation import SceneError, allowed
from .design import Design
from .parts import ABOUT, ARRAYS, Parts, Receipt
from .work import Part, Span, Work, joined

STORE, TOKEN, RECEIPTS = "store.zarr", "token", "receipts"  # in the folder of parts
LARGEST, SMALLEST, BLOCKS = 20_000, 1_000, 64  # points of a block, and how many blocks a small study has
NUMBER = 8  # bytes of a value


@dataclass(frozen=True)
class Writes:
    """Solves a block, and writes it where it is to stay if this process sees that folder; else gives back the Part."""

    work: Work
    folder: str
    token: str
    blocks: Blocks

    def __call__(self, given: tuple[Span, list[Any]]) -> Part | Receipt:
        """`given`: the block, and what `values_of` has for it."""
        span, values = given
        part = self.work(rows_of(values))
        folder = Path(self.folder)
        try:
            if (folder / TOKEN).read_text("utf-8") != self.token:
                return part
            write(folder, self.blocks, span, part)
        except OSError:  # which the one that called hears of where it writes itself, if that is not of here alone
            return part
        return Receipt(part.size, part.said, part.seconds)


class Regions(Parts):
    """Blocks in a store; a part that is smaller is kept as in `Parts` until its block is whole.

    A receipt says which blocks are there: a line in a file of the process that has written it, once it is written.
    """

    def __init__(self, folder: Path, work: Work, design: Design, create: Callable[[Path, Blocks], None]):
        super().__init__(folder)
        self.design, self.create = design, create
        self.blocks = blocks_of(design.shape, min(LARGEST, max(SMALLEST, design.size // BLOCKS)))
        self.figures = work.figures
        self.writes = Writes(work, str(folder.absolute()), uuid4().hex, self.blocks)
        self.done: dict[Span, dict[str, str]] = {}
        self.held: dict[Span, int] = {}  # of blocks that are not whole, how many points there are

    def begin(self, about: Mapping[str, Any], resume: bool) -> None:
        """Raises SceneError as `Parts` does, and where the disk cannot hold what is left."""
        there = (self.folder / STORE).exists()
        known = receipts(self.folder) if there else {}
        left = self.design.size - sum(stop - start for start, stop in known)
        _check_disk(self.folder, NUMBER * len(self.figures) * left)
        super().begin(about, resume)
        if there:
            for path in (self.folder / STORE).rglob("*.partial"):  # of a process that was ended as it wrote
                path.unlink(missing_ok=True)
        else:
            shutil.rmtree(self.folder / RECEIPTS, ignore_errors=True)
            new = self.folder / f"{STORE}.new"
            shutil.rmtree(new, ignore_errors=True)
            self.create(new, self.blocks)
            new.replace(self.folder / STORE)
        (self.folder / RECEIPTS).mkdir(exist_ok=True)
        (self.folder / TOKEN).write_text(self.writes.token, "utf-8")
        self.done = {span: said for span, said in known.items() if self.blocks.of(span[0]) == span}
        for span in super().spans():
            self._count(span)

    def task(self, work: Work, design: Design, span: Span) -> tuple[Callable[..., Any], Any]:
        """What is to be called to solve a part, and with what: of a whole block, to write it there."""
        if self.blocks.of(span[0]) == span:
            return self.writes, (span, values_of(design, self.blocks, span))
        return super().task(work, design, span)

    def end_of(self, point: int, size: int) -> int:
        """Where a part of some `size` ends that begins at a point: with its block, if that is not much longer."""
        start, stop = self.blocks.of(point)
        return stop if point == start and stop - start < 2 * size else min(stop, point + size)

    def keep(self, span: Span, part: Part | Receipt) -> None:
        """Raises OSError where nothing can be written."""
        if isinstance(part, Receipt):
            self.done[span] = part.said
        elif self.blocks.of(span[0]) == span:
            self._write(span, part)
        else:
            super().keep(span, part)
            self._count(span)

    def _write(self, block: Span, part: Part) -> None:
        write(self.folder, self.blocks, block, part)
        self.done[block] = part.said

    def _count(self, span: Span) -> None:
        """A smaller part that is there; once its block is whole it goes there."""
        block = self.blocks.of(span[0])
        if block not in self.done:
            self.held[block] = self.held.get(block, 0) + span[1] - span[0]
            if self.held[block] < block[1] - block[0]:
                return
            self._write(block, joined([part for _, part in self.pieces(block)]))
        self.held.pop(block, None)
        for each in self.spans_within(block):
            self.path(each).unlink()

    def pieces(self, block: Span) -> list[tuple[Span, Part]]:
        """The smaller parts of a block, in order."""
        return [(span, self.read_one(span)) for span in self.spans_within(block)]

    def spans_within(self, block: Span) -> list[Span]:
        """Those of a block that are there by themselves, in order."""
        return [span for span in super().spans() if block[0] <= span[0] < block[1]]

    def spans(self) -> list[Span]:
        """Of all that are there, in order."""
        return sorted([*self.done, *(span for block in self.held for span in self.spans_within(block))])

    def finish(self, path: Path, whole: bool) -> Path:
        """Where the store is: at `path`, if it is whole; else all that there is stands in it, and it goes on there."""
        store = self.folder / STORE
        said: dict[str, str] = {}
        for _, each in sorted(self.done.items()):
            said = each | said
        for block in sorted(self.held):
            part = empty(block[1] - block[0], len(self.figures))
            for span, piece in self.pieces(block):
                place = slice(span[0] - block[0], span[1] - block[0])
                for name in ARRAYS:
                    getattr(part, name)[place] = getattr(piece, name)
                said = piece.said | said
            put(store, self.blocks, block, self.figures, part)
        add_attributes(store, {"sentences": json.dumps(said, sort_keys=True)})
        if not whole:
            return store
        store.replace(path)
        self.end()
        return path

    def end(self) -> None:
        """The store is where it is to be. What is of somebody else stays."""
        (self.folder / TOKEN).unlink(missing_ok=True)
        shutil.rmtree(self.folder / RECEIPTS, ignore_errors=True)
        super().end()


def values_of(design: Design, blocks: Blocks, span: Span) -> list[Any]:
    """What makes the rows of a block: on a grid, some values of each axis; else the rows."""
    if design.sample != "grid":
        return [design.rows(*span)]
    return [axis.rows[place] for axis, place in zip(design.axes, blocks.region(span), strict=True)]


def rows_of(values: list[Any]) -> list[tuple[Any, ...]]:
    """The rows themselves, each value with each of the others'."""
    return [sum(row, ()) for row in product(*values)]


def write(folder: Path, blocks: Blocks, block: Span, part: Part) -> None:
    """A whole block, then its receipt, which may be there twice. Raises OSError where nothing can be written."""
    figures = json.loads((folder / ABOUT).read_text("utf-8"))["figures"].split()
    put(folder / STORE, blocks, block, figures, part)
    name = f"{socket.gethostname()}-{os.getpid()}.jsonl"
    with (folder / RECEIPTS / name).open("ab") as file:
        file.write(json.dumps([*block, part.said]).encode() + b"\n")


def put(store: Path, blocks: Blocks, block: Span, figures: Any, part: Part) -> None:
    """A block into its region; `refused` last, without which none of its points is solved."""
    columns = dict(zip(figures, part.figures.T, strict=True))
    words = {name: getattr(part, name) for name in ("notes", "reason", "refused")}
    write_region(store, blocks.region(block), columns | words)


def empty(size: int, figures: int) -> Part:
    """Of points that are not solved."""
    words = np.full(size, "", object)
    return Part(np.full((size, figures), np.nan), np.full(size, NOT_SOLVED, object), words, words.copy())


def receipts(folder: Path) -> dict[Span, dict[str, str]]:
    """By block what its notes said. A line that was not written to its end is none."""
    found = {}
    for path in sorted((folder / RECEIPTS).glob("*.jsonl")):
        for line in path.read_bytes().splitlines():
            try:
                start, stop, said = json.loads(line)
            except ValueError:
                continue
            found[int(start), int(stop)] = said
    return found


def _check_disk(folder: Path, needed: int) -> None:
    """Raises SceneError where so many bytes are not free."""
    free = shutil.disk_usage(folder.parent).free
    if needed > free:
        raise SceneError("out", str(folder.parent), allowed("study-disk", needed=1e-9 * needed, free=1e-9 * free))
