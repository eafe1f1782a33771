"""The page on loopback, in headless Chromium and with bare clients."""

import asyncio
import os
import statistics
import time
from contextlib import suppress
from itertools import count
from pathlib import Path

from playwright.sync_api import sync_playwright

from tests.app.conftest import LABORATORY, QUIET, Page, chromium
from tests.app.socket_client import SocketClient, run

from .serving import served_page
from .size import of, some
from .timing import row
from .workspace import rows_of

VISITS = 15
MOVES, PLAYED = 80, 4.0  # of a slider; s
COVERED, ELSEWHERE = (16, 25), (55, 100)  # goals of p50 and p95 from a slider to its picture [ms]; by the browser
CASES = {
    "exact waves drawn": (LABORATORY, COVERED),
    "exact waves drawn, in the opening": ("", COVERED),
    "50 modes drawn": ("?method=modal", COVERED),
    "Hertz": ("?law=hertz", COVERED),
    "a beam, 5 modes": ("?scene=figure-8.15", COVERED),
    "a beam, 20 modes": ("?scene=hammer-on-cantilever", COVERED),
    "a four-bar, 12 modes": ("?scene=four-bar", ELSEWHERE),
    "a slider-crank moves on": ("?scene=slider-crank&method=multibody", ELSEWHERE),
}

ANSWERS = {  # query; goal, half of what the first of these measurements gave [ms]
    "exact waves": ("", 8.2),
    "Hertz": ("?law=hertz", 13.5),
    "a stepped rod": ("?scene=stepped-rod", 8.5),
    "a hammer on a cantilever": ("?scene=hammer-on-cantilever", 23.5),
}
ANSWER_MOVES, ANSWER_BATCHES = 40, 7

# The picture is there once the frame that draws an answer is over: one that the browser finds is found and drawn in it.
LATENCY = """async (moves) => {
  const { page } = strikewave, { controls, own } = page, found = [];
  const answers = () => strikewave.frames + own.count;
  const frame = () => new Promise((done) => requestAnimationFrame(() => {
    const channel = new MessageChannel(); channel.port1.onmessage = done; channel.port2.postMessage(0); }));
  for (let k = 0; k < moves; k++) {
    const [before, drawn, begun] = [answers(), page.painted, performance.now()];
    controls.send('mass_ratio', 0.6 + k / 100);
    do await frame(); while (answers() === before || page.painted === drawn);
    found.push(performance.now() - begun);
    await new Promise((done) => setTimeout(done, 40 + 30 * Math.random()));
  }
  return found.slice(moves / 8);
}"""
DRAG_SECONDS = 2
DRAG = """async (seconds) => {
  const { controls, own } = strikewave.page, begun = performance.now(), before = own.count;
  for (let k = 0; performance.now() - begun < 1000 * seconds; k++) {
    controls.send('mass_ratio', 0.6 + 0.001 * k);
    await new Promise((done) => requestAnimationFrame(done));
  }
  return (own.count - before) / seconds;
}"""
DRAGGED = {
    "exact waves, in the opening": "",
    "Hertz, in the opening": "?law=hertz",
    "a beam, in the opening": "?scene=hammer-on-cantilever&layout=opening",
}
PLAYBACK = """async (seconds) => {
  const { page } = strikewave, { player } = page;
  player.pace.value = '0.25'; player.go(0); player.toggle();
  await new Promise((done) => setTimeout(done, 500));
  const from = page.painted, begun = performance.now();
  await new Promise((done) => setTimeout(done, 1000 * seconds));
  const rate = (page.painted - from) / (performance.now() - begun) * 1000;
  player.toggle();
  return rate;
}"""


def measure() -> dict[str, object]:
    begun = time.perf_counter()
    with served_page() as own:
        address, process = own
        rows = [row("impact serve answers after", time.perf_counter() - begun, "s")]
        rows += _browser(address, process)
        rows += run(_answers(address, process), 300)
        if same := of(None, own):  # a small run starts one server
            return dict(rows + run(_sessions(*same), 120))
    with served_page() as own:  # one that holds no memory free of what went before
        rows += run(_sessions(*own), 120)
    return dict(rows)


def _browser(address: str, process: int) -> list:
    rows = []
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium(), args=QUIET)
        begun = time.perf_counter()
        page = Page(browser, address)
        rows.append(row("page interactive, from the request, first visit", time.perf_counter() - begun, "s", "<= 2"))
        moves = of(MOVES, 8)
        for name, (query, (half, most)) in some(CASES).items():
            page = Page(browser, address, query)
            page.tab.wait_for_timeout(of(500, 50))
            received = page.frames["bytes"]
            times = sorted(page.evaluate(LATENCY, moves))
            rows.append(row(f"slider to redrawn picture, {name}: p50", statistics.median(times), "ms", f"<= {half}"))
            rows.append(
                row(f"slider to redrawn picture, {name}: p95", times[int(0.95 * len(times))], "ms", f"<= {most}")
            )
            rows.append(
                row(f"websocket per solve, {name}", (page.frames["bytes"] - received) / (1e3 * moves), "kB", "<= 100")
            )
            frames = sum(page.quiet()[each] for each in ("sent", "received"))  # the last answer is there
            rows.append(row(f"playback, {name}", page.evaluate(PLAYBACK, of(PLAYED, 0.5)), "frames/s", ">= 55"))
            extra = page.frames["sent"] + page.frames["received"] - frames
            rows.append(row(f"websocket frames during playback, {name}", extra, "", "0"))
            page.context.close()
        rows += rows_of(browser, address, PLAYBACK)
        for name, query in some(DRAGGED).items():
            rows += _drag(Page(browser, address, query), process, name)
        browser.close()
    return rows


def _drag(page: Page, process: int, name: str) -> list:
    """Pictures a second while a slider is dragged that the browser answers, and what that costs the server."""
    page.wait("() => strikewave.page.own.answers !== null")
    seconds = of(DRAG_SECONDS, 0.5)
    page.evaluate(DRAG, of(0.5, 0.1))
    page.quiet()
    before = _processor_time(_tree(process))
    pictures = page.evaluate(DRAG, seconds)
    page.quiet()  # with the answer once the hand rests
    used = (_processor_time(_tree(process)) - before) / seconds
    page.context.close()
    return [
        row(f"pictures while dragging, {name}", pictures, "frames/s", ">= 50"),
        row(f"server CPU of a second of dragging, {name}", 1e3 * used, "ms", "<= 20"),
    ]


async def _answers(address: str, process: int) -> list:
    """CPU of the server and its workers for one move of a slider, whoever of them did the work."""
    rows, drags, batches = [], of(ANSWER_MOVES, 4), of(ANSWER_BATCHES, 1)
    for name, (query, target) in some(ANSWERS).items():
        client = await SocketClient(address).open(query)
        await client.changes(of(2.0, 0.5))  # the scene itself: who sends before that is answered is slowed
        used, moves = [], count()  # none twice: answers are kept
        for _ in range(batches + 1):  # the first does not count
            before = _processor_time(_tree(process))
            for _ in range(drags):
                await client.set("mass_ratio", 0.5 + next(moves) / (2 * drags * (batches + 1)))
                await client.answer()
                await asyncio.sleep(0.02)  # as a page does: it draws what it was sent
            used.append((_processor_time(_tree(process)) - before) / drags)
        client.close()
        rows.append(row(f"server CPU an answer, {name}", 1e3 * statistics.median(used[1:]), "ms", f"<= {target}"))
    return rows


def _tree(process: int) -> list[int]:
    """A process and all that it started, and these."""
    parents = {}
    for status in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):  # it has just ended
            parents[int(status.parent.name)] = int(status.read_text().rpartition(")")[2].split()[1])
    found = [process]
    for each in found:
        found += [child for child, parent in parents.items() if parent == each]
    return found


def _processor_time(processes: list[int]) -> float:
    """Time [s] that these have used of a processor."""
    stats = (Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split() for process in processes)
    return sum(int(fields[11]) + int(fields[12]) for fields in stats) / os.sysconf("SC_CLK_TCK")


async def _sessions(address: str, process: int) -> list:
    def used() -> tuple[float, float]:
        pages = int(Path(f"/proc/{process}/statm").read_text().split()[1])
        return _processor_time([process]), pages * os.sysconf("SC_PAGE_SIZE") / 1e6

    clients = [await SocketClient(address).open() for _ in range(2)]
    await asyncio.sleep(0.5)
    visits, (cpu, memory) = of(VISITS, 2), used()
    clients += [await SocketClient(address).open() for _ in range(visits)]
    await asyncio.sleep(0.5)
    cpu_after, memory_after = used()
    for client in clients:
        client.close()
    return [
        row("server CPU to open a session", 1e3 * (cpu_after - cpu) / visits, "ms", "<= 150"),
        row("memory held by a session", (memory_after - memory) / visits, "MB", "<= 2"),
    ]
