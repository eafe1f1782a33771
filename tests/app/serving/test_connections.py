"""Connections that say nothing: they neither stop a server nor keep anybody out, and leave nothing in its log."""

import contextlib
import resource
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from types import SimpleNamespace

import pytest

from app.serving import connections
from app.serving.limits import MAX_CONNECTIONS

from ..servers import ROOT, free_port

SILENT = 600  # connections, of two addresses
EARLY = 200  # while the server starts; more than wait in line
START = """
import resource, sys
resource.setrlimit(resource.RLIMIT_NOFILE, (256, 256))  # open files, and no more to be had
from app.serving import limits
limits.MAX_SESSIONS = 0  # the house is full: every page is refused
from app.command.main import main
sys.exit(main(sys.argv[1:]))
"""


def fetched(port, path="liveness", patience=60):
    try:
        return urllib.request.urlopen(f"http://127.0.0.1:{port}/{path}", timeout=patience).status
    except urllib.error.HTTPError as refused:
        return refused.code


@pytest.mark.slow
def test_silent_connections_do_not_stop_a_server_of_few_files(tmp_path):
    """1 106 of them from one address did, and its log grew by 81 MB; 200 while it started left as many traces."""
    port, log = free_port(), tmp_path / "log"
    with log.open("w") as output:
        call = [sys.executable, "-c", START, "serve", "--port", str(port)]
        process = subprocess.Popen(call, cwd=ROOT, stdout=output, stderr=subprocess.STDOUT)
    silent = []
    try:
        while True:  # also while it gets ready
            assert process.poll() is None, log.read_text()
            try:
                early = socket.create_connection(("127.0.0.1", port), timeout=5)
                break
            except OSError:
                time.sleep(0.1)
        silent.append(early)
        for _ in range(EARLY):
            silent.append(socket.socket())
            silent[-1].setblocking(False)
            silent[-1].connect_ex(("127.0.0.1", port))
        deadline = time.monotonic() + 300

        def answered(path):
            while True:  # who comes early waits, and beyond 128 of them has to ask again, some of them seconds later
                with contextlib.suppress(OSError):
                    return fetched(port, path, patience=10)
                assert process.poll() is None and time.monotonic() < deadline, log.read_text()

        assert answered("liveness") == 200
        for number in range(SILENT):
            source = (f"127.0.0.{2 + number % 2}", 0)
            silent.append(socket.create_connection(("127.0.0.1", port), timeout=20, source_address=source))
            if number % 100 == 99:
                assert answered("liveness") == 200 and answered("") == 503
    finally:
        for wire in silent:
            wire.close()
        process.terminate()
        process.wait(30)
    assert len(log.read_text()) < 1_000 and "ERROR" not in log.read_text(), log.read_text()[:3_000]


def test_as_many_files_as_may_be_are_asked_for(monkeypatch):
    asked = []
    monkeypatch.setattr(resource, "setrlimit", lambda _, limits: asked.append(limits))
    for limits, most in (((1024, 524_288), MAX_CONNECTIONS), ((256, 256), 128), ((-1, -1), MAX_CONNECTIONS)):
        monkeypatch.setattr(resource, "getrlimit", lambda _, limits=limits: limits)
        assert connections.room() == most
    assert asked == [(connections.FILES, 524_288), (256, 256)]


def test_the_oldest_of_the_address_with_most_gives_way():
    """All that share the first 64 bits of an address of the new kind are one."""
    gone = []

    def connection(address, begun, closed=False):
        stream = SimpleNamespace(begun=begun, closed=lambda: closed, close=lambda: gone.append(begun))
        return SimpleNamespace(stream=stream, context=SimpleNamespace(remote_ip=address))

    many = [connection(f"2001:db8::{k}", begun, begun == 0.0) for k, begun in enumerate((3.0, 2.0, 0.0))]
    connections.make_room(SimpleNamespace(_connections=[connection("203.0.113.1", 1.0), *many]))
    assert gone == [2.0]
    connections.make_room(SimpleNamespace(_connections=many[2:]))  # nothing to close
    assert gone == [2.0]
