"""Pendulums and rods that turn on the page, in a real browser."""

import pytest
from playwright.sync_api import expect

from .test_compare_page import set_and_wait
from .test_page import drag, settled

DRAWN = "() => strikewave.page.axial.stage.canvas.toDataURL()"
AT = "t => strikewave.page.player.seek(t)"


def test_a_pendulum_bends_by_as_many_modes_as_are_chosen(open_page):
    page = open_page("?scene=figure-10.12")
    expect(page.tab.locator("p.symbols:visible")).to_contain_text("0.1968 kg is felt at the contact as 0.1136 kg")
    expect(page.tab.locator("ol.events")).to_contain_text("The pendulum touches the stop")
    height, factor = page.evaluate(
        "() => [strikewave.page.view.stage.root.clientHeight, strikewave.page.view.stage.factor]"
    )
    assert height > 280 and factor >= 1  # it has room to hang in, and how much larger its movement is drawn is said
    page.evaluate(AT, 0.1)
    bent = page.evaluate(DRAWN)
    page.answered(lambda: drag(page, "Modes", 0.7))
    settled(page)
    page.evaluate(AT, 0.1)
    assert page.evaluate(DRAWN) != bent
    page.turn_to("Numbers")
    expect(page.tab.get_by_text("moment at the pivot, N m")).to_be_visible()


def test_picture_caption_and_charts_of_bodies_without_waves_tell_one_solution(open_page):
    """The contact that gives way, also where rigid bodies are compared: these are dashed in the picture."""
    page = open_page("?scene=rigid-pendulum&law=hertz&method=rigid")
    assert (page.header("exact")["name"], page.header("other")["name"]) == ("compliant", "rigid")
    page.evaluate(AT, 0.5)
    shown = "() => [strikewave.page.view.field.mass(0.5), strikewave.page.view.stage.touching(0.5)]"
    moved, touching = page.evaluate(shown)
    assert moved > 0.2 and touching  # it presses on; a rigid impulse would have thrown it back by then
    expect(page.tab.locator(".caption")).to_have_text("The pendulum touches the mass.")
    assert page.evaluate("() => strikewave.page.view.force.at(0.5)") > 0
    legend = page.tab.locator(".chart:visible", has_text="Contact force").locator(".legend")
    expect(legend).to_contain_text("compliant contact")
    expect(legend).not_to_contain_text("rigid")  # whose impulse has no force


@pytest.mark.parametrize("scene, words", [("figure-5.24", "27000 rad/s are critical"), ("figure-5.22", "(5.56)")])
def test_a_rod_turns(open_page, scene, words):
    page = open_page(f"?scene={scene}")
    page.turn_to("Story")  # one of them is opened with an analysis
    expect(page.tab.locator("p.symbols:visible")).to_contain_text(words)
    page.evaluate(AT, 0.05)
    early = page.evaluate(DRAWN)
    page.evaluate(AT, 0.3)
    assert page.evaluate(DRAWN) != early


def test_what_is_felt_of_a_rod_on_its_end(open_page):
    """A quarter; nearer to the middle more, and no more is said where it no longer turns."""
    page = open_page("?scene=note-rod")
    said = page.tab.locator("p.symbols:visible")
    expect(said).to_contain_text("the target of 2 kg gives way as 0.5 kg would, 0.25 of it")
    ((_, name, value),) = [trial for trial in page.header("opens")["trials"] if trial[0] == "centre"]
    set_and_wait(page, **{name: value})
    settled(page)
    expect(said).not_to_contain_text("gives way")


def test_of_a_rod_without_changes_of_section_none_are_told(open_page):
    page = open_page("?scene=rod-with-end-mass")
    expect(page.tab.locator("ol.events")).to_contain_text("A wave sets out along the rod.")
    expect(page.tab.locator("ol.events")).not_to_contain_text("change of section")
