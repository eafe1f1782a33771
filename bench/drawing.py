"""What an answer of an analysis costs: as columns that the page fills its figure with, and as a figure by HoloViews."""

import gzip
import json
import resource

import solvers
from app.choices.choices import Choices
from app.views.tradeoff import SCALED, stored_data

from .timing import processor_times, row

LEVEL = 6  # of packing, as the server packs


def _resident() -> float:
    """Most memory so far [MB]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3


def measure() -> dict[str, object]:
    asked = Choices().chosen() | {SCALED: False}
    found = solvers.stored_tradeoff(solvers.load("fixed-rod"))
    if found is None:
        raise ValueError("no table of the fixed rod is stored")
    before = _resident()
    import holoviews as hv
    from bokeh.document import Document

    hv.extension("bokeh")

    def drawn() -> str:
        document = Document()
        document.add_root(hv.renderer("bokeh").get_plot(found.plot("rebound")).state)
        return json.dumps(document.to_json(deferred=False))

    def filled() -> str:
        return stored_data(asked)

    names = "columns of a trade-off, as the page takes them", "the same as a figure by HoloViews"
    rows = []
    for name, text, spent in zip(names, (filled(), drawn()), processor_times((filled, drawn)), strict=True):
        rows.append(row(f"{name}: processor", 1e3 * spent, "ms"))
        rows.append(row(f"{name}: sent", len(text) / 1e3, "kB"))
        rows.append(row(f"{name}: packed", len(gzip.compress(text.encode(), LEVEL)) / 1e3, "kB"))
    rows.append(row("more memory of a process that draws", _resident() - before, "MB"))
    return dict(rows)
