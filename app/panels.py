"""The panels beside the solution: who answers what is asked in them, and when."""

from collections.abc import Callable, Coroutine
from functools import partial
from typing import Any

import panel as pn
import param

from .advice import plan_data, regimes_data
from .auto_view import auto_data
from .jobs.long_run import LongRun
from .jobs.runner import Runner
from .map_point import choices_at
from .questions import Questions
from .stability_view import stability_data, stability_kernels
from .tradeoff_view import stored_data, tradeoff_data, tradeoff_kernels


class Panels(Questions):
    """Has the questions of a visitor answered; a part of `app.lab.Lab`."""

    # What the laboratory gives
    chosen: Callable[[], dict[str, Any]]
    _runner_of: Callable[..., Runner]
    visitor: str | None
    _refuse: Callable[[str], None]
    _wait: Callable[[str, str], None]
    _tell: Callable[..., Coroutine]
    choose: Callable[[dict[str, Any]], None]

    def open_panels(self) -> None:
        """Make those who answer, and have them asked whenever a question changes."""
        self._plan_runner = self._runner_of(plan_data, partial(setattr, self, "plan"))
        self._regimes_runner = self._runner_of(regimes_data, partial(setattr, self, "regimes"))
        self._stored_runner = self._runner_of(stored_data, partial(setattr, self, "tradeoff"))
        self._auto_runner = self._runner_of(auto_data, partial(setattr, self, "auto"), stoppable=True)
        self._point_runner = self._runner_of(choices_at, self.choose)
        self._auto_asked = 0  # times that have not been dealt with
        self._long = {
            "tradeoff": self._long_run("tradeoff", tradeoff_data, tradeoff_kernels),
            "stability": self._long_run("stability", stability_data, stability_kernels),
        }
        self._again: set[str] = set()  # long runs that begin anew when they have ended
        self._asked: dict[str, dict[str, Any]] = {}  # last, by name of the answer
        self.param.watch(self.ask_panels, list(self.FOLLOWED))
        for name in self._long:
            self.param.watch(partial(self._start_or_stop, name), f"{name}_running")
        self.param.watch(self._stop_or_resume, "auto_running")
        self.param.watch(self._go_to, "map_point")

    def _long_run(self, name: str, work: Callable, kernels: Callable) -> LongRun:
        acts = partial(setattr, self, name), self._refuse, partial(self._wait, name)
        return LongRun(work, kernels, *(partial(self._tell, act) for act in acts), visitor=self.visitor)

    def leave_panels(self) -> None:
        """The visitor has gone; who comes back asks anew."""
        self._asked.clear()
        self._again.clear()
        for run in self._long.values():
            run.leave()

    def ask_panels(self, *events: param.parameterized.Event) -> None:
        """Have every open panel follow the choices, after the blow itself is answered."""
        chosen = self.chosen()
        if self.plan_shown:
            asked = chosen | {"question": self.question, "plan_tolerance": self.plan_tolerance}
            self._want("plan", self._plan_runner, asked, asked)
            self._want("regimes", self._regimes_runner, asked, asked)
        if self.auto_shown:
            asked = chosen | {name: getattr(self, name) for name in self.AUTO}
            self._want_auto(asked, _of_any_method(asked))
        if self.tradeoff_shown and not self._long["tradeoff"].busy:
            self._want("tradeoff", self._stored_runner, chosen, _of_any_method(chosen))

    def _want(self, name: str, runner: Runner, asked: dict[str, Any], key: dict[str, Any]) -> None:
        """Ask, unless the same, as far as it matters, was asked last."""
        if self._asked.get(name) != key:
            self._asked[name] = key
            pn.state.execute(partial(runner.want, asked))

    def _go_to(self, event: param.parameterized.Event) -> None:
        """Have the sliders follow a point of the map; the browser sends the next when this one is cleared."""
        if event.new:
            pn.state.execute(partial(self._arrive, self.chosen() | {"map_point": event.new}))

    async def _arrive(self, asked: dict[str, Any]) -> None:
        await self._point_runner.want(asked)
        await self._tell(setattr, self, "map_point", "")

    def _want_auto(self, asked: dict[str, Any], key: dict[str, Any]) -> None:
        """As `_want`; the visitor sees that it is under way, and may stop it."""
        if self._asked.get("auto") != key:
            self._asked["auto"] = key
            self._auto_asked += 1
            self.auto_running = True
            pn.state.execute(partial(self._find_auto, asked))

    async def _find_auto(self, asked: dict[str, Any]) -> None:
        await self._auto_runner.want(asked)
        self._auto_asked -= 1
        if not self._auto_asked:
            await self._tell(self._auto_over)

    def _auto_over(self) -> None:
        if not self._auto_asked:  # nor was anything asked since
            self.auto_running = False

    def _stop_or_resume(self, event: param.parameterized.Event) -> None:
        """The visitor has had enough, or wants it all the same."""
        if not event.new:
            self._auto_runner.stop()
        elif not self._auto_asked:
            self._asked.pop("auto", None)
            self.ask_panels()

    def _start_or_stop(self, name: str, event: param.parameterized.Event) -> None:
        run = self._long[name]
        self._again.discard(name)
        if not event.new:
            run.stop()
        elif run.busy:  # stopped before, and about to end
            self._again.add(name)
        else:
            self._start(name)

    def _start(self, name: str) -> None:
        more = self.STABILITY if name == "stability" else ()
        asked = self.chosen() | {key: getattr(self, key) for key in more}
        pn.state.execute(partial(self._long[name].start, asked, partial(self._ended, name, asked)))

    async def _ended(self, name: str, asked: dict[str, Any]) -> None:
        if name in self._again:
            self._again.discard(name)
            self._start(name)
            return
        await self._tell(setattr, self, f"{name}_running", False)
        if name == "tradeoff":  # what was measured stays, unless the scene has changed meanwhile
            self._asked[name] = _of_any_method(asked)
            self.ask_panels()


def _of_any_method(asked: dict[str, Any]) -> dict[str, Any]:
    """What was asked, without the method and its resolution."""
    return {name: value for name, value in asked.items() if name not in ("method", "modes", "elements")}
