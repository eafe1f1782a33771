"""Answers while a slider moves: coarser where the chosen ones take long, and those chosen at rest."""

import time

import pytest
from playwright.sync_api import expect

from app.choices.choices import Choices
from app.choices.request import DRAFT, LEAST, Request
from app.choices.scene_of import choices_of
from app.messages.encoding import read_header
from app.messages.solve import solve_frame
from app.page.drafts import MOVING_SECONDS, QUICK_SECONDS, SHARES, draft_share
from app.page.lab import Lab
from app.page.questions import Questions
from app.serving import guard

SLOW = "figure-8.10"  # 15 elements, 180 000 steps


@pytest.fixture
def slow(monkeypatch):
    """However quick this machine is, an answer takes four times as long as feels immediate."""
    monkeypatch.setattr("app.page.drafts.solve_seconds", lambda message: 4.0 * QUICK_SECONDS)


def chosen(scene, **changed):
    return Choices(**({"scene": scene} | choices_of(scene) | changed)).chosen()


def test_what_is_quick_is_solved_as_chosen():
    assert draft_share(0.0) == draft_share(QUICK_SECONDS) == 1.0


@pytest.mark.parametrize("seconds, share", [(0.02, 0.5), (0.05, 0.25), (0.1, 0.125), (9.0, SHARES[-1])])
def test_the_slower_the_coarser(seconds, share):
    assert draft_share(seconds) == share


def resolution(header):
    """Modes or elements that a message was solved by."""
    main = header.get("main", header)
    return main.get("elements") or main["modes"]


@pytest.mark.parametrize("scene", [SLOW, "figure-5.6", "figure-8.9"])
def test_a_draft_is_coarser_says_so_and_repeats_the_choices(scene):
    before, after = (read_header(solve_frame(chosen(scene) | more)) for more in ({}, {DRAFT: 0.125}))
    assert resolution(after) == LEAST < 0.3 * resolution(before)
    assert (before["draft"], after["draft"]) == (False, True)
    assert after["chosen"] == before["chosen"] == chosen(scene)


def test_a_draft_keeps_so_many_modes_and_no_more_than_are_chosen():
    few, many = (Request.of(chosen("fixed-rod", modes=modes) | {DRAFT: 0.125}) for modes in (2, 160))
    assert (few.modes, many.modes) == (2, 20)
    assert Request.of(chosen("fixed-rod", modes=9) | {DRAFT: 0.125}).modes == LEAST


def moved(*names: str) -> list[bool]:
    """Of changes in quick succession, whether each asks for a draft."""
    lab = Lab(**chosen(SLOW))
    lab.frame = solve_frame(chosen(SLOW))
    lab._resting = True  # what waits for rest needs a server
    return [DRAFT in lab.wish(name) for name in names]


@pytest.mark.usefixtures("slow")
def test_one_slider_that_changes_again_and_again_is_answered_by_drafts():
    assert moved(*4 * ["speed"]) == [False, False, True, True]
    assert moved("speed", "mass_ratio", "speed", "mass_ratio") == 4 * [False]
    assert moved("speed", "speed", "mass_ratio", "speed", "speed") == 5 * [False]


@pytest.mark.usefixtures("slow")
def test_a_mechanism_that_moves_on_is_answered_by_drafts_from_the_first_change_of_a_number():
    lab = Lab(**chosen("four-bar-moves", motion_seconds=0.06))
    lab.frame, lab._resting = solve_frame(lab.chosen()), True
    assert [DRAFT in lab.wish(name) for name in ("method", "speed", "speed", "motion_links")] == [
        *(False, True, True, False)
    ]


@pytest.mark.usefixtures("slow")
@pytest.mark.parametrize("answered", [True, False])
def test_a_movement_goes_on_while_the_page_waits_for_a_slow_answer(answered):
    lab = Lab(**chosen(SLOW))
    lab.frame, lab._resting = solve_frame(chosen(SLOW)), True
    for _ in range(3):
        wish = lab.wish("speed")
        lab._moved_at -= 2 * MOVING_SECONDS
        lab.answered_at = time.monotonic() - (0 if answered else 2 * MOVING_SECONDS)
    assert (DRAFT in wish) == answered


@pytest.mark.usefixtures("slow")
def test_a_draft_that_is_still_slow_is_followed_by_a_coarser_one():
    lab = Lab(**chosen(SLOW))
    lab.frame, lab._resting = solve_frame(chosen(SLOW) | {DRAFT: 0.5}), True  # 90 000 steps
    lab._share = 0.5
    lab._slider, lab._moved_at, lab._in_a_row = "speed", time.monotonic(), 3
    assert lab.wish("speed")[DRAFT] < 0.5


def test_the_socket_takes_nothing_more_for_it():
    assert {*Choices.CHOSEN, *Questions.ASKED} == guard.SETTABLE


def test_a_drag_is_answered_coarsely_and_refined_at_rest(show):
    page = show(f"?scene={SLOW}")
    page.evaluate(
        """() => { window.drafts = [];
          strikewave.page.model.on('frame', () => drafts.push(strikewave.page.frame.draft)); }"""
    )
    tag = page.tab.get_by_text("coarse while you drag")
    expect(tag).to_be_hidden()
    box = page.tab.get_by_role("slider", name="Impact speed", exact=True).bounding_box()
    middle = box["y"] + box["height"] / 2
    page.tab.mouse.move(box["x"] + 0.5 * box["width"], middle)
    page.tab.mouse.down()
    for step in range(600):  # there and back, until one is answered
        page.tab.mouse.move(box["x"] + (0.5 + 0.3 * abs((step / 60 + 1.0) % 2.0 - 1.0)) * box["width"], middle)
        page.frames_pass(3)
        if page.evaluate("() => drafts.includes(true)"):
            break
    assert page.evaluate("() => drafts.includes(true)")
    page.tab.mouse.up()
    page.wait("() => strikewave.page.frame.chosen.speed === strikewave.page.model.speed")
    page.wait("() => !strikewave.page.frame.draft")
    expect(tag).to_be_hidden()
    assert page.header("main")["elements"] == 15


def test_a_key_is_answered_as_chosen(show):
    page = show(f"?scene={SLOW}")
    page.answered(lambda: page.tab.get_by_role("slider", name="Impact speed", exact=True).press("ArrowRight"))
    assert page.header("draft") is False


def test_what_is_kept_is_never_a_draft(show):
    page = show(f"?scene={SLOW}")
    page.evaluate("() => { const { page } = strikewave; page.frame = { ...page.frame, draft: true }; }")
    page.tab.get_by_role("button", name="Keep", exact=True).click()
    assert page.evaluate("() => strikewave.page.compare.runs.length") == 0
    page.answered(lambda: page.evaluate("() => strikewave.page.choose('speed', 3)"))
    page.wait("() => strikewave.page.compare.runs.length === 1")
    assert page.evaluate("() => strikewave.page.compare.runs[0].frame.draft") is False
