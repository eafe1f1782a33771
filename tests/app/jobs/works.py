"""Work for processes: functions of a module, as all that a worker can do."""

import os
import time

from solvers.jit.compiling import NotCompiled


def double(value):
    return 2 * value


def process(_):
    return os.getpid(), os.getpriority(os.PRIO_PROCESS, 0)


def compute(seconds):
    """Use a processor for so long."""
    begun = time.process_time()
    while time.process_time() - begun < seconds:
        pass
    return seconds


def sleep(seconds):
    time.sleep(seconds)
    return seconds


def refuse(value):
    raise ValueError(f"value: got {value}; allowed: others")


def fail(_):
    raise ZeroDivisionError("secret path /etc")


def not_compiled(_):
    raise NotCompiled("kernel")


def end(_):
    os._exit(3)


def blas_threads(_):
    return os.environ.get("OPENBLAS_NUM_THREADS")


def until_cancelled(value, cancelled, report):
    report("begun")
    while not cancelled():
        time.sleep(0.005)
    return f"some of {value}"
