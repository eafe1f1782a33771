"""A scene of one's own is in its link, whole: opened by it, reloaded, and after the server has begun anew."""

import pytest

from solvers.scenes.library import SCENES

from ...patience import SECONDS
from ..conftest import Page
from ..strangers import named

CHOSEN = "(name) => window.strikewave?.page.frame?.chosen.scene === name"
ANEW = f"(name) => !window.same && ({CHOSEN})(name)"
COMPILED = 1e3 * SECONDS  # ms: of kinds that no page opens with, kernels may have to be compiled first


def text_of(scene: str) -> str:
    return (SCENES / f"{scene}.toml").read_text("utf-8")


def test_a_link_holds_all_of_it_through_reload_and_restart(browser, own_server):
    """All of usual size were cut at 320 letters, and another scene was shown."""
    name = named(text_of("four-bar"))
    assert len(name) > 320
    page = Page(browser, own_server.address, f"?scene={name}&mass_ratio=0.5")
    try:
        page.wait(CHOSEN, name)
        page.tab.reload()
        page.wait(CHOSEN, name)
        page.tab.get_by_role("slider", name="Mass ratio").first.press("ArrowRight")
        page.wait("() => strikewave.page.frame.chosen.mass_ratio > 0.5")
        page.evaluate("() => { window.same = true; }")
        own_server.end()
        own_server.start()
        page.wait(ANEW, name, timeout=COMPILED)
        assert page.header("chosen")["mass_ratio"] > 0.5
    finally:
        page.context.close()


@pytest.mark.parametrize("scene", ["stepped-rod", "hammer-on-cantilever", "brick-off-centre", "table-6.10"])
def test_scenes_of_all_kinds_are_opened_by_their_links(open_page, scene):
    name = named(text_of(scene))
    page = open_page(f"?scene={name}", drawn=False)
    page.wait(CHOSEN, name, timeout=COMPILED)
    page.tab.reload()
    page.wait(CHOSEN, name)
    assert page.evaluate("() => strikewave.page.frame.chosen.scene") == name
