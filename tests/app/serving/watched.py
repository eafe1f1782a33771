"""The command, which says in its log what has taken the event loop for too long, in seconds of its own thread, whatever
else the machine does, and what it was doing. Run as a program.

To look for garbage is counted apart, by objects that are looked through: its time is that of memory, which on a busy
machine others use, and a page of few objects is all that can be done for it.
"""

import asyncio
import gc
import os
import sys
import threading
import time
import traceback

TOLD = 0.02  # s, of which it is told
MARK, LOOKED = "TAKEN", "LOOKED THROUGH"
RUN = asyncio.Handle._run
PID, THREAD = os.getpid(), threading.get_ident()
under_way, collecting, seen = False, 0.0, []


def told(log: str) -> list[tuple[float, str]]:
    """Seconds and what was done, of each that a log tells."""
    parts = (part.split(" s", 1) for part in log.split(f"{MARK} ")[1:])
    return [(float(seconds), doing[:4_000]) for seconds, doing in parts]


def looked_through(log: str) -> list[int]:
    """How many objects, of each whole collection that a log tells."""
    return [int(part.split()[0]) for part in log.split(f"{LOOKED} ")[1:]]


def collected(phase: str, found: dict[str, int]) -> None:
    """What Python calls before and after it looks for garbage."""
    global collecting
    if os.getpid() != PID:
        return
    if phase == "start" and found["generation"] == 2:
        # In one call: while a list of them is held, tuples that another thread is still filling cannot grow.
        count = next(map(len, map(gc.get_objects, (None,))))
        print(f"{LOOKED} {count} objects", flush=True)
    if threading.get_ident() == THREAD:
        collecting += time.thread_time() * (-1 if phase == "start" else 1)


def timed(handle: asyncio.Handle) -> None:
    """Run a callback of the loop."""
    global under_way, collecting
    if os.getpid() != PID or threading.get_ident() != THREAD:
        RUN(handle)
        return
    seen.clear()
    begun, under_way, collecting = time.thread_time(), True, 0.0
    RUN(handle)
    under_way, taken = False, time.thread_time() - begun - collecting
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
    gc.callbacks.append(collected)
    threading.Thread(target=look, daemon=True).start()
    main()
