"""What energy was given besides that before the impact, of which shares are shown, and whether it adds up."""

from collections.abc import Mapping
from typing import Any

SOURCES = ("drives", "weight")  # what may give energy: negative then, else what has gone there
LARGEST_GAP = 1e-2  # of the energy, with which shares of it are shown


def given(energy: Mapping[str, float]) -> dict[str, float]:
    """What drives and weight have given by the end, and `whole`, all that was given with what there was before [J]."""
    since = {source: max(-energy.get(source, 0.0), 0.0) for source in SOURCES}
    return since | {"whole": energy["initial"] + sum(since.values())}


def books_open(solution: Any) -> bool:
    """Whether its energy does not add up, so that shares of it would tell nothing."""
    gap = abs(solution.diagnostics["energy_error"])
    return gap > LARGEST_GAP or any(note.code == "books-open" for note in solution.notes)
