"""The page for who sees, hears or points differently: axe-core's rules in many states, the keyboard, and schemes."""

import base64
from pathlib import Path

import pytest
from playwright.sync_api import expect

from ..fitting import WRITTEN
from .test_workspace_page import whole

AXE = Path(__file__).parents[3] / "node_modules/axe-core/axe.min.js"
FINDINGS = """async () => {
  const rules = { 'target-size': { enabled: true }, 'label-content-name-mismatch': { enabled: true } };
  const given = { resultTypes: ['violations'], rules, elementRef: false, preload: false }; // all styles are there
  const { violations } = await axe.run(document, given);
  return violations.filter(({ impact }) => ['serious', 'critical'].includes(impact)).flatMap(({ id, nodes }) =>
    nodes.map(({ target, failureSummary }) => `${id}: ${target.flat(9).join(' ')}: ${failureSummary}`));
}"""
# Analyses as they are while an answer is awaited, whatever comes meanwhile.
AWAITED = """() => {
  for (const root of strikewave.page.root.querySelectorAll('.analysis')) {
    root.setAttribute('aria-busy', 'true');
    Object.defineProperty(root, 'ariaBusy', { value: 'true', configurable: true, writable: true });
  }
}"""
BEFORE = ("Which model is enough?", "Bounces")  # in the middle: still there when the next one has come beside it
ANALYSES = [
    "Which model is enough?",
    "Choose method by error",
    "Cost vs. accuracy",
    "Stability",
    "Energy over time",
    "Bounces",
    "Compare with measured data",
]


def findings(page) -> list[str]:
    if not page.evaluate("() => Boolean(window.axe)"):
        page.evaluate(AXE.read_text(encoding="utf-8") + ";0")
    return page.evaluate(FINDINGS)


@pytest.mark.parametrize(
    "query", ["", "?scene=hammer-on-cantilever", "?scene=split-hopkinson", "?scene=brick-off-centre"]
)
def test_no_rule_of_access_is_broken(show, query):
    page = show(query)
    found = {"desk": findings(page)}
    page.tab.emulate_media(forced_colors="active")
    found["forced colours"] = findings(page)
    page.tab.emulate_media(forced_colors="none", color_scheme="dark")
    for size in [(820, 1180), (390, 844)]:
        page.tab.set_viewport_size({"width": size[0], "height": size[1]})
        page.laid_out()
        found[f"dark, {size}"] = findings(page)
    page.tab.emulate_media(color_scheme="light")
    page.resize(1440, 900)  # for the next
    assert {state: broken for state, broken in found.items() if broken} == {}


def test_no_rule_of_access_is_broken_by_what_is_opened(open_page):
    page = open_page()
    page.tab.keyboard.press("k")
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('speed', 2)"))
    expect(page.tab.locator(".chip-run .show")).to_be_visible()
    page.turn_to("Numbers")
    found = {"Numbers": findings(page)}
    for name in ANALYSES:
        page.analysis(name)
        page.frames_pass(18)  # some work for long: the form is there
        page.evaluate(AWAITED)
        if name not in BEFORE:
            expect(page.tab.locator(".analysis:visible")).to_have_count(2)
            found[name] = findings(page)
    assert {name: broken for name, broken in found.items() if broken} == {}


def test_the_help_says_all_keys_and_gives_the_focus_back(open_page):
    page = open_page()
    help_ = page.tab.get_by_role("dialog", name="Help")
    focused = "() => strikewave.page.root.getRootNode().activeElement?.className ?? ''"
    page.tab.get_by_role("button", name="Help").focus()
    page.tab.keyboard.press("?")
    expect(help_).to_be_visible()
    assert findings(page) == []
    assert {"Space", ", .", "[ ]", "Ctrl+Z", "K"} <= set(help_.locator("kbd").all_inner_texts())
    expect(help_.get_by_role("link")).to_have_count(0)  # nobody has said where the documentation is
    before = page.evaluate("() => strikewave.page.player.t")
    page.tab.keyboard.press(".")  # of the clock, which is below
    assert page.evaluate("() => strikewave.page.player.t") == before
    for _ in range(3):
        page.tab.keyboard.press("Tab")
        assert page.evaluate(focused) in ("sign", "help-dialog", "")  # nothing of what lies below
    page.tab.keyboard.press("Escape")
    expect(help_).to_be_hidden()
    assert page.evaluate(focused) == "open-help"
    page.resize(390, 844)
    page.tab.keyboard.press("F1")
    expect(help_).to_be_visible()
    assert page.evaluate(WRITTEN) == []
    help_.get_by_role("button", name="Close help").click()
    expect(help_).to_be_hidden()


def test_the_help_on_a_phone_is_of_fingers(open_page):
    page = open_page(size=(390, 844), has_touch=True, is_mobile=True)
    page.tab.get_by_role("button", name="Help").click()
    help_ = page.tab.get_by_role("dialog", name="Help")
    expect(help_).to_contain_text("Two fingers on a chart")
    expect(help_.locator("kbd")).to_have_count(0)


def test_the_help_links_to_the_documentation_where_its_address_is_set(open_page):
    page = open_page(
        own=True,
        script="""document.addEventListener('readystatechange', () => {
             const session = document.getElementById('session');
             if (!session || document.readyState !== 'interactive') return; // before any script reads it
             const said = { ...JSON.parse(session.textContent), documentation: 'https://a.org/b' };
             session.textContent = JSON.stringify(said);
           });""",
    )
    page.tab.get_by_role("button", name="Help").click()
    links = page.tab.get_by_role("dialog", name="Help").get_by_role("link")
    assert links.first.get_attribute("href") == "https://a.org/b/page.html"
    named = [link.get_attribute("href").rpartition("/")[2].replace(".html", ".md") for link in links.all()]
    assert all((Path(__file__).parents[3] / "docs" / name).exists() for name in named)


def test_the_dark_scheme_turns_the_whole_page_over(open_page):
    page = open_page(color_scheme="dark")
    corner = page.tab.screenshot(clip={"x": 700, "y": 2, "width": 4, "height": 4})
    dark = page.evaluate(
        """async (data) => {
          const image = Object.assign(new Image(), { src: `data:image/png;base64,${data}` });
          await image.decode();
          const c = new OffscreenCanvas(4, 4).getContext('2d');
          c.drawImage(image, 0, 0);
          return c.getImageData(1, 1, 1, 1).data[0];
        }""",
        base64.b64encode(corner).decode(),
    )
    assert dark < 40


def test_the_keyboard_goes_to_the_picture_at_once(open_page):
    page = open_page()
    page.tab.keyboard.press("Tab")
    skip = page.tab.get_by_role("button", name="Skip to the picture")
    assert skip.evaluate("element => element.matches(':focus-visible') && element.getBoundingClientRect().width > 50")
    page.tab.keyboard.press("Enter")
    page.tab.keyboard.press("Tab")
    assert page.evaluate(
        "() => strikewave.page.layout.centre.contains(strikewave.page.root.getRootNode().activeElement)"
    )


def test_letters_are_as_large_as_the_browser_is_told(open_page):
    page = open_page()
    sizes = page.evaluate(
        """() => {
          document.documentElement.style.fontSize = '24px';
          const of = (selector) => parseFloat(getComputedStyle(strikewave.page.root.querySelector(selector)).fontSize);
          return ['.field label', '.chart h2', '.events li', '.tabs button'].map(of);
        }"""
    )
    assert min(sizes) >= 1.5 * 13 and whole(page)
