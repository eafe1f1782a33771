"""Who may come in: sessions are issued here, one live socket each, and only so many of them."""

import calendar
import math
import time
from collections import Counter
from collections.abc import Callable, Iterable
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
from .limits import (
    ADDRESS_BURST,
    ADDRESS_RATE,
    ADDRESS_SESSIONS,
    IDLE_SECONDS,
    MAX_IN_LINE,
    MAX_REOPEN_PAUSE,
    MAX_SESSIONS,
    REOPEN_PAUSE,
    SESSIONS_BURST,
    SESSIONS_RATE,
)

TOKEN_SECONDS = 12 * 3600  # for which a page may come back with the session it was given
KNOWN = {*Choices.CHOSEN, *ASKED, *FORMER, "panel"}  # keys of an address; others never reach a session
SHORTEST_PAUSE = 1e-3  # [s]
FULL = page().text("serving.full")


class Door:
    """Issues sessions and says who may open a socket to one.

    A session is known by a token that this process has signed; an address, a header or another page cannot name one.
    """

    def __init__(self, secret: bytes, clock: Callable[[], float] = time.monotonic):
        self._secret, self._clock = secret, clock
        self._live: dict[str, Any] = {}  # by session: its socket
        self._barred: dict[str, float] = {}  # sessions whose visitors were turned out, and when
        self._turned_out = Shares(clock)  # by address, how many lately
        self._waiting: set[Any] = set()  # sockets of which the session has not begun
        self._lines: dict[str, list[Any]] = {}  # by address, sockets that wait to begin, the first first
        self._begun: dict[str, float] = {}  # by address, when the last session from there began
        self._new = Rate(SESSIONS_RATE, SESSIONS_BURST, clock)
        self._rates: dict[str, Rate] = {}  # by address, likewise

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

    def full(self, address: str) -> bool:
        """Whether there is no room for another visitor from there."""
        return len(self._live) >= MAX_SESSIONS and self._first_to_go(address) is None

    def refuses(self, token: str | None, sessions: Iterable[str], address: str) -> str | None:
        """Why this token opens no socket, or None; `sessions` are those that exist."""
        now = self._clock()
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
        if self.full(address) or self._new.left < 1.0 or self._new_from(address).left < 1.0:
            return FULL
        return None

    def _new_from(self, address: str) -> Rate:
        """How many sessions may be made for an address: what it takes is not taken from all others."""
        self._rates = {each: rate for each, rate in self._rates.items() if rate.left < ADDRESS_BURST}
        return self._rates.setdefault(address, Rate(ADDRESS_RATE, ADDRESS_BURST, self._clock))

    def enter(self, socket: Any) -> None:
        """Count a socket, which knows its `session_id` and `address`; if there is no room otherwise, another goes."""
        if len(self._live) >= MAX_SESSIONS and (first := self._first_to_go(socket.address)) is not None:
            self.leave(first)
            first.turn_out(page().text("serving.idle"), flood=False)
        self._live[socket.session_id] = socket
        self._waiting.add(socket)
        self._count(socket, 1.0)

    def _count(self, socket: Any, sessions: float) -> None:
        self._new.take(sessions)
        self._new_from(socket.address).take(sessions)

    def leave(self, socket: Any) -> None:
        """Forget a socket, also where it still waits to begin."""
        if self._live.get(socket.session_id) is socket:
            del self._live[socket.session_id]
        if socket in self._waiting:
            self._count(socket, -1.0)
        self._step_out(socket)

    def bar(self, session: str) -> None:
        """Let this session be opened no more."""
        self._barred[session] = self._clock()

    def slow(self, address: str) -> None:
        """For a while, let new sessions from there begin one after the other: somebody there has flooded."""
        self._turned_out.charge(address, 1.0)

    def pause(self, socket: Any) -> float | None:
        """How long [s] the session of this socket still waits, 0 if it begins now; None if too many wait already.

        Where visitors were turned out lately, a class may be behind one address with somebody who floods: new sessions
        begin one after the other. Who waits asks again, and whoever leaves makes room for the next at once.
        """
        now, address = self._clock(), socket.address
        line = self._lines.setdefault(address, [])
        if socket not in line:
            if len(line) >= MAX_IN_LINE:
                return None
            line.append(socket)
        between = min(REOPEN_PAUSE * self._turned_out.used(address), MAX_REOPEN_PAUSE)
        self._begun = {each: when for each, when in self._begun.items() if now - when < MAX_REOPEN_PAUSE}
        first = self._begun.get(address, -math.inf) + between  # when the first of the line begins
        if between > SHORTEST_PAUSE and (first > now or socket is not line[0]):
            return max(first - now, 0.0) + between * line.index(socket)
        self._step_out(socket)
        self._begun[address] = now
        return 0.0

    def _step_out(self, socket: Any) -> None:
        self._waiting.discard(socket)
        line = self._lines.get(socket.address, [])
        if socket in line:
            line.remove(socket)
        if not line:
            self._lines.pop(socket.address, None)

    def debt(self, address: str) -> float:
        """Seconds of the event loop that a new session from there counts as having had: others go first."""
        return self._turned_out.used(address)

    def _first_to_go(self, address: str) -> Any:
        """Whose place a visitor from this address may have: of one who is idle, or whose address has far more than it.

        One address with many sockets does not shut the door for the others; a class behind one keeps its places.
        """
        now = self._clock()
        idlest = min(self._live.values(), key=lambda each: each.active, default=None)
        if idlest is None or now - idlest.active > IDLE_SECONDS:
            return idlest
        count = Counter(socket.address for socket in self._live.values())
        most, sessions = count.most_common(1)[0]
        if sessions <= ADDRESS_SESSIONS or count[address] >= sessions:
            return None
        return min((each for each in self._live.values() if each.address == most), key=lambda each: each.active)

    def _session_in(self, token: str | None) -> str | None:
        try:
            if not token or not check_token_signature(token, secret_key=self._secret, signed=True):
                return None
            expires = get_token_payload(token).get("session_expiry", 0)
            return get_session_id(token) if calendar.timegm(time.gmtime()) < expires else None
        except (ValueError, KeyError, TypeError, IndexError):  # no token at all
            return None
