"""The table of a trade-off: points of time and error, what they are measured by, which of them nothing beats."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any

from ..text.notes import Note, coded
from .refinement import label

if TYPE_CHECKING:
    from ..notebook.plots import Drawn

EQUAL_ERRORS = 1e-12  # errors below it are equal


@dataclass(frozen=True)
class Point:
    """One method at one resolution. Errors are found minus true, see `accuracy.quantities`; None: no such thing.

    A true contact is found if the method has a contact of its own that overlaps it.
    """

    method: dict[str, Any]  # name and options, as in a scene file
    ladder: str  # the method with the options that all its resolutions share, and what makes it finer
    resolution: str | None  # the option that makes it finer
    size: float | None  # the value of that option
    wall_time: float  # of a whole warm solve with its own error estimate, if nothing else runs: the shortest of repeats
    spread: tuple[float, float] | None  # shortest and longest of the repeats [s]; None: solved but once
    repeats: int
    first_time: float  # of the first solve, with what had to be compiled for it [s]
    estimated_error: float | None  # of the rebound, as the solution itself says
    errors: dict[str, float | Any]  # None: not known
    contacts: int
    true_contacts: int
    true_contacts_found: int
    invented_contacts: int
    notes: list[Note] = field(default_factory=list)

    @property
    def label(self) -> str:
        return label(self.method, always=self.resolution)

    def table(self) -> dict[str, Any]:
        table = {each.name: getattr(self, each.name) for each in fields(self)} | coded(self.notes)
        return table | {"knob": table.pop("resolution")}

    @classmethod
    def from_table(cls, row: Mapping[str, Any]) -> "Point":
        """The same from what `table` gave."""
        given: dict[str, Any] = {
            key: value for key, value in row.items() if key not in ("label", "best_for", "note_codes")
        }
        given["resolution"] = given.pop("knob")
        given["notes"] = [Note.from_table(note) for note in row["note_codes"]]
        given["spread"] = row["spread"] and tuple(row["spread"])
        return cls(**given)


@dataclass(frozen=True)
class ReferenceInfo:
    """What errors are measured by.

    kind "exact": travelling waves; "converged": the finest that was affordable, itself uncertain by how much it differs
    from the next coarser and from another method; "closed form": nothing that can solve the scene can be refined, and
    errors are only differences from one of the answers.
    """

    kind: str
    method: dict[str, Any]
    uncertainty: dict[str, float | None]  # by quantity, as errors are; None: not known
    note: Note  # the same in a sentence

    @property
    def words(self) -> str:
        return str(self.note)

    def table(self) -> dict[str, Any]:
        table = {each.name: getattr(self, each.name) for each in fields(self)}
        return table | {"note": self.note.table(), "words": self.words}

    @classmethod
    def from_table(cls, table: Mapping[str, Any]) -> "ReferenceInfo":
        """The same from what `table` gave."""
        return cls(table["kind"], table["method"], table["uncertainty"], Note.from_table(table["note"]))


@dataclass(frozen=True)
class TradeOff:
    """The table, sorted by method and resolution, with all that is needed to draw it."""

    scene: dict[str, Any]
    quantities: dict[str, str]  # name: what it is
    reference: ReferenceInfo | None  # None: not known yet, so no errors
    points: list[Point]
    refused: dict[str, Note]  # method: why it cannot
    remarks: list[Note]  # what does not get better however fine it is, and what was left out
    machine: dict[str, Any]
    version: str
    date: str
    seconds: float  # of a processor, that all of it took
    stopped: str | None = None  # why it is not complete; None: it is
    code: dict[str, str] | None = None  # fingerprints of what was measured, and of what measures; None: not known
    calibration: dict[str, float] | None = None  # of `machine`, beside the measurement, see `accuracy.calibration` [s]
    shipped: bool = False  # whether it came with the library; else it was measured on this machine
    changed: list[str] = field(default_factory=list)  # what of the code is no longer that which was measured
    scale: dict[str, float] | None = None  # times here over those on `machine`, by which they are scaled; None: not

    def front(self, quantity: str) -> list[Point]:
        """Points that nothing beats in time and error at once (Pareto), quickest first.

        Errors below the uncertainty of the reference are equal.
        """
        floor = max((self.reference.uncertainty.get(quantity) if self.reference else None) or 0.0, EQUAL_ERRORS)
        known = [point for point in self.points if point.errors.get(quantity) is not None]
        kept, best = [], float("inf")
        for point in sorted(known, key=lambda point: (point.wall_time, abs(point.errors[quantity]))):
            error = max(abs(point.errors[quantity]), floor)
            if error < best:
                kept.append(point)
                best = error
        return kept

    def plot(self, quantity: str = "rebound") -> "Drawn":
        """A HoloViews object: errors of one of `quantities` over wall time, a line for each ladder of resolutions, and
        what nothing beats, dashed. Errors below the uncertainty of the reference are drawn on it.

        Raises SceneError for another word.
        """
        from ..notebook import plots  # loads HoloViews, which nothing else here needs

        return plots.tradeoff(self, quantity)

    def _repr_html_(self) -> str:
        from ..notebook import cards

        return cards.tradeoff_card(self)

    def table(self) -> dict[str, Any]:
        """Plain tables for JSON. Each point besides says its `label` and in `best_for` on which fronts it lies.

        A page needs: `points[].wall_time` and `.spread` across, `.errors[quantity]` upward (its size), `.label`,
        `.estimated_error`, `.note_codes`, `.contacts` and `.true_contacts_found` for the hover, `.method` for a click,
        which is the table `[method]` of a scene file; `.ladder` to join points by a line; `best_for` for the front;
        `reference.words` and `reference.uncertainty[quantity]` for the grey band below which no errors are known;
        `remarks`, `refused`, `machine` as text.
        """
        fronts = {quantity: self.front(quantity) for quantity in self.quantities}
        table = {each.name: getattr(self, each.name) for each in fields(self)}
        table |= {
            "reference": self.reference and self.reference.table(),
            "points": [point.table() for point in self.points],
            "refused": {name: str(note) for name, note in self.refused.items()},
            "refused_codes": {name: note.table() for name, note in self.refused.items()},
            "remarks": [str(note) for note in self.remarks],
            "remark_codes": [note.table() for note in self.remarks],
        }
        for point, row in zip(self.points, table["points"], strict=True):
            row["label"] = point.label
            row["best_for"] = [quantity for quantity, front in fronts.items() if point in front]
        return table

    @classmethod
    def from_table(cls, table: Mapping[str, Any]) -> "TradeOff":
        """The same from what `table` gave."""
        given = {key: value for key, value in table.items() if key not in ("refused_codes", "remark_codes")}
        given |= {
            "points": [Point.from_table(row) for row in table["points"]],
            "reference": table["reference"] and ReferenceInfo.from_table(table["reference"]),
            "refused": {name: Note.from_table(note) for name, note in table["refused_codes"].items()},
            "remarks": [Note.from_table(note) for note in table["remark_codes"]],
        }
        return cls(**given)
