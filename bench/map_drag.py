"""What the main thread of the browser does while a slider is dragged with the map open, and a phone's as slow a one."""

import json
from typing import Any

import numpy as np
from playwright.sync_api import CDPSession

from tests.app.conftest import Page

from .size import of
from .timing import row

CASES = {  # query, and the map: the mass ratio is dragged, which is no axis, so that all of it is another one
    "rigid": ("?layout=opening&scene=fixed-rod", "peak_force,speed,target.length"),
    "Hertz": ("?layout=opening&scene=fixed-rod&law=hertz", "peak_force,speed,hertz_stiffness"),
}
SLOWER = 1, 4  # times; the latter as a phone
MOVES = 240  # of the hand
TO = 0.2, 0.8  # share of the slider, back and forth
WHATIF = "strikewave.page.opening.door.whatif"
OPEN = f"""async (said) => {{
  await strikewave.page.opening.door.open(said);
  const {{ plane }} = {WHATIF}, draw = plane.draw.bind(plane);
  globalThis.pictures = [];
  plane.draw = (...all) => (globalThis.pictures.push(performance.now()), draw(...all));
  globalThis.frames = [];
  const each = (now) => (globalThis.frames.push(now), requestAnimationFrame(each));
  requestAnimationFrame(each);
}}"""
QUIET = f"() => {WHATIF}.view && {WHATIF}.jobs.idle && !{WHATIF}.due"
CLEAR = "() => { globalThis.pictures.length = globalThis.frames.length = 0; }"
SEEN = "() => [globalThis.pictures.length, globalThis.frames.at(-1) - globalThis.frames[0], globalThis.frames.length]"
CATEGORIES = ["devtools.timeline", "disabled-by-default-devtools.timeline"]
TASK = "RunTask"
FRAME = "FireAnimationFrame"
APART = 5e3  # us between frames, at least


def measure(browser, address: str) -> list:
    rows = []
    for name, (query, said) in CASES.items():
        for slower in SLOWER:
            page = Page(browser, address, query)
            page.evaluate(OPEN, said)
            page.wait(QUIET)
            session = page.context.new_cdp_session(page.tab)
            session.send("Emulation.setCPUThrottlingRate", {"rate": slower})
            rows += _rows(f"{name}, processor {slower} x slower", *_dragged(page, session))
            page.context.close()
    return rows


def _dragged(page: Page, session: CDPSession) -> tuple[float, float, np.ndarray]:
    """Pictures of the map and frames in a second, and (2, frames) what `busy` says of the main thread."""
    events: list[dict[str, Any]] = []
    ended: list[bool] = []
    session.on("Tracing.dataCollected", lambda data: events.extend(data["value"]))
    session.on("Tracing.tracingComplete", lambda _: ended.append(True))
    slider = page.tab.get_by_role("slider", name="Mass ratio")
    box = slider.bounding_box()
    assert box
    aim = [(box["x"] + share * box["width"], box["y"] + box["height"] / 2) for share in TO]
    mouse = page.tab.mouse
    mouse.move(*aim[0])
    mouse.down()
    page.evaluate(CLEAR)
    session.send("Tracing.start", {"traceConfig": {"includedCategories": CATEGORIES}})
    for k in range(of(MOVES, 10)):
        share = abs((k / 60) % 2 - 1)
        mouse.move(aim[0][0] + share * (aim[1][0] - aim[0][0]), aim[0][1])
        page.tab.wait_for_timeout(8)
    pictures, spent, frames = page.tab.evaluate(SEEN)
    mouse.up()
    session.send("Tracing.end")
    while not ended:
        page.tab.wait_for_timeout(20)
    return 1e3 * pictures / spent, 1e3 * frames / spent, busy(events)


def busy(events: list[dict[str, Any]]) -> np.ndarray:
    """Of the main thread in each frame [ms]: (time, its processor time), from a trace.

    The former is longer where other threads and processes have the processors.
    """
    fired = [event for event in events if event["name"] == FRAME]
    if not fired:
        raise ValueError(json.dumps(sorted({event["name"] for event in events})))
    thread = fired[0]["pid"], fired[0]["tid"]
    times = np.unique([event["ts"] for event in fired])
    edges = times[np.diff(times, prepend=-np.inf) > APART]  # the callbacks of a frame come together
    tasks = [e for e in events if e["name"] == TASK and (e["pid"], e["tid"]) == thread and "dur" in e]
    at = np.searchsorted(edges, [event["ts"] + event["dur"] for event in tasks], side="right")
    spent = [np.bincount(at, [event.get(key, 0) for event in tasks], edges.size + 1) for key in ("dur", "tdur")]
    return 1e-3 * np.array(spent)[:, 1:-1]


def _rows(name: str, pictures: float, frames: float, spent: np.ndarray) -> list:
    times, processor = spent
    target = ">= 20" if "rigid" in name else ""
    return [
        row(f"pictures of the map while a slider is dragged, {name}", pictures, "/s", target),
        row(f"frames meanwhile, {name}", frames, "/s"),
        row(f"main thread busy in a frame, median, {name}", float(np.median(times)), "ms"),
        row(f"main thread busy in a frame, p95, {name}", float(np.quantile(times, 0.95)), "ms", "<= 16"),
        row(f"processor time of the main thread in a frame, p95, {name}", float(np.quantile(processor, 0.95)), "ms"),
    ]
