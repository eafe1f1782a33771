"""What hands do on a page: keys typed into a field, a slider dragged or moved by arrows, a finger that taps.

A field is never filled without keys, as `fill` of Playwright does: a page that refuses keys would pass.
"""

from playwright.sync_api import Locator

THUMB = 18  # px wide, of a slider
MOST_PRESSES = 1200  # of an arrow: a slider that moves by itself is never where it should be


def type_into(field: Locator, text: str, leave: str = "Tab") -> None:
    """Click a field, select what stands in it, type by keys, and leave it by one, or stay for lack of it."""
    field.click()
    field.press("ControlOrMeta+a")
    if text:
        field.press_sequentially(text)
    else:
        field.press("Delete")
    if leave:
        field.press(leave)


def paste_into(area: Locator, text: str) -> None:
    """What is too long to be typed, in the place of all that stands there, as a paste by the mouse does."""
    area.click()
    area.press("ControlOrMeta+a")
    area.page.keyboard.insert_text(text)


def _aimed(slider: Locator, share: float) -> tuple[float, float]:
    """The middle of the thumb of a slider that stands at this share of its length."""
    box = slider.bounding_box()
    assert box
    return box["x"] + THUMB / 2 + share * (box["width"] - THUMB), box["y"] + box["height"] / 2


def drag(slider: Locator, share: float) -> None:
    """Drag a slider with the mouse, to a share of its length."""
    slider.scroll_into_view_if_needed()
    start = float(slider.input_value()) / float(slider.get_attribute("max") or "nan")
    mouse = slider.page.mouse
    mouse.move(*_aimed(slider, start))
    mouse.down()
    for k in range(1, 9):
        mouse.move(*_aimed(slider, start + (share - start) * k / 8))
    mouse.up()


def arrow(slider: Locator, place: int) -> None:
    """Move a slider by keys to one of its places: to an end at once, or by large steps and then by small ones."""
    top = int(slider.get_attribute("max") or 0)
    if place in (0, top):
        return slider.press("End" if place else "Home")
    slider.focus()
    for step, less, more in ((top // 10, "PageDown", "PageUp"), (1, "ArrowLeft", "ArrowRight")):  # as Chromium has them
        for _ in range(MOST_PRESSES):
            if abs(way := place - int(slider.input_value())) < step:
                break
            slider.press(more if way > 0 else less)
        else:
            raise AssertionError(f"the slider does not come to {place}")
    return None


def slide(slider: Locator, place: int) -> None:
    """Drag a slider close to one of its places, and go on to it by arrows."""
    drag(slider, place / int(slider.get_attribute("max") or "0"))
    arrow(slider, place)


def tap(target: Locator) -> None:
    """Touch it with a finger."""
    target.tap()
