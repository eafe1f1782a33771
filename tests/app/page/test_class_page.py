"""Codes of a class: made at the end of a lesson, read on the page of a teacher, saved as a table."""

import pytest
from playwright.sync_api import expect

from .students import Student, put_in, read_by_teacher, reading, saved, tables
from .test_access_page import findings
from .test_lesson_page import button, ready

LESSON = "bounce-twice"
# Twenty students, each with other answers; the third of each four has left two questions out.
CLASS = """async (name) => {
  const page = document.querySelector('link[rel=modulepreload][href$="/page.js"]').href;
  const exported = await import(page.replace('page.js', 'lesson/lesson.js'));
  const shared = (name) => Object.entries(exported).find(([each]) => each.endsWith(`_${name}`))[1];
  const [codeOf, POINTS] = [shared('codeOf'), shared('POINTS')];
  const record = await (await fetch(`lessons/${name}`)).json();
  const numbers = [[116.4, 'µs'], [58.2, 'µs'], [0.1164, 'ms'], [17187, 's'], [300, 'µs']];
  return [...Array(20).keys()].map((k) => {
    const [value, unit] = numbers[k % 5];
    const tries = 1 + (k % 3);
    const line = Array.from({ length: POINTS }, (_, n) => Math.max(0, 36 - n + (n > 8 + (k % 3) ? 60 - 5 * n : 0)));
    const outcomes = ['yes', k % 2 ? 'yes' : 'late', 'early', k % 5 ? 'none' : 'yes', 'yes'];
    const left = k % 4 === 2;
    return codeOf(record, {
      next: { picked: k % 3 },
      force: left ? null : { outcomes, late: k % 7 === 0, line },
      once: left ? null : { places: [1.2 + 0.3 * k, k % 2 ? 0.45 : null] },
      back: { value, unit, tries, right: k % 5 !== 4 },
      story: { order: k % 2 ? [0, 1, 2, 3, 4, 5] : [0, 1, 3, 2, 4, 5], tries, right: true },
    }, 7 * k);
  });
}"""


def test_a_class_of_twenty_is_read_and_saved(open_page):
    page = open_page(f"?class={LESSON}", accept_downloads=True)
    reading(page)
    codes = page.evaluate(CLASS, LESSON)
    names = ["=1+1 ", "Müller, Ida\t", "+49 ", "Jane Doe, jane@uni.example, 1234567, ", *[""] * 16]
    put_in(page, [name + code for name, code in zip(names, codes, strict=True)])
    expect(page.tab.get_by_role("status").filter(has_text="read")).to_have_text("20 codes are read.")
    found = tables(page)
    assert [row[2] for row in found["20 codes have an answer"]] == ["7 (35 %)", "7 (35 %)", "6 (30 %)"]
    assert [row[0] for row in found["20 codes have an answer"]] == ["○not right", "✓right", "○not right"]
    numbers = [(row[0], row[1].split(":")[0], row[2]) for row in found["First tries of 20 codes, by size"]]
    assert numbers[:3] == [
        ("○not right", "58.19 µs", "4 (20 %)"),
        ("✓right", "116.4 µs", "8 (40 %)"),
        ("○not right", "300 µs", "4 (20 %)"),
    ]
    assert numbers[3][2] == "4 (20 %)" and numbers[3][1].startswith("This is velocity over length")
    order = found["In its place at the first try, of 20 codes"]
    assert [row[2] for row in order] == ["20 (100 %)"] * 2 + ["10 (50 %)"] * 2 + ["20 (100 %)"] * 2
    assert "place 4 instead: 10" in order[2][1]
    assert [row[2] for row in found["What is looked for: 2"]] == ["10 (67 %)", "0 (0 %)", "5 (33 %)", *["0 (0 %)"] * 2]
    assert [row[2] for row in found["Found, of 15 codes"]] == ["15 (100 %)", "10 (67 %)"]
    assert len(found["All codes"]) == 20
    assert [row[6] for row in found["All codes"][:5]] == [
        "116.4 µs, right at the first try ✓",
        "58.2 µs first, right after 2 tries ✓",
        "0.1164 ms first, right after 3 tries ✓",
        "17190 s, right at the first try ✓",
        "300 µs first, not right after 2 tries ○",
    ]
    head, *rows = saved(page)
    who, points = ["name", "email", "id", "code"], ["points", "points.first", "points.most"]
    assert head[:10] == [*who, *points, "next", "next.text", "next.right"]
    assert [row[0] for row in rows[:5]] == ["'=1+1", "Müller, Ida", "'+49", "Jane Doe", ""]
    assert [row[1:3] for row in rows[:5]] == [[""] * 2] * 3 + [["jane@uni.example", "1234567"], [""] * 2]
    assert [row[3] for row in rows] == codes
    by = {name: [row[k] for row in rows] for k, name in enumerate(head)}
    assert by["next.text"][1] == "A second contact" and by["next.right"][:3] == ["false", "true", "false"]
    assert [by["back.first"][k] for k in (0, 1, 3)] == ["true", "false", "true"]
    # 1: a wrong choice, 3 of 5 criteria, the slider, a number and an order at the first try; 2: left two out
    assert [by[name][0] for name in ("points", "points.first", "points.most")] == ["3.6", "3.6", "5"]
    assert [by[name][2] for name in ("points", "points.first")] == ["2", "0"]
    assert by["next"][:4] == ["1", "2", "3", "1"] and by["force.line"][2] == "" and by["force.2.jump"][0] == "late"
    assert [by["back"][0], by["back.unit"][0], by["back.tries"][2], by["back.right"][4]] == [
        "116.4",
        "µs",
        "3",
        "false",
    ]
    assert (
        by["story"][0] == "1 2 4 3 5 6" and by["once.2"][0] == "" and float(by["once.1"][0]) == pytest.approx(1.2, 0.05)
    )


def test_lines_that_cannot_be_read_are_named_with_their_reason(open_page):
    page = open_page("?class=what-an-impact-is")
    reading(page)
    other = page.evaluate(CLASS.replace("next:", "other:").replace("back:", "speed:"), "what-an-impact-is")[0]
    page.tab.goto(f"http://{page.address}/?class={LESSON}")
    page.laid_out()
    reading(page)
    first, second = page.evaluate(CLASS, LESSON)[:2]
    swapped = second[:5] + second[6] + second[5] + second[7:]
    put_in(page, [f"Ann {first}", "", other, f"Ben {swapped}", "Carla BCDF-GHJK", first, f"Dora {second[:-1]}E"])
    expect(page.tab.locator(".class-count")).to_have_text("1 code is read, 5 lines are not:")
    why = page.tab.locator(".class-unread li").all_inner_texts()
    assert ["another lesson" in why[0], "has changed places" in why[1], "no code: it" in why[2]] == [True] * 3
    assert why[3].endswith("the same code stands in line 1.") and why[4].endswith("no code has the sign E.")
    assert [line.split(",")[0] for line in why] == [f"Line {number}" for number in (3, 4, 5, 6, 7)]
    page.tab.reload()
    page.laid_out()
    reading(page)
    expect(page.tab.locator(".class-count")).to_have_text("1 code is read, 5 lines are not:")  # of this tab
    put_in(page, [f"Ann {first}, Ben {second[:30]}", f"{second[30:]} Carla"])
    expect(page.tab.locator(".class-count")).to_have_text("2 codes are read, 1 line is not:")
    expect(page.tab.locator(".class-unread")).to_contain_text("A name stands before its code")
    assert [row[1] for row in tables(page)["All codes"]] == ["Ann", "Ben"]
    put_in(page, ["x"] * 503)
    expect(page.tab.locator(".class-unread li").first).to_have_text(
        "500 lines can be read at once. The 3 lines after them are left out: read them by themselves."
    )


def test_a_class_that_plays_is_counted_by_its_teacher(open_page):
    """Four students: `python -m bench.lesson_class` plays twenty."""
    students = [Student(open_page("liveness", drawn=False), number) for number in range(4)]
    for student in students:
        student.begin(LESSON)
    for step in Student.STEPS:
        for student in students:
            step(student)
    first, *_ = students
    assert findings(first.page) == []
    first.page.tab.reload()
    ready(first.page)
    button(first.page, "Code for my teacher").click()
    assert first.page.tab.locator(".class-code").inner_text() == first.code  # else a class would count it twice
    page = first.page
    with page.tab.expect_navigation():
        page.tab.get_by_role("link", name="For teachers: read codes").click()
    page.laid_out()
    read_by_teacher(page, students)


@pytest.mark.parametrize("size", [(390, 844), (1366, 768)])
def test_the_button_that_copies_a_code_is_seen_when_the_code_is(open_page, size):
    page = open_page("liveness", drawn=False, size=size)
    page.tab.goto(f"http://{page.address}/?lesson={LESSON}&step=6")
    ready(page)
    page.tab.evaluate(  # the longest code: with a line
        """() => {
          const { progress } = strikewave.page.opening.teaching.lesson;
          const line = Array.from({ length: 260 }, (_, k) => k % 90);
          const outcomes = Array(5).fill({ outcome: 'yes' });
          progress.answers.force = { line, outcomes, done: true, late: false };
        }"""
    )
    code = button(page, "Code for my teacher")
    code.evaluate("(each) => each.scrollIntoView({ block: 'end' })")  # as far down as it can be pressed
    code.click()
    assert len(page.tab.locator(".class-code").inner_text()) > 50
    page.frames_pass(2)
    copies = page.tab.locator(".class-given button")
    assert copies.evaluate(
        """(each) => {
          const { bottom, left, top } = each.getBoundingClientRect();
          return [top + 1, bottom - 1].every((y) => each.getRootNode().elementFromPoint(left + 9, y) === each);
        }"""
    )


def test_the_page_of_a_teacher_breaks_no_rule_of_access_and_fits(open_page):
    page = open_page(f"?class={LESSON}")
    reading(page)
    put_in(page, [*page.evaluate(CLASS, LESSON), "no code"])
    for size in [(1440, 900), (390, 844)]:
        page.resize(*size)
        page.frames_pass(3)
        assert findings(page) == []
        page.fits(size[0])
        assert page.evaluate(
            "() => { const each = strikewave.page.root.querySelector('.classes'); "
            "return each.scrollWidth <= each.clientWidth; }"
        )
    page.tab.keyboard.press("k")  # does nothing to what is behind
    assert page.evaluate("() => strikewave.page.compare.runs.length") == 0


def test_what_happens_lies_over_the_lines_of_a_class(open_page):
    page = open_page(f"?class={LESSON}")
    reading(page)
    put_in(page, page.evaluate(CLASS, LESSON))
    page.frames_pass(3)
    dark = """() => {
      const canvas = strikewave.page.root.querySelector('.class-laid canvas');
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let k = 0; k < data.length; k += 4) count += data[k] === 28 && data[k + 1] === 39 && data[k + 2] === 51;
      return count;
    }"""
    assert page.evaluate(dark) > 300  # pixels in the colour of what happens


def test_a_class_of_a_lesson_that_is_not_there_is_refused_in_a_sentence(open_page):
    page = open_page("?class=none-such")
    expect(page.tab.locator(".toast")).to_contain_text("There is no lesson called none-such")
    page.errors.clear()  # the browser notes that there was nothing
