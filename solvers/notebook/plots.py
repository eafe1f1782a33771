"""A solution as HoloViews objects.

>>> import solvers
>>> curve = solvers.solve(solvers.load("fixed-rod")).plot("force").Curve.I
>>> [dimension.pprint_label for dimension in curve.dimensions()]
['time (s)', 'contact force (N)']
"""

from typing import Any

import holoviews as hv
import numpy as np

from ..validation import SceneError, allowed, choice
from .figures import FIELDS, HISTORIES, STRIKING, Figure, histories_of, origin, reach

INSTANTS, PLACES = 801, 401
LONGEST_HISTORY = 20_000  # instants; a longer one is drawn at INSTANTS
WIDTH, HEIGHT = 700, 350  # pixels
TIME = hv.Dimension("time", label="time", unit="s")


def plot(solution: Any, what: str) -> Any:
    """See `Solution.plot`."""
    drawn = DRAWN[choice("what", what, DRAWN)]
    motion = solution.known_motion
    if not hv.Store.renderers:  # the user has chosen none
        hv.extension("bokeh")
    title = solution.scene.title or "Scene"
    return _wide(drawn(solution, motion).relabel(f"{title}, {solution.method['name']}"))


def _wide(drawn: Any) -> Any:
    """Long enough for many contacts, the legend beside them; of Bokeh alone, as others measure in other units."""
    if hv.Store.current_backend != "bokeh":
        return drawn
    size = {"width": WIDTH, "height": HEIGHT}
    kinds = (hv.opts.Curve, hv.opts.Image, hv.opts.Area)
    beside = (kind(**size, legend_position="right") for kind in (hv.opts.Overlay, hv.opts.NdOverlay))
    return drawn.opts(*(kind(**size) for kind in kinds), *beside)


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


DRAWN = {"force": _force, "motion": _motion, "waves": _waves, "energy": _energy}
