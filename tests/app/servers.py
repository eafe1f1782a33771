"""Servers of the page, each a process of its own, and the time for which what they start computes."""

import os
import random
import signal
import socket
import subprocess
import sys
import time
import urllib.request
from contextlib import suppress
from pathlib import Path

import pytest

from ..patience import SECONDS

ROOT = Path(__file__).parents[2]


PORTS = range(20_000, 30_000)  # none that a system gives to whoever connects, meanwhile


def free_port() -> int:
    while True:
        with socket.socket() as probe, suppress(OSError):
            port = random.choice(PORTS)
            probe.bind(("127.0.0.1", port))
            return port


class Server:
    """A server that can be ended and started again on the same port."""

    MODULE = "app.command"  # that is run

    def __init__(self, log: Path, *options: str):
        self.port, self.log, self.options = free_port(), log, options
        self.address = f"127.0.0.1:{self.port}"
        self.process: subprocess.Popen | None = None

    def start(self) -> None:
        if self.process is not None and self.process.returncode != -signal.SIGKILL:
            self.said_no_trace()
        self.log.unlink(missing_ok=True)  # what a killed one has started may still write to that
        with self.log.open("w") as output:
            self.process = subprocess.Popen(
                [sys.executable, "-m", self.MODULE, "serve", "--port", str(self.port), *self.options],
                stdout=output,
                stderr=subprocess.STDOUT,
                cwd=ROOT,
            )
        deadline = time.monotonic() + SECONDS  # a first compilation
        while True:
            if self.process.poll() is not None or time.monotonic() > deadline:
                self.process.kill()
                pytest.fail("the server did not start:\n" + self.log.read_text())
            try:
                urllib.request.urlopen(f"http://{self.address}/liveness", timeout=2).read()
                return
            except OSError:
                time.sleep(0.1)

    @property
    def runs(self) -> bool:
        return self.process is not None and self.process.poll() is None

    def end(self, how: int = signal.SIGKILL) -> None:
        """If it runs; also where it is stopped."""
        if self.runs:
            self.process.send_signal(signal.SIGCONT)
            self.process.send_signal(how)
            self.process.wait(20)

    def said_no_trace(self) -> None:
        """Its log must hold no stack trace."""
        log = self.log.read_text()
        assert "Traceback" not in log, log[-3000:]


def _fields(pid: int) -> list[str] | None:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    except (OSError, IndexError):
        return None


def _descends(pid: int, of: int) -> bool:
    while pid > 1:
        if pid == of:
            return True
        fields = _fields(pid)
        pid = int(fields[1]) if fields else 0
    return False


def _seconds(of: int, solves: bool) -> dict[int, float]:
    """Of processors, that each of a server's processes has used, by its id."""
    found, server = {}, _fields(of)
    for folder in Path("/proc").glob("[0-9]*"):
        pid, fields = int(folder.name), _fields(int(folder.name))
        # Workers are nicer than the server; the compiling process is not.
        if fields and server and (not solves or int(fields[16]) > int(server[16])) and _descends(pid, of):
            found[pid] = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    return found


class Meter:
    """Seconds of processors that a server and what it has started use from now on; `solves`: only those of its workers.

    Unlike the time that passes, they are the same on a machine that does much else beside.
    """

    def __init__(self, server: Server, solves: bool = False):
        self._pid, self._solves = server.process.pid, solves
        self._begun = _seconds(self._pid, solves)
        self.used: dict[int, float] = {}  # by each process, also by those that have ended

    def read(self) -> float:
        """Until now; often enough, as what a process has used is known no more once it has ended."""
        for pid, seconds in _seconds(self._pid, self._solves).items():
            self.used[pid] = seconds - self._begun.get(pid, 0.0)
        return sum(self.used.values())
