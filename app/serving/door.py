"""Who may come in: sessions are issued here, one live socket each, and only so many of them."""

import calendar
import time
from collections import Counter, deque
from collections.abc import Callable
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
from ..choices.own import LONGEST
from ..jobs.fair import Shares
from ..page.address import ASKED, FORMER, LONGEST_TEXT
from .limits import ADDRESS_SESSIONS, IDLE_SECONDS, MAX_BARRED, MAX_SESSIONS

TOKEN_SECONDS = 12 * 3600  # for which a page may come back with the session it was given
KNOWN = {*Choices.CHOSEN, *ASKED, *FORMER, "panel"}  # keys of an address; others never reach a session
FULL = "serving.full"


class Door:
    """Issues sessions and says who may open a socket to one.

    A session is known by a token that this process has signed; an address, a header or another page cannot name one.
    """

    def __init__(self, secret: bytes, clock: Callable[[], float] = time.monotonic):
        self._secret, self._clock = secret, clock
        self._live: dict[str, Any] = {}  # by session: its socket
        self._barred: deque[str] = deque(maxlen=MAX_BARRED)  # sessions whose visitors were turned out
        self._turned_out = Shares(clock)  # by address, how many lately

    def issue(self, arguments: dict[str, list[bytes]]) -> str:
        """A token for a new session with these choices; the session itself is made when its socket opens."""
        longest = {"scene": LONGEST}  # whose name is all of it, if it is the visitor's own
        kept = {
            key: [arguments[key][-1][: longest.get(key, 4 * LONGEST_TEXT)]]
            for key in arguments
            if key in KNOWN or is_key(key)
        }
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

    def refuses(self, token: str | None, address: str) -> str | None:
        """Code of why this token opens no socket, or None. Who comes back needs room too: else sessions had no end."""
        session = self._session_in(token)
        if session is None:
            return "serving.out-of-date"
        if session in self._barred:
            return "serving.barred"
        if session in self._live:
            return "serving.open-already"
        return FULL if self.full(address) else None

    def enter(self, socket: Any) -> None:
        """Count a socket, which knows its `session_id` and `address`; if there is no room otherwise, another goes."""
        if len(self._live) >= MAX_SESSIONS and (first := self._first_to_go(socket.address)) is not None:
            self.leave(first)
            first.turn_out("serving.idle", flood=False)
        self._live[socket.session_id] = socket

    def leave(self, socket: Any) -> None:
        if self._live.get(socket.session_id) is socket:
            del self._live[socket.session_id]

    def bar(self, session: str) -> None:
        """Let this session be opened no more."""
        self._barred.append(session)

    def slow(self, address: str) -> None:
        """For a while, let new sessions from there come after others: somebody there has flooded."""
        self._turned_out.charge(address, 1.0)

    def debt(self, address: str) -> float:
        """Seconds of the event loop that a new session from there counts as having had: others go first."""
        return self._turned_out.used(address)

    def _first_to_go(self, address: str) -> Any:
        """Whose place a visitor from this address may have: of one whose address has far more than it, or who is idle.

        One address with many sockets does not shut the door for the others; a class behind one keeps its places.
        """
        by_idleness = sorted(self._live.values(), key=lambda each: each.active)
        count = Counter(each.address for each in by_idleness)
        most, sessions = max(count.items(), key=lambda each: each[1], default=("", 0))
        if sessions > ADDRESS_SESSIONS and count[address] < sessions:
            return next(each for each in by_idleness if each.address == most)
        if by_idleness and self._clock() - by_idleness[0].active > IDLE_SECONDS:
            return by_idleness[0]
        return None

    def _session_in(self, token: str | None) -> str | None:
        try:
            if not token or not check_token_signature(token, secret_key=self._secret, signed=True):
                return None
            expires = get_token_payload(token).get("session_expiry", 0)
            return get_session_id(token) if calendar.timegm(time.gmtime()) < expires else None
        except (ValueError, KeyError, TypeError, IndexError):  # no token at all
            return None
