"""What a step shows: the bodies, or the picture its scene opens with; below that rows over time, or charts."""

from ..views.registry import VIEWS
from ..views.whatif import COLUMNS
from .fields import Fields
from .problems import wanted
from .solving import Shown
from .stage import Stage

PLAIN = ("bodies", "rows")
PICTURES = {"axial": ("forces", "opening")}  # arrows on the bodies; the picture that the scene opens with: a drop
CHARTS = {  # of the page, by kind of scene
    "axial": ("force", "moved", "indentation", "map"),
    "beam": ("force", "moved", "indentation", "dispersion", "map"),
    "mechanism": ("force", "moved", "indentation", "reactions", "map"),
    "bodies": ("hodograph", "course", "map"),
}
RESULTS = COLUMNS[1:]  # of a map
ANALYSES = ("energy", "modes", "ratios", "spectrum", "joints", "convergence", "tradeoff", "stability")
MOST = 2  # of both at once


def read_shown(fields: Fields, stage: Stage) -> tuple[str, ...] | None:
    """Names of a list `show`, of what there is for this kind of scene; None without one."""
    analyses = [view.key for view in VIEWS if view.key in ANALYSES and stage.kind in view.kinds]
    pictures = [name for name in PICTURES.get(stage.kind, ()) if name != "opening" or stage.drops]
    found = fields.names("show", [*PLAIN, *pictures, *CHARTS[stage.kind], *analyses])
    charts = [name for name in found or () if name not in (*PLAIN, *pictures)]
    if found and (len(charts) > MOST or (charts and {"rows", "opening"} & {*found})):
        fields.problem("show", "charts-and-rows", most=MOST)
    return found


def read_map(fields: Fields, stage: Stage) -> tuple[str, ...]:
    """The result that a map shows, and the settings across and upwards, of a list `map`; without one the page's own."""
    given = fields.take("map")
    if given is None:
        return ()
    settings = stage.mapped()
    listed = isinstance(given, list) and len(given) == 3 and all(isinstance(each, str) for each in given)
    if listed and given[0] in RESULTS and {*given[1:]} <= {*settings} and given[1] != given[2]:
        return tuple(given)
    fields.refuse("map", given, wanted("map", results=[*RESULTS], names=settings))
    return ()


def has(shown: Shown, name: str) -> bool:
    """Whether there is anything of it in this impact."""
    solution, chosen = shown.solution, shown.request.chosen
    if name in ("force", "forces", "reactions"):
        return solution.peak_force is not None
    if name == "indentation":
        return solution.peak_indentation is not None
    if name in ("hodograph", "course"):
        return bool(solution.sliding)
    if name == "energy":  # of a mechanism that moves on it is a chart
        return True
    views = [view for view in VIEWS if view.key == name]
    return all(view.depends_on(chosen) is not None for view in views)
