"""The socket of one visitor: what comes is judged, the newest of each choice is kept, and all take turns."""

import asyncio
import logging
import time
from collections import deque
from typing import Any

from bokeh.protocol.message import Message
from bokeh.util.token import get_session_id
from panel.io.server import WSHandler
from tornado.websocket import WebSocketClosedError

from ..jobs.loops import of_loop
from ..jobs.turns import Rate, Turnstile
from ..lab import Lab, lab_of
from . import guard
from .limits import (
    MAX_OVER_SECONDS,
    MAX_REFUSED,
    MAX_WAITING,
    OVER_PAUSE,
    PART_SECONDS,
    PARTS_BURST,
    PARTS_RATE,
)

CLOSE_SECONDS = 1.0  # for the browser to hear that its socket is closed
LIMIT = 1008  # code of a socket that is closed because of what came over it
TOO_MANY = "Too much came from this page at once: it was disconnected. Reload it to go on."
SETTABLE = guard.SETTABLE | frozenset(Lab.OPENED)
log = logging.getLogger("strikewave")


class Socket(WSHandler):
    """Bokeh's, but who may open it, what may come and how much of it is decided here."""

    session_id = ""

    def open(self, *arguments: Any, **options: Any) -> None:
        self.active = time.monotonic()
        self._parts = Rate(PARTS_RATE, PARTS_BURST)
        self._over_since: float | None = None
        self._mail: deque[tuple[Message, list[dict[str, Any]]]] = deque()
        self._delivering = False
        self._refused = self._pulls = 0
        self._out = False
        reason = "Not the page's protocol."
        if self.selected_subprotocol == "bokeh":
            reason = self._door.refuses(self._token, self.application_context._sessions)
        if reason is not None:
            self.close(LIMIT, reason)
            return
        self.session_id = get_session_id(self._token)
        self._door.enter(self)
        super().open(*arguments, **options)

    @property
    def _door(self) -> Any:
        return self.application.settings["door"]

    async def _async_open(self, token: str) -> None:
        turnstile = of_loop(Turnstile)
        await asyncio.sleep(self._door.pause(self.request.remote_ip))
        await turnstile.enter(self.session_id)
        with turnstile.pay(self.session_id):
            await super()._async_open(token)
        if (lab := lab_of(self.connection.session.document)) is not None:
            lab.come_back()

    async def on_message(self, fragment: str | bytes) -> None:
        """Take a part of a message; who sends more than their share is not read from until it is their turn."""
        try:
            await self._take(fragment)
        except Exception as error:  # nobody above could do anything about it
            log.error("a message could not be taken: %r", error)
            self.close(LIMIT, "This message could not be read.")

    async def _take(self, fragment: str | bytes) -> None:
        if self._out or not await self._in_turn() or self._gone or self._out:
            return
        message = await self._receive(fragment)
        if message is None:
            return
        self.active = time.monotonic()
        verdict = guard.judge(message.msgtype, message.content, self._own, SETTABLE)
        self._pulls += message.msgtype == "PULL-DOC-REQ"
        if verdict.reason is not None or self._pulls > guard.MAX_PULLS:
            await self._refuse(message, verdict.reason or "not allowed")
        elif message.msgtype == "PATCH-DOC" and not verdict.events:
            await self._answer(self.connection.ok(message))
        else:
            await self._post(message, verdict.events)

    @property
    def _gone(self) -> bool:
        """Whether there is no session yet, or no more."""
        return self.connection is None or self.connection._session is None

    async def _in_turn(self) -> bool:
        """Wait until this socket may be read from; False if it is closed instead."""
        of_loop(Turnstile).note(self.session_id, PART_SECONDS)
        await asyncio.sleep(0)  # what has come already would be read in one go, while all others wait
        wait = self._parts.take()
        if not wait:
            if self._parts.left > PARTS_BURST / 2:
                self._over_since = None
            return True
        now = time.monotonic()
        self._over_since = self._over_since or now
        if now - self._over_since > MAX_OVER_SECONDS:
            self.turn_out(TOO_MANY)
            return False
        await asyncio.sleep(max(wait, OVER_PAUSE))
        return True

    @property
    def _own(self) -> str:
        """The model that holds this visitor's choices."""
        lab = lab_of(self.connection.session.document)
        return lab.choices_model if lab is not None else ""

    async def _refuse(self, message: Message, reason: str) -> None:
        self._refused += 1
        if self._refused > MAX_REFUSED:
            self.turn_out(TOO_MANY)
            return
        reply = self.connection.error(message, reason)
        reply.content["traceback"] = None  # stack traces stay here
        await self._answer(reply)

    async def _post(self, message: Message, events: list[dict[str, Any]]) -> None:
        """Have it handled in turn; what it sets anew is dropped from those that still wait."""
        kept, dropped = deque(), []
        for earlier, before in self._mail:
            left = guard.newest_only(before, events)
            if before and not left:
                dropped.append(earlier)
            else:
                kept.append((earlier, left))
        self._mail = kept
        if len(kept) < MAX_WAITING:
            kept.append((message, events))
            if not self._delivering:
                self._delivering = True
                asyncio.ensure_future(self._deliver()).add_done_callback(_seen)
        else:
            await self._refuse(message, "too many messages")
        for earlier in dropped:
            await self._answer(self.connection.ok(earlier))

    async def _deliver(self) -> None:
        turnstile = of_loop(Turnstile)
        try:
            while self._mail and not self._gone:
                await turnstile.enter(self.session_id)
                if not self._mail or self._gone:
                    return
                message, events = self._mail.popleft()
                if message.msgtype == "PATCH-DOC":
                    message.content["events"] = events
                with turnstile.pay(self.session_id):
                    reply = await self._handle(message)
                    if reply is not None:
                        await self._answer(reply)
        finally:
            self._delivering = False

    async def _answer(self, reply: Message) -> None:
        if reply.msgtype == "ERROR":
            reply.content["traceback"] = None
            reply.content["text"] = "refused"
        await self.send_message(reply)

    def turn_out(self, sentence: str) -> None:
        """Tell the visitor why, and close the socket for good; what still comes is not looked at."""
        if self._out:
            return
        self._out = True
        self._door.bar(self.session_id, self.request.remote_ip)
        self._mail.clear()
        asyncio.ensure_future(self._tell_and_close(sentence)).add_done_callback(_seen)

    async def _tell_and_close(self, sentence: str) -> None:
        try:
            if not self._gone:
                session = self.connection.session
                if (lab := lab_of(session.document)) is not None:
                    telling = session.with_document_locked(setattr, lab, "disconnected", sentence)
                    await asyncio.wait_for(telling, 1.0)  # who does not read is not waited for
        except (TimeoutError, WebSocketClosedError):
            pass
        finally:
            self.close(LIMIT, sentence[:120])
            asyncio.get_running_loop().call_later(CLOSE_SECONDS, self._abort)

    def _abort(self) -> None:
        """Who goes on sending does not answer that the socket is closed."""
        if self.ws_connection is not None:
            self.ws_connection._abort()

    def on_close(self) -> None:
        if not self.session_id:
            return
        self._door.leave(self)
        self._mail.clear()
        if self._gone:
            return
        if (lab := lab_of(self.connection.session.document)) is not None:
            lab.leave()
        super().on_close()


def _seen(task: asyncio.Future) -> None:
    if not task.cancelled() and task.exception() is not None:
        log.error("a message could not be handled: %r", task.exception())
