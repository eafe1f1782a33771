"""Students who play a lesson, each in a window of their own, and the teacher who reads their codes."""

import csv
import io
import re
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from .hands import paste_into, slide, type_into
from .test_lesson_page import LATE, LINE, ORDER, button, drawn, in_order, judged, onwards, ready, typed

READ = "() => window.strikewave && !strikewave.page.asked && strikewave.page.root.querySelector('.classes')"
SENT = """() => {
  const { asked, panels } = strikewave.page.model.shared;
  const names = Object.values(asked).map(([name]) => name);
  return [...strikewave.page.names, ...Object.values(panels), ...names];
}"""
OF_PANEL = {"dark_mode", "device_pixel_ratio", "language", "timezone", "timezone_offset", "webdriver", "webgl"}
OPTIONS = ("No more contact, as each goes its own way", "A second contact", "The mass slows down and comes back")
NUMBERS = (("116.4", "µs"), ("58.2", "µs"), ("0,1164", "ms"), ("8593", "s"), ("300", "µs"))
KEYS = "ArrowRight*9 ArrowDown*5 ArrowRight Enter ArrowUp*14 ArrowRight*7 ArrowDown*17 End"
END, POINTS, RISE = 2.6, 24, 120 / 30  # of lines in codes: their last time [T], how many, and steps between values [kN]
BY_ITSELF = "/kernels.wasm", "/liveness"  # requests of a page that nobody touches
CODE = re.compile(r"[B-DF-HJ-NP-TWXZ]{4}-[B-DF-HJ-NP-TWXZ]{4}")


# What a slider's question says of the places that are found, and of those that are not.
MORE = "() => strikewave.page.root.querySelector('.lesson-more')?.textContent ?? ''"


class Student:
    """One of *Why does it bounce twice?*: `number` decides how each question is answered; every fourth skips two."""

    def __init__(self, page, number: int):
        self.page, self.number = page, number
        self.code = ""
        self.given: dict[str, str] = {}  # by columns of the table that the teacher saves
        self.line: list[tuple[float, float]] = []
        self.signs: list[str] = []  # of criteria that the line meets
        self.places: list[float] = []
        self.order: list[int] = []
        self.requests: list[str] = []
        self.sent: list[str] = []

    def begin(self, lesson: str) -> None:
        tab = self.page.tab
        tab.on("request", lambda request: self.requests.append(f"{request.method} {request.url}"))
        tab.on("websocket", lambda socket: socket.on("framesent", lambda data: self.sent.append(str(data))))
        tab.goto(f"http://{self.page.address}/?lesson={lesson}")
        ready(self.page)

    def choose(self) -> None:
        option = self.number % 3
        self.page.tab.get_by_label(OPTIONS[option]).check()
        button(self.page, "Show what happens").click()
        onwards(self.page)
        self.given["next"] = str(option + 1)

    def draw(self) -> None:
        page, way = self.page, self.number % 4
        if way == 2:
            return onwards(page, "Skip →")
        if way == 3:
            page.tab.locator(".sketch-plot").focus()
            typed(page, KEYS)
        else:
            self.line = [LINE, LATE][way]
            drawn(page, self.line)
        button(page, "Show what happens").click()
        self.signs = judged(page)
        onwards(page)

    def move(self) -> None:
        """The slider, until there is one contact."""
        page = self.page
        if self.number % 4 == 2:
            return onwards(page, "Skip →")
        for place in (730, 80)[: 1 + self.number % 2]:
            said = page.evaluate(MORE)
            page.answered(lambda place=place: slide(page.tab.locator("#choice-mass_ratio"), place))
            page.wait(f"(said) => {{ const now = ({MORE})(); return now && now !== said; }}", said)  # it is found
            self.places.append(page.header("chosen")["mass_ratio"])
        onwards(page)

    def type(self) -> None:
        """A number, with its unit behind it or chosen; who was wrong and is odd tries again."""
        page, (value, unit) = self.page, NUMBERS[self.number % len(NUMBERS)]
        field = page.tab.get_by_label("Your number")
        right = value.endswith("1164") or value == "116.4"
        if self.number % 2:
            page.tab.get_by_label("Unit").select_option(unit)
        type_into(field, value if self.number % 2 else f"{value} {unit}")
        button(page, "Check").click()
        again = not right and self.number % 2 == 1
        if again:
            type_into(field, "116.4 µs", "Enter")
        met = right or again
        said = {"": value.replace(",", "."), ".unit": unit, ".tries": 1 + again, ".right": str(met).lower()}
        self.given |= {f"back{key}": str(each) for key, each in said.items()}
        onwards(page, "Next →" if met else "Skip →")

    def sort(self) -> None:
        page, tries = self.page, 1 + self.number % 2
        if tries == 1:
            in_order(page)
        self.order = [1 + item for item in page.evaluate(ORDER)]
        button(page, "Check").click()
        if tries == 2:
            in_order(page)
            button(page, "Check").click()
        self.given |= {"story": " ".join(map(str, self.order)), "story.tries": str(tries), "story.right": "true"}
        onwards(page)

    def hand_in(self) -> None:
        self.page.quiet()  # of what was chosen before, an answer may still come
        requests, sent = len(self.requests), len(self.sent)
        button(self.page, "Code for my teacher").click()
        self.code = self.page.tab.locator(".class-code").inner_text()
        self.page.frames_pass(5)
        assert [each for each in self.requests[requests:] if not each.endswith(BY_ITSELF)] == self.sent[sent:] == []
        assert CODE.match(self.code) and all(each.startswith("GET ") for each in self.requests)
        changed = set(re.findall(r'"attr": ?"(\w+)"', " ".join(self.sent))) - OF_PANEL
        assert changed <= set(self.page.evaluate(SENT))  # choices of the scene, and nothing of an answer
        assert not self.places or "mass_ratio" in changed

    STEPS = (choose, draw, move, type, sort, hand_in)


def reading(page) -> None:
    page.wait(READ)
    page.frames_pass(2)


def put_in(page, lines: list[str]) -> None:
    paste_into(page.tab.get_by_role("textbox", name="One code a line"), "\n".join(lines))


def tables(page) -> dict[str, list[list[str]]]:
    """Rows of the tables by their captions: answers and their counts."""
    return dict(
        page.evaluate(
            """() => [...strikewave.page.root.querySelectorAll('.class-sums table')].map((table) => [
              table.caption.textContent,
              [...table.tBodies[0].rows].map((row) =>
                [...row.cells].map((cell) => cell.textContent.replaceAll('\u00a0', ' '))),
            ])"""
        )
    )


def saved(page) -> list[list[str]]:
    with page.tab.expect_download() as waited:
        button(page, "Save as CSV").click()
    text = Path(waited.value.path()).read_bytes().decode("utf-8")
    assert text.startswith("\ufeff") and text.count("\r\n") == text.count("\n")
    return list(csv.reader(io.StringIO(text.removeprefix("\ufeff"))))


def read_by_teacher(page, students: list[Student]) -> None:
    """The page of the teacher, which is open, counts and saves what they have given."""
    reading(page)
    asked = []
    page.tab.on("request", lambda request: asked.append(request.url) if request.url.startswith("http") else None)
    sent = page.frames["sent"]
    put_in(page, [student.code for student in students])
    counted(tables(page), students)
    head, *rows = saved(page)
    assert asked == [] and page.frames["sent"] == sent
    for student, row in zip(students, rows, strict=True):
        found = dict(zip(head, row, strict=True))
        assert found["code"] == student.code
        assert {name: found[name] for name in student.given} == student.given, found
        outcomes = [cell for name, cell in found.items() if re.match(r"force\.\d", name) and cell]
        assert ["✓" if each == "yes" else "○" for each in outcomes] == student.signs
        places = [float(found[name]) for name in ("once.1", "once.2") if found[name]]
        assert places == pytest.approx(student.places, rel=0.05)
        if student.line:
            early = np.linspace(0, END, POINTS)[:8]  # before the jump, which is as wide as a pointer draws it
            values = np.array(found["force.line"].split(), float)[:8]
            times, forces = np.array(student.line).T
            assert np.abs(values - np.interp(early, times, forces)).max() < RISE


def counted(found: dict[str, list[list[str]]], students: list[Student]) -> None:
    """Its tables have the counts of what they gave."""
    count = len(students)
    said = [int(row[2].split()[0]) for row in found[f"{count} codes have an answer"]]
    assert said == [sum(student.given["next"] == str(1 + k) for student in students) for k in range(len(OPTIONS))]
    numbers = {row[1].split(":")[0]: int(row[2].split()[0]) for row in found[f"First tries of {count} codes, by size"]}
    given = Counter(student.given["back"] for student in students)
    assert numbers["116.4 µs"] == given["116.4"] + given["0.1164"] and numbers["58.19 µs"] == given["58.2"]
    assert numbers.get("300 µs", 0) == given["300"] and sum(numbers.values()) == count
    places = [int(row[2].split()[0]) for row in found[f"In its place at the first try, of {count} codes"]]
    assert places == [sum(student.order[k] == 1 + k for student in students) for k in range(6)]
    moved = [student for student in students if student.places]
    ranges = [int(row[2].split()[0]) for row in found[f"Found, of {len(moved)} codes"]]
    assert ranges == [sum(len(student.places) > k for student in moved) for k in range(2)]
    drew = [student for student in students if student.signs]
    for k in range(5):
        right = next(row for row in found[f"What is looked for: {1 + k}"] if row[0].startswith("✓"))
        assert int(right[2].split()[0]) == sum(student.signs[k] == "✓" for student in drew)
