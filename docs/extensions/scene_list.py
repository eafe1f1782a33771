"""The table of built-in scenes, written from their files when the pages are built."""

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

MARK = "<!-- built-in scenes -->"
SCENES = Path(__file__).parents[2] / "solvers" / "scenes"
OTHERS = "Not from the thesis's figures and tables"


def on_page_markdown(markdown: str, **_: object) -> str:
    """Called by MkDocs with the text of each page."""
    return markdown.replace(MARK, "\n".join(_tables())) if MARK in markdown else markdown


def _tables() -> Iterator[str]:
    groups: dict[str, list[str]] = {}
    for path in sorted(SCENES.glob("*.toml"), key=_rank):
        scene = tomllib.loads(path.read_text(encoding="utf-8"))
        row = f"| `{path.stem}` | {scene['title']} | {scene['source']} |"
        groups.setdefault(_heading(path.stem), []).append(row)
    for heading, rows in groups.items():
        yield from (f"### {heading}", "", "| name | title | source |", "|---|---|---|", *rows, "")


def _heading(name: str) -> str:
    found = re.fullmatch(r"(?:figure|table)-(\d+)\..*", name)
    return f"Thesis, chapter {found[1]}" if found else OTHERS


def _rank(path: Path) -> tuple[object, ...]:
    found = re.fullmatch(r"(figure|table)-(\d+)\.(\d+)", path.stem)
    return (True, int(found[2]), found[1], int(found[3])) if found else (False, 0, path.stem, 0)
