"""The socket of one visitor: what comes is checked, the newest of each choice is kept, and all take turns."""

import asyncio
import json
import logging
import random
import time
from collections import deque
from contextlib import suppress
from typing import Any, ClassVar

from bokeh.protocol.message import Message
from bokeh.util.token import get_session_id, get_token_payload
from panel.io.server import WSHandler
from tornado.iostream import StreamClosedError
from tornado.web import HTTPError
from tornado.websocket import WebSocketClosedError, WebSocketProtocol, WebSocketProtocol13

from ..choices.choices import Choices
from ..jobs.fair import Stranger
from ..jobs.loops import of_loop
from ..jobs.turns import Rate, Turnstile
from ..jobs.workers import Workers
from ..page.lab import Lab, lab_of
from ..page.reading import TAKEN, Taken, facts_by_worker, taken_by_worker
from . import guard
from .addresses import host_of
from .haste import Haste
from .limits import (
    HASTE,
    HASTE_BURST,
    HASTE_RATE,
    HASTY_SECONDS,
    MAX_CLOSING,
    MAX_OVER_SECONDS,
    MAX_REFUSED,
    MAX_WAITING,
    OVER_PAUSE,
    PART_SECONDS,
    PARTS_BURST,
    PARTS_RATE,
    READ_AT_ONCE,
)

SESSIONS = "sessions"  # what strangers ask for who open a socket
SOCKET_SECONDS = 0.002  # of the event loop to open one, charged also to who leaves before their turn
CLOSE_SECONDS = 1.0  # for the browser to hear that its socket is closed
LIMIT = 1008  # close code of a socket, for what came over it
TOO_MANY = "serving.too-much"
CHOSEN = frozenset(Choices.CHOSEN)
log = logging.getLogger("strikewave")


class Reading(Turnstile):
    """Turns to read messages: many sockets that send all they can get little; others get no less."""

    def __init__(self):
        super().__init__(READ_AT_ONCE)


class Wire(WebSocketProtocol13):
    """Tornado's, but a ping, a pong or a fragment takes its turn too: each costs as much as a part of a message."""

    async def _receive_frame(self) -> None:
        before = self._message_bytes_in
        await super()._receive_frame()
        if self._message_bytes_in == before:
            await self.handler.pass_by()  # pyright: ignore[reportAttributeAccessIssue]


class Socket(WSHandler):
    """Bokeh's, but who may open it, what may come and how much of it is decided here."""

    session_id = ""
    _closing: ClassVar[deque[WebSocketProtocol]] = deque()  # of all visitors, the oldest first
    _turn: asyncio.Future | None = None  # turn to begin, while waited for
    _reading: asyncio.Future | None = None  # a scene of the visitor's own, likewise

    async def prepare(self) -> None:
        if not host_of(self.request.headers.get("Origin", "http://none")):
            raise HTTPError(403)  # Tornado stumbles over it
        await super().prepare()

    def open(self, *arguments: Any, **options: Any) -> None:
        self.active = time.monotonic()
        self._parts = Rate(PARTS_RATE, PARTS_BURST)
        self._over_since: float | None = None
        self._haste = Haste()
        self._slowed, self._hasty_until = Rate(HASTE_RATE, HASTE_BURST), 0.0
        self._mail: deque[tuple[Message, list[dict[str, Any]]]] = deque()
        self._delivering = False
        self._refused = self._pulls = 0
        self._out = False
        self.address = self.application.settings["addresses"].of(self.request)
        reason: str | None = "serving.protocol"
        if self.selected_subprotocol == "bokeh":
            reason = self._door.refuses(self._token, self.address)
        if reason is not None or self._token is None:
            self._end(reason or "serving.protocol")
            return
        self.session_id = get_session_id(self._token)
        self._door.enter(self)
        self.set_nodelay(True)  # an answer is several frames, of which none waits until another is acknowledged
        super().open(*arguments, **options)

    @property
    def _door(self) -> Any:
        return self.application.settings["door"]

    @property
    def _lab(self) -> Lab | None:
        """Visitor's lab; None once the page has gone."""
        connection = self.connection
        return None if self._gone or connection is None else lab_of(connection.session.document)

    @property
    def _is_open(self) -> bool:
        return not self._out and self.ws_connection is not None

    def get_websocket_protocol(self) -> Any:
        protocol: Any = super().get_websocket_protocol()
        socket: Any = self
        return protocol and Wire(socket, False, protocol.params)

    async def _async_open(self, token: str) -> None:
        turnstile = of_loop(Turnstile)
        stranger = Stranger(SESSIONS, self.address)
        turnstile.charge(stranger, SOCKET_SECONDS)
        self._turn = asyncio.ensure_future(self._taken_in_turn(token, stranger))
        await asyncio.wait([self._turn])
        if not self._is_open:
            return
        self._charge(self._door.debt(self.address))
        TAKEN[self.session_id] = self._turn.result()
        try:
            await turnstile.paid(stranger, super()._async_open(token))
        finally:
            TAKEN.pop(self.session_id, None)
        if (lab := self._lab) is not None:  # who left meanwhile has none
            lab.come_back()

    async def _taken_in_turn(self, token: str, stranger: Stranger) -> Taken:
        """What the address of the page says, when it is this socket's turn."""
        taken = await taken_by_worker(get_token_payload(token).get("arguments", {}), stranger)
        await of_loop(Turnstile).enter(stranger)
        return taken

    async def on_message(self, fragment: str | bytes) -> None:
        """Take a part of a message; who sends more than their share is not read from until it is their turn."""
        try:
            await self._take(fragment)
        except Exception as error:  # nobody above could do anything about it
            log.error("a message could not be taken: %r", error)
            self.turn_out("serving.unreadable")

    async def _receive(self, fragment: str | bytes) -> Message | None:
        """A whole message, if this completes one. A page sends no buffers, which Bokeh would keep without bound;
        what Bokeh cannot read is not logged.
        """
        with suppress(Exception):
            receiver: Any = self.receiver
            message = await receiver.consume(fragment)
            if isinstance(message.header["msgid"], str) if message else receiver._partial is None:
                return message
        self.turn_out("serving.unreadable", flood=False)
        return None

    async def _take(self, fragment: str | bytes) -> None:
        if self._out:
            return
        if self.connection is None:  # a page sends nothing before it knows that its session has begun
            self.turn_out(TOO_MANY, flood=False)
            return
        if not await self._in_turn() or self._gone or self._out:
            return
        message = await self._receive(fragment)
        if message is None:
            return
        self.active = time.monotonic()
        decision = guard.decide(message.msgtype, message.content, self._choices_model, guard.SETTABLE)
        self._pulls += message.msgtype == "PULL-DOC-REQ"
        if decision.reason is not None or self._pulls > guard.MAX_PULLS:
            await self._refuse(message, decision.reason or "not allowed")
        elif message.msgtype == "PATCH-DOC" and not decision.events:
            await self._answer(self.connection.ok(message))
        else:
            await self._post(message, decision.events)

    @property
    def _gone(self) -> bool:
        """Whether there is no session yet, or no more."""
        return self.connection is None or self.connection._session is None

    async def pass_by(self) -> None:
        """A frame that is no message: no browser sends many."""
        if self._parts.left < 1.0:
            self.turn_out(TOO_MANY)
        await self._in_turn()

    async def _in_turn(self) -> bool:
        """Wait until this socket may be read from; False if it is closed instead."""
        if self._out:
            await asyncio.sleep(OVER_PAUSE)
            return False
        reading = of_loop(Reading)
        await reading.enter(self.session_id)
        reading.charge(self.session_id, PART_SECONDS)
        of_loop(Turnstile).charge(self.session_id, PART_SECONDS)
        await asyncio.sleep(0)  # else all that has come is read in one go, while all others wait
        if time.monotonic() < self._hasty_until:
            await asyncio.sleep(OVER_PAUSE * (0.5 + random.random()))  # not all at the same moment
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
        self._charge(OVER_PAUSE)
        await asyncio.sleep(max(wait, OVER_PAUSE))
        return True

    @property
    def _choices_model(self) -> str:
        """The model that holds this visitor's choices."""
        lab = self._lab
        return lab.choices_model if lab is not None else ""

    async def _refuse(self, message: Message, reason: str) -> None:
        self._refused += 1
        if self._refused > MAX_REFUSED:
            self.turn_out(TOO_MANY)
            return
        if self.connection is None:
            return
        reply = self.connection.error(message, reason)
        reply.content["traceback"] = None  # stack traces stay here
        await self._answer(reply)

    async def _post(self, message: Message, events: list[dict[str, Any]]) -> None:
        """Have a message handled in turn; drop from those that wait what it sets anew."""
        self._see_haste(events)
        if self._out:
            return
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
                asyncio.ensure_future(self._deliver()).add_done_callback(_log_failure)
        else:
            await self._refuse(message, "too many messages")
        for earlier in dropped:
            if self.connection is not None:
                await self._answer(self.connection.ok(earlier))

    def _see_haste(self, events: list[dict[str, Any]]) -> None:
        """A page sets a choice again when it has its answer; who does not wait for it is read slowly for a while."""
        now, lab = time.monotonic(), self._lab
        names = CHOSEN.intersection(event.get("attr") for event in events)
        if not (hasty := self._haste.seen(names, lab.answered_at if lab is not None else now)):
            return
        if now > self._hasty_until and not self._slowed.allows():
            self.turn_out(TOO_MANY)
        self._hasty_until = now + HASTY_SECONDS * (0.5 + random.random())
        self._charge(hasty * HASTE)

    def _charge(self, seconds: float) -> None:
        """Charge so much time to who sends more than can be answered: others then come first."""
        for shared in (of_loop(Turnstile), of_loop(Reading), of_loop(Workers)):
            shared.charge(self.session_id, seconds)

    async def _deliver(self) -> None:
        turnstile = of_loop(Turnstile)
        try:
            while self._mail and not self._gone:
                while self._parts.left < 0.0 and not self._out:  # messages that come too quickly wait
                    await asyncio.sleep(OVER_PAUSE)
                await turnstile.enter(self.session_id)
                if not self._mail or self._gone:
                    return
                message, events = self._mail.popleft()
                if message.msgtype == "PATCH-DOC":
                    message.content["events"] = events
                facts = []  # of scenes of the visitor's own, which are known as long as this has them
                for name in guard.own_scenes(events):
                    self._reading = asyncio.ensure_future(facts_by_worker(name, self.session_id))
                    facts.append(await self._reading)
                if not self._gone:
                    await turnstile.paid(self.session_id, self._handle_and_answer(message))
        finally:
            self._delivering = False

    async def _handle_and_answer(self, message: Message) -> None:
        reply = await self._handle(message)
        if reply is not None:
            await self._answer(reply)

    async def send_message(self, message: Message) -> None:
        """As Bokeh does, but all parts of a message in one go: five calls of the system take 1 ms of each answer."""
        if message.msgtype == "PULL-DOC-REPLY":
            message.content["doc"].pop("version", None)  # of Bokeh, whose script the page has already
        parts: list[tuple[str | bytes, bool]] = [
            (part, False) for part in (message.header_json, message.metadata_json, message.content_json)
        ]
        for buffer in message.buffers:
            parts += [(json.dumps(buffer.ref), False), (buffer.to_bytes(), True)]
        with await self.write_lock.acquire():
            protocol: Any = self.ws_connection
            if protocol is None or protocol.is_closing():
                return
            stream, protocol.stream = protocol.stream, (frames := Frames())
            try:
                for part, binary in parts:
                    protocol.write_message(part, binary)
            finally:
                protocol.stream = stream
            with suppress(StreamClosedError):
                await stream.write(b"".join(frames))

    async def _answer(self, reply: Message) -> None:
        if reply.msgtype == "ERROR":
            reply.content["traceback"] = None
            reply.content["text"] = "refused"
        await self.send_message(reply)

    def turn_out(self, code: str, flood: bool = True) -> None:
        """Send the visitor the reason by its code, and close the socket for good; what still comes is not read."""
        if self._out:
            return
        self._out = True
        self._door.bar(self.session_id)
        if flood:
            self._door.slow(self.address)
        self._mail.clear()
        asyncio.ensure_future(self._tell_and_close(code)).add_done_callback(_log_failure)

    async def _tell_and_close(self, code: str) -> None:
        try:
            if (connection := self.connection) is not None and (lab := self._lab) is not None:
                delivery: Any = connection.session.with_document_locked(setattr, lab, "disconnected", code)
                await asyncio.wait_for(delivery, 1.0)  # who does not read is not waited for
        except (TimeoutError, WebSocketClosedError):
            pass
        finally:
            self._end(code)

    def _end(self, code: str) -> None:
        """Close the socket; do not wait for who does not answer and goes on sending."""
        if (protocol := self.ws_connection) is None:
            return
        self.close(LIMIT, code)
        self._closing.append(protocol)
        asyncio.get_running_loop().call_later(CLOSE_SECONDS, self._give_up, protocol)
        if len(self._closing) > MAX_CLOSING:
            self._give_up(self._closing[0])

    def _give_up(self, protocol: Any) -> None:
        if protocol in self._closing:
            self._closing.remove(protocol)
            protocol._abort()

    def on_close(self) -> None:
        for waited in filter(None, (self._turn, self._reading)):
            waited.cancel()  # who has gone keeps no place in the line
        if not self.session_id:
            return
        self._door.leave(self)
        self._mail.clear()
        if self._gone:
            return
        if (lab := self._lab) is not None:
            lab.leave()
        super().on_close()


class Frames(list[bytes]):
    """In the place of a stream: keeps what is written, to be sent at once."""

    def write(self, frame: bytes) -> asyncio.Future:
        self.append(frame)
        done = asyncio.get_running_loop().create_future()
        done.set_result(None)
        return done


def _log_failure(task: asyncio.Future) -> None:
    if not task.cancelled() and task.exception() is not None:
        log.error("a message could not be handled: %r", task.exception())
