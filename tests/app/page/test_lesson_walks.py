"""Each lesson is taken wholly: by keys alone, and by a finger on a phone, with the answers of its file, to its code."""

import re

import numpy as np
import pytest
from playwright.sync_api import expect

from app.lessons.events import times_of
from app.lessons.judging import exact_boundary, exact_line
from app.lessons.lesson import Boundary
from app.lessons.scales import value_at
from app.lessons.shipped import lesson_names, shipped_lesson
from app.lessons.solving import solved

from .hands import tap, type_into

THERE = """() => {
  if (!window.strikewave) return false;
  const { asked, changes, opening: { teaching: { lesson } }, root, telling } = strikewave.page;
  return Boolean(lesson) && !lesson.coming && !asked && !telling && !changes.quiet && !root.inert;
}"""
FOCUSED = "(wanted) => strikewave.page.root.getRootNode().activeElement?.matches(wanted)"
ANSWERS = "() => strikewave.page.opening.teaching.lesson.progress.answers"
DONE = "(name) => strikewave.page.opening.teaching.lesson.progress.answers[name]?.done"
ORDER = "() => strikewave.page.opening.teaching.lesson.question.answer.order"
SHARE = """([name, value]) => {
  const { bounds: { low, high }, log } = strikewave.page.controls.fields[name];
  return log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
}"""
CODE = re.compile(r"[B-DF-HJ-NP-TWXZ]{4}(-[B-DF-HJ-NP-TWXZ]{4})+")
MOST = 120  # presses of Tab to what is looked for
POINTS = 24  # of a line that is drawn
LESSONS = lesson_names()


def place_for(part) -> float:
    """In the first range in which the goal of a slider is met, so far from its ends as a finger may miss."""
    low, high = part.found[0].range
    return float(f"{np.sqrt(low * high) if low > 0.0 else 0.5 * (low + high):.3g}")


def right_line(step, part) -> list[tuple[float, float]]:
    """The curve that is looked for, by a few points [T] and values of the chart; over a map in shares of it."""
    if isinstance(part, Boundary):
        values = exact_boundary(part)
        return [(k / (values.size - 1), values[k]) for k in range(0, values.size, 4)]
    solution = solved(step).solution
    times = times_of(solution)
    until = part.until if isinstance(part.until, float) else times[part.until]
    values = exact_line(solution, part, until)
    places = np.linspace(0, values.size - 1, POINTS).round().astype(int)
    return [(until * place / (values.size - 1), min(values[place], part.axis[1])) for place in places]


class Walk:
    """Through one lesson; how a thing is reached and pressed is left to the two kinds."""

    def __init__(self, page, lesson):
        self.page, self.lesson = page, lesson

    def there(self) -> None:
        self.page.wait(THERE)

    def take(self) -> str:
        """All steps; the code at the end."""
        for number, step in enumerate(self.lesson.steps, 1):
            self.there()
            assert self.page.evaluate("() => strikewave.page.opening.teaching.lesson.at") == number - 1
            for part in step.parts:
                if hasattr(self, part.KIND):
                    getattr(self, part.KIND)(part, step)
                    self.page.wait(DONE, part.name)
            if number < len(self.lesson.steps):
                self.press(".lesson-moves .ready")
        self.press(".class-handed .lesson-main")
        return self.page.tab.locator(".class-code").inner_text()


class Keys(Walk):
    """Nothing but keys: Tab leads to whatever is needed, and away from it."""

    def key(self, name: str, times: int = 1) -> None:
        for _ in range(times):
            self.page.tab.keyboard.press(name)

    def reach(self, wanted: str) -> None:
        for _ in range(MOST):
            if self.page.evaluate(FOCUSED, wanted):
                return
            self.key("Tab")
        pytest.fail(f"no Tab leads to {wanted}")

    def press(self, wanted: str) -> None:
        self.reach(wanted)
        self.key("Enter")

    def choice(self, part, step) -> None:
        self.reach(".lesson-choice input")
        self.key("Space")
        self.key("ArrowDown", next(k for k, option in enumerate(part.options) if option.right))
        self.press(".lesson-choice .lesson-main")

    def number(self, part, step) -> None:
        self.reach(".lesson-number input")
        self.page.tab.keyboard.type(f"{part.answer:.6g} {part.unit if part.unit != '1' else ''}".strip())
        self.key("Tab")
        assert not self.page.evaluate(FOCUSED, ".lesson-number input")
        self.press(".lesson-number .lesson-main")

    def order(self, part, step) -> None:
        for wanted in range(len(part.items)):
            if (place := self.page.evaluate(ORDER).index(wanted)) > wanted:
                self.reach(f".lesson-lines li:nth-child({place + 1}) button")  # the first one moves it up
                self.key("Enter", place - wanted)
        self.press(".lesson-order > .lesson-main")

    def set(self, part, step) -> None:
        self.reach(f".field-{part.slider} input.number")
        self.key("ControlOrMeta+a")
        self.page.tab.keyboard.type(str(place_for(part)))
        self.key("Tab")

    def sketch(self, part, step) -> None:
        self.press(".sketch-tools button:last-child")
        self.reach(".sketch-points textarea")
        line = right_line(step, part)
        if isinstance(part, Boundary):
            over = list(zip(part.ranges, part.logs, strict=True))
            line = [tuple(value_at(share, *way) for share, way in zip(point, over, strict=True)) for point in line]
        self.page.tab.keyboard.type("\n".join(f"{t:.3f} {value:.4g}" for t, value in line))
        self.press(".sketch-points button")
        self.press(".lesson-asked .lesson-main")


class Finger(Walk):
    """Taps, strokes of a finger, and the letters of its keyboard."""

    def press(self, wanted: str) -> None:
        tap(self.page.tab.locator(f"{wanted}:visible").first)

    def choice(self, part, step) -> None:
        right = next(k for k, option in enumerate(part.options) if option.right)
        tap(self.page.tab.locator(".lesson-choice label").nth(right))
        self.press(".lesson-choice .lesson-main")

    def number(self, part, step) -> None:
        field = self.page.tab.locator(".lesson-number input")
        tap(field)
        type_into(field, f"{part.answer:.6g} {part.unit if part.unit != '1' else ''}".strip(), "")
        self.press(".lesson-number .lesson-main")

    def order(self, part, step) -> None:
        for wanted in range(len(part.items)):
            while (place := self.page.evaluate(ORDER).index(wanted)) > wanted:
                tap(self.page.tab.locator(".lesson-lines li").nth(place).locator("button").first)
        self.press(".lesson-order > .lesson-main")

    def set(self, part, step) -> None:
        slider = self.page.tab.locator(f"#choice-{part.slider}")
        slider.scroll_into_view_if_needed()
        box = slider.bounding_box()
        share = self.page.evaluate(SHARE, [part.slider, place_for(part)])
        start = float(slider.input_value()) / float(slider.get_attribute("max"))
        y = box["y"] + box["height"] / 2
        xs = [box["x"] + 9 + each * (box["width"] - 18) for each in (start, share)]
        self.stroke([(xs[0], y), (0.5 * (xs[0] + xs[1]), y), (xs[1], y)])

    def sketch(self, part, step) -> None:
        plot = self.page.tab.locator(".sketch-plot")
        plot.scroll_into_view_if_needed()
        box = plot.bounding_box()
        line = right_line(step, part)
        low, high = part.axis
        self.stroke([
            (
                box["x"] + min(t / line[-1][0], 1) * (box["width"] - 1),
                box["y"] + (1 - (value - low) / (high - low)) * (box["height"] - 1),
            )
            for t, value in line
        ])  # fmt: skip
        self.press(".lesson-asked .lesson-main")

    def stroke(self, points: list[tuple[float, float]]) -> None:
        """Of one finger, from the first point to the last."""
        session = self.page.tab.context.new_cdp_session(self.page.tab)
        for k, (x, y) in enumerate(points):
            kind = "touchMove" if k else "touchStart"
            session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y}]})
        session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        session.detach()


WAYS = {"keys": (Keys, {"size": (1440, 900)}), "finger": (Finger, {"size": (390, 844), "has_touch": True})}


@pytest.mark.browser
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", LESSONS)
def test_a_lesson_is_taken_wholly(open_page, name, way):
    kind, how = WAYS[way]
    lesson = shipped_lesson(name)
    page = open_page(f"?lesson={name}&language=en", drawn=False, **how)
    code = kind(page, lesson).take()
    assert CODE.match(code)
    expect(page.tab.locator(".class-given button")).to_be_in_viewport()
    asked = {part.name for step in lesson.steps for part in step.parts if hasattr(part, "name")}
    answers = page.evaluate(ANSWERS)
    assert answers.keys() == asked and all(each["done"] for each in answers.values())
    first = [each["first"] for each in answers.values() if each.get("first") and "value" in each["first"]]
    assert all(each["done"] for each in first)  # numbers of the file are right at once
    page.fits(how["size"][0])
