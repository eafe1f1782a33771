"""What a client may send, and what it is told. Bokeh's server trusts its clients; ours may be anybody.

Installed once per process, around details of the pinned Bokeh: tests/app/test_guard.py fails if they change.
"""

import time
from typing import Any

from bokeh.server.connection import ServerConnection
from bokeh.server.protocol_handler import ProtocolHandler
from tornado.web import RequestHandler

from .uploads import MeasuredRecord

MAX_MESSAGE = 20_000  # bytes; the longest honest message has some hundreds
MAX_EVENTS = 32  # in one message
RATE, BURST = 120.0, 480.0  # messages a second in the long run, and at once
POLICY = (
    "default-src 'self'; script-src 'self' 'unsafe-inline' blob:; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; connect-src 'self' ws: wss: blob:; font-src 'self' data:; "
    "object-src 'none'; base-uri 'self'; form-action 'none'"
)


class Alive(RequestHandler):
    """Answers as soon as the server serves, which is after all kernels are compiled."""

    def get(self):
        self.write({"alive": True})


def patterns() -> list[tuple]:
    return [(r"/liveness", Alive), (r"/record", MeasuredRecord)]


def install() -> None:
    """Refuse what no honest page sends, keep stack traces here, set security headers. Idempotent."""
    if getattr(ProtocolHandler.handle, "guarded", False):
        return
    ProtocolHandler.handle = _guarded(ProtocolHandler.handle)
    ServerConnection.error = _silent(ServerConnection.error)
    RequestHandler.set_default_headers = _with_headers(RequestHandler.set_default_headers)


def allowed(event: Any) -> bool:
    """Whether an honest page may send this event: a plain value for a property, or a plain event of a model."""
    if not isinstance(event, dict):
        return False
    if event.get("kind") == "ModelChanged":
        value = event.get("new")
        return not isinstance(value, (list, dict)) or (isinstance(value, dict) and value.get("type") == "number")
    return event.get("kind") == "MessageSent" and event.get("msg_type") == "bokeh_event"


def _guarded(handle):
    async def guarded(self, message, connection):
        now = time.monotonic()
        tokens, last = getattr(connection, "_tokens", (BURST, now))
        tokens = min(BURST, tokens + RATE * (now - last))
        connection._tokens = (tokens - 1.0 if tokens >= 1.0 else tokens, now)
        if tokens < 1.0:
            return connection.error(message, "too many messages")
        if message.msgtype == "PUSH-DOC":
            return connection.error(message, "not allowed")
        if message.msgtype == "PATCH-DOC":
            events = message.content.get("events") if isinstance(message.content, dict) else None
            if not isinstance(events, list) or len(events) > MAX_EVENTS or not all(map(allowed, events)):
                return connection.error(message, "not allowed")
        return await handle(self, message, connection)

    guarded.guarded = True
    return guarded


def _silent(error):
    def silent(self, message, text):
        reply = error(self, message, "refused")
        reply.content["traceback"] = None
        return reply

    return silent


def _with_headers(set_default_headers):
    def with_headers(self):
        set_default_headers(self)
        self.set_header("Content-Security-Policy", POLICY)
        self.set_header("X-Content-Type-Options", "nosniff")
        self.set_header("Referrer-Policy", "same-origin")

    return with_headers
