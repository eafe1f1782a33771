"""What a visitor may ask about a blow beside its solution: bounded values, no widget, and the answers as text."""

from typing import Any

import param

from solvers.auto import ASKABLE
from solvers.regime_models import QUESTIONS
from solvers.stability import AXES

WITHIN = ("tolerance", "time")
STABILITY_AXES = tuple(name for name in AXES if name != "step")
BUDGET = 6.0  # s that one visitor may keep the others waiting


class Questions(param.Parameterized):
    """Questions of a visitor and the answers to them, each a text in JSON."""

    plan_shown = param.Boolean(default=False, doc="whether the plan and the map of regimes are open")
    question = param.Selector(default=QUESTIONS[0], objects=list(QUESTIONS))
    plan_tolerance = param.Number(default=0.05, bounds=(1e-4, 0.5))
    map_point = param.String(
        default="", regex=r"^[0-9.e+ -]{0,40}$", doc="where the visitor wants to be, until it is so"
    )
    plan = param.String(default="", doc="the smallest adequate model, see app.advice")
    regimes = param.String(default="", doc="the map in which the scene lies, see app.advice")
    tradeoff_shown = param.Boolean(default=False, doc="whether speed against accuracy is open")
    tradeoff_running = param.Boolean(default=False, doc="whether it is being measured; the visitor starts and stops it")
    tradeoff = param.String(default="", doc="that table, see app.tradeoff_view")
    auto_shown = param.Boolean(default=False, doc="whether a tolerance is asked for instead of a method")
    auto_within = param.Selector(default=WITHIN[0], objects=list(WITHIN))  # what the answer is to keep to
    auto_quantity = param.Selector(default=ASKABLE[0], objects=list(ASKABLE))
    auto_tolerance = param.Number(default=0.01, bounds=(1e-6, 0.5))
    auto_budget = param.Number(default=0.05, bounds=(1e-4, BUDGET), doc="computing time that may be spent [s]")
    auto_waves = param.Boolean(default=True, doc="whether exact travelling waves may be chosen")
    auto_follows = param.Boolean(default=False, doc="whether the page shows the method that is chosen")
    auto_running = param.Boolean(default=False, doc="whether it is looked for; the visitor may stop it")
    auto = param.String(default="", doc="what keeps to it, see app.auto_view")
    stability_shown = param.Boolean(default=False, doc="whether the maps of stability are open")
    stability_axis = param.Selector(default=STABILITY_AXES[0], objects=list(STABILITY_AXES))  # beside the step
    stability_running = param.Boolean(default=False, doc="whether they are worked out; the visitor starts and stops it")
    stability = param.String(default="", doc="those maps, or how far they are, see app.stability_view")

    PLAN = ("plan_shown", "question", "plan_tolerance")
    AUTO = ("auto_within", "auto_quantity", "auto_tolerance", "auto_budget", "auto_waves")
    TRADEOFF = ("tradeoff_shown",)
    STABILITY = ("stability_axis",)
    RUNS = ("tradeoff_running", "stability_running", "auto_running")
    FOLLOWED = (*PLAN, "auto_shown", *AUTO, *TRADEOFF)  # what panels answer at once
    ASKED = (*FOLLOWED, "auto_follows", *RUNS, "stability_shown", *STABILITY, "map_point")


def _defaults(*names: str) -> dict[str, Any]:
    return {name: Questions.param[name].default for name in names}


QUESTIONS_OF = {  # by work: what it is asked besides the choices, as long as nobody changes it
    "plan_data": _defaults("question", "plan_tolerance"),
    "regimes_data": _defaults("question", "plan_tolerance"),
    "auto_data": _defaults(*Questions.AUTO),
    "choices_at": {"map_point": "0.3 1.0"},
    "stability_kernels": _defaults(*Questions.STABILITY),
}


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
