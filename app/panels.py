"""What is asked about a blow beside its solution: parameters of the panels below the page, and who answers them."""

from collections.abc import Callable
from functools import partial
from typing import Any

import panel as pn
import param

from solvers.regime_models import QUESTIONS

from .advice import plan_data, regimes_data
from .runner import Runner


class Panels(param.Parameterized):
    """Bounded questions of a visitor and the answers to them, each a text in JSON; a part of `app.lab.Lab`."""

    plan_shown = param.Boolean(default=False, doc="whether the plan and the map of regimes are open")
    question = param.Selector(default=QUESTIONS[0], objects=list(QUESTIONS))
    plan_tolerance = param.Number(default=0.05, bounds=(1e-4, 0.5))
    plan = param.String(default="", doc="the smallest adequate model, see app.advice")
    regimes = param.String(default="", doc="the map in which the scene lies, see app.advice")

    ASKED = ("plan_shown", "question", "plan_tolerance")

    # What the laboratory gives
    chosen: Callable[[], dict[str, Any]]
    _runner_of: Callable[..., Runner]
    _asking: Callable[..., None]

    def open_panels(self) -> None:
        """Make those who answer, and have them asked whenever a question changes."""
        self._plan_runner = self._runner_of(plan_data, partial(self._tell, "plan"))
        self._regimes_runner = self._runner_of(regimes_data, partial(self._tell, "regimes"))
        self.param.watch(self.ask_panels, list(self.ASKED))

    def _tell(self, name: str, answer: Any) -> None:
        """Set an answer with the document locked: of two that come at once, outside the lock, one may get lost."""
        pn.state.execute(partial(setattr, self, name, answer), schedule=True)

    def ask_panels(self, *events: param.parameterized.Event) -> None:
        """Have every open panel follow the choices, after the blow itself is answered."""
        if self.plan_shown:
            asked = self.chosen() | {"question": self.question, "plan_tolerance": self.plan_tolerance}
            self._asking(self._plan_runner, asked)
            self._asking(self._regimes_runner, asked)


def accepted(name: str, value: object) -> bool:
    """Whether a question may have this value."""
    parameter = Panels.param[name]
    if isinstance(value, bool) != isinstance(parameter, param.Boolean):  # Python counts booleans among the numbers
        return False
    try:
        Panels(**{name: value})
    except (ValueError, TypeError, OverflowError):
        return False
    return True
