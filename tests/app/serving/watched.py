"""The command, which says in its log what has taken the event loop for too long, in seconds of its own thread, whatever
else the machine does, and what it was doing. Run as a program."""

import asyncio
import gc
import os
import sys
import threading
import time
import traceback

TOLD = 0.02  # s, of which it is told
MARK = "TAKEN"
RUN = asyncio.Handle._run
PID, THREAD = os.getpid(), threading.get_ident()
under_way, seen = False, []


def told(log: str) -> list[tuple[float, str]]:
    """Seconds and what was done, of each that a log tells."""
    parts = (part.split(" s", 1) for part in log.split(f"{MARK} ")[1:])
    return [(float(seconds), doing[:4_000]) for seconds, doing in parts]


def timed(handle: asyncio.Handle) -> None:
    """Run a callback of the loop."""
    global under_way
    if os.getpid() != PID or threading.get_ident() != THREAD:
        RUN(handle)
        return
    seen.clear()
    begun, under_way = time.thread_time(), True
    RUN(handle)
    under_way, taken = False, time.thread_time() - begun
    if taken > TOLD:
        print(f"{MARK} {taken:.3f} s", *seen, flush=True)


def look() -> None:
    """What the loop does, every 20 ms."""
    while True:
        time.sleep(0.02)
        if under_way and (frame := sys._current_frames().get(THREAD)):
            lines = [f"{each.name} {each.filename}:{each.lineno}" for each in traceback.extract_stack(frame)[-8:]]
            seen.append("\n" + " < ".join(reversed(lines)))


if __name__ == "__main__":
    from panel.io import document

    from app.command.main import main

    document.GC_DEBOUNCE = 1  # as many leave in a minute as elsewhere in an hour
    asyncio.Handle._run = timed
    gc.callbacks.append(lambda phase, found: seen.append(f"\ngc {found['generation']} {phase}"))
    threading.Thread(target=look, daemon=True).start()
    main()
