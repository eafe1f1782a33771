"""The laboratory: the one component of the page. Python holds the choices and solves; the browser draws and plays."""

import hashlib
import json
import time
from collections.abc import Callable
from contextlib import contextmanager
from functools import partial
from typing import Any
from weakref import WeakKeyDictionary

import panel as pn
import param
from panel.io.document import unlocked
from param.parameterized import _syncing

from solvers import Waves

from ..choices.beam import free_place
from ..choices.choices import Choices, accepts, refusal
from ..choices.facts import facts_of
from ..choices.own import is_own
from ..choices.request import DRAFT
from ..choices.scene_of import choices_of, own_choices
from ..jobs.answers import KEPT
from ..jobs.loops import of_loop
from ..jobs.runner import Runner
from ..jobs.turns import Turnstile
from ..messages.solve import solve_frame
from ..text.catalogues import LANGUAGES, script
from ..text.refusals import reason_of
from ..views.registry import opened_with
from .address import ASKED, PANELS
from .begin import begin
from .drafts import Drafts
from .packed import STATIC, pack
from .panels import Panels
from .questions import accepted
from .reading import TAKEN, take

_SERVED = [
    *(file.read_bytes() for file in sorted(STATIC.rglob("*")) if file.is_file()),
    *(found.files.values() if (found := pack()) else ()),
    *(script(language).encode() for language in LANGUAGES),
]
HEIGHT = 860  # pixels, in a page of somebody else, unless another is given
VERSION = hashlib.sha256(b"".join(_SERVED)).hexdigest()[:10]
_LABS: WeakKeyDictionary[Any, "Lab"] = WeakKeyDictionary()  # by document


def lab_of(document: Any) -> "Lab | None":
    """The laboratory in a document."""
    return _LABS.get(document)


class Lab(Choices, Panels, Drafts, pn.custom.JSComponent):
    """Choices synchronised with the browser, and the message that answers them.

    Every choice is a bounded parameter of this very class, so that what a hostile client sends over the socket meets
    the same bounds as a slider: it is refused, and the browser is set back.
    """

    frame = param.Bytes(default=b"", doc="answer to the choices, see app.messages.axial")
    refused = param.String(default="", doc="why the last changes were not taken: notes, in JSON")
    waiting = param.String(default="", doc="why the answer takes longer: a note, in JSON, or nothing")
    disconnected = param.String(default="", doc="code of why this page is about to be disconnected")
    spec = param.Dict(default={}, doc="bounds and options of every choice, for the controls")
    shared = param.Dict(default={}, doc="what the address says beside the choices, see app.page.address")

    _bundle = STATIC / "page.js"
    _priority_changes = [*Choices.CHOSEN, *Panels.ASKED]  # no debounce: the browser waits for each answer

    def __init__(self, **choices):
        own = choices_of(choices["scene"]) if accepts("scene", choices.get("scene")) else {}
        place = {"sizing_mode": "stretch_width", "height": HEIGHT, "margin": 0}
        super().__init__(spec=spec_of_choices(), shared={"panels": PANELS, "asked": ASKED}, **(place | own | choices))
        self._sent = frozenset(self._linked_properties)
        self._waits: dict[str, Any] = {}  # by what is waited for: a note why it takes longer
        waiting = partial(self._report, self._wait, solve_frame.__name__)
        context = pn.state.curdoc.session_context if pn.state.curdoc else None
        self.visitor = context.id if context else None
        self._runner = Runner(solve_frame, self._take, self._fail, waiting, visitor=self.visitor)
        if pn.state.curdoc and context:
            pn.state.curdoc.on_session_destroyed(lambda _: self.leave())
        self._away = False
        self.answered_at = 0.0  # when the visitor was last shown an answer or refusal
        self._shown_choices: dict[str, Any] = {}  # the choices of the frame that is shown
        self._hold()
        self._quiet = False
        self.param.watch(self._changed, list(self.CHOSEN))
        self.watch_moves()
        self.open_panels()
        self._begin()
        if self.frame and any(getattr(self, name) for name in PANELS.values()):
            pn.state.onload(self.ask_panels)  # what the address has opened; for nobody who only fetches the page

    @classmethod
    def _component_resource_path(cls, esm_path: Any, compiled: Any) -> str:
        return "/".join([*filter(None, [pn.state.rel_path]), f"assets/{VERSION}/page.js"])  # served like all of ours

    def _get_model(self, *where: Any, **how: Any) -> Any:
        """Without the styles that Panel has for inputs of its own: there are none here, and each names its version."""
        model = super()._get_model(*where, **how)
        model.stylesheets = []  # pyright: ignore[reportAttributeAccessIssue]
        return model

    def _hold(self) -> None:
        """Hold what is known of scenes of the visitor's own: of that which is chosen, and of that which is shown."""
        names = {self.scene, self._shown_choices.get("scene")}
        self._facts = [facts_of(name) for name in names if name is not None and is_own(name)]

    @property
    def choices_model(self) -> str:
        """Id of the model in the document that holds the choices: all that a browser may set."""
        return next((model.data.id for model, _ in self._models.values()), "")

    def leave(self) -> None:
        """The visitor has gone: nothing more is worked out."""
        self._away = True
        self._runner.leave()
        self.leave_panels()

    def come_back(self) -> None:
        """The socket is open, perhaps again: then what was given up meanwhile is asked anew."""
        if self._away:
            self._away = False
            begin(partial(self._runner.want, self.chosen()))
            self.ask_panels()

    async def _report(self, act: Callable, *arguments: Any) -> None:
        """Change properties with the document locked, and have Bokeh send them, each, before the lock is left.

        Of two that change at once outside the lock, one may get lost. All that becomes known while a visitor looks on
        goes through here.
        """
        document, turnstile = pn.state.curdoc, of_loop(Turnstile)
        await turnstile.enter(self.visitor)

        if document is None or document.session_context is None:
            act(*arguments)
            return

        async def acting(_: Any) -> None:
            with turnstile.pay(self.visitor):
                document.hold("collect")
                try:
                    act(*arguments)
                finally:
                    document.unhold()

        await document.session_context.with_locked_document(acting)

    def _begin(self) -> None:
        """The first answer goes out with the page if it is known; else it is asked for when the page is there.

        What is sent between the making of a document and the word that it is drawn may be held back, and lost.
        """
        if (known := KEPT.known(solve_frame, self.chosen())) is not None:
            self.frame = known
            self._shown_choices = self.chosen()
        elif self.visitor is not None:
            pn.state.onload(partial(self._runner.want, self.chosen()))

    def _wait(self, name: str, note: dict[str, Any] | None) -> None:
        """Show the visitor why an answer takes longer; None when it has come."""
        self._waits[name] = note
        found = next(filter(None, self._waits.values()), None)
        self.waiting = json.dumps(found) if found else ""

    def _changed(self, *events: param.parameterized.Event) -> None:
        if self._quiet:
            return
        if left := [event.old for event in events if event.name == "scene"]:
            with self._silence():  # as if opened directly, whichever scene was before
                self.param.update(**own_choices(self.scene))
            self.param.update(**opened_with(self.scene, left[0]))
            self._hold()
        if any(event.name == "support" for event in events):
            with self._silence():
                self.place = free_place(self.support, self.place)
        self.refused = ""
        begin(partial(self._runner.want, self.wish(*(event.name for event in events))))

    def computed(self) -> float:
        """Computing time of the last answer [s]."""
        return self._runner.computed

    async def solve_wanted(self, wish: dict[str, Any]) -> None:
        """Have a wish answered, unless a newer one comes before."""
        await self._runner.want(wish)

    def choose(self, wanted: dict[str, Any]) -> None:
        """Set several choices at once, and have their answer."""
        with self._silence():
            self.param.update(**wanted)
        self.refused = ""
        begin(partial(self._runner.want, self.chosen()))

    @contextmanager
    def _silence(self):
        """Change parameters, and with them the controls in the browser, without asking for a solve."""
        self._quiet = True
        try:
            yield
        finally:
            self._quiet = False

    async def _take(self, message: bytes) -> None:
        await self._report(self._show, self._current, message)

    async def _fail(self, reason: dict[str, Any]) -> None:
        await self._report(self._set_back, self._current, reason)

    @property
    def _current(self) -> dict[str, Any]:
        """The choices that are being answered, or were last."""
        return {name: value for name, value in self._runner.current.items() if name != DRAFT}

    def _show(self, answered: dict[str, Any], message: bytes) -> None:
        self.answered_at = time.monotonic()
        self._shown_choices = answered
        self._hold()
        self.frame = message
        self.ask_panels()

    def _set_back(self, failed: dict[str, Any], reason: dict[str, Any]) -> None:
        """Restore those of the frame shown, and say the reason; nothing where newer choices are on their way."""
        if self.chosen() != failed:
            return
        if self._shown_choices:
            with self._silence():
                self.param.update(**self._shown_choices)
        self._refuse(reason)

    def _refuse(self, *reasons: dict[str, Any]) -> None:
        self.answered_at = time.monotonic()
        self.refused = ""
        self.refused = json.dumps(reasons)
        before = self.chosen()
        if self.frame or before | choices_of(self.scene) == before:
            return
        with self._silence():  # nothing is shown yet: the scene, as it says itself
            self.param.update(**choices_of(self.scene))
        self._begin()

    def _server_change(self, doc: Any, ref: str, subpath: str | None, attr: str, old: Any, new: Any) -> None:
        """Take what the browser may set, of all that has changed in the model, at once, as the document is locked.

        Panel would use a callback of the document, which costs 0.4 ms of each answer; after other changes, made
        here, it would wait 50 ms for more, and hold back what the browser sets meanwhile.
        """
        if attr not in self.CHOSEN and attr not in self.ASKED:
            return
        if pn.state._unblocked(doc) and attr not in self._changing.get(ref, ()):
            self._process_events({attr: new})
        else:
            super()._server_change(doc, ref, subpath, attr, old, new)

    def _process_events(self, events: dict[str, Any]) -> None:
        """Take each change that a client sends on its own; what is out of bounds is refused and set back."""
        with of_loop(Turnstile).pay(self.visitor):
            self._take_changes(events)

    def _take_changes(self, events: dict[str, Any]) -> None:
        for name, value in events.items():
            if name not in self.CHOSEN and name not in self.ASKED:
                continue
            if accepts(name, value) if name in self.CHOSEN else accepted(name, value):
                self._set(name, value)
            else:
                self._refuse(reason_of(refusal(name, value, type(self))))
                with self._silence():
                    self.param.trigger(name)

    def _param_change(self, *events: param.parameterized.Event) -> None:
        """Write what has changed into the model at once, where the document is locked.

        Panel looks for children, references to models and styles in every change first, for 1 ms of each answer.
        """
        document = next((model.document for model, _ in self._models.values()), None)
        own = all(event.name in self._sent for event in events)
        if document is None or not own or not document.session_context or not pn.state._unblocked(document):
            super()._param_change(*events)
            return
        known = self._in_process__events.get(document, {})  # the browser has these already
        changed = {each.name: each.new for each in events if (each.name, each.new) not in known.items()}
        with unlocked():
            for model, _ in self._models.values():
                model.data.update(**changed)

    def _set(self, name: str, value: Any) -> None:
        """Set a value from the browser as Panel does, without 3 ms of work that no choice needs: telling all who
        wait that it is busy, and making every read-only parameter writable for a while.
        """
        document = pn.state.curdoc
        self._in_process__events[document] = {name: value}
        try:
            with _syncing(self, [name]):  # the browser has it already
                setattr(self, name, value)
        finally:
            self._in_process__events.pop(document, None)


def spec_of_choices() -> dict[str, Any]:
    """Default, bounds or options of every choice."""
    found = {}
    for name in Choices.CHOSEN:
        parameter = Choices.param[name]
        if isinstance(parameter, param.String):
            found[name] = {"default": parameter.default}
        elif isinstance(parameter, param.Selector):
            found[name] = {"default": parameter.default, "options": list(parameter.objects)}
            if name == "method":
                found[name]["exact"] = Waves.NAME
        else:
            low, high = parameter.bounds
            whole = isinstance(parameter, param.Integer)
            found[name] = {"default": parameter.default, "low": low, "high": high, "whole": whole}
    return found


def create() -> "Lab":
    """One visitor's laboratory, with the choices that the address asks for."""
    document = pn.state.curdoc
    context = document.session_context if document is not None else None
    taken = TAKEN.pop(context.id, None) if context else None
    taken = taken or take(pn.state.session_args)
    lab = Lab(height=None, **taken.choices, **taken.opened)  # the window has one
    if document is not None:
        document.config.reconnect_session = False  # the page comes back with a session of its own, see connection.js
        document.config.notify_connection_status = False
        _LABS[document] = lab
    if reasons := [*taken.refused, *json.loads(lab.refused or "[]")]:
        lab.refused = json.dumps(reasons)  # which the browser shows one after the other
    return lab
