"""The picture of docs/architecture.md: rooms by the layers of pyproject.toml, their lines, and what they import."""

import tomllib
from pathlib import Path

import grimp

ROOT = Path(__file__).parents[2]
PLACE = "<!-- rooms -->"
WIDTH, WIDE, HIGH = 920, 220, 34  # pixels: of the picture, and of a room
GAP, BESIDE = 26, 12  # between layers, and between rooms of one
Edge = tuple[str, str]


def on_page_markdown(markdown: str, **_) -> str:
    return markdown.replace(PLACE, picture()) if PLACE in markdown else markdown


def layers() -> list[list[str]]:
    """From the top, each with its rooms."""
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]["contracts"]
    named = {contract["name"]: contract for contract in contracts}
    return [
        [f"{named[name]['containers'][0]}.{room}" for room in layer.split(" | ")]
        for name in ("The app's layers", "The library's layers")
        for layer in named[name]["layers"]
    ]


def edges(rooms: list[str]) -> set[Edge]:
    """Which imports which, but for what follows from others."""
    graph = grimp.build_graph("app", "solvers")
    for room in rooms:
        graph.squash_module(room)
    below = {room: graph.find_modules_directly_imported_by(room) & set(rooms) - {room} for room in rooms}

    def reached(room: str) -> set[str]:
        return below[room].union(*(reached(other) for other in below[room]))

    far = {room: set().union(*(reached(other) for other in below[room])) for room in rooms}
    return {(room, other) for room in rooms for other in below[room] - far[room]}


def lines_of(room: str) -> int:
    path = ROOT / room.replace(".", "/")
    files = path.rglob("*.py") if path.is_dir() else [path.with_suffix(".py")]
    return sum(len(file.read_text("utf-8").splitlines()) for file in files)


def picture() -> str:
    """As SVG, in the colour of the text around it."""
    rows = layers()
    places = {}
    for number, row in enumerate(rows):
        start = 0.5 * (WIDTH - WIDE * len(row) - BESIDE * (len(row) - 1))
        for k, room in enumerate(row):
            places[room] = (start + k * (WIDE + BESIDE), number * (HIGH + GAP), WIDE)
    high = len(rows) * (HIGH + GAP) - GAP
    parts = [_arrow(places[one], places[other]) for one, other in sorted(edges(list(places)))]
    parts += [_box(room, place) for room, place in places.items()]
    look = 'role="img" style="width: 100%; height: auto" font-size="13" fill="none" stroke="currentColor"'
    about = "<title>Rooms of the program, by layers: each imports what lies below it</title>"
    return f'<svg viewBox="0 0 {WIDTH} {high}" {look}>{about}{"".join(parts)}</svg>'


def _box(room: str, place: tuple[float, float, float]) -> str:
    x, y, wide = place
    at = f'x="{x:.0f}" y="{y}" width="{wide:.0f}" height="{HIGH}" rx="4" stroke-width="1"'
    shape = f'<rect {at} fill="var(--md-default-bg-color, #fff)"/>'
    words = f'<tspan font-weight="bold">{room}</tspan> <tspan opacity="0.6">{lines_of(room)}</tspan>'
    middle = f'x="{x + wide / 2:.0f}" y="{y + HIGH / 2 + 5:.0f}" text-anchor="middle"'
    return f'{shape}<text {middle} fill="currentColor" stroke="none">{words}</text>'


def _arrow(above: tuple[float, float, float], below: tuple[float, float, float]) -> str:
    """Between the middles of two rooms, past those between them."""
    (x, y, wide), (a, b, across) = above, below
    start, end = x + wide / 2, a + across / 2
    bend = 0.5 * (b - y - HIGH)
    way = f"M{start:.0f} {y + HIGH} C{start:.0f} {y + HIGH + bend:.0f} {end:.0f} {b - bend:.0f} {end:.0f} {b}"
    return f'<path d="{way}" opacity="0.25" stroke-width="1.5"/>'
