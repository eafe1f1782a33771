"""A scene of one's own is in its link, whole: opened by it, and reloaded; after its server has begun anew, too, as in
`test_connection_page`."""

import pytest

from solvers.scenes.library import SCENES

from ...patience import SECONDS
from ..strangers import named

CHOSEN = "(name) => window.strikewave?.page.frame?.chosen.scene === name"
COMPILED = 1e3 * SECONDS  # ms: of kinds that no page opens with, kernels may have to be compiled first


def text_of(scene: str) -> str:
    return (SCENES / f"{scene}.toml").read_text("utf-8")


def test_a_link_holds_all_of_it_and_what_is_changed_through_a_reload(open_page):
    """All of usual size were cut at 320 letters, and another scene was shown."""
    name = named(text_of("four-bar"))
    assert len(name) > 320
    page = open_page(f"?scene={name}&mass_ratio=0.5")
    page.wait(CHOSEN, name)
    page.tab.get_by_role("slider", name="Mass ratio").first.press("ArrowRight")
    page.wait("() => strikewave.page.frame.chosen.mass_ratio > 0.5 && !location.search.includes('mass_ratio=0.5&')")
    page.tab.reload()
    page.wait(CHOSEN, name)
    assert page.header("chosen")["mass_ratio"] > 0.5


@pytest.mark.parametrize("scene", ["stepped-rod", "hammer-on-cantilever", "brick-off-centre", "table-6.10"])
def test_scenes_of_all_kinds_are_opened_by_their_links(open_page, scene):
    name = named(text_of(scene))
    page = open_page(f"?scene={name}", drawn=False)
    page.wait(CHOSEN, name, timeout=COMPILED)
    page.tab.reload()
    page.wait(CHOSEN, name)
    assert page.evaluate("() => strikewave.page.frame.chosen.scene") == name
