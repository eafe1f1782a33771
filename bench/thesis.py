"""Every numbered figure and table of the thesis: how the page shows it, and what differs from what is printed.

`python -m bench.thesis` writes docs/thesis.md from the scenes, their tables `[view]` and their notes.
"""

import re
from pathlib import Path

from app.choices.choices import SCENES
from app.choices.opened import Opening, opening_of

PAGE = Path(__file__).parents[1] / "docs" / "thesis.md"
NUMBERED = re.compile(r"(figure|table)-(\d+)\.(\d+)")
CHARTS = {
    "force": "Contact force",
    "moved": "Movement",
    "moments": "Bending moments",
    "stress": "History at a place",
    "along": "Along the body, now",
    "support": "Force at the supports",
    "reactions": "Force in the joints",
}
VIEWS = {
    "convergence": "Convergence",
    "energy": "Energy over time",
    "mode_change": "Mode change",
    "ringing": "Modes",
    "stretch": "Stretch as it turns",
}
TABS = {"numbers": "Numbers"}
# What of an item is not to be seen, whatever is opened.
LACKS = {
    "figure-3.1": "one of the three cases; the others are other targets",
    "figure-4.19": "velocity of the struck face, that of the mass while they touch, beside the mean of the rod",
    "figure-5.2": "the sum of the two waves, not each",
    "figure-5.14": "the set that holds at the instant: step the clock over the change",
    "figure-5.15": "the set that holds at the instant: step the clock over the change",
    "figure-5.17": "the set that holds at the instant: step the clock over the change",
    "figure-5.18": "the set that holds at the instant: step the clock over the change",
    "figure-8.11": "the shear force, to which the shear angle is proportional; no section is drawn turned",
    "figure-10.12": "the moments at pivot and contact; half way, place the gauge there",
    "table-6.1": "the first balance as velocities along the rod; the jumps are in the note",
    "table-8.4": "one of four rows; the others by the comparisons",
}
HEAD = """\
# The thesis, item by item

All {figures} numbered figures and {tables} tables of the thesis are scenes, by their number: `figure-4.18` in the
gallery, in a link (`?scene=figure-4.18`) or with `impact solve figure-4.18`. Chosen in the gallery they open on what
they are about: *picture* is the opening itself, with bodies, their rows over time and the force; the others open a dock
beside it.

Written from the scenes by `python -m bench.thesis`.

| item | what it shows | opens with | what differs from the print, or is not seen |
|---|---|---|---|
"""


def numbered() -> list[str]:
    """Names of the scenes of the thesis, in its order, figures before tables."""
    found = [(int(m[2]), m[1], int(m[3]), m[0]) for m in map(NUMBERED.fullmatch, SCENES) if m]
    return [name for *_, name in sorted(found)]


def opened(opening: Opening) -> str:
    """What the page opens, in words."""
    charts = [CHARTS[name] for name in opening.charts if name in CHARTS]
    tabs = [TABS[opening.tab]] if opening.tab else []
    if opening.read and (charts or tabs):
        (charts or tabs)[-1] += f": {opening.read}"
    where = [*charts, *(VIEWS[name] for name in opening.views), *tabs]
    if opening.time is not None:
        where.append(f"at {1e6 * opening.time:g} µs")
    return ", ".join(where) or "picture"


def row(name: str) -> str:
    scene = SCENES[name]
    _, _, differs = scene.note.partition("Differs: ")
    lacks = LACKS.get(name, "")
    said = " ".join(part for part in (differs.strip(), f"Shown: {lacks}." if lacks else "") if part)
    return f"| {name.replace('-', ' ')} | {scene.title} | {opened(opening_of(name))} | {said.replace('|', '/')} |"


def text() -> str:
    """The whole page."""
    names = numbered()
    tables = sum(name.startswith("table") for name in names)
    return HEAD.format(figures=len(names) - tables, tables=tables) + "\n".join(map(row, names)) + "\n"


if __name__ == "__main__":
    PAGE.write_text(text(), encoding="utf-8")
