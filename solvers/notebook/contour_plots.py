"""A contour over two keys as a HoloViews object."""

from typing import Any

import numpy as np

from .plots import WIDTH, Drawn, draw_with_bokeh, hv, titled

LINE, JUMP = "as wanted", "jump over it"


def contour(found: Any) -> Drawn:
    """See `solvers.Contour.plot`."""
    draw_with_bokeh()
    keys = [hv.Dimension(key, unit=found.units[key] or None, range=ends) for key, ends in found.between.items()]
    drawn = [_part(found.lines, keys, LINE, {}), _part(found.jumps, keys, JUMP, {"color": "red"})]
    unit = f" {found.figure_unit}" if found.figure_unit else ""
    about = f"{found.figure.replace('_', ' ')} = {found.wanted:g}{unit}"
    return titled(hv.Overlay(drawn), found.title, about).opts(**({"width": WIDTH} if _bokeh() else {}))


def _part(lines: list[Any], keys: list[Any], label: str, look: dict[str, str]) -> Drawn:
    """All lines as one with gaps; a single vertex is a mark beside them."""
    paths: list[tuple[float, float]] = []
    for line in lines:
        paths += [*line.vertices, *(line.vertices[:1] if line.closed else []), (np.nan, np.nan)]
    alone = [line.vertices[0] for line in lines if len(line.vertices) == 1]
    curve = hv.Curve(np.array(paths).reshape(-1, 2), *keys, label=label).opts(**look)
    marks = hv.Scatter(np.array(alone).reshape(-1, 2), *keys, label=label).opts(**look)
    return curve * marks if alone else curve


def _bokeh() -> bool:
    return hv.Store.current_backend == "bokeh"
