"""Buttons of a phone: a finger that comes down beside one finds it."""

import pytest

PHONE = {"size": (390, 844), "has_touch": True, "is_mobile": True, "device_scale_factor": 2}
MISSED = """() => {
  const root = strikewave.page.root.getRootNode();
  const found = (x, y) => {
    let element = document.elementFromPoint(x, y);
    while (element?.shadowRoot) element = element.shadowRoot.elementFromPoint(x, y);
    return element?.closest('button');
  };
  return [...root.querySelectorAll('.topbar button, .closer button')].flatMap((button) => {
    button.scrollIntoView({ block: 'center' });
    const { left, top, width, height } = button.getBoundingClientRect();
    const [x, y] = [left + width / 2, top + height / 2];
    const beside = [-20, 20].map((away) => found(x, y + away) === button);
    return width && height < 36 && !beside.includes(true) ? [button.textContent] : [];
  });
}"""


@pytest.mark.parametrize("query", ["?scene=fixed-rod", "?lesson=bounce-twice"])
def test_a_button_takes_a_finger_above_it_or_below(open_page, query):
    """Half of 44 px away from its middle, on one side at least: on the other there may be another button."""
    page = open_page(query, plain=True, own=True, **PHONE)
    page.wait("() => strikewave.page.root.style.visibility === ''")  # a lesson is there
    assert page.evaluate("() => strikewave.page.root.getRootNode().querySelectorAll('.topbar button').length") > 4
    assert page.evaluate(MISSED) == []
