"""A solution as HoloViews objects.

>>> import solvers
>>> curve = solvers.solve(solvers.load("fixed-rod")).plot("force").Curve.I
>>> [dimension.pprint_label for dimension in curve.dimensions()]
['time (s)', 'contact force (N)']
"""

import textwrap
from typing import Any

import holoviews as hv
import numpy as np

from ..validation import SceneError, allowed, choice
from .figures import BANDS, FIELDS, HISTORIES, STRIKING, Figure, histories_of, origin, reach

INSTANTS, PLACES = 801, 401
LONGEST_HISTORY = 20_000  # instants; a longer one is drawn at INSTANTS
WIDTH, HEIGHT = 700, 350  # pixels
LETTERS = 56  # of a line of a title, which is as wide as a picture
CLEAR = 10  # pixels between a bar of colours and its label
LONG_LEGEND = 250  # pixels, of methods with their options
TIME = hv.Dimension("time", label="time", unit="s")
Drawn = hv.core.Dimensioned  # what all of these are


def plot(solution: Any, what: str) -> Drawn:
    """See `Solution.plot`."""
    drawn = DRAWN[choice("what", what, DRAWN)]
    motion = solution.known_motion
    draw_with_bokeh()
    return titled(drawn(solution, motion), solution.scene.title, solution.method["name"])


def draw_with_bokeh() -> None:
    if not hv.Store.renderers:  # the user has chosen none
        hv.extension("bokeh")


def rendered(drawn: Drawn) -> Any:
    """As Bokeh has it, for a page."""
    return hv.render(drawn, backend="bokeh")


def titled(drawn: Any, title: str, about: str) -> Any:
    """Long enough for many contacts, the legend beside them; of Bokeh alone, as others measure in other units."""
    label = f"{title or 'Scene'}, {about}"
    drawn = drawn.relabel(label)
    if hv.Store.current_backend != "bokeh":
        return drawn
    lines = textwrap.fill(label, LETTERS).replace("{", "{{").replace("}", "}}")  # HoloViews fills in what is in braces
    look = {"width": WIDTH, "height": HEIGHT, "title": lines, "fontsize": {"title": "11pt"}}
    kinds = (hv.opts.Curve, hv.opts.Area, hv.opts.Scatter)
    scaled = (hv.opts.Image, hv.opts.Points, hv.opts.QuadMesh)
    beside = (kind(**look, legend_position="right") for kind in (hv.opts.Overlay, hv.opts.NdOverlay))
    bar = {"colorbar_opts": {"title_standoff": CLEAR}}
    whole = hv.opts.Layout(show_title=False)  # each of its parts has one
    return drawn.opts(*(kind(**look) for kind in kinds), *(kind(**look, **bar) for kind in scaled), *beside, whole)


def _instants(solution: Any) -> np.ndarray:
    return np.linspace(0.0, solution.duration, INSTANTS)


def _force(solution: Any, motion: Any) -> Any:
    """Every jump is kept; contacts are shaded; of methods with a raw force also the resolved one."""
    figure = Figure("N", "contact force", HISTORIES["contact_force"].of)
    time, force = solution.time, solution.force
    if time.size > LONGEST_HISTORY:
        time = _instants(solution)
        force = motion.force(time)
    curves = [_curve(figure, time, force)]
    if hasattr(motion, "resolved_force"):
        even = _instants(solution)
        curves[0] = curves[0].relabel("raw")
        curves.append(_curve(figure, even, motion.resolved_force(even)).relabel("resolved"))
    spans = [(contact.start, contact.end) for contact in solution.contacts]
    starts, ends = np.array(spans).reshape(-1, 2).T
    contacts = hv.VSpans((starts, ends), kdims=[TIME, "end"]).opts(color="grey", alpha=0.2)
    return hv.Overlay([*curves, contacts])  # the first gives the axes their names


def _motion(solution: Any, motion: Any) -> Any:
    """Displacements and velocities of the impactor and of the struck face."""
    time, own = _instants(solution), histories_of(solution.scene)

    def beside(axis: Figure, names: dict[str, str]) -> Any:
        shown = {label: own[name].of(motion, time) for name, label in names.items() if name in own}
        return hv.Overlay([_curve(axis, time, values).relabel(label) for label, values in shown.items()])

    position, velocity = (STRIKING[name] for name in ("impactor_position", "impactor_velocity"))
    positions = {"impactor_position": "impactor", "end_position": "struck face"}
    velocities = {"impactor_velocity": "impactor", "end_velocity": "struck face", "target_mean_velocity": "target mean"}
    displacement = position._replace(long_name="displacement")
    return (beside(displacement, positions) + beside(velocity._replace(long_name="velocity"), velocities)).cols(1)


def _waves(solution: Any, motion: Any) -> Any:
    """Stress over place and time."""
    first, last = reach(solution)
    if last <= first:
        raise SceneError("what", "waves", allowed("no-length"))
    x, time, stress = np.linspace(first, last, PLACES), _instants(solution), FIELDS["stress"]
    place = hv.Dimension("x", label=f"place from {origin(solution.scene)}", unit="m")
    values = stress.of(motion, time, x)
    peak = float(np.abs(values).max()) or 1.0
    scale = hv.Dimension("stress", label=stress.long_name, unit=stress.unit, range=(-peak, peak))
    return hv.Image((x, time, values), [place, TIME], scale).opts(cmap="RdBu_r", colorbar=True)


def _energy(solution: Any, motion: Any) -> Any:
    """Each part upon the others: the top is the total."""
    time = _instants(solution)
    energy = hv.Dimension("energy", label="energy", unit="J")
    parts = {
        name.replace("_", " "): hv.Area((time, values), TIME, energy) for name, values in motion.energies(time).items()
    }
    return hv.Area.stack(hv.NdOverlay(parts, kdims="part", sort=False))


def _curve(figure: Figure, time: np.ndarray, values: np.ndarray) -> Any:
    value = hv.Dimension(figure.long_name.replace(" ", "_"), label=figure.long_name, unit=figure.unit)
    return hv.Curve((time, values), TIME, value)


# --- studies ----------------------------------------------------------------------------------------------------------


def ensemble(found: Any, what: str, units: Any) -> Any:
    """See `Ensemble.plot`; `units` by figure."""
    choice("what", what, (*BANDS, *units))
    draw_with_bokeh()
    if what not in BANDS:
        change = hv.Dimension("change", label=f"relative change of {found.key}")
        value = hv.Dimension(what, label=what.replace("_", " "), unit=units[what][0] or None)
        return titled(hv.Scatter((found.perturbations, getattr(found, what)), change, value), "", what)
    band, figure = getattr(found, what), BANDS[what]
    value = hv.Dimension(what, label=figure.long_name, unit=figure.unit)
    upper = hv.Dimension("upper", label=f"{figure.long_name}, upper", unit=figure.unit)
    areas = {"all runs": (band.lowest, band.highest), "nine tenths": (band.low, band.high)}
    drawn = [
        hv.Area((found.time, *both), TIME, [value, upper], label=name).opts(alpha=0.3) for name, both in areas.items()
    ]
    return titled(
        hv.Overlay([*drawn, hv.Curve((found.time, band.median), TIME, value, label="median")]), "", "ensemble"
    )


def figures(found: Any, what: str, units: Any) -> Any:
    """See `Figures.plot`; `units` by figure."""
    choice("what", what, units)
    draw_with_bokeh()
    value = hv.Dimension(what, label=what.replace("_", " "), unit=units[what] or None)
    keys = [hv.Dimension(key, unit=found.units.get(key) or None) for key in found.varied]
    if len(keys) == 2:
        return titled(_over_two(found, what, keys, value), "", what)
    key, across = (keys[0], found.varied[keys[0].name]) if len(keys) == 1 else ("scene", np.arange(len(found)))
    points = hv.Scatter((across, found.columns[what]), key, value).opts(logx=_wide(across))
    return titled(points, "", what)


def _over_two(found: Any, what: str, keys: list[Any], value: Any) -> Any:
    """A map where two keys form a grid, else coloured points; by powers of ten where values span a hundredfold."""
    logs = [_wide(values) for values in found.varied.values()]
    options = {"logx": logs[0], "logy": logs[1], "colorbar": True, "cmap": "viridis"}
    filled = found.grid()
    if filled is None or min(axis.size for axis in filled[0].values()) < 2:
        points = hv.Points((*found.varied.values(), found.columns[what]), keys, value)
        return points.opts(**options, color=what) if hv.Store.current_backend == "bokeh" else points
    axes, arrays = filled
    edges = [edges_of(axis, log) for axis, log in zip(axes.values(), logs, strict=True)]
    return hv.QuadMesh((*edges, arrays[what].T), keys, value).opts(**options)


def _wide(values: np.ndarray) -> bool:
    """Whether they span a hundredfold, above zero."""
    return bool(values.min() > 0.0 and values.max() >= 99.9 * values.min())


def convergence(found: Any, what: str) -> Any:
    """See `Convergence.plot`."""
    choice("what", what, ("differences", *found.values))
    draw_with_bokeh()
    log = found.kind != "restitution"
    across = hv.Dimension(found.kind, unit="s" if found.kind == "step" else None)
    if what != "differences":
        value = hv.Dimension(what, label=what.replace("_", " "), unit=found.units[what] or None)
        curve = hv.Curve((found.counts, found.values[what]), across, value).opts(logx=log)
        return titled(curve, found.method, what)
    value = hv.Dimension("difference", label="difference to the finest" if log else "difference to the last")
    curves = {}
    for name, differences in found.differences.items():
        shown = differences > 0.0 if log else np.ones(differences.size, bool)
        if shown.any():  # else the same for all
            curve = hv.Curve((found.counts[shown], differences[shown]), across, value, label=name.replace("_", " "))
            curves[name] = curve.opts(logx=log, logy=log)
    return titled(hv.Overlay(list(curves.values())), found.method, what)


def tradeoff(found: Any, quantity: str) -> Any:
    """See `TradeOff.plot`."""
    choice("quantity", quantity, found.quantities)
    draw_with_bokeh()
    seconds = hv.Dimension("wall_time", label="wall time", unit="s")
    error = hv.Dimension("error", label=f"error of {quantity}")
    floor = max((found.reference and found.reference.uncertainty.get(quantity)) or 0.0, LEAST_ERROR)

    def curve(points: list[Any], label: str) -> Any:
        points = sorted(points, key=lambda point: point.wall_time)
        errors = [max(abs(point.errors[quantity]), floor) for point in points]
        return hv.Curve(([point.wall_time for point in points], errors), seconds, error, label=label)

    ladders: dict[str, list[Any]] = {}
    for point in found.points:
        if point.errors.get(quantity) is not None:
            ladders.setdefault(point.ladder, []).append(point)
    drawn = [each for name, points in ladders.items() for each in _marked(curve(points, name))]
    front = _marked(curve(found.front(quantity), "nothing better"))[0].opts(color="black")
    if hv.Store.current_backend == "bokeh":
        front = front.opts(line_dash="dashed")
    whole = titled(hv.Overlay([*drawn, front]).opts(logx=True, logy=True), found.scene.get("title", ""), quantity)
    return whole.opts(width=WIDTH + LONG_LEGEND) if hv.Store.current_backend == "bokeh" else whole


LEAST_ERROR = 1e-16  # on axes of powers of ten, which have no zero


def _marked(curve: Any) -> tuple[Any, Any]:
    """A line and its points, as a ladder may have but one."""
    return curve.opts(logx=True, logy=True), hv.Scatter(curve, label=curve.label).opts(logx=True, logy=True)


def regimes(found: Any, what: str) -> Any:
    """See `RegimeMap.plot`."""
    choice("what", what, ("smallest", *found.models))
    draw_with_bokeh()
    time = hv.Dimension("relative_time", label="contact time over the period of the target")
    ratio = hv.Dimension("mass_ratio", label="mass ratio, target over impactor")
    shown = found.relative_time > 0.0
    if what == "smallest":
        cells = found.smallest[:, shown]
        drawn = []
        for number, name in enumerate([*found.models, "none of them"]):
            row, column = np.nonzero(cells == number)
            points = found.relative_time[shown][column], found.mass_ratio[row]
            drawn += [_squares(hv.Scatter(points, time, ratio, label=name))] if row.size else []
        return titled(hv.Overlay(drawn), found.family, f"smallest adequate model for {found.question}")
    edges = edges_of(found.relative_time[shown], True), edges_of(found.mass_ratio, True)
    errors = found.errors[found.models.index(what)][:, shown]
    value = hv.Dimension("error", label=f"error of {found.question}")
    mesh = hv.QuadMesh((*edges, np.where(np.isfinite(errors), errors, np.nan)), [time, ratio], value)
    lines = [
        hv.Curve(points, time, ratio, label=f"{100 * level:g} %").opts(logx=True, logy=True)
        for level, points in found.contours[what].items()
        if points[0].size
    ]
    mesh = mesh.opts(logx=True, logy=True, logz=True, colorbar=True, cmap="viridis")
    return titled(hv.Overlay([mesh, *lines]), found.family, what)


def _squares(points: Any) -> Any:
    points = points.opts(logx=True, logy=True)
    return points.opts(marker="square", size=6) if hv.Store.current_backend == "bokeh" else points


def stability(found: Any, integrator: str | None) -> Any:
    """See `Stability.plot`."""
    known = {name: each for name, each in found.maps.items() if each.reason is None}
    if integrator is None:
        return hv.Layout([stability(found, name) for name in known]).cols(2)
    choice("integrator", integrator, known)
    draw_with_bokeh()
    down, across = found.axes
    dimensions = [hv.Dimension(axis.name, label=axis.name.replace("_", " "), unit=axis.unit) for axis in (across, down)]
    value = hv.Dimension("energy_error", label="energy error")
    each, logs = known[integrator], {"logx": across.log, "logy": down.log}
    error = np.where(each.ending < UNENDED, np.maximum(np.abs(each.energy_error), LEAST_ERROR), np.nan)
    mesh = hv.QuadMesh((*(edges_of(axis.values, axis.log) for axis in (across, down)), error), dimensions, value)
    drawn = [mesh.opts(**logs, logz=True, colorbar=True, cmap="viridis")]
    if each.limit is not None and (each.limit <= down.values[-1]).any():
        steps = np.where(each.limit <= down.values[-1], each.limit, np.nan)
        limit = hv.Curve((across.values, steps), *dimensions, label="largest stable step")
        drawn.append(limit.opts(**logs, color="black"))
    row, column = found.here
    here = hv.Scatter(([column], [row]), *dimensions, label="the scene itself")
    return titled(hv.Overlay([*drawn, here.opts(**logs, color="red")]), found.scene.title, integrator)


UNENDED = 2  # of `Map.ending`: from here on a run has not parted the bodies


def edges_of(middles: np.ndarray, log: bool) -> np.ndarray:
    """Of cells about these values, of which there are two or more."""
    places = np.log(middles) if log else np.asarray(middles, float)
    between = 0.5 * (places[1:] + places[:-1])
    edges = np.concatenate(([2.0 * places[0] - between[0]], between, [2.0 * places[-1] - between[-1]]))
    return np.exp(edges) if log else edges


DRAWN = {"force": _force, "motion": _motion, "waves": _waves, "energy": _energy}
