"""A study of the command in a process of its own, which gets an interrupt in its midst."""

import subprocess
import sys
from pathlib import Path

from ...patience import SECONDS

RUNS = 20  # that have begun by then
ALONE = f"""
import os, signal, sys
from contextlib import contextmanager
from itertools import count
from app.command import sweep, trust
from app.command.interrupts import interruptible
from app.command.main import main

begun = count(1)

@contextmanager
def interrupted_once():
    with interruptible() as interrupted:
        def asked_before_every_run():
            if next(begun) == {RUNS}:
                os.kill(os.getpid(), signal.SIGINT)
            return interrupted()
        yield asked_before_every_run

sweep.interruptible = trust.interruptible = interrupted_once
signal.signal(signal.SIGINT, signal.default_int_handler)  # whoever runs the tests may ignore interrupts
sys.exit(main(sys.argv[1:]))
"""


def interrupted(*words: str) -> tuple[int, str, str]:
    """Its exit code, and what it wrote on standard output and standard error."""
    call = [sys.executable, "-c", ALONE, *words]
    done = subprocess.run(call, cwd=Path(__file__).parents[3], capture_output=True, text=True, timeout=SECONDS)
    return done.returncode, done.stdout, done.stderr
