"""A link of a teacher: controls that are hidden, fixed or bounded."""

import re
from urllib.parse import parse_qs

import pytest
from playwright.sync_api import expect

from .hands import arrow, type_into
from .test_access_page import findings
from .test_page import settled

LINK = "?scene=fixed-rod&hide=method,modes&fix=restitution&bound=mass_ratio:0.1:2"


def field(page, name: str):
    return page.tab.locator(f"#choice-{name}")


def chosen(page, name: str):
    return page.header("chosen")[name]


def test_controls_are_hidden_fixed_and_bounded(open_page):
    page = open_page(LINK)
    settled(page)
    expect(field(page, "method")).not_to_be_visible()
    expect(field(page, "modes")).not_to_be_visible()
    expect(field(page, "restitution")).to_be_visible()
    expect(field(page, "restitution")).to_be_disabled()
    before = chosen(page, "restitution")
    page.evaluate("() => strikewave.page.choose('restitution', 0.123)")
    page.answered(lambda: arrow(field(page, "mass_ratio"), 1000))
    assert (chosen(page, "mass_ratio"), chosen(page, "restitution")) == (2, before)
    page.answered(lambda: arrow(field(page, "mass_ratio"), 0))
    assert chosen(page, "mass_ratio") == 0.1
    number = page.tab.get_by_role("textbox", name="Mass ratio, exact value")
    type_into(number, "3", "Enter")
    wrong = page.tab.locator(".field-mass_ratio .wrong")
    expect(wrong).to_contain_text("from 0.1 to 2")
    assert chosen(page, "mass_ratio") == 0.1
    assert findings(page) == []
    page.wait(
        "() => decodeURIComponent(location.search).includes('hide=method,modes&fix=restitution&bound=mass_ratio:0.1:2')"
    )
    page.tab.reload()
    page.laid_out()
    settled(page)
    expect(field(page, "method")).not_to_be_visible()
    assert chosen(page, "mass_ratio") == 0.1


def test_a_value_beyond_its_bounds_is_brought_within(open_page):
    page = open_page("?scene=fixed-rod&mass_ratio=5&bound=mass_ratio:0.5:2")
    page.wait("() => strikewave.page.frame.chosen.mass_ratio === 2")
    page.show_scene("free-rod")
    assert 0.5 <= chosen(page, "mass_ratio") <= 2


def test_values_of_bodies_do_not_move_what_is_fixed(open_page):
    page = open_page("?scene=fixed-rod&fix=mass_ratio")
    settled(page)
    mass = page.tab.locator(".bodies").get_by_role("textbox").first
    expect(mass).to_be_visible()
    expect(mass).to_be_disabled()
    expect(page.tab.locator(".bodies").get_by_role("combobox").first).to_be_disabled()


def test_no_change_is_offered_that_a_link_does_not_allow(open_page):
    page = open_page("?layout=opening&scene=fixed-rod")
    settled(page)
    expect(page.tab.locator(".what-if")).to_have_text("What if it were four times as heavy? →")
    page = open_page("?layout=opening&scene=fixed-rod&bound=mass_ratio:0.9:1.1")
    settled(page)
    expect(page.tab.locator(".what-if")).not_to_have_text("What if it were four times as heavy? →")
    page = open_page("?layout=opening&scene=fixed-rod&fix=scene,mass_ratio,speed,law,method,modes,restitution")
    settled(page)
    expect(page.tab.locator(".what-if")).to_be_hidden()


@pytest.mark.parametrize(
    "query, sentence",
    [
        ("hide=methods", "hide: got methods; allowed in this scene: scene, "),
        ("fix=bodies", "fix: got bodies; allowed in this scene: scene, "),
        (
            "bound=mass_ratio:2:1",
            "bound: got mass_ratio:2:1; allowed: mass_ratio:LOW:HIGH, with two numbers from 0.001 to ",
        ),
    ],
)
def test_a_bad_name_or_bound_is_refused_in_a_sentence(open_page, query, sentence):
    page = open_page(f"?scene=fixed-rod&{query}")
    expect(page.tab.locator(".toast")).to_contain_text(sentence)


def test_a_scene_that_is_held_stays_and_the_gallery_shut_and_bodies_move_all_the_same(open_page):
    page = open_page("?scene=fixed-rod&fix=scene,law")
    settled(page)
    expect(page.tab.locator(".bodies").get_by_role("textbox").first).to_be_enabled()
    expect(page.tab.get_by_role("button", name="Lessons")).to_have_count(0)
    expect(page.tab.locator("button.scene")).to_be_disabled()
    page.tab.keyboard.press("g")
    page.frames_pass(5)
    expect(page.tab.get_by_role("dialog", name="Scenes")).to_have_count(0)
    page.evaluate("() => strikewave.page.choose('scene', 'free-rod')")
    page.frames_pass(5)
    assert chosen(page, "scene") == "fixed-rod"


ALL = "scene,mass_ratio,speed,law,method,modes,restitution,bodies"


def test_with_all_hidden_the_left_dock_is_gone(open_page):
    page = open_page(f"?scene=fixed-rod&hide={ALL}")
    settled(page)
    expect(page.tab.locator(".dock.left")).to_be_hidden()
    expect(page.tab.locator(".folder.left")).to_be_hidden()
    assert page.tab.locator(".centre").bounding_box()["x"] < 20
    page.tab.get_by_role("button", name="← Picture", exact=True).click()
    expect(page.tab.get_by_role("button", name="Charts", exact=True)).to_be_visible()
    expect(page.tab.get_by_role("button", name="Controls", exact=True)).to_have_count(0)


def the_form(page, save="Save", link="Link for a class"):
    """That which makes a link for a class, opened from the menu by keys."""
    page.tab.get_by_role("button", name=save, exact=True).press("Enter")
    page.tab.get_by_role("button", name=link, exact=True).press("Enter")
    form = page.tab.get_by_role("dialog", name=link)
    expect(form).to_be_visible()
    return form


def test_a_form_makes_a_link_that_hides_fixes_and_bounds(open_page):
    page = open_page("?scene=fixed-rod&mass_ratio=0.8&layout=laboratory", own=True)
    loaded = "() => performance.getEntriesByType('resource').filter(({ name }) => name.includes('sharing/')).length"
    assert page.evaluate(loaded) == 0
    form = the_form(page)
    link, seen = form.get_by_label("The link"), form.get_by_role("status")
    expect(seen).to_have_text("A class sees what you see; all is free.")
    for group, way in (("Compare with", "Hidden"), ("Modes", "Hidden"), ("Restitution (rigid)", "Fixed")):
        form.get_by_role("group", name=group).get_by_role("button", name=way).press("Enter")
    low = form.get_by_role("textbox", name="Mass ratio, lowest value")
    high = form.get_by_role("textbox", name="Mass ratio, highest value")
    assert (low.input_value(), high.input_value()) == ("0.001", "1000")
    type_into(low, "0.1")
    type_into(high, "2")
    expect(seen).to_have_text(
        "A class sees what you see; hidden: Modes, Compare with; fixed: Restitution (rigid); "
        "within bounds: Mass ratio (0.1 to 2); all else is free, but the values of the bodies stay."
    )
    good = link.input_value()
    assert "mass_ratio=0.8&hide=method,modes&fix=restitution&bound=mass_ratio:0.1:2" in good
    type_into(low, "3")
    expect(form.locator(".wrong:not([hidden])")).to_have_text(
        "Mass ratio: got 3, 2; allowed: two numbers from 0.001 to 1000, the lower one first."
    )
    expect(seen).to_have_text("No link yet: the ends of Mass ratio cannot be.")
    expect(form.get_by_role("button", name="Copy")).to_be_disabled()
    assert link.input_value() == "" and high.get_attribute("aria-invalid") == "true"
    way = form.get_by_role("group", name="Mass ratio").get_by_role("button", name="Hidden")
    way.press("Enter")  # with which no end is wrong
    assert "hide=method,modes,mass_ratio&fix=restitution" in link.input_value()
    form.get_by_role("group", name="Mass ratio").get_by_role("button", name="Free").press("Enter")
    assert link.input_value() == ""
    type_into(low, "0,1")
    expect(form.locator(".wrong:not([hidden])")).to_have_count(0)
    assert link.input_value() == good
    page.evaluate("() => { navigator.clipboard.writeText = async (link) => { window.copied = link; }; }")
    form.get_by_role("button", name="Copy").press("Enter")
    expect(form.get_by_role("button", name="Copied")).to_be_visible()
    page.tab.keyboard.press("k")  # does nothing to what is behind
    page.tab.keyboard.press("Escape")
    expect(form).to_be_hidden()
    expect(page.tab.get_by_role("button", name="Save", exact=True)).to_be_focused()
    assert page.evaluate("() => strikewave.page.compare.runs.length") == 0
    other = open_page("?" + page.evaluate("() => window.copied").split("?")[1])
    settled(other)
    expect(field(other, "method")).not_to_be_visible()
    expect(field(other, "modes")).not_to_be_visible()
    expect(field(other, "restitution")).to_be_disabled()
    other.answered(lambda: arrow(field(other, "mass_ratio"), 1000))
    assert chosen(other, "mass_ratio") == 2
    form = the_form(other)  # begins with what the link says
    expect(form.get_by_role("textbox", name="Mass ratio, highest value")).to_have_value("2")
    expect(form.get_by_role("group", name="Modes").get_by_role("button", pressed=True)).to_have_text("Hidden")


@pytest.mark.parametrize(
    "query, size, words",
    [
        ("?scene=hammer-on-cantilever", (1280, 720), ("Save", "Link for a class")),
        ("?scene=spinning-ball&language=es", (390, 844), ("Exportar", "Enlace para una clase")),
    ],
)
def test_the_form_of_links_breaks_no_rule_of_access_and_fits(open_page, query, size, words):
    page = open_page(query, size=size)
    form = the_form(page, *words)
    low = form.get_by_role("textbox").first
    type_into(low, "x")
    expect(form.locator(".wrong:not([hidden])")).to_have_count(1)
    assert findings(page) == []
    page.tab.emulate_media(color_scheme="dark")
    assert findings(page) == []
    page.fits(size[0])
    assert form.evaluate("form => [form, ...form.children].every((each) => each.scrollWidth <= each.clientWidth)")
    expect(form.locator("textarea")).to_be_in_viewport()


def test_where_a_link_hides_what_is_asked_the_source_does_not_tell_it(open_page):
    page = open_page("?scene=drop-test&layout=opening&hide=law,scene")
    source = page.tab.locator(".closer .source, .source")
    expect(source).to_have_count(1)
    expect(source).to_have_text("")


def test_a_link_for_a_class_keeps_the_layout_and_no_instant_and_hides_the_ways_to_look_closer(open_page):
    page = open_page("?scene=drop-test&layout=docks&tab=charts", own=True)
    settled(page)
    said = parse_qs(the_form(page).get_by_label("The link").input_value().split("?")[1])
    assert said["layout"] == ["docks"] and not {"t", "playing", "tab"} & said.keys()
    page.tab.keyboard.press("Escape")  # shuts the form
    page.tab.keyboard.press("Escape")  # and the dock
    page.wait("() => location.search === '?scene=drop-test'")
    expect(page.tab.locator(".source")).to_have_text(re.compile("^Source: "))
    form = the_form(page)
    ways = form.get_by_role("group", name="Ways to look closer, and the source")
    expect(ways.get_by_role("button")).to_have_text(["Free", "Hidden"])
    ways.get_by_role("button", name="Hidden").press("Enter")
    expect(form.get_by_role("status")).to_have_text(
        "A class sees what you see; hidden: Ways to look closer, and the source; all else is free."
    )
    link = form.get_by_label("The link").input_value()
    page.tab.goto(link)
    page.wait("() => Boolean(window.strikewave)")
    settled(page)
    for name in ("Analysis", "All charts and controls", "Charts"):
        expect(page.tab.get_by_role("button", name=name, exact=True)).to_have_count(0)
    expect(page.tab.get_by_text("Source:")).to_be_hidden()
    assert "hide=closer" in page.evaluate("() => decodeURIComponent(location.search)")
