"""The page as people use it: its first second, a slider in the hand, kept runs, what stays in memory."""

import statistics
import time

from tests.app.conftest import Page

from .size import of, some
from .timing import row

VISITS = 5
PLAYED = 4.0  # s
DRAGGED = {  # scene; least answers a second while its slider moves
    "fixed-rod": 20,
    "ball-on-rod": 20,
    "stepped-rod": 20,
    "hammer-on-cantilever": 12,
    "split-hopkinson": 12,
    "figure-8.10": 12,
}
SUBJECTS = ("figure-4.12", "figure-5.16", "figure-6.5", "figure-8.15", "figure-8.20", "table-8.3", "figure-9.8")
PHONE, SLOWER = (390, 844), 4  # window, and times as slow a processor
MOVES = 1000
KEPT = (5, 12, 40, 100)  # modes

# What the same machine takes for a loop that never changes: figures of two machines are compared by it.
JS_LOOP = """() => { const begun = performance.now(); let sum = 0;
  for (let k = 0; k < 2e7; k++) sum += Math.sqrt(k);
  return [performance.now() - begun, sum][0]; }"""
FIRST = """() => ({
  paint: performance.getEntriesByName('first-contentful-paint')[0].startTime,
  moving: performance.now(),
  sent: [...performance.getEntriesByType('navigation'), ...performance.getEntriesByType('resource')]
    .map(({ name, transferSize }) => [new URL(name).pathname, transferSize]),
})"""
DRAG = """async (seconds) => {
  const { page } = strikewave, { speed } = page.model, { own } = page, seen = new Set(), begun = performance.now();
  const { count } = own; // of those that the browser answered by itself
  const take = () => seen.add(page.frame.chosen.speed);
  page.model.on('frame', take);
  for (let k = 0; performance.now() - begun < 1000 * seconds; k++) {
    page.controls.send('speed', speed * (1 + 0.3 * Math.sin(k / 40)));
    await new Promise((done) => requestAnimationFrame(done));
  }
  return (seen.size + own.count - count) / (performance.now() - begun) * 1000;
}"""
OPEN = """async (name) => {
  const { page } = strikewave, begun = performance.now();
  page.choose('scene', name);
  while (page.frame.chosen.scene !== name || page.asked) await new Promise((done) => setTimeout(done, 2));
  await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  return performance.now() - begun;
}"""
MOVE = """async ([from, moves]) => {
  for (let k = from; k < from + moves; k++) {
    const { own } = strikewave.page, answers = () => strikewave.frames + own.count, before = answers();
    strikewave.page.controls.send('mass_ratio', 0.6 + k / 2000);
    while (answers() === before) await new Promise((done) => setTimeout(done, 4));
  }
}"""
KEEP = """async (modes) => {
  const { page } = strikewave;
  if (page.model.modes !== modes) {
    page.choose('modes', modes);
    while (page.frame.chosen.modes !== modes) await new Promise((done) => setTimeout(done, 10));
  }
  await new Promise((done) => setTimeout(done, 600));  // no draft is kept
  page.compare.keep();
}"""


def rows_of(browser, address: str, playback: str) -> list:
    """Every figure; `playback`: script that gives the frames a second while the page plays."""
    tab = browser.new_page()
    rows = [
        row("bare loop of JavaScript, 2e7 square roots", tab.evaluate(JS_LOOP), "ms"),
        row("bare loop of Python, 1e7 additions", 1e3 * _python_loop(), "ms"),
    ]
    tab.close()
    return (
        rows
        + _first(browser, address)
        + _drags(browser, address)
        + _kept(browser, address, playback)
        + _subjects(browser, address)
        + _phone(browser, address, playback)
        + _heap(browser, address)
    )


def _python_loop() -> float:
    begun, total = time.perf_counter(), 0
    for k in range(of(10_000_000, 1_000)):
        total += k
    return time.perf_counter() - begun


def _first(browser, address: str) -> list:
    found = []
    for _ in range(of(VISITS, 1)):
        page = Page(browser, address, "", drawn=False, reduced_motion="no-preference")
        page.wait("() => window.strikewave?.page.player.playing && strikewave.page.painted > 1")
        found.append(page.evaluate(FIRST))
        page.context.close()
    paint, moving = (statistics.median(visit[key] for visit in found) for key in ("paint", "moving"))
    ours = [(path, size) for path, size in found[0]["sent"] if not path.startswith(("/static/", "/libraries/"))]
    return [
        row("first paint", 1e-3 * paint, "s", "<= 0.3"),
        row("moving by itself, from the request", 1e-3 * moving, "s", "<= 1.5"),
        row("requests of a first visit, ours", len(ours), "", "<= 25"),
        row("sent on a first visit, ours", 1e-6 * sum(size for _, size in ours), "MB", "<= 1"),
        row("requests of a first visit, all", len(found[0]["sent"]), ""),
        row("sent on a first visit, all", 1e-6 * sum(size for _, size in found[0]["sent"]), "MB"),
    ]


def _drags(browser, address: str) -> list:
    rows = []
    for scene, target in some(DRAGGED).items():
        page = Page(browser, address, f"?scene={scene}")
        page.tab.wait_for_timeout(of(500, 50))
        page.evaluate(DRAG, of(1.0, 0.2))  # the first does not count
        rows.append(row(f"answers while dragging, {scene}", page.evaluate(DRAG, of(4.0, 0.5)), "/s", f">= {target}"))
        page.context.close()
    return rows


def _kept(browser, address: str, playback: str) -> list:
    rows = []
    for scene in some(("fixed-rod", "hammer-on-cantilever")):
        page = Page(browser, address, f"?scene={scene}&method=modal")
        for modes in some(KEPT):
            page.evaluate(KEEP, modes)
        rows.append(
            row(
                f"playback with {len(KEPT)} kept runs, {scene}",
                page.evaluate(playback, of(PLAYED, 0.5)),
                "frames/s",
                ">= 55",
            )
        )
        page.context.close()
    return rows


def _heap(browser, address: str) -> list:
    page = Page(browser, address)
    session = page.context.new_cdp_session(page.tab)

    def used() -> float:
        session.send("HeapProfiler.collectGarbage")
        return session.send("Runtime.getHeapUsage")["usedSize"]

    warm = of(100, 10)
    page.evaluate(MOVE, [0, warm])
    before = used()
    page.evaluate(MOVE, [warm, of(MOVES, 20)])
    after = used()
    page.context.close()
    return [row(f"heap of JavaScript after {MOVES} moves, beside before", after / before, "", "<= 1.1")]


def _subjects(browser, address: str) -> list:
    """Scenes of the thesis, each opened for the second time, with the dock that shows what it is about."""
    page = Page(browser, address, "")
    times = [[page.evaluate(OPEN, name) for name in some(SUBJECTS)] for _ in range(2)][1]
    page.context.close()
    found = (("median", statistics.median(times)), ("slowest", max(times)))
    return [
        row(f"a scene of the thesis opens on its subject, warm, {name}", ms / 1e3, "s", "<= 1") for name, ms in found
    ]


def _phone(browser, address: str, playback: str) -> list:
    page = Page(browser, address, "", PHONE, has_touch=True)
    page.quiet()
    page.context.new_cdp_session(page.tab).send("Emulation.setCPUThrottlingRate", {"rate": SLOWER})
    rate = page.evaluate(playback, of(PLAYED, 0.5))
    page.context.close()
    return [row(f"playback on a phone, {SLOWER} times as slow", rate, "frames/s", ">= 50")]
