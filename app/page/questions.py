"""What a visitor may open and ask beside the choices: bounded values, no widget, and the answers as text."""

import param

from ..views.registry import VIEWS
from ..views.whatif import LONGEST, POINTS


class Questions(param.Parameterized):
    """Questions of a visitor and the answers to them, each a text in JSON; all are made from the registry of views."""

    OPENED = tuple(view.opener for view in VIEWS)
    RUNS = tuple(view.running for view in VIEWS if view.run or view.stoppable)
    FOLLOWED = (*OPENED, *(name for view in VIEWS for name in view.sent))  # what is answered at once
    ASKED = (
        *OPENED,
        *RUNS,
        "body_value",
        "time_in_view",
        POINTS,
        *(name for view in VIEWS for name in view.asked),
    )  # what a visitor may set

    body_value = param.String(
        default="", regex=r"^[a-z0-9_.]{0,60}(=[\w.+-]{0,30})?$", doc="a value of a body, until it is so"
    )
    time_in_view = param.String(
        default="",
        regex=r"^$|^\d+(\.\d+)?(e-?\d\d?)? \d+(\.\d+)?(e-?\d\d?)?$",
        doc="START END [s]; empty: all of it",
    )
    closer = param.Bytes(default=b"", doc="the message whose histories are of the time in view")
    whatif_points = param.String(
        default="",
        regex=rf"(?s)^.{{0,{LONGEST}}}\Z",
        doc="points of the map, in JSON, see app.views.whatif; empty: none",
    )
    whatif = param.String(default="", doc="figures at these points, in JSON")


for _view in VIEWS:
    Questions.param.add_parameter(_view.opener, param.Boolean(default=False, doc="whether it is open"))
    if _view.running in Questions.RUNS:
        Questions.param.add_parameter(_view.running, param.Boolean(default=False, doc="whether it is under way"))
    for _name, _question in _view.asked.items():
        Questions.param.add_parameter(_name, _question.parameter)
    for _name in {_view.name: None} | dict(_view.more):
        Questions.param.add_parameter(_name, param.String(default="", doc="its answer, see app.views"))


def accepted(name: str, value: object) -> bool:
    """Whether a question may have this value."""
    parameter = Questions.param[name]
    if isinstance(value, bool) != isinstance(parameter, param.Boolean):  # Python counts booleans among the numbers
        return False
    try:
        Questions(**{name: value})
    except (ValueError, TypeError, OverflowError):
        return False
    return True
