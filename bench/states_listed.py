"""The states of the page that bench.states takes pictures of: what is opened, and what is done then."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from app.views.registry import PANELS
from tests.app.conftest import LABORATORY, Page
from tests.app.fitting import LARGE

BUSY = 90_000  # ms that an analysis may take
HALF_AND_END = (0.5, 1.0)
EVERYWHERE = ".tab-panel"  # what is scrolled through


@dataclass(frozen=True, kw_only=True)
class State:
    """A state by its link and by what is done then."""

    name: str
    query: str = LABORATORY
    act: Callable[[Page], object] | None = None
    at: tuple[float, ...] = ()  # shares of the impact at which there is a picture
    scrolled: str = ""  # what is scrolled through, a picture for every window of it
    moving: bool = False  # whether words drawn at other instants are looked at, too
    fails: bool = False  # whether errors belong to it
    rest: int = 500  # ms before the picture
    script: str = ""  # of the window, before anything
    options: dict[str, Any] = field(default_factory=dict)  # of the window


SCENES = (  # of every family, half way and at the end of play
    "fixed-rod", "free-rod", "semi-infinite-rod", "rod-with-end-mass", "rod-with-gap", "stepped-rod", "split-hopkinson",
    "two-unequal-rods", "hammer-on-cantilever", "xylophone-bar", "figure-8.15", "figure-6.2", "figure-5.24",
    "two-balls", "newtons-cradle", "spring-mass", "bouncing-ball", "drop-test", "rigid-pendulum", "figure-9.1",
    "figure-9.11", "figure-10.8", "figure-10.12", "compound-pendulum", "double-pendulum", "rotating-bar", "four-bar",
    "four-bar-moves", "slider-crank", "bouncing-on-piston", "trip-hammer", "bent-rods", "table-6.7",
    "brick-off-centre", "brick-on-floor", "note-rod", "note-rod-friction", "painleve-rod", "painleve-sliding",
    "percussion-rod", "spinning-ball",
)  # fmt: skip
ANALYSES = {  # by the name in an address: a scene that has much to show in it
    "energy": "fixed-rod", "needs": "fixed-rod&law=hertz", "tolerance": "fixed-rod", "tradeoff": "free-rod",
    "trust": "hammer-on-cantilever", "convergence": "hammer-on-cantilever", "methods": "fixed-rod",
    "stability": "fixed-rod", "bounces": "bouncing-ball", "joints": "bent-rods", "stretch": "figure-5.24",
    "mode_change": "table-6.10", "ratios": "fixed-rod", "modes": "hammer-on-cantilever", "code": "fixed-rod",
    "spectrum": "hammer-on-cantilever",
}  # fmt: skip
FOR_BEAMS = ("energy", "needs", "tolerance", "stability", "bounces")
REFUSED = "?scene=fixed-rod&mass_ratio=2 kg&speed=99999&modes=few&t=never&kept=Z&colour=red"
CUT_OFF = """() => {
  window.fetch = () => Promise.reject(new Error('offline'));
  dispatchEvent(new Event('offline'));
}"""
KEEP = "() => strikewave.page.compare.keep()"
CHOOSE = "([name, value]) => strikewave.page.choose(name, value)"
NO_CLIPBOARD = "() => { navigator.clipboard.writeText = () => Promise.reject(new Error('no')); }"


def settled(page: Page, name: str) -> None:
    """Wait for the answer of an analysis."""
    page.tab.wait_for_timeout(300)
    page.wait("name => strikewave.page.analyses[name].root.getAttribute('aria-busy') !== 'true'", name, timeout=BUSY)


def turned(page: Page, tab: str) -> None:
    if page.tab.get_by_role("tab", name=tab, exact=True).count():
        page.turn_to(tab)


def choose(page: Page, name: str, value: object) -> None:
    page.answered(lambda: page.evaluate(CHOOSE, [name, value]))


def keep(page: Page, count: int, beside: bool = False, name: str = "mass_ratio", low: float = 0.4) -> None:
    """Solutions that differ in one choice."""
    for k in range(count):
        choose(page, name, low * (k + 1))
        page.tab.wait_for_timeout(600)  # no draft is kept
        page.evaluate(KEEP)
    choose(page, name, low * (count + 1.5))
    if beside:
        page.evaluate("() => strikewave.page.compare.standBeside(strikewave.page.compare.runs[0])")


def kept_story(page: Page, tab: str, count: int = 4) -> None:
    keep(page, count)
    turned(page, tab)


def upload(page: Page, text: str) -> None:
    page.analysis("Compare with measured data")
    file = {"name": "a-rather-long-name-of-a-file-that-somebody-has-measured.csv", "mimeType": "text/csv"}
    page.tab.locator(".record-panel input[type=file]").set_input_files({**file, "buffer": text.encode()})
    page.tab.wait_for_timeout(800)
    settled(page, "record")


def example(page: Page, moved: bool = False) -> None:
    page.analysis("Compare with measured data")
    page.tab.locator(".record-panel .record-form button").nth(1).click()
    page.wait("() => strikewave.page.analyses.record.answer", timeout=BUSY)
    if moved:
        page.evaluate(
            "() => { const { record } = strikewave.page.analyses; record.shift.value = 300; record.moved(); }"
        )
        page.tab.locator(".record-panel .panel-head button").first.click()


def wide(page: Page, name: str) -> None:
    """An analysis that has taken the room of the dock, too."""
    settled(page, name)
    page.tab.locator(".analysis:not(.behind):visible .panel-head button").first.click()


def body(page: Page, key: str = "", value: str = "") -> None:
    """All bodies opened; and a value typed into one of them."""
    turned(page, "Controls")
    page.evaluate(
        "() => strikewave.page.root.querySelectorAll('details.body').forEach((each) => { each.open = true; })"
    )
    if key:
        box = page.tab.locator(".body").nth(1).get_by_label(key)
        box.fill(value)
        box.press("Enter")
    else:
        page.tab.locator(".bodies:not(.stage)").evaluate("element => element.scrollIntoView({ block: 'start' })")


def chart_menu(page: Page, item: str = "") -> None:
    turned(page, "Charts")
    tools = page.tab.locator(".time-views .chart:visible .tools").first
    tools.locator(".more").click()
    if item:
        tools.get_by_role("button", name=item).click()


def hovered_chart(page: Page) -> None:
    turned(page, "Charts")
    page.tab.locator(".time-views .chart:visible canvas").first.hover()


def hovered(page: Page, selector: str) -> None:
    page.tab.locator(selector).filter(visible=True).first.hover()


def opened_gallery(page: Page, words: str = "") -> None:
    page.evaluate("words => strikewave.page.scenes.open(words)", words)


def zoomed(page: Page) -> None:
    turned(page, "Charts")
    page.evaluate("() => { const { axis, linkUnit: u = 1 } = strikewave.page.view; axis.show([0.31 * u, 0.347 * u]); }")


def folded(page: Page, *names: str) -> None:
    page.evaluate(
        """names => { const { layout } = strikewave.page;
        layout.sizes.folded = Object.fromEntries(names.map((name) => [name, true])); layout.place(); }""",
        list(names),
    )


def narrow(page: Page) -> None:
    page.evaluate(
        """() => {
          const { layout } = strikewave.page;
          Object.assign(layout.sizes, { left: 180, right: 180 });
          layout.place();
        }"""
    )


def undone(page: Page) -> None:
    choose(page, "mass_ratio", 2.5)
    page.tab.wait_for_timeout(900)
    choose(page, "law", "hertz")
    page.tab.wait_for_timeout(900)
    page.answered(page.tab.get_by_role("button", name="Undo").click)


def run_stability(page: Page) -> None:
    page.tab.wait_for_timeout(500)
    page.wait("() => strikewave.page.analyses.stability.known", timeout=2 * BUSY)


ANALYSED = [
    State(
        name=f"analysis-{key}",
        query=f"?scene={ANALYSES[key]}&panel={key}",
        act=run_stability if key == "stability" else partial(settled, name=key),
        scrolled=".analysis:not(.behind)",
        rest=1500,
    )
    for key, *_ in PANELS
    if key != "record"
] + [
    State(
        name=f"analysis-{key}-of-beam",
        query=f"?scene=hammer-on-cantilever&panel={key}",
        act=run_stability if key == "stability" else None,
        scrolled=".analysis:not(.behind)",
        rest=2500,
    )
    for key in FOR_BEAMS
]
BESIDE_IT = [
    State(name="record-empty", act=lambda page: page.analysis("Compare with measured data")),
    State(name="record-example", act=example, scrolled=".record-panel", rest=1200),
    State(name="record-moved-and-wide", act=partial(example, moved=True), scrolled=".record-panel", rest=1200),
    State(name="record-bad", act=partial(upload, text="time,force\n1,two\nthree\n"), fails=True),
    State(name="record-not-numbers", act=partial(upload, text="\x00\x01\x02" * 400), fails=True),
    State(name="opening", query=""),
    State(name="opening-beam", query="?scene=hammer-on-cantilever&layout=opening"),
    State(name="plan-wide-beside", query="?panel=tolerance", act=partial(wide, name="tolerance"), rest=1500),
    State(name="energy-wide", query="?panel=energy", act=partial(wide, name="energy"), rest=1500),
    State(name="two-analyses", query="?panel=energy,tolerance", rest=2000),
]
COMPARED = [
    *(State(name=f"kept-{count}", act=partial(keep, count=count)) for count in (1, 2, 3, 4)),
    State(name="kept-4-story", act=partial(kept_story, tab="Story"), scrolled=EVERYWHERE),
    State(name="kept-4-numbers", act=partial(kept_story, tab="Numbers"), scrolled=EVERYWHERE),
    State(name="kept-4-charts", act=partial(kept_story, tab="Charts"), at=(0.6,), scrolled=EVERYWHERE),
    State(name="kept-4-of-beam", query="?scene=hammer-on-cantilever", act=partial(kept_story, tab="Charts")),
    State(name="beside-a-rod", act=partial(keep, count=2, beside=True), at=(0.4,)),
    State(name="beside-a-chain", query="?scene=split-hopkinson", at=(0.4,),
          act=partial(keep, count=1, beside=True, name="speed", low=2.0)),
    State(name="beside-a-beam", query="?scene=hammer-on-cantilever", at=(0.5,),
          act=partial(keep, count=1, beside=True, name="speed", low=0.4)),
    State(name="beside-a-mechanism", query="?scene=four-bar", at=(0.5,),
          act=partial(keep, count=1, beside=True, name="speed", low=0.4)),
    State(name="beside-in-space", query="?scene=brick-off-centre", at=(0.9,),
          act=partial(keep, count=1, beside=True, name="speed", low=0.8)),
    State(name="compare-menu", act=lambda page: page.tab.locator(".more-pins").click()),
    State(name="compare-menu-kept", act=lambda page: (keep(page, 2), page.tab.locator(".more-pins").click())),
    State(name="locked", act=lambda page: (keep(page, 1), page.evaluate("() => strikewave.page.compare.lock(true)"))),
]  # fmt: skip
TABS = [
    State(name=f"tab-{tab.lower()}-{scene}", query=f"?scene={scene}", act=partial(turned, tab=tab), at=(0.5,),
          scrolled=EVERYWHERE)
    for scene in ("fixed-rod", "hammer-on-cantilever", "split-hopkinson", "brick-off-centre", "four-bar")
    for tab in ("Story", "Numbers", "Charts", "Analysis")
]  # fmt: skip
SAID = [
    State(name="refused-link", query=REFUSED),
    State(name="refused-method", query="?scene=hammer-on-cantilever&method=waves&modes=900"),
    State(name="refused-here", query="?scene=double-pendulum&panel=stability,convergence", rest=2500),
    State(name="refused-map", query="?scene=brick-off-centre&panel=tolerance", rest=1500),
    State(name="solved-by-another", query="?scene=split-hopkinson&method=rigid", at=(0.5,)),
    State(name="connection-lost", act=lambda page: page.evaluate(CUT_OFF), fails=True),
    State(name="connection-lost-kept", act=lambda page: (keep(page, 3), page.evaluate(CUT_OFF)), fails=True),
    State(name="link-not-copied", query="?scene=figure-8.10&kept=A,modes:5;B,modes:9",
          act=lambda page: (page.evaluate(NO_CLIPBOARD), page.tab.locator(".copy-link").click())),
    State(name="solving", act=lambda page: page.evaluate("() => strikewave.page.waiter.soon('record', 'Solving …')"),
          rest=2500),
    State(name="tip-of-symbol", act=partial(hovered, selector=".controls [data-term]")),
    State(name="tip-in-story", act=lambda page: (turned(page, "Story"), hovered(page, ".tab-panel [data-term]"))),
    State(name="scene-focused", act=lambda page: page.tab.locator(".topbar .scene").focus()),
    State(name="gallery", act=opened_gallery),
    State(name="gallery-found", act=partial(opened_gallery, words="beam")),
    State(name="help", act=lambda page: page.evaluate("() => strikewave.page.help.open()")),
    State(name="skip-link", act=lambda page: page.tab.keyboard.press("Tab")),
]  # fmt: skip
CHARTS = [
    State(name="chart-menu", act=chart_menu),
    State(name="chart-numbers", act=partial(chart_menu, item="Show the numbers"), scrolled=EVERYWHERE),
    State(name="chart-hovered", act=hovered_chart),
    State(name="zoomed", act=zoomed, at=(0.33,)),
    State(name="zoomed-beam", query="?scene=hammer-on-cantilever", act=zoomed),
    State(name="undone", act=undone),
]
BODIES = [
    State(name="bodies", act=body, scrolled=".body-list"),
    State(name="bodies-wrong", act=partial(body, key="Length", value="3 µm")),
    State(name="bodies-refused", act=partial(body, key="Length", value="9000 m")),
    State(name="bodies-of-chain", query="?scene=split-hopkinson", act=body, scrolled=".body-list"),
    State(name="bodies-of-mechanism", query="?scene=four-bar", act=body, scrolled=".body-list"),
    State(name="bodies-in-space", query="?scene=brick-off-centre", act=body, scrolled=".body-list"),
    State(name="long-title", query="?scene=figure-7.1"),
    State(name="changed-title", query="?scene=figure-7.1&speed=2"),
]
WINDOWS = [
    State(name="folded", act=lambda page: folded(page, "left", "right")),
    State(name="folded-right", query="?scene=hammer-on-cantilever", act=lambda page: folded(page, "right")),
    State(name="docks-narrow", act=narrow),
]
SCHEMES = [
    State(name=f"{scheme}-{scene or 'first'}", query=query, at=(0.5,), act=partial(turned, tab=tab), rest=1500,
          options=options)
    for scheme, options in [
        ("dark", {"color_scheme": "dark"}),
        ("forced", {"forced_colors": "active"}),
        ("forced-dark", {"forced_colors": "active", "color_scheme": "dark"}),
        ("contrast", {"contrast": "more"}),
    ]
    for scene, query, tab in [
        ("first", "", "Charts"),
        ("beam", "?scene=hammer-on-cantilever", "Story"),
        ("space", "?scene=brick-off-centre", "Numbers"),
        ("plan", "?panel=needs", "Analysis"),
        ("tradeoff", "?scene=free-rod&panel=tradeoff", "Analysis"),
    ]
] + [
    State(name=f"large-{scene}", query=query, script=LARGE, at=(0.5,), rest=1500)
    for scene, query in [
        ("first", ""),
        ("beam", "?scene=hammer-on-cantilever"),
        ("space", "?scene=brick-off-centre"),
        ("plan", "?panel=needs"),
    ]
]  # fmt: skip
PLAYED = [State(name=f"scene-{name}", query=f"?scene={name}", at=HALF_AND_END, moving=True) for name in SCENES]
STATES = [*ANALYSED, *BESIDE_IT, *COMPARED, *TABS, *SAID, *CHARTS, *BODIES, *WINDOWS, *SCHEMES, *PLAYED]
