"""Where a contact is gained or lost, in numbers: in the foot of the map, under a pointer, above the curves."""

import re

import pytest

import solvers

from .hands import arrow
from .test_page import settled
from .test_whatif_page import DONE, WHATIF, opened

WRITTEN = """() => {
  const { prototype } = CanvasRenderingContext2D;
  const { fillText } = prototype;
  const words = [];
  prototype.fillText = function (...all) { words.push([all[0], this.font]); return fillText.apply(this, all); };
  const { modes } = strikewave.page.opening.door.whatif;
  modes.curves.draw(['peak_force', 'newton']);
  prototype.fillText = fillText;
  return words.filter(([, font]) => font.startsWith('13px')).map(([word]) => word);
}"""


def contacts(mass_ratio: float, speed: float = 1.0, **contact) -> int:
    scene = solvers.load("fixed-rod").replace({"contact": contact} if contact else {})
    values = {"impactor.mass": scene.target.mass / mass_ratio, "impactor.velocity": speed}
    return len(solvers.solve(scene.replace(values), method="waves").contacts)


def test_the_nearest_changes_are_said_below_the_map(show):
    page = opened(show, "?layout=opening&whatif=peak_force,mass_ratio,speed")
    said = page.tab.locator(".whatif-border").text_content()
    form = r"([^:]*): 1 contact just above 1.011 or just below ([\d.]+)"  # thesis 4.5: 1.0107
    axis, low = re.fullmatch(form, said).groups()
    assert axis == "Mass ratio"  # by a rigid law nothing changes over the speed
    assert (contacts(1.0), contacts(1.0105), contacts(1.0115)) == (2, 2, 1)
    assert (contacts(0.999 * float(low)), contacts(1.001 * float(low))) == (1, 2)
    slider = page.tab.locator("#choice-mass_ratio")
    arrow(slider, int(slider.input_value()) + 30)
    settled(page)
    page.wait(DONE)
    said = page.tab.locator(".whatif-border").text_content()
    assert said == "Mass ratio: 2 contacts just below 1.011"
    page.tab.keyboard.press("Control+z")


def test_changes_along_both_axes_are_said(show):
    chosen = "law=hertz&mass_ratio=0.7&speed=1&hertz_stiffness=1e12"
    page = opened(show, f"?layout=opening&{chosen}&whatif=peak_force,speed,hertz_stiffness")
    page.wait(f"() => {WHATIF}.borders.root.textContent.includes(' · ')")
    said = page.tab.locator(".whatif-border").text_content()
    form = r"Impact speed: 1 contact just below (\S+) m/s · Stiffness: 1 contact just below ([^\u00a0]+).*"
    speed, stiffness = map(number, re.fullmatch(form, said.replace("\u00a0m/s", " m/s")).groups())
    for share, count in ((0.99, 1), (1.01, 2)):
        assert contacts(0.7, share * speed, law="hertz", stiffness=1e12) == count, said
        assert contacts(0.7, 1.0, law="hertz", stiffness=share * stiffness) == count, said


@pytest.mark.parametrize("law", ["rigid", "hertz"])
def test_a_line_of_the_map_says_its_place_under_a_pointer(show, law):
    y = "speed" if law == "rigid" else "hertz_stiffness"
    page = opened(show, f"?layout=opening&law={law}&whatif=peak_force,mass_ratio,{y}")
    spots = page.evaluate(f"""() => {{
      const {{ plane, view }} = {WHATIF};
      const whole = [...plane.raster.torn].filter(([, {{ ends, found }}]) => found && ends.length === 2);
      const spots = whole.map(([k, each]) => {{
        const [[x, y]] = each.ends;
        const [X, Y] = view.spot((k % view.nx) + x, Math.floor(k / view.nx) + y);
        return [plane.plot.x + X * plane.plot.w, plane.plot.y + (1 - Y) * plane.plot.h];
      }});
      const [px, py] = plane.at;
      const inside = ([x, y]) => Math.hypot(x - px, y - py) > 40 && y > plane.plot.y + 20 && x > plane.plot.x + 8;
      return spots.filter(inside);
    }}""")
    assert len(spots) > 20
    corner = page.tab.locator(".whatif-map canvas").last.bounding_box()
    for x, height in (spots[len(spots) // 3], spots[-1]):
        page.tab.mouse.move(corner["x"] + x + 4, corner["y"] + height)
        page.wait(f"() => /[|].*: [^…]/.test({WHATIF}.borders.root.textContent)")
        said = page.tab.locator(".whatif-border").text_content()
        before, after, first, one, second, other = re.fullmatch(
            r"(\d)\+? \| (\d)\+? contacts?: (\D+) ([\d.·⁰¹²³⁴⁵⁶⁷⁸⁹]+)[^,]*, (\D+) ([\d.·⁰¹²³⁴⁵⁶⁷⁸⁹]+).*", said
        ).groups()
        place = dict([(first, number(one)), (second, number(other))])
        sure = max(1e-3, rounded(one))
        for share, count in ((-sure, int(before)), (sure, int(after))):
            values = place | {first: place[first] * (1 + share)}
            stiff = {"law": "hertz", "stiffness": values["Stiffness"]} if law == "hertz" else {}
            assert contacts(values["Mass ratio"], values.get("Impact speed", 1.0), **stiff) == count, said
    page.tab.mouse.move(corner["x"] + 300, corner["y"] - 60)
    page.wait(f"() => !{WHATIF}.borders.root.textContent.includes('|')")


def number(words: str) -> float:
    """Of 2·10⁹."""
    head, _, power = words.rpartition("10") if re.search("[⁰¹²³⁴⁵⁶⁷⁸⁹]", words) else (words, "", "")
    digits = power.translate(str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789"))
    return float(head.rstrip("·") or 1) * 10 ** int(digits or 0)


def rounded(words: str) -> float:
    """How far a written number may be from what it stands for: half of its last digit, and a little."""
    head, _, _ = words.partition("·")
    _, _, decimals = head.partition(".")
    return 0.51 * 10.0 ** -len(decimals) / float(head)


def test_curves_say_where_contacts_change_the_nearest_first(open_page):
    page = open_page("?layout=opening&whatif=curves:peak_force,mass_ratio,speed")  # no curve is there of another scene
    page.wait(f"() => {WHATIF}?.modes.curves.jobs.shown?.whole")
    words = page.evaluate(WRITTEN)
    first = [float(each) for each in words if re.fullmatch(r"\d\.\d{3,}", each)]
    assert first[:3] == [1.011, 0.5786, 0.3274]
    for value in first[:3]:
        assert contacts(value * (1 - 2e-3)) != contacts(value * (1 + 2e-3))
