"""What a scene is opened with, as it shows what it is named after: charts, and views beside the solution."""

from typing import Any, NamedTuple


class Opening(NamedTuple):
    """Charts and views by their names in the stacks of the page and in `app.views.registry`."""

    charts: tuple[str, ...] = ()
    place: float | None = None  # of the figure, from the struck end [m]
    until: float | None = None  # the part of the impact that is looked at, from the first touch on [s]
    views: tuple[str, ...] = ()
    varied: str = ""  # what the view of convergence varies, see `solvers.studies.levels`
    by: tuple[float, ...] = ()  # its values


def _stress(place: float) -> Opening:
    return Opening(charts=("stress",), place=place)


def _convergence(varied: str, *by: float) -> Opening:
    return Opening(views=("convergence",), varied=varied, by=by)


_STEPS = _convergence("step", 58.9e-8, 29.5e-8, 9.82e-8, 5.89e-8)
_NONE = Opening()
OPENINGS = {
    "bouncing-ball": Opening(views=("bounces",)),
    "bent-rods": Opening(views=("joints",)),
    "figure-5.23": Opening(views=("stretch",)),
    "figure-5.24": Opening(views=("stretch",)),
    "table-6.2": _convergence("elements", 5, 10, 20),
    "table-6.3": _convergence("restitution", 1.0, 0.7, 0.3, 0.0),
    "table-6.4": _STEPS,
    "table-6.5": _STEPS,
    "table-6.6": _convergence("modes", 5, 8, 12),
    "table-6.8": _convergence("modes", 5, 9, 13),
    "figure-6.7": Opening(charts=("moved",)),
    "figure-6.8": Opening(charts=("moved",)),
    "figure-6.9": Opening(charts=("reactions",), until=1e-3),
    "figure-6.10": Opening(charts=("reactions",), until=1e-3),
    "table-6.9": Opening(views=("mode_change",)),
    "table-6.10": Opening(views=("mode_change",)),
    "table-6.11": Opening(views=("mode_change",)),
    "table-6.12": Opening(views=("mode_change",)),
    "figure-9.11": Opening(charts=("force",)),
    "figure-9.12": _stress(1.0),
    "figure-9.13": _stress(1.0),
    "figure-9.14": _stress(0.5),
    "figure-10.2": Opening(charts=("force",)),
    "figure-10.3": Opening(charts=("moved",)),
    "figure-10.4": _stress(0.74),
    "figure-10.5": _stress(0.0),
    "figure-10.6": _stress(0.74),
    "figure-10.7": _stress(0.0),
    "figure-10.10": Opening(charts=("force",)),
}


def opening_of(scene: str) -> Opening:
    """Nothing for most scenes."""
    return OPENINGS.get(scene, _NONE)


def opened_charts(scene: str) -> dict[str, Any]:
    """Names of charts, where the stress is told [m], and until when time is looked at [s]."""
    opening = opening_of(scene)
    return {"charts": list(opening.charts), "place": opening.place, "until": opening.until}
