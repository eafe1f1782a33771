"""Who may come in: only whom this server has given a session, one socket each, and only so many."""

import pytest
from bokeh.util.token import generate_jwt_token, generate_session_id, get_session_id, get_token_payload

from app.choices.own import LONGEST
from app.serving import door as doors
from app.serving.door import FULL, Door
from app.serving.limits import ADDRESS_SESSIONS, IDLE_SECONDS, MAX_BARRED, MAX_SESSIONS
from solvers.scenes.library import SCENES
from tests.app.strangers import named

SECRET = b"a secret of this process"
HERE, ELSEWHERE = "203.0.113.1", "203.0.113.2"
CLASS = 50


class Clock:
    """Time that passes when a test says so."""

    now = 1_000.0

    def __call__(self):
        return self.now


class Socket:
    def __init__(self, token, idle=0.0, address=HERE, now=Clock.now):
        self.session_id, self.active, self.address = get_session_id(token), now - idle, address
        self.reported = None

    def turn_out(self, sentence, flood=True):
        self.reported = sentence


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def door(clock):
    return Door(SECRET, clock)


def opened(door, address=HERE):
    """A new socket from an address, or None if it is refused."""
    token = door.issue({})
    if door.refuses(token, address) is not None:
        return None
    socket = Socket(token, address=address, now=door._clock())
    door.enter(socket)
    return socket


def test_a_session_that_was_issued_opens_once_and_again_when_its_socket_has_gone(door):
    token = door.issue({})
    socket = Socket(token)
    assert door.refuses(token, HERE) is None
    door.enter(socket)
    assert door.refuses(token, HERE) == "serving.open-already"
    door.leave(socket)
    assert door.refuses(token, HERE) is None


@pytest.mark.parametrize("signed", [False, True])
def test_a_session_that_another_has_made_up_is_refused(door, signed):
    own = generate_session_id(secret_key=b"another", signed=True)
    for session in (own, "evil", ""):
        token = generate_jwt_token(session, secret_key=b"another", signed=signed, expiration=300)
        assert door.refuses(token, HERE) == "serving.out-of-date"


@pytest.mark.parametrize("token", [None, "", "x", "a.b", "a.b.c", "é", "eyJ9.eyJ9", "." * 100, "A" * 10_000])
def test_what_is_no_token_is_refused(door, token):
    assert door.refuses(token, HERE) == "serving.out-of-date"


def test_a_token_that_is_too_old_or_was_changed_is_refused(door, monkeypatch):
    token = door.issue({})
    assert door.refuses(token[:-2] + "xx", HERE) == "serving.out-of-date"
    monkeypatch.setattr(doors, "TOKEN_SECONDS", -1)
    assert door.refuses(door.issue({}), HERE) == "serving.out-of-date"


def test_who_was_turned_out_stays_out(door):
    token = door.issue({})
    door.bar(get_session_id(token))
    assert door.refuses(token, HERE) == "serving.barred"


def test_only_what_an_address_may_say_reaches_a_session(door):
    given = {"speed": [b"1", b"2"], "bokeh-session-id": [b"evil"], "law": [b"x" * 9_000], "panel": [b"energy"]}
    token = door.issue(given)
    arguments = get_token_payload(token)["arguments"]
    assert set(arguments) == {"speed", "law", "panel"} and arguments["speed"] == [b"2"]
    assert len(token) < 2_000


def test_a_scene_of_ones_own_reaches_a_session_whole(door):
    names = [named(path.read_text("utf-8")) for path in SCENES.glob("*.toml")]
    assert max(map(len, names)) > 700
    for name in (*names, "own." + "A" * (LONGEST - 4)):
        arguments = get_token_payload(door.issue({"scene": [name.encode()]}))["arguments"]
        assert arguments["scene"] == [name.encode()]
    long = get_token_payload(door.issue({"scene": [b"A" * 100_000], "law": [b"A" * 100_000]}))["arguments"]
    assert len(long["scene"][0]) == LONGEST and len(long["law"][0]) < LONGEST


def test_the_last_place_is_given_and_no_more_than_that(door):
    for _ in range(MAX_SESSIONS):
        token = door.issue({})
        assert door.refuses(token, HERE) is None and not door.full(HERE)
        door.enter(Socket(token))
    assert door.refuses(door.issue({}), HERE) == FULL and door.full(HERE)


def test_who_is_idle_for_long_makes_room(door):
    sockets = [Socket(door.issue({}), idle=IDLE_SECONDS - 60.0) for _ in range(MAX_SESSIONS - 1)]
    idle = Socket(door.issue({}), idle=IDLE_SECONDS + 60.0)
    for socket in (*sockets, idle):
        door.enter(socket)
    token = door.issue({})
    assert not door.full(HERE) and door.refuses(token, HERE) is None
    door.enter(Socket(token))
    assert "idle" in idle.reported and not any(socket.reported for socket in sockets)


def test_whoever_made_room_has_none_to_give_again(door, monkeypatch):
    monkeypatch.setattr(doors, "MAX_SESSIONS", 2)
    old = [Socket(door.issue({}), idle=IDLE_SECONDS + 60.0), Socket(door.issue({}))]
    for socket in old:
        door.enter(socket)
    assert opened(door, ELSEWHERE) is not None and old[0].reported
    assert opened(door, ELSEWHERE) is None  # the socket of the first may not have closed yet


def test_one_address_with_many_sockets_does_not_fill_the_server_for_others(door):
    many = [Socket(door.issue({})) for _ in range(MAX_SESSIONS)]
    for k, socket in enumerate(many):
        socket.active += k
        door.enter(socket)
    assert door.full(HERE) and opened(door, HERE) is None
    others = [opened(door, ELSEWHERE) for _ in range(CLASS)]
    assert None not in others
    assert all(socket.reported for socket in many[:CLASS])  # those that had done nothing for longest
    assert not any(socket.reported for socket in [*many[CLASS:], *others])


def test_a_class_behind_one_address_keeps_its_places(door):
    here = [opened(door, HERE) for _ in range(ADDRESS_SESSIONS)]
    rest = [opened(door, f"198.51.100.{k}") for k in range(MAX_SESSIONS - ADDRESS_SESSIONS)]
    assert None not in [*here, *rest]
    assert opened(door, ELSEWHERE) is None and not any(socket.reported for socket in here)


def test_three_addresses_do_not_shut_the_house(door):
    """50 idle sockets each: nobody was over his share, and every newcomer was refused."""
    idle = [opened(door, f"198.51.100.{k % 3}") for k in range(MAX_SESSIONS)]
    assert None not in idle
    assert None not in [opened(door, f"203.0.113.{k}") for k in range(10)]


def test_many_addresses_that_do_nothing_do_not_shut_it_for_long(door, clock):
    idle = [opened(door, f"198.51.100.{k % 30}") for k in range(MAX_SESSIONS)]
    assert opened(door, ELSEWHERE) is None
    clock.now += IDLE_SECONDS - 1.0
    busy = idle[0]
    busy.active = clock.now
    assert opened(door, ELSEWHERE) is None
    clock.now += 2.0
    assert all(opened(door, ELSEWHERE) is not None for _ in range(CLASS))
    assert not busy.reported


def test_where_visitors_were_turned_out_new_sessions_come_after_others(door, clock):
    assert door.debt(HERE) == 0.0
    door.slow(HERE)
    assert door.debt(HERE) == 1.0 and door.debt(ELSEWHERE) == 0.0
    clock.now += 60.0
    assert door.debt(HERE) < 1e-3


def test_of_a_flood_of_sockets_that_leave_nothing_is_left(door):
    for _ in range(1_220):
        socket = opened(door)
        assert socket is not None
        door.leave(socket)
    assert None not in [opened(door) for _ in range(CLASS)]


def test_five_addresses_of_strangers_who_never_rest_do_not_shut_the_house(door):
    """With 30 each nobody was over his share."""
    busy = [opened(door, f"198.51.100.{k % 5}") for k in range(MAX_SESSIONS)]
    others = [opened(door, f"203.0.113.{k}") for k in range(MAX_SESSIONS - 5 * ADDRESS_SESSIONS)]
    assert None not in [*busy, *others] and not any(socket.reported for socket in others)


def test_a_crowd_gives_way_before_who_only_reads(door, clock):
    reading = opened(door, ELSEWHERE)
    clock.now += IDLE_SECONDS + 1.0
    crowd = [opened(door, HERE) for _ in range(MAX_SESSIONS - 1)]
    assert opened(door, "203.0.113.3") is not None and crowd[0].reported and not reading.reported


def test_who_comes_back_to_a_full_house_waits(door):
    """Sessions that were left for a moment were no visitors, and all came back at once: 600 in place of 150."""
    token = door.issue({})
    first = Socket(token)
    door.enter(first)
    door.leave(first)
    assert None not in [opened(door, f"198.51.100.{k}") for k in range(MAX_SESSIONS)]
    assert door.refuses(token, HERE) == FULL


def test_of_those_turned_out_only_the_last_are_remembered(door):
    for k in range(3 * MAX_BARRED):
        door.bar(str(k))
    assert len(door._barred) == MAX_BARRED and str(3 * MAX_BARRED - 1) in door._barred
