"""Lessons in the folder without a server: those that need none, from the disk, and a sentence in place of others."""

import pytest

from app.command.main import main
from app.lessons.alone import runs_alone
from app.lessons.lesson import Set
from app.lessons.shipped import lesson_names, shipped_lesson

from .conftest import SECONDS, choose

MOST = 1_090_000  # bytes of all files
LESSON = "bounce-twice"
AT = "(step) => { const { lesson } = strikewave.page.opening.teaching; return lesson?.at === step && !lesson.coming; }"
READY = "() => window.strikewave && !strikewave.page.opening.teaching.lesson?.coming && !strikewave.page.asked"
ALONE = [name for name in lesson_names() if runs_alone(shipped_lesson(name))]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("static") / "impact"
    assert main(["export-static", str(place), "--lessons"]) == 0
    return place


def said(tab) -> str:
    return tab.locator(".toast").inner_text().replace("\u00a0", " ")


@pytest.mark.browser  # needs Node, which packs the page
@pytest.mark.slow
def test_it_is_small_and_says_how_many_it_has(folder, capsys):
    assert sum(path.stat().st_size for path in folder.rglob("*") if path.is_file()) <= MOST
    assert main(["export-static", str(folder), "--lessons"]) == 0
    assert f", {len(ALONE)} lessons, " in capsys.readouterr().out


def test_what_runs_alone_has_scenes_that_kernels_answer():
    assert {LESSON, "mass-on-a-rod", "split-hopkinson", "what-an-impact-is"} <= set(ALONE)
    assert "a-ball-with-spin" not in ALONE  # friction
    assert "when-is-a-body-rigid" not in ALONE  # a rod of another length


@pytest.mark.parametrize("name", ALONE)
def test_every_step_is_answered_from_the_disk(opened, folder, name):
    tab = opened(f"?lesson={name}", script=f"() => window.strikewave && ({AT})(0)")
    for number, step in enumerate(shipped_lesson(name).steps):
        tab.evaluate("(step) => strikewave.page.opening.teaching.lesson.enter(step)", number)
        tab.wait_for_function(AT, arg=number, timeout=SECONDS)
        tab.wait_for_function(READY, timeout=SECONDS)
        chosen = tab.evaluate("() => strikewave.page.frame.chosen")
        (question,) = [part for part in step.parts if isinstance(part, Set)] or [None]
        wanted = {"scene": step.scene} | step.choices | ({question.slider: question.start} if question else {})
        assert {key: chosen[key] for key in wanted} == pytest.approx(wanted)
        for end in question.range if question else ():
            choose(tab, question.slider, end)
            assert tab.evaluate("name => strikewave.page.frame.chosen[name]", question.slider) == end
        assert tab.evaluate("() => strikewave.page.model.refused") == ""
    assert [url for url in tab.asked if not url.startswith((f"{folder.as_uri()}/", "data:", "blob:"))] == []
    assert tab.errors == []


def test_a_lesson_is_played_and_left(opened):
    tab = opened(f"?lesson={LESSON}", script=f"() => window.strikewave && ({AT})(0)")
    tab.get_by_label("A second contact").check()
    tab.get_by_role("button", name="Show what happens").click()
    tab.get_by_role("button", name="Next →").click()
    tab.wait_for_function(AT, arg=1, timeout=SECONDS)
    tab.reload()
    tab.wait_for_function(f"() => window.strikewave && ({AT})(1)", timeout=SECONDS)
    tab.get_by_role("button", name="Leave the lesson").click()
    tab.wait_for_function("() => window.strikewave && !strikewave.page.opening.teaching.on", timeout=SECONDS)
    assert tab.errors == []


def test_the_last_step_gives_a_code_and_leads_to_no_page_of_a_server(opened):
    tab = opened(f"?lesson={LESSON}&step=6", script=f"() => window.strikewave && ({AT})(5)")
    tab.get_by_role("button", name="Code for my teacher").click()
    assert len(tab.locator(".class-code").inner_text()) > 15
    assert tab.locator("a[href*='class=']").count() == 0


def test_the_gallery_has_these_lessons_and_says_how_many_need_a_server(opened):
    tab = opened()
    tab.keyboard.press("g")
    group = tab.locator("dialog.gallery section", has=tab.get_by_role("heading", name="Lessons", exact=True))
    assert group.get_by_role("link").count() == len(ALONE)
    others = len(lesson_names()) - len(ALONE)
    assert f"{others} more lessons need a server." in group.inner_text()
    group.get_by_role("link", name="What comes after the bounce?").click()
    tab.wait_for_function(f"() => window.strikewave && ({AT})(0)", timeout=SECONDS)
    assert tab.errors == []


@pytest.mark.parametrize("name", ["a-ball-with-spin", "none-of-this-name", "hasOwnProperty", "../x"])
def test_a_lesson_that_is_not_there_is_said_in_one_sentence(opened, name):
    tab = opened(f"?lesson={name}")
    tab.locator(".toast").wait_for()
    assert said(tab) == f"This page works without a server and does not have the lesson {name}."
    assert tab.evaluate("() => strikewave.page.root.style.visibility") == ""
    assert tab.errors == []


def test_codes_of_a_class_are_said_to_be_read_on_the_page_of_a_server(opened):
    tab = opened(f"?class={LESSON}")
    tab.locator(".toast").wait_for()
    assert said(tab) == "This page works without a server: codes of a class are read on the page of one."
    assert tab.errors == []


def test_a_folder_without_lessons_says_so(opened, tmp_path):
    assert main(["export-static", str(tmp_path / "plain"), "--laboratory", "https://example.org/"]) == 0
    tab = opened(f"?lesson={LESSON}", base=(tmp_path / "plain").as_uri())
    tab.locator(".toast").wait_for()
    assert said(tab).endswith(f"does not have the lesson {LESSON}; the laboratory has it.")
    tab.keyboard.press("g")
    assert tab.get_by_role("heading", name="Lessons", exact=True).count() == 0
    assert tab.errors == []


def test_a_course_page_has_it_in_a_frame_that_follows_its_height(browser, folder, served):
    address = f"{folder.name}/index.html?embed&amp;lesson={LESSON}"
    script = "addEventListener('message', ({ data }) => { document.querySelector('iframe').height = data.height; })"
    frame = f'<iframe sandbox="allow-scripts" src="{address}" width="700" height="300"></iframe>'
    (folder.parent / "course.html").write_text(f"{frame}<script>{script}</script>")
    tab = browser.new_page()
    tab.goto(served.replace(folder.name, "course.html"))
    inside = tab.frames[1]
    inside.wait_for_function(f"() => window.strikewave && ({AT})(0)", timeout=SECONDS)
    tab.wait_for_function("() => document.querySelector('iframe').height > 300", timeout=SECONDS)
    inside.wait_for_function("() => strikewave.page.root.scrollHeight <= innerHeight", timeout=SECONDS)
    inside.get_by_role("button", name="Skip →").click()
    inside.wait_for_function(AT, arg=1, timeout=SECONDS)
    tab.close()
