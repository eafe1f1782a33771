"""Contours over two keys, to read: a few vertices of each line."""

from typing import Any

from .words import shown, text

SHOWN = 7  # vertices of a line


def contour(found: Any) -> str:
    """What was asked, a few vertices of each line and of each jump, what comes nearest, and notes."""
    keys = heads(found)
    widths = [max(16, len(key)) for key in keys]
    lines = [found.title or text("report.scene"), f"  {asked(found)}"]
    if found.lines or found.jumps:
        lines += ["", "  " + "  ".join(key.rjust(width) for key, width in zip(keys, widths, strict=True))]
    for head, vertices in parts(found):
        lines.append(f"  {head}")
        for vertex in vertices:
            cells = (shown(value, ".10g").rjust(width) for value, width in zip(vertex, widths, strict=True))
            lines.append("  " + "  ".join(cells))
    said = beside(found)
    lines += ["", *(f"  {each}" for each in said)] if said else []
    return "\n".join([*lines, "", *("  " + text("report.note", note=note) for note in found.notes)])


def heads(found: Any) -> list[str]:
    """The keys with their units."""
    return [f"{key} [{found.units[key]}]" if found.units[key] else key for key in found.between]


def parts(found: Any) -> list[tuple[str, list[Any]]]:
    """Of each line and of each jump what it is, and some of its vertices."""
    return [
        (_head(kind, number, line, found.figure_unit), some(line.vertices))
        for kind, listed in (("line", found.lines), ("jump", found.jumps))
        for number, line in enumerate(listed, 1)
    ]


def beside(found: Any) -> list[str]:
    """What comes nearest, and warnings on the vertices."""
    return ([nearest(found)] if found.nearest is not None else []) + warned(found.warnings, "contour.noted")


def asked(found: Any) -> str:
    """What was wanted over which ranges, and how much there is of it."""
    ranges = [
        text("contour.range", key=key, low=shown(low, ".8g"), high=_valued(high, found.units[key]))
        for key, (low, high) in found.between.items()
    ]
    said = {"figure": found.figure, "wanted": _valued(found.wanted, found.figure_unit), "method": found.method}
    counts = {"lines": len(found.lines), "jumps": len(found.jumps)}
    return text("contour.asked", one=ranges[0], other=ranges[1], **said, **counts)


def nearest(found: Any) -> str:
    """In words."""
    values, figure = found.nearest
    at = ", ".join(
        f"{key} = {_valued(value, found.units[key])}" for key, value in zip(found.between, values, strict=True)
    )
    return text("contour.nearest", figure=found.figure, found=_valued(figure, found.figure_unit), at=at)


def warned(warnings: Any, code: str) -> list[str]:
    """A sentence for each."""
    return [text(code, count=each.count, code=each.code, first=each.first) for each in warnings]


def some(vertices: list[Any]) -> list[Any]:
    """The first, the last, and others evenly between them."""
    last = len(vertices) - 1
    return [vertices[round(n * last / (SHOWN - 1))] for n in range(SHOWN)] if last >= SHOWN else vertices


def _head(kind: str, number: int, line: Any, unit: str) -> str:
    said = {"number": number, "vertices": len(line.vertices), "closed": "true" if line.closed else "false"}
    if kind == "line":
        return text("contour.line", **said)
    below, above = (pick(side) for pick, side in zip((min, max), zip(*line.sides, strict=True), strict=True))
    return text("contour.jump", below=shown(below, ".6g"), above=_valued(above, unit), **said)


def _valued(value: float, unit: str) -> str:
    return shown(value, ".8g") + (f" {unit}" if unit else "")
