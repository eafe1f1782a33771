"""Who may come in: only whom this server has given a session, one socket each, and only so many."""

from itertools import count

import pytest
from bokeh.util.token import generate_jwt_token, generate_session_id, get_session_id, get_token_payload

from app.serving import door as doors
from app.serving.door import FULL, Door
from app.serving.limits import (
    ADDRESS_BURST,
    ADDRESS_RATE,
    ADDRESS_SESSIONS,
    IDLE_SECONDS,
    MAX_IN_LINE,
    MAX_REOPEN_PAUSE,
    MAX_SESSIONS,
    SESSIONS_BURST,
)

SECRET = b"a secret of this process"
HERE, ELSEWHERE = "203.0.113.1", "203.0.113.2"
CLASS = 50


class Clock:
    """Time that passes when a test says so."""

    now = 1_000.0

    def __call__(self):
        return self.now


class Socket:
    def __init__(self, token, idle=0.0, address=HERE):
        self.session_id, self.active, self.address = get_session_id(token), Clock.now - idle, address
        self.reported = None

    def turn_out(self, sentence, flood=True):
        self.reported = sentence


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def door(clock):
    return Door(SECRET, clock)


@pytest.fixture
def unhurried(door, monkeypatch):
    """Sessions may come as quickly as they like."""
    monkeypatch.setattr(door, "_new", doors.Rate(1e9, 1e9))
    monkeypatch.setattr(doors, "ADDRESS_BURST", 1e9)


def opened(door, address=HERE):
    """A new socket from an address, or None if it is refused."""
    token = door.issue({})
    if door.refuses(token, [], address) is not None:
        return None
    socket = Socket(token, address=address)
    door.enter(socket)
    return socket


def begun(door, clock, sockets, seconds):
    """How long each of these has waited when its session begins; at most so many seconds are waited for all."""
    since, found = clock.now, {}
    while len(found) < len(sockets) and clock.now - since < seconds:
        for socket in sockets:
            if socket not in found and door.pause(socket) == 0.0:
                found[socket] = clock.now - since
        clock.now += 0.1
    return list(found.values())


def test_a_session_that_was_issued_opens_once_and_again_when_its_socket_has_gone(door):
    token = door.issue({})
    socket = Socket(token)
    assert door.refuses(token, [], HERE) is None
    door.enter(socket)
    assert "open already" in door.refuses(token, [socket.session_id], HERE)
    door.leave(socket)
    assert door.refuses(token, [socket.session_id], HERE) is None


@pytest.mark.parametrize("signed", [False, True])
def test_a_session_that_another_has_made_up_is_refused(door, signed):
    own = generate_session_id(secret_key=b"another", signed=True)
    for session in (own, "evil", ""):
        token = generate_jwt_token(session, secret_key=b"another", signed=signed, expiration=300)
        assert "out of date" in door.refuses(token, [], HERE)


@pytest.mark.parametrize("token", [None, "", "x", "a.b", "a.b.c", "é", "eyJ9.eyJ9", "." * 100, "A" * 10_000])
def test_what_is_no_token_is_refused(door, token):
    assert "out of date" in door.refuses(token, [], HERE)


def test_a_token_that_is_too_old_or_was_changed_is_refused(door, monkeypatch):
    token = door.issue({})
    assert "out of date" in door.refuses(token[:-2] + "xx", [], HERE)
    monkeypatch.setattr(doors, "TOKEN_SECONDS", -1)
    assert "out of date" in door.refuses(door.issue({}), [], HERE)


def test_who_was_turned_out_stays_out(door):
    token = door.issue({})
    door.bar(get_session_id(token))
    assert "disconnected" in door.refuses(token, [], HERE)


def test_only_what_an_address_may_say_reaches_a_session(door):
    given = {"speed": [b"1", b"2"], "bokeh-session-id": [b"evil"], "law": [b"x" * 9_000], "panel": [b"energy"]}
    token = door.issue(given)
    arguments = get_token_payload(token)["arguments"]
    assert set(arguments) == {"speed", "law", "panel"} and arguments["speed"] == [b"2"]
    assert len(token) < 2_000


def test_the_last_place_is_given_and_no_more_than_that(door, unhurried):
    for _ in range(MAX_SESSIONS):
        token = door.issue({})
        assert door.refuses(token, [], HERE) is None and not door.full(HERE)
        door.enter(Socket(token))
    assert door.refuses(door.issue({}), [], HERE) == FULL and door.full(HERE)


def test_who_is_idle_for_long_makes_room(door, unhurried):
    sockets = [Socket(door.issue({}), idle=IDLE_SECONDS - 60.0) for _ in range(MAX_SESSIONS - 1)]
    idle = Socket(door.issue({}), idle=IDLE_SECONDS + 60.0)
    for socket in (*sockets, idle):
        door.enter(socket)
    token = door.issue({})
    assert not door.full(HERE) and door.refuses(token, [], HERE) is None
    door.enter(Socket(token))
    assert "idle" in idle.reported and not any(socket.reported for socket in sockets)


def test_whoever_made_room_has_none_to_give_again(door, monkeypatch):
    monkeypatch.setattr(doors, "MAX_SESSIONS", 2)
    old = [Socket(door.issue({}), idle=IDLE_SECONDS + 60.0), Socket(door.issue({}))]
    for socket in old:
        door.enter(socket)
    assert opened(door, ELSEWHERE) is not None and old[0].reported
    assert opened(door, ELSEWHERE) is None  # the socket of the first may not have closed yet


def test_one_address_with_many_sockets_does_not_fill_the_server_for_others(door, unhurried):
    many = [Socket(door.issue({})) for _ in range(MAX_SESSIONS)]
    for k, socket in enumerate(many):
        socket.active += k
        door.enter(socket)
    assert door.full(HERE) and opened(door, HERE) is None
    others = [opened(door, ELSEWHERE) for _ in range(CLASS)]
    assert None not in others
    assert all(socket.reported for socket in many[:CLASS])  # those that had done nothing for longest
    assert not any(socket.reported for socket in [*many[CLASS:], *others])


def test_a_class_behind_one_address_keeps_its_places(door, unhurried):
    here = [opened(door, HERE) for _ in range(ADDRESS_SESSIONS)]
    rest = [opened(door, f"198.51.100.{k}") for k in range(MAX_SESSIONS - ADDRESS_SESSIONS)]
    assert None not in [*here, *rest]
    assert opened(door, ELSEWHERE) is None and not any(socket.reported for socket in here)


def test_a_class_may_come_at_once_and_a_flood_may_not(door):
    sockets = [opened(door) for _ in range(int(ADDRESS_BURST) + 20)]
    assert None not in sockets[: int(ADDRESS_BURST)] and sockets[-1] is None
    assert door.refuses(door.issue({}), [], HERE) == FULL


def test_a_flood_of_sockets_from_one_address_is_refused_to_no_other(door, clock):
    for _ in range(1_220):  # in 10 s, as somebody did
        clock.now += 10.0 / 1_220
        if (socket := opened(door)) is not None:
            assert door.pause(socket) == 0.0
            door.leave(socket)
    assert opened(door) is None
    assert None not in [opened(door, ELSEWHERE) for _ in range(CLASS)]
    clock.now += 2.0 / ADDRESS_RATE
    assert opened(door) is not None


def test_what_a_full_server_refuses_uses_nothing_up(door, clock):
    for k in count():
        if (socket := opened(door, f"198.51.100.{k % 200}")) is None:
            break
        door.pause(socket)
        door.leave(socket)
    assert k == int(SESSIONS_BURST)
    assert all(opened(door) is None for _ in range(500))
    clock.now += 60.0
    assert None not in [opened(door) for _ in range(CLASS)]


# --- where visitors were turned out -----------------------------------------------------------------------------------


def flood(door, address=HERE, sockets=4):
    for k in range(sockets):
        door.bar(f"flooding {k}")
        door.slow(address)


def test_where_visitors_were_turned_out_new_sessions_come_one_after_the_other(door, clock):
    sockets = [opened(door) for _ in range(3)]
    assert begun(door, clock, sockets, 1.0) == [0.0] * 3 and door.debt(HERE) == 0.0
    flood(door)
    waits = begun(door, clock, [opened(door) for _ in range(4)], 60.0)
    assert len(waits) == 4 and waits[-1] > 2.0 * MAX_REOPEN_PAUSE
    assert door.debt(HERE) > 0.0
    assert begun(door, clock, [opened(door, ELSEWHERE) for _ in range(3)], 1.0) == [0.0] * 3


def test_sockets_that_were_opened_and_closed_leave_no_queue_behind(door, clock):
    """One visitor flooded, opened and closed sockets for ten seconds, and his address stayed shut for minutes."""
    flood(door)
    for _ in range(200):
        clock.now += 0.05
        if (socket := opened(door)) is not None:
            door.pause(socket)
            door.leave(socket)
    socket = opened(door)
    assert socket is not None and begun(door, clock, [socket], 300.0)[0] <= 2.0 * MAX_REOPEN_PAUSE


def test_who_leaves_the_line_makes_room_for_the_next(door, clock):
    flood(door)
    first = opened(door)
    assert door.pause(first) == 0.0
    waiting = [opened(door) for _ in range(20)]
    assert all(door.pause(socket) > 0.0 for socket in waiting)
    for socket in waiting[:-1]:
        door.leave(socket)
    assert 0.0 < door.pause(waiting[-1]) <= MAX_REOPEN_PAUSE


def test_the_line_has_an_end_and_is_one_of_each_address(door, clock):
    flood(door, sockets=40)
    waits = [door.pause(opened(door)) for _ in range(MAX_IN_LINE + 11)]
    assert waits[0] == 0.0 and waits.count(None) == 10  # the first has begun already
    assert max(wait for wait in waits if wait is not None) <= MAX_IN_LINE * MAX_REOPEN_PAUSE
    assert door.pause(opened(door, ELSEWHERE)) == 0.0


def test_a_class_beside_somebody_who_floods_on_gets_in(door, clock):
    sockets = [opened(door) for _ in range(CLASS)]
    since, found = clock.now, {}
    while len(found) < CLASS and clock.now - since < 300.0:
        flood(door, sockets=1)  # ten times a second
        found |= {socket: clock.now for socket in sockets if socket not in found and door.pause(socket) == 0.0}
        clock.now += 0.1
    assert len(found) == CLASS and clock.now - since <= 1.3 * CLASS * MAX_REOPEN_PAUSE


def test_a_flood_that_is_over_is_forgotten(door, clock):
    flood(door)
    clock.now += 60.0
    assert begun(door, clock, [opened(door) for _ in range(CLASS)], 1.0)[-1] <= 0.2
