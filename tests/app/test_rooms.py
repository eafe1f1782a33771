"""Rooms of the browser's code: each imports what lies below it, and nothing above."""

import re
from pathlib import Path

from app.serving.pages import STATIC

ROOMS = [  # from the top
    *("offline", "page.js", "kinds.js", "gallery", "courses", "classes", "lesson", "panels", "sharing", "take"),
    *("whatif", "wasm"),
    *("fall", "mechanism", "beam", "axial", "space", "opening", "compare", "away"),
    *("frame", "charts", "form", "clock", "wire", "browser", "text", "place.js"),
]
IMPORT = re.compile(r"^(?:import|export|\} from)\b[^;\n]*?'(\.{1,2}/[^']+)';$", re.MULTILINE)


def room_of(file: Path) -> str:
    return file.relative_to(STATIC.resolve()).parts[0]


def test_no_room_imports_one_above_it():
    arrows = [
        (room_of(file), room_of((file.parent / name).resolve()))
        for file in STATIC.resolve().rglob("*.js")
        for name in IMPORT.findall(file.read_text("utf-8"))
    ]
    assert len(arrows) > 600
    assert {name for arrow in arrows for name in arrow} == set(ROOMS)
    assert [arrow for arrow in arrows if ROOMS.index(arrow[0]) > ROOMS.index(arrow[1])] == []
