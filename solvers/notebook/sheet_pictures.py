"""Pictures of a report as SVG that needs nothing else: curves, and fields over time and place."""

import base64
import math
import struct
import zlib
from collections.abc import Sequence
from html import escape
from typing import Any

import numpy as np

from .words import shown, text

WIDTH, HEIGHT = 400.0, 218.0  # of a picture, in its own units
LEFT, RIGHT, TOP, BOTTOM = 46.0, 10.0, 24.0, 36.0  # room for numbers and names around the axes
BAR = 50.0  # room on the right for the scale of colours
INKS = ("#0c3a78", "#c2571a", "#5a7a2e")  # of curves, which differ in grey, too
DASHES = ("", "6 3", "2 3")
STOPS = np.array(  # from tension to compression, as on the page
    [[12, 58, 120], [66, 133, 200], [186, 215, 236], [246, 247, 248], [250, 205, 176], [222, 105, 62], [138, 24, 30]]
)
PREFIXES = {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}
SCALED = ("s", "m", "N", "Pa", "J", "m/s")  # units that take a prefix on an axis
TICKS = 5  # about so many intervals of an axis


def scaled(largest: float, unit: str) -> tuple[float, str]:
    """By what to multiply values of this size to have them with the prefix that suits them, and that unit."""
    if unit not in SCALED or not largest > 0.0 or not math.isfinite(largest):
        return 1.0, unit
    power = 3 * math.floor(math.log10(largest * (1.0 + 1e-12)) / 3.0)
    power = min(max(power, min(PREFIXES)), max(PREFIXES))
    return 10.0**-power, PREFIXES[power] + unit


def picture(found: Any) -> str:
    """Of what a report draws: see `solvers.studies.report.pictures`."""
    return _field(found) if hasattr(found, "x") else _curves(found)


def _curves(found: Any) -> str:
    """A line for each history, named where there are several; contacts are shaded."""
    values = [line[1] for line in found.lines.values()]
    low, high = min(0.0, *(each.min() for each in values)), max(0.0, *(each.max() for each in values))
    high = high if high > low else low + 1.0
    room = 0.05 * (high - low)
    low, high = low - room * (low < 0.0), high + room
    over, time_unit = scaled(found.until, "s")
    up, unit = scaled(max(abs(low), abs(high)), found.unit)
    x = _Axis(0.0, found.until * over, LEFT, WIDTH - RIGHT)
    y = _Axis(low * up, high * up, HEIGHT - BOTTOM, TOP)
    spans = "".join(
        f'<rect x="{x(start * over):.2f}" y="{TOP}" height="{HEIGHT - BOTTOM - TOP}" fill="#8894a3" fill-opacity=".16" '
        f'width="{max(x(end * over) - x(start * over), 0.6):.2f}"/>'
        for start, end in found.spans
    )
    lines = "".join(
        f'<polyline fill="none" {_pen(label, number)} stroke-linejoin="round" '
        f'points="{_points(x(time * over), y(line * up))}"/>'
        for number, (label, (time, line)) in reversed(list(enumerate(found.lines.items())))
    )
    legend = _legend(list(found.lines)) if len(found.lines) > 1 else ""
    head = f"{_named(found.name)} [{unit}]"
    return _whole(head, _grid(x, y) + spans + lines + _ends(x, y, time_unit, head) + legend)


def _field(found: Any) -> str:
    """Colours over time and place, and their scale."""
    over, time_unit = scaled(float(found.time[-1]), "s")
    along, place_unit = scaled(float(np.abs(found.x).max()), "m")
    largest = float(np.abs(found.values).max())
    up, unit = scaled(largest, found.unit)
    right = WIDTH - RIGHT - BAR
    x = _Axis(0.0, float(found.time[-1]) * over, LEFT, right)
    y = _Axis(float(found.x[0]) * along, float(found.x[-1]) * along, HEIGHT - BOTTOM, TOP)
    image = _image(found.values.T[::-1] / largest, LEFT, TOP, right - LEFT, HEIGHT - BOTTOM - TOP)
    scale = _Axis(-largest * up, largest * up, HEIGHT - BOTTOM, TOP)
    bar = _image(np.linspace(1.0, -1.0, 64)[:, None], right + 10.0, TOP, 8.0, HEIGHT - BOTTOM - TOP)
    marks = "".join(
        f'<text x="{right + 21:.1f}" y="{scale(tick) + 3.6:.1f}">{_said(tick)}</text>' for tick in scale.ticks(4)
    )
    place = text("sheet.picture.place-support" if found.bends else "sheet.picture.place-end", unit=place_unit)
    head = f"{_named(found.name)} [{unit}]"
    return _whole(head, image + bar + marks + _ends(x, y, time_unit, head, place))


class _Axis:
    """Where values stand in the picture."""

    def __init__(self, low: float, high: float, start: float, end: float):
        self.low, self.high, self.start, self.end = low, high, start, end

    def __call__(self, value: Any) -> Any:
        return self.start + (value - self.low) / (self.high - self.low) * (self.end - self.start)

    def ticks(self, count: int = TICKS) -> list[float]:
        """Round numbers."""
        rough = (self.high - self.low) / count
        power = 10.0 ** math.floor(math.log10(rough))
        step = next(size * power for size in (1.0, 2.0, 2.5, 5.0, 10.0) if size * power >= rough * (1.0 - 1e-9))
        first, last = math.ceil(self.low / step - 1e-9), math.floor(self.high / step + 1e-9)
        return [number * step for number in range(first, last + 1)]


def _named(name: str) -> str:
    names = {
        "force": text("sheet.picture.force"),
        "velocity": text("sheet.picture.velocity"),
        "displacement": text("sheet.picture.displacement"),
        "stress": text("sheet.picture.stress"),
        "deflection": text("sheet.picture.deflection"),
    }
    return names.get(name, name)


def _pen(label: str, number: int) -> str:
    """Colour and dashes of a curve; pale for what is beside the matter."""
    if label == "raw":
        return 'stroke="#a9bdd6" stroke-width=".7"'
    return f'stroke="{INKS[number]}" stroke-width="1.5" stroke-dasharray="{DASHES[number]}"'


def _legend(labels: Sequence[str]) -> str:
    """In the top right corner, above the axes."""
    names = {
        "impactor": text("sheet.picture.impactor"),
        "struck": text("sheet.picture.struck"),
        "resolved": text("sheet.picture.resolved"),
        "raw": text("sheet.picture.raw"),
    }
    parts, at = [], WIDTH - RIGHT
    for number, label in reversed(list(enumerate(labels))):
        name = names.get(label, label)
        parts.append(f'<text x="{at:.1f}" y="14" text-anchor="end">{escape(name)}</text>')
        at -= 5.6 * len(name) + 8.0
        parts.append(f'<line x1="{at - 14:.1f}" x2="{at:.1f}" y1="10.5" y2="10.5" {_pen(label, number)}/>')
        at -= 24.0
    return "".join(parts)


def _points(x: np.ndarray, y: np.ndarray) -> str:
    return " ".join(f"{a:.2f},{b:.2f}" for a, b in zip(x.tolist(), y.tolist(), strict=True))


def _grid(x: _Axis, y: _Axis) -> str:
    """Thin lines at all ticks, a stronger one at zero."""
    lines = [f'<path d="M{x(tick):.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#e4e8ed"/>' for tick in x.ticks()]
    for tick in y.ticks():
        ink = "#8894a3" if tick == 0.0 else "#e4e8ed"
        lines.append(f'<path d="M{LEFT} {y(tick):.1f}H{WIDTH - RIGHT}" stroke="{ink}"/>')
    return "".join(lines)


def _ends(x: _Axis, y: _Axis, time_unit: str, head: str, place: str = "") -> str:
    """Numbers and names of both axes; above it what is drawn."""
    low = HEIGHT - BOTTOM
    parts = [f'<path d="M{LEFT} {TOP}V{low}H{x.end:.1f}" fill="none" stroke="#4a5563"/>']
    parts += [f'<text x="{x(tick):.1f}" y="{low + 13}" text-anchor="middle">{_said(tick)}</text>' for tick in x.ticks()]
    parts += [
        f'<text x="{LEFT - 5}" y="{y(tick) + 3.6:.1f}" text-anchor="end">{_said(tick)}</text>' for tick in y.ticks()
    ]
    middle = 0.5 * (LEFT + x.end)
    time = escape(text("sheet.picture.time", unit=time_unit))
    parts.append(f'<text x="{middle:.1f}" y="{HEIGHT - 6}" text-anchor="middle">{time}</text>')
    parts.append(f'<text x="{LEFT if not place else 0}" y="14" font-weight="600">{escape(head)}</text>')
    if place:
        across = 0.5 * (TOP + low)
        turned = f'transform="translate(10 {across:.1f}) rotate(-90)" text-anchor="middle"'
        parts.append(f"<text {turned}>{escape(place)}</text>")
    return "".join(parts)


def _said(tick: float) -> str:
    return shown(tick + 0.0, ".4g").replace("-", "−")


def _whole(head: str, drawn: str) -> str:
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:g} {HEIGHT:g}" role="img" font-size="11" '
        f'fill="#1d2733"><title>{escape(head)}</title>{drawn}</svg>'
    )


def _image(values: np.ndarray, left: float, top: float, width: float, height: float) -> str:
    """Values (rows, columns) from -1 to 1 as colours, the first row on top."""
    data = base64.b64encode(png(colours(values))).decode()
    return (
        f'<image x="{left:g}" y="{top:g}" width="{width:g}" height="{height:g}" preserveAspectRatio="none" '
        f'href="data:image/png;base64,{data}"/>'
    )


def colours(values: np.ndarray) -> np.ndarray:
    """Red, green and blue (rows, columns, 3) of values from -1 to 1."""
    place = (np.clip(values, -1.0, 1.0) + 1.0) / 2.0 * (len(STOPS) - 1)
    mixed = [np.interp(place, np.arange(len(STOPS)), channel) for channel in STOPS.T]
    return np.rint(np.stack(mixed, -1)).astype(np.uint8)


def png(pixels: np.ndarray) -> bytes:
    """The file of a picture (rows, columns, 3) of bytes. Source: PNG specification, sections 5 and 11."""
    rows, columns, _ = pixels.shape
    lines = np.zeros((rows, 1 + 3 * columns), np.uint8)  # each line behind the number of its filter: none
    lines[:, 1:] = pixels.reshape(rows, -1)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", columns, rows, 8, 2, 0, 0, 0)
    body = zlib.compress(lines.tobytes(), 9)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")
