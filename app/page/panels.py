"""The views beside the solution: who answers what is asked in them, and when."""

import json
from collections import Counter
from collections.abc import Callable, Coroutine, Hashable, Iterable, Iterator
from functools import partial
from typing import Any

import param

from ..choices.body_value import with_body_value
from ..choices.own import is_own
from ..choices.request import IN_VIEW
from ..choices.scene_of import kind_name
from ..jobs.long_run import LongRun
from ..jobs.runner import Runner
from ..jobs.spread import points_started
from ..jobs.workers import Lost
from ..messages.solve import solve_frame
from ..views.registry import VIEWS, View
from ..views.whatif import POINTS, id_of, whatif_data
from .begin import begin
from .questions import Questions
from .reading import by_worker, depends_on

MAX_ANALYSIS_SECONDS = 30.0  # of computing that one answer of a view may take
REST_SECONDS = 0.4  # for which choices must stand before a view of many solves follows them


class Panels(Questions):
    """Has the questions of a visitor answered; a part of `app.page.lab.Lab`."""

    # What the laboratory gives
    scene: str
    chosen: Callable[[], dict[str, Any]]
    visitor: str | None
    _refuse: Callable[[dict[str, Any]], None]
    _wait: Callable[[str, dict[str, Any] | None], None]
    _report: Callable[..., Coroutine]
    _shown_choices: dict[str, Any]
    choose: Callable[[dict[str, Any]], None]

    def open_panels(self) -> None:
        """Make those who answer, and have them asked whenever a question changes."""
        self._runners: dict[str, Runner] = {}  # by property of the answer, or of the question that leads somewhere
        self._long: dict[str, LongRun] = {}  # by view
        self._pending: Counter[str] = Counter()  # by view: times that it was asked and is not answered
        self._again: set[str] = set()  # long runs that begin anew when they have ended
        self._asked: dict[str, Hashable] = {}  # by view: what its last answer, or the one that comes, depends on
        self._looking: dict[str, Any] = {}  # by view: what was asked last, whose scene may have to be looked at
        self._led: dict[str, Any] = {}  # by question that leads somewhere: what was asked last, until it is answered
        self.param.watch(self.ask_panels, list(self.FOLLOWED))
        for view in VIEWS:
            self._open(view)
        acts = partial(setattr, self, "closer"), self._refuse_closer, partial(self._wait, IN_VIEW)
        self._runners[IN_VIEW] = Runner(solve_frame, *self._reports(acts), visitor=self.visitor)
        self.param.watch(self._look_closer, IN_VIEW)
        acts = partial(setattr, self, "whatif"), self._refuse_points
        how = {"visitor": self.visitor, "stoppable": True, "start": points_started}
        self._runners[POINTS] = Runner(whatif_data, *self._reports(acts), **how)
        self.param.watch(self._ask_points, POINTS)
        acts = self.choose, self._refuse, partial(self._wait, with_body_value.__name__)
        self._lead("body_value", Runner(with_body_value, *self._reports(acts), visitor=self.visitor))

    def _lead(self, name: str, runner: Runner) -> None:
        """Have a question answered by choices that change."""
        self._runners[name] = runner
        self.param.watch(partial(self._go_to, name), name)

    def _refuse_closer(self, reason: dict[str, Any]) -> None:
        """Say it of what is shown: of other choices their own answer does, and twice would end what is asked next."""
        asked, shown = self._runners[IN_VIEW].current, self._shown_choices
        if shown and shown == {name: asked.get(name) for name in shown}:
            self._refuse(reason)

    def _look_closer(self, event: param.parameterized.Event) -> None:
        """Have the histories of the stretch of time in view sampled for it."""
        if event.new:
            begin(partial(self._runners[IN_VIEW].want, self.chosen() | {IN_VIEW: event.new}))

    def _ask_points(self, event: param.parameterized.Event) -> None:
        """Have points of the map found; where none are asked any more, what is under way ends."""
        runner = self._runners[POINTS]
        if event.new:
            begin(partial(runner.want, self.chosen() | {POINTS: event.new}))
        else:
            runner.stop()

    def _refuse_points(self, reason: dict[str, Any]) -> None:
        """Say it on the map alone: of what is chosen it says nothing."""
        self.whatif = json.dumps({"id": id_of(self._runners[POINTS].current[POINTS]), "error": reason})

    def _reports(self, acts: Iterable[Callable]) -> Iterator[Callable]:
        return (partial(self._report, act) for act in acts)

    def _open(self, view: View) -> None:
        for name, work in view.answers.items():
            self._runners[name] = self._runner_of(view, work, partial(setattr, self, name))
        for name, question in view.asked.items():
            if question.leads:
                self._lead(name, self._runner_of(view, question.leads, self.choose))
        if view.run and view.kernels:
            acts = partial(setattr, self, view.name), self._refuse, partial(self._wait, view.name)
            self._long[view.name] = LongRun(
                view.run, view.kernels, *self._reports(acts), visitor=self.visitor, kept=view.kept
            )
            self.param.watch(partial(self._start_or_stop, view), view.running)
        elif view.stoppable:
            self.param.watch(partial(self._stop_or_resume, view), view.running)

    def _runner_of(self, view: View, work: Callable, publish: Callable) -> Runner:
        acts = publish, partial(self._refuse_view, view), partial(self._wait, work.__name__)
        return Runner(
            work,
            *self._reports(acts),
            visitor=self.visitor,
            seconds=MAX_ANALYSIS_SECONDS,
            rest=REST_SECONDS if view.rests else 0.0,
            stoppable=view.stoppable,
        )

    def leave_panels(self) -> None:
        """The visitor has gone; who comes back asks anew."""
        self._asked.clear()
        self._again.clear()
        self._looking.clear()
        for run in (*self._runners.values(), *self._long.values()):
            run.leave()

    def ask_panels(self, *events: param.parameterized.Event) -> None:
        """Have every open view follow the choices, after the impact itself is answered.

        After an event, only those are asked that it opened or in which it asks something else.
        """
        changed = {event.name for event in events}
        for view in VIEWS:
            concerned = not events or changed & {view.opener, *view.sent}
            if not (concerned and view.work and self._shows(view)):
                continue
            asked = self._looking[view.name] = self._asked_of(view)
            if view.looks and (asked["bodies"] or is_own(asked["scene"])):
                begin(partial(self._look, view, asked))
            else:
                self._want(view, asked, view.depends_on(asked))

    async def _look(self, view: View, asked: dict[str, Any]) -> None:
        """Have a worker look at a scene that is the visitor's own, unless something else is asked meanwhile."""
        try:
            found = await by_worker(depends_on, view.name, asked, who=self.visitor)
        except (ValueError, Lost):  # which the visitor sees where it is solved
            return
        if self._looking.get(view.name) is asked and self._shows(view):
            self._want(view, asked, found)

    def _asked_of(self, view: View) -> dict[str, Any]:
        return self.chosen() | {name: getattr(self, name) for name in view.sent}

    def _shows(self, view: View) -> bool:
        """Whether a view is open, and for this scene."""
        return getattr(self, view.opener) and kind_name(self.scene) in view.kinds

    def _want(self, view: View, asked: dict[str, Any], depends_on: Hashable) -> None:
        """Ask, unless it is for another scene, the same, as far as it matters, was asked last, or the visitor has a
        long run answer it."""
        measured = view.name in self._long and self._long[view.name].busy
        if depends_on is None or measured or self._asked.get(view.name) == depends_on:
            return
        self._asked[view.name] = depends_on
        if view.stoppable:  # the visitor sees that it is under way, and may stop it
            self._pending[view.name] += len(view.answers)
            setattr(self, view.running, True)
        for name in view.answers:
            begin(partial(self._answer, view, self._runners[name], asked))

    async def _answer(self, view: View, runner: Runner, asked: dict[str, Any]) -> None:
        await runner.want(asked)
        if view.stoppable:
            self._pending[view.name] -= 1
            if not self._pending[view.name]:
                await self._report(self._over, view)

    def _over(self, view: View) -> None:
        if not self._pending[view.name]:  # nor was anything asked since
            setattr(self, view.running, False)

    def _refuse_view(self, view: View, reason: dict[str, Any]) -> None:
        """What was not answered may be asked again."""
        self._asked.pop(view.name, None)
        self._refuse(reason)

    def _go_to(self, name: str, event: param.parameterized.Event) -> None:
        """Have the sliders follow what is asked; the browser sends the next when this question is cleared."""
        if not event.new or self._led.get(name) == event.new:  # a browser that waits for long asks again
            return
        under_way, self._led[name] = name in self._led, event.new
        asked = self.chosen() | {name: event.new}
        begin(partial(self._runners[name].want, asked) if under_way else partial(self._arrive, name, asked))

    async def _arrive(self, name: str, asked: dict[str, Any]) -> None:
        try:
            await self._runners[name].want(asked)  # and all that was asked meanwhile
        finally:
            del self._led[name]
        await self._report(self._arrived, name)

    def _arrived(self, name: str) -> None:
        if name not in self._led:  # nor was anything asked since
            setattr(self, name, self.param[name].default)

    def _stop_or_resume(self, view: View, event: param.parameterized.Event) -> None:
        """The visitor has had enough, or wants it all the same."""
        if not event.new:
            self._runners[view.name].stop()
        elif not self._pending[view.name]:
            self._asked.pop(view.name, None)
            self.ask_panels()

    def _start_or_stop(self, view: View, event: param.parameterized.Event) -> None:
        run = self._long[view.name]
        self._again.discard(view.name)
        if not event.new:
            run.stop()
        elif run.busy:  # stopped before, and about to end
            self._again.add(view.name)
        else:
            self._start(view)

    def _start(self, view: View) -> None:
        asked = self._asked_of(view)
        begin(partial(self._long[view.name].start, asked, partial(self._ended, view, asked)))

    async def _ended(self, view: View, asked: dict[str, Any]) -> None:
        if view.name in self._again:
            self._again.discard(view.name)
            self._start(view)
            return
        await self._report(setattr, self, view.running, False)
        if view.work:  # what was measured stays, unless the scene has changed meanwhile
            self._asked[view.name] = view.depends_on(asked)
            self.ask_panels()
