"""A picture of every state of the page at five sizes, and what does not fit in it: `python -m bench.states DIR`.

Not part of the bench: it measures nothing, and the pictures are for somebody to look at.
"""

import argparse
import re
from contextlib import nullcontext
from pathlib import Path

from playwright.sync_api import Error, sync_playwright

from tests.app.conftest import QUIET, Page, Windows, chromium
from tests.app.fitting import DRAWN, INSTANTS, SCROLLED, UNREACHED, WRITTEN

from .serving import served_page
from .states_listed import STATES, State

SIZES = [(1440, 900), (1920, 1080), (1280, 720), (820, 1180), (390, 844)]
STEPS = 4  # pictures of what is scrolled through, at most

# One window further down in what scrolls; whether it did.
FURTHER = """(selector) => {
  const { page } = strikewave;
  let box = [...page.root.querySelectorAll(selector)].find((each) => each.checkVisibility());
  while (box && (box.scrollHeight <= box.clientHeight + 8 || getComputedStyle(box).overflowY === 'visible'))
    box = box.parentElement;
  if (!box || box.scrollTop + box.clientHeight >= box.scrollHeight - 8) return false;
  box.scrollTop += 0.9 * box.clientHeight;
  return true;
}"""


def shoot(state: State, page: Page, folder: Path, name: str) -> list[str]:
    """Save the pictures of a state; what does not fit."""
    found: dict[str, None] = {}
    if state.act:
        state.act(page)
    page.tab.wait_for_timeout(state.rest)
    for share in state.at or [None]:
        if share is not None:
            page.evaluate("share => strikewave.page.player.go(share * strikewave.page.player.duration)", share)
            page.tab.wait_for_timeout(250)
        suffix = f"-at-{share:g}" if len(state.at) > 1 else ""
        page.tab.screenshot(path=folder / f"{name}{suffix}.png")
        found |= dict.fromkeys(page.evaluate(WRITTEN) + page.evaluate(SCROLLED))
    for step in range(2, STEPS + 1):
        if not state.scrolled or not page.evaluate(FURTHER, state.scrolled):
            break
        page.tab.wait_for_timeout(200)
        page.tab.screenshot(path=folder / f"{name}-{step}.png")
        found |= dict.fromkeys(page.evaluate(WRITTEN))
    if state.moving:
        found |= dict.fromkeys(page.evaluate(DRAWN, INSTANTS))
    found |= dict.fromkeys(page.evaluate(UNREACHED))
    return [*found, *(f"error: {error}" for error in page.errors if not state.fails)]


def crawl(address: str, folder: Path, states: list[State], sizes: list[tuple[int, int]]) -> int:
    """Every state at every size; how many findings."""
    count = 0
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium(), args=QUIET)
        windows = Windows(browser)
        for state in states:
            for size in sizes:
                name = f"{state.name}-{size[0]}"
                page = Page(browser, address, state.query, size, script=state.script, windows=windows, **state.options)
                try:
                    found = shoot(state, page, folder, name)
                except Error as error:
                    found = [f"not reached: {error}"]
                    page.tab.screenshot(path=folder / f"{name}.png")
                page.close()
                count += len(found)
                print(name, *(f"    {each}" for each in found), sep="\n", flush=True)
        browser.close()
    return count


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, metavar="DIR", help="where the pictures go")
    parser.add_argument("--only", default="", metavar="NAME", help="states whose name matches this expression")
    parser.add_argument("--sizes", default="", help="widths of windows, as 390,1440; default: all five")
    parser.add_argument("--address", help="of a page that is served already, as localhost:5006")
    asked = parser.parse_args()
    widths = [int(width) for width in asked.sizes.split(",") if width]
    sizes = [size for size in SIZES if not widths or size[0] in widths]
    states = [state for state in STATES if re.search(asked.only, state.name)]
    asked.folder.mkdir(parents=True, exist_ok=True)
    with nullcontext((asked.address, 0)) if asked.address else served_page() as (address, _):
        count = crawl(address, asked.folder, states, sizes)
    print(f"{len(states)} states at {len(sizes)} sizes, {count} findings; pictures in {asked.folder}")


if __name__ == "__main__":
    main()
