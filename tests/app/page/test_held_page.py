"""A link of a teacher: controls that are hidden, fixed or bounded."""

import pytest
from playwright.sync_api import expect

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
    page.answered(lambda: field(page, "mass_ratio").fill("1000"))
    assert (chosen(page, "mass_ratio"), chosen(page, "restitution")) == (2, before)
    page.answered(lambda: field(page, "mass_ratio").fill("0"))
    assert chosen(page, "mass_ratio") == 0.1
    number = page.tab.get_by_role("textbox", name="Mass ratio, exact value")
    number.fill("3")
    number.press("Enter")
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
    page = open_page("?scene=fixed-rod&fix=law")
    settled(page)
    expect(page.tab.locator(".bodies").get_by_role("textbox").first).to_be_enabled()


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
        ("hide=methods", "hide: got methods; allowed: scene, "),
        ("fix=bodies", "fix: got bodies; allowed: scene, "),
        (
            "bound=mass_ratio:2:1",
            "bound: got mass_ratio:2:1; allowed: mass_ratio:LOW:HIGH, with two numbers from 0.001 to ",
        ),
    ],
)
def test_a_bad_name_or_bound_is_refused_in_a_sentence(open_page, query, sentence):
    page = open_page(f"?scene=fixed-rod&{query}")
    expect(page.tab.locator(".toast")).to_contain_text(sentence)


def test_a_scene_that_is_held_stays_and_the_gallery_shut(open_page):
    page = open_page("?scene=fixed-rod&fix=scene")
    settled(page)
    expect(page.tab.locator("button.scene")).to_be_disabled()
    page.tab.keyboard.press("g")
    page.frames_pass(5)
    expect(page.tab.get_by_role("dialog", name="Scenes")).to_have_count(0)
    page.evaluate("() => strikewave.page.choose('scene', 'free-rod')")
    page.frames_pass(5)
    assert chosen(page, "scene") == "fixed-rod"
