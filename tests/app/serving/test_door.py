"""Who may come in: only whom this server has given a session, one socket each, and only so many."""

import time
from itertools import pairwise

import pytest
from bokeh.util.token import generate_jwt_token, generate_session_id, get_session_id, get_token_payload

from app.serving import door as doors
from app.serving.door import FULL, Door
from app.serving.limits import IDLE_SECONDS, MAX_REOPEN_PAUSE, MAX_SESSIONS, SESSIONS_BURST

SECRET = b"a secret of this process"


class Socket:
    def __init__(self, token, idle=0.0):
        self.session_id, self.active = get_session_id(token), time.monotonic() - idle
        self.reported = None

    def turn_out(self, sentence):
        self.reported = sentence


@pytest.fixture
def door():
    return Door(SECRET)


def test_a_session_that_was_issued_opens_once_and_again_when_its_socket_has_gone(door):
    token = door.issue({})
    socket = Socket(token)
    assert door.refuses(token, []) is None
    door.enter(socket)
    assert "open already" in door.refuses(token, [socket.session_id])
    door.leave(socket)
    assert door.refuses(token, [socket.session_id]) is None


@pytest.mark.parametrize("signed", [False, True])
def test_a_session_that_another_has_made_up_is_refused(door, signed):
    own = generate_session_id(secret_key=b"another", signed=True)
    for session in (own, "evil", ""):
        token = generate_jwt_token(session, secret_key=b"another", signed=signed, expiration=300)
        assert "out of date" in door.refuses(token, [])


@pytest.mark.parametrize("token", [None, "", "x", "a.b", "a.b.c", "é", "eyJ9.eyJ9", "." * 100, "A" * 10_000])
def test_what_is_no_token_is_refused(door, token):
    assert "out of date" in door.refuses(token, [])


def test_a_token_that_is_too_old_or_was_changed_is_refused(door, monkeypatch):
    token = door.issue({})
    assert "out of date" in door.refuses(token[:-2] + "xx", [])
    monkeypatch.setattr(doors, "TOKEN_SECONDS", -1)
    assert "out of date" in door.refuses(door.issue({}), [])


def test_who_was_turned_out_stays_out(door):
    token = door.issue({})
    door.bar(get_session_id(token))
    assert "disconnected" in door.refuses(token, [])


def test_only_what_an_address_may_say_reaches_a_session(door):
    given = {"speed": [b"1", b"2"], "bokeh-session-id": [b"evil"], "law": [b"x" * 9_000], "panel": [b"energy"]}
    token = door.issue(given)
    arguments = get_token_payload(token)["arguments"]
    assert set(arguments) == {"speed", "law", "panel"} and arguments["speed"] == [b"2"]
    assert len(token) < 2_000


def test_the_last_place_is_given_and_no_more_than_that(door, monkeypatch):
    monkeypatch.setattr(door, "_new", doors.Rate(1e9, 1e9))
    for _ in range(MAX_SESSIONS):
        token = door.issue({})
        assert door.refuses(token, []) is None and not door.full
        door.enter(Socket(token))
    assert door.refuses(door.issue({}), []) == FULL and door.full


def test_who_is_idle_for_long_makes_room(door, monkeypatch):
    monkeypatch.setattr(door, "_new", doors.Rate(1e9, 1e9))
    sockets = [Socket(door.issue({}), idle=IDLE_SECONDS - 60.0) for _ in range(MAX_SESSIONS - 1)]
    idle = Socket(door.issue({}), idle=IDLE_SECONDS + 60.0)
    for socket in (*sockets, idle):
        door.enter(socket)
    token = door.issue({})
    assert not door.full and door.refuses(token, []) is None
    door.enter(Socket(token))
    assert "idle" in idle.reported and not any(socket.reported for socket in sockets)


def test_a_class_may_come_at_once_and_a_flood_may_not(door):
    refused = [door.refuses(door.issue({}), []) for _ in range(int(SESSIONS_BURST) + 20)]
    assert refused[: int(SESSIONS_BURST)] == [None] * int(SESSIONS_BURST)
    assert refused[-1] == FULL


def test_where_visitors_were_turned_out_new_sessions_come_one_after_the_other():
    door = Door(b"secret")
    assert [door.pause("here") for _ in range(3)] == [0.0] * 3 and door.debt("here") == 0.0
    door.bar("somebody", "here")
    waits = [door.pause("here") for _ in range(4)]
    between = [later - sooner for sooner, later in pairwise(waits)]
    assert waits[0] == 0.0 and all(0.9 * MAX_REOPEN_PAUSE < each <= MAX_REOPEN_PAUSE for each in between)
    assert 0.9 < door.debt("here") <= 1.0
    assert door.pause("elsewhere") == 0.0
