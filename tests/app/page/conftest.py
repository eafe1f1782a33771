"""Pages that tests of one file share, where loading one each would take longest."""

import pytest

from ..conftest import LABORATORY
from .moved import Shown

# Nothing kept or open, then these settings; once they are answered, all as it is at first, and this panel is opened.
ANEW = """([settings, panel]) => new Promise((done, failed) => {
  const { page } = strikewave, { analyses, compare, layout, player, toast } = page;
  compare.lock(false);
  compare.clear();
  for (const each of analyses.all) if (each.open) each.toggle();
  analyses.arrange();
  layout.tabs.select('story');
  page.goTo(settings, (frame) => {
    if (!frame) return failed(new Error('these settings are not reached'));
    const { axis, usual, what } = page.view, { view } = page;
    if (what !== usual) view.colour(usual);
    axis?.show(axis.opened);
    const { first, start = 0, time, unit } = view.clock(frame);
    player.playing = false;
    player.go(time === null ? first : time / unit - start);
    layout.tabs.panel('numbers').scrollTop = 0;
    toast.root.hidden = true;
    if (panel) analyses.open(analyses[panel]);
    return done();
  });
})"""
RESTS = """() => {
  const { asked, frame, telling, waiting } = strikewave.page;
  return !asked && !frame.draft && !telling && !Object.keys(waiting).length; // after many scenes, drafts come first
}"""


@pytest.fixture(scope="module")
def pages(browser, server, windows):
    """By layout."""
    shown = Shown(browser, server, windows)
    yield shown
    shown.close()


@pytest.fixture
def show(pages):
    """Show what a link leads to, in a page that has shown others; at the end as `open_page`."""
    yield pages.show
    for page in pages.by_layout.values():
        page.evaluate("() => strikewave.page.opening.door.close()")  # the map, before those who follow
    assert [error for page in pages.by_layout.values() for error in page.errors if "GL Driver" not in error] == []
    assert [address for page in pages.by_layout.values() for address in page.foreign] == []


@pytest.fixture
def anew(pages, show):
    """Show a scene in the laboratory as it opens, whatever other tests have done there, with a panel or without."""

    def shown(scene: str = "fixed-rod", size=(1440, 900), panel: str = "", **settings):
        page = show(pages.queries.get("laboratory", LABORATORY), size)
        pages.queries["laboratory"] = "anew"  # no link: the next one is followed
        page.tab.mouse.move(0, 0)
        page.evaluate(ANEW, [{"scene": scene} | settings, panel])
        page.wait(RESTS)
        return page

    return shown
