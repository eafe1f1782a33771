"""Who may come in: sessions are issued here, one live socket each, and only so many of them."""

import calendar
import time
from collections.abc import Iterable
from typing import Any

from bokeh.util.token import (
    check_token_signature,
    generate_jwt_token,
    generate_session_id,
    get_session_id,
    get_token_payload,
)

from ..choices.bodies import is_key
from ..choices.choices import Choices
from ..jobs.fair import Shares
from ..jobs.turns import Rate
from ..page.address import ASKED, FORMER, LONGEST_TEXT
from ..text.catalogues import page
from .limits import IDLE_SECONDS, MAX_REOPEN_PAUSE, MAX_SESSIONS, REOPEN_PAUSE, SESSIONS_BURST, SESSIONS_RATE

TOKEN_SECONDS = 12 * 3600  # for which a page may come back with the session it was given
KNOWN = {*Choices.CHOSEN, *ASKED, *FORMER, "panel"}  # keys of an address; others never reach a session
FULL = page().text("serving.full")


class Door:
    """Issues sessions and says who may open a socket to one.

    A session is known by a token that this process has signed; an address, a header or another page cannot name one.
    """

    def __init__(self, secret: bytes):
        self._secret = secret
        self._live: dict[str, Any] = {}  # by session: its socket
        self._barred: dict[str, float] = {}  # sessions whose visitors were turned out, and when
        self._turned_out = Shares()  # by address, how many lately
        self._next: dict[str, float] = {}  # by address, when the next new session from there may begin
        self._new = Rate(SESSIONS_RATE, SESSIONS_BURST)

    def issue(self, arguments: dict[str, list[bytes]]) -> str:
        """A token for a new session with these choices; the session itself is made when its socket opens."""
        kept = {key: [arguments[key][-1][: 4 * LONGEST_TEXT]] for key in arguments if key in KNOWN or is_key(key)}
        return generate_jwt_token(
            generate_session_id(secret_key=self._secret, signed=True),
            secret_key=self._secret,
            signed=True,
            expiration=TOKEN_SECONDS,
            extra_payload={"headers": {}, "cookies": {}, "arguments": kept},
        )

    @property
    def full(self) -> bool:
        return len(self._live) >= MAX_SESSIONS and self._idlest() is None

    def refuses(self, token: str | None, sessions: Iterable[str]) -> str | None:
        """Why this token opens no socket, or None; `sessions` are those that exist."""
        now = time.monotonic()
        self._barred = {each: when for each, when in self._barred.items() if now - when < TOKEN_SECONDS}
        session = self._session_in(token)
        if session is None:
            return page().text("serving.out-of-date")
        if session in self._barred:
            return page().text("serving.barred")
        if session in self._live:
            return page().text("serving.open-already")
        if session in sessions:
            return None
        if self.full or not self._new.allows():
            return FULL
        return None

    def enter(self, socket: Any) -> None:
        """Count a socket; if there is no room otherwise, who has been idle for longest goes."""
        if len(self._live) >= MAX_SESSIONS and (idlest := self._idlest()) is not None:
            idlest.turn_out(page().text("serving.idle"))
        self._live[socket.session_id] = socket

    def leave(self, socket: Any) -> None:
        if self._live.get(socket.session_id) is socket:
            del self._live[socket.session_id]

    def bar(self, session: str, address: str = "") -> None:
        """Let this session be opened no more, and others from there only after a while."""
        self._barred[session] = time.monotonic()
        self._turned_out.charge(address, 1.0)

    def pause(self, address: str) -> float:
        """How long [s] a new session from this address waits, one after the other where visitors were turned out.

        A class may be behind one address with somebody who floods.
        """
        now = time.monotonic()
        self._next = {each: when for each, when in self._next.items() if when > now}
        begins = self._next.get(address, now)
        if (between := min(REOPEN_PAUSE * self._turned_out.used(address), MAX_REOPEN_PAUSE)) > 0.0:
            self._next[address] = begins + between
        return begins - now

    def debt(self, address: str) -> float:
        """Seconds of the event loop that a new session from there counts as having had: others go first."""
        return self._turned_out.used(address)

    def _idlest(self) -> Any:
        socket = min(self._live.values(), key=lambda each: each.active, default=None)
        return socket if socket is not None and time.monotonic() - socket.active > IDLE_SECONDS else None

    def _session_in(self, token: str | None) -> str | None:
        try:
            if not token or not check_token_signature(token, secret_key=self._secret, signed=True):
                return None
            expires = get_token_payload(token).get("session_expiry", 0)
            return get_session_id(token) if calendar.timegm(time.gmtime()) < expires else None
        except (ValueError, KeyError, TypeError, IndexError):  # no token at all
            return None
