"""A slider that moves, answered by the browser at once and by the server at rest; and whether the two are alike."""

import math
from collections.abc import Iterator
from typing import Any
from urllib.parse import parse_qsl

import pytest

from ..conftest import Page

READY = """() => {
  const { answers } = strikewave.page.own;
  if (answers) answers.longest = Infinity; // however busy the machine is
  return answers !== null;
}"""
STATE = """() => {
  const { exact, duration, f0, exactMass, exactForce, match, prediction, ...frame } = strikewave.page.frame;
  const { peakForce, contacts, restitution, energy, final, targetFinal, left, cutOff } = exact;
  const arrays = Object.fromEntries(
    Object.entries({ f0: f0 ?? [], exactMass, exactEnd: frame.exactEnd, exactWhole: frame.exactWhole ?? [] })
      .map(([name, values]) => [name, [...values]]));
  const figures = { duration, peakForce, contacts, restitution, energy, final, targetFinal, left, cutOff, match };
  return { figures: { ...figures, prediction }, arrays, force: Math.max(...exactForce) };
}"""
MOVE = """async ([name, values]) => {
  const { page } = strikewave, { own } = page, seen = [];
  for (const value of values) {
    const before = own.count;
    page.controls.send(name, value);
    for (let k = 0; own.count === before && k < 100; k++) await new Promise((done) => requestAnimationFrame(done));
    seen.push([own.made.has(page.frame), page.frame.chosen[name]]);
  }
  return [seen, ...[LOOKS].map((look) => look())];
}"""
CHOOSE = "(choice) => strikewave.page.choose(...choice)"
AT_REST = """([name, value]) => {
  const { frame, own, changes } = strikewave.page;
  return !own.made.has(frame) && frame.chosen[name] === value && !changes.asked;
}"""


def as_chosen(text: str) -> float | str:
    """A number of a link as a slider has it."""
    try:
        return float(text)
    except ValueError:
        return text


class Shown:
    """Pages that go from one scene to the next as by the gallery, one for each layout."""

    def __init__(self, *given: Any):
        self.given = given  # browser, address of the server, and windows
        self.by_layout: dict[str, Page] = {}
        self.queries: dict[str, str] = {}  # what each has been led to last

    def show(self, query: str, size=(1440, 900)) -> Page:
        """With the choices of this link, or those that a test has moved before, if that is where it was."""
        choices = dict(parse_qsl(query.lstrip("?")))
        layout, scene = choices.pop("layout", "laboratory"), choices.pop("scene", "fixed-rod")
        if (page := self.by_layout.get(layout)) is None:
            browser, address, windows = self.given
            page = self.by_layout[layout] = Page(browser, address, query, size, windows=windows)
        elif page.tab.viewport_size != {"width": size[0], "height": size[1]}:
            page.resize(*size)
        if self.queries.get(layout, query) != query:
            if scene == page.header("chosen")["scene"]:  # which another one takes back to what it begins with
                page.show_scene("free-rod" if scene == "fixed-rod" else "fixed-rod")
            page.show_scene(scene)
            for choice in ([name, as_chosen(text)] for name, text in choices.items()):
                if page.header("chosen")[choice[0]] != choice[1]:
                    page.answered(lambda choice=choice: page.evaluate(CHOOSE, choice))
        self.queries[layout] = query
        return page

    def close(self) -> None:
        for page in self.by_layout.values():
            page.close()


def by_itself(page, name: str, values: list, *looks: str) -> list[Any]:
    """What each of these looks sees of the browser's own answer, once this has had all these values."""
    seen, *found = page.evaluate(MOVE.replace("LOOKS", ", ".join(looks)), [name, values])
    assert seen == [[True, value] for value in values]
    return found


def moved(page, name: str, values: list, *looks: str) -> Iterator[tuple[Any, Any]]:
    """The same beside what they see of the server's answer."""
    page.wait(READY)
    own = by_itself(page, name, values, *looks)
    page.wait(AT_REST, [name, values[-1]])
    return zip(own, [page.evaluate(look) for look in looks], strict=True)


def flat(value) -> list:
    """Numbers and words of nested lists, in order; what there is none of is no number."""
    if isinstance(value, dict):
        return [each for key in sorted(value) for each in flat(value[key])]
    if isinstance(value, list):
        return [each for part in value for each in flat(part)]
    return [math.nan if value is None else value]


def figures_alike(own, there, close: float) -> None:
    assert flat(own) == pytest.approx(flat(there), rel=close, abs=close, nan_ok=True)


def arrays_alike(own: dict[str, list], there: dict[str, list], close: float) -> None:
    """Up to so much of the largest number of each; some messages have them in two bytes or four."""
    assert own.keys() == there.keys()
    for name, values in there.items():
        assert own[name] == pytest.approx(values, abs=close * max(map(abs, values), default=0.0)), name
