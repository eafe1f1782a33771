"""The port before the server is ready: open, honest about it, and handed over without a refused connection."""

import socket
import subprocess
import sys
import urllib.error
import urllib.request
from pathlib import Path

import pytest

from app.serving.early import EarlyPort

from ..servers import free_port

ROOT = Path(__file__).parents[3]
SERVE = """
import sys
from app.command.main import main
code = main(sys.argv[1:])
print("panel" in sys.modules)
sys.exit(code)
"""


@pytest.fixture
def early():
    port = EarlyPort(free_port(), "127.0.0.1")
    yield port
    for each in port.hand_over():
        each.close()


@pytest.mark.parametrize("path", ["", "liveness", "?mass_ratio=3"])
def test_who_comes_early_is_informed_and_asks_again(early, path):
    with pytest.raises(urllib.error.HTTPError) as answer:
        urllib.request.urlopen(f"http://127.0.0.1:{early.port}/{path}", timeout=20)
    assert answer.value.code == 503 and answer.value.headers["Retry-After"]
    text = answer.value.read().decode()
    assert "gets ready" in text and 'http-equiv="refresh"' in text


def test_who_says_nothing_or_leaves_keeps_nobody_waiting(early):
    silent = [socket.create_connection(("127.0.0.1", early.port), timeout=20) for _ in range(20)]
    silent[0].close()
    silent[1].sendall(b"GET / HTTP/1.1\r\nX: " + b"x" * 200_000)
    with pytest.raises(urllib.error.HTTPError, match="503"):
        urllib.request.urlopen(f"http://127.0.0.1:{early.port}/", timeout=20)
    for each in silent:
        each.close()


def test_the_port_is_never_closed_on_the_way_to_the_server():
    early = EarlyPort(free_port(), "127.0.0.1")
    (taken,) = early.hand_over()
    with taken, socket.create_connection(("127.0.0.1", early.port), timeout=20) as waiting:
        taken.setblocking(True)
        accepted, _ = taken.accept()  # as the server does, some time later
        assert accepted.getpeername() == waiting.getsockname()
        accepted.close()


@pytest.mark.parametrize(
    "address, said",
    [("127.0.0.1", "--port: got {port}; allowed: a free port"), ("192.0.2.1", "--address: got '192.0.2.1'")],
)
def test_a_port_or_address_that_cannot_be_had_is_refused_before_anything_is_started(early, address, said):
    call = [sys.executable, "-c", SERVE, "serve", "--port", str(early.port), "--address", address]
    done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, timeout=300)
    assert done.returncode == 2 and done.stdout.strip() == "False"  # nothing was loaded for it, let alone compiled
    assert done.stderr.startswith("impact: " + said.format(port=early.port)) and done.stderr.count("\n") == 1
