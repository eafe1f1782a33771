"""The bodies on the page: shown, typed, refused at the field, in link, history and comparison, set back."""

from playwright.sync_api import expect

from .hands import arrow, slide, type_into
from .test_compare_page import KEEP
from .test_links_page import at_rest, chosen
from .test_workspace_page import whole

SEARCH = "() => location.search"
OUTSIDE = """() => {  // what sticks out of the column of the bodies, or is cut
  const { root } = strikewave.page.bodies, { left, right } = root.getBoundingClientRect();
  const parts = [...root.querySelectorAll('label, input, select, dt, dd, summary, .unit')].filter((e) => e.checkVisibility());
  return parts.filter((e) => { const r = e.getBoundingClientRect(); return r.left < left || r.right > right
    || (e.tagName !== 'INPUT' && e.scrollWidth > e.clientWidth + 1); }).map((e) => e.textContent || e.id);
}"""  # noqa: E501


def body(page, number: int):
    return page.tab.locator(".body").nth(number - 1)


def unfold(page, number: int) -> None:
    """Its values, unless another test has."""
    details = body(page, number)
    if details.get_attribute("open") is None:
        details.locator("summary").click()


def field(page, name: str, number: int = 2):
    return body(page, number).locator("input.number, select").and_(page.tab.get_by_label(name))


def typed(page, name: str, text: str, number: int = 2) -> None:
    """Type a value, and wait for what it does as a step of the history."""
    box = field(page, name, number)

    def enter():
        type_into(box, text, "Enter")

    page.answered(enter)
    page.wait("() => !strikewave.page.bodies.asked")


def test_a_typed_value_is_solved_linked_undone_reloaded_and_set_back(open_page):
    page = open_page()
    expect(body(page, 2).locator(".derived")).to_contain_text("5156 m/s")
    at_rest(page)
    typed(page, "Length", "60 cm")
    at_rest(page)
    expect(field(page, "Length")).to_have_value("600")
    expect(page.tab.get_by_label("Mass ratio, exact value")).to_have_value("2")  # the striker is as heavy as before
    expect(field(page, "Mass, kg", 1)).to_have_value("2.133")
    page.wait("() => location.search === '?target.length=0.6&layout=laboratory'")
    page.answered(lambda: field(page, "Material").select_option("aluminium"))
    page.wait("() => location.search === '?target.length=0.6&target.material=aluminium&layout=laboratory'")
    at_rest(page)
    said = "Length 600 mm (body 2), Material Aluminium (body 2)."
    expect(page.tab.locator(".of-numbers")).to_contain_text(said)
    page.answered(lambda: page.evaluate("() => strikewave.page.history.undo()"))
    expect(field(page, "Material")).to_have_value("steel")
    page.answered(lambda: page.evaluate("() => strikewave.page.history.redo()"))
    page.wait("() => location.search === '?target.length=0.6&target.material=aluminium&layout=laboratory'")
    again = open_page(page.evaluate(SEARCH))
    assert again.header("chosen") == page.header("chosen")
    page.tab.reload()
    page.laid_out()
    assert page.header("chosen")["bodies"] == "target.length=0.6 target.material=aluminium"
    page.answered(body(page, 2).get_by_role("button", name="Reset").click)
    page.wait("() => location.search === '?layout=laboratory'")
    assert page.header("chosen")["mass_ratio"] == 1.0


def test_mass_and_ratio_follow_each_other(anew):
    page = anew()
    typed(page, "Mass, kg", "0.5", 1)
    expect(page.tab.get_by_label("Mass ratio, exact value")).to_have_value("4.266")
    ratio = page.tab.get_by_label("Mass ratio, exact value")
    page.answered(lambda: type_into(ratio, "2", "Enter"))
    expect(field(page, "Mass, kg", 1)).to_have_value("1.0665")
    expect(page.tab.locator(".field-mass_ratio .ends")).to_have_text("← heavy strikerlight striker →")


def test_what_cannot_be_is_said_at_the_field_and_nothing_is_lost(anew):
    page = anew()
    typed(page, "Length", "600")
    before, sent = page.header("chosen"), page.quiet()["sent"]
    box = field(page, "Length")
    for given in ("-3", "0", "2 kg", "nan", "1e400", "abc", "<b>x"):
        type_into(box, given, "Enter")
        expect(page.tab.locator(".wrong:visible")).to_have_count(1)
        expect(page.tab.locator(".wrong:visible")).to_contain_text(f"“{given}” is not possible.")
        assert box.get_attribute("aria-invalid") == "true"
    assert page.quiet()["sent"] == sent and page.header("chosen") == before
    expect(page.tab.locator(".toast:visible")).to_have_count(0)
    type_into(box, "600", "Enter")
    expect(page.tab.locator(".wrong:visible")).to_have_count(0)


def test_what_the_server_refuses_is_said_at_the_field_too(anew):
    page = anew()
    box = field(page, "Length")
    type_into(box, "9000 m", "Enter")
    expect(page.tab.locator(".wrong:visible")).to_have_text(
        "Mass ratio would then be 3·10⁴; it can be from 0.001 to 1000."
    )
    expect(page.tab.locator(".toast:visible")).to_have_count(0)
    expect(box).to_have_value("9000000")  # what was typed stays, to be mended
    assert chosen(page, "bodies", "mass_ratio") == ["", 1.0]


def test_a_bad_link_says_what_cannot_be_and_shows_the_rest(open_page):
    page = open_page("?target.length=-1&target.material=bronze&target.rods.2.length=3&speed=2")
    expect(page.tab.locator(".toast")).to_contain_text("is not possible")
    assert chosen(page, "bodies", "speed") == ["target.material=bronze", 2]


def test_kept_solutions_differ_by_their_bodies_in_words(open_page):
    page = open_page()
    page.evaluate(KEEP)
    typed(page, "Length", "600")
    expect(page.tab.locator(".of-story")).to_contain_text("Length 600 mm (body 2)")
    page.evaluate(KEEP)
    typed(page, "Length", "")  # as in the scene
    again = open_page(page.evaluate(SEARCH))
    again.wait("() => strikewave.page.compare.runs.length === 2")
    kept = "() => strikewave.page.compare.runs.map(({ frame }) => frame.chosen.bodies)"
    assert again.evaluate(kept) == page.evaluate(kept) == ["", "target.length=0.6"]


def test_all_bodies_of_a_chain_are_reached_in_every_window(anew):
    page = anew("split-hopkinson")
    heads = page.tab.locator(".body summary b").all_inner_texts()
    assert heads[:2] == ["Body 1, strikes: rod", "Body 2, is struck: chain of rods"]
    assert heads[2:] == [f"Body 2, rod {number} of 3" for number in (1, 2, 3)]
    unfold(page, 4)
    typed(page, "Length", "20", 4)
    page.wait("() => location.search === '?scene=split-hopkinson&target.rods.2.length=0.02&layout=laboratory'")
    for width, height in [(1440, 900), (1280, 720), (820, 1180), (390, 844)]:
        page.tab.set_viewport_size({"width": width, "height": height})
        page.laid_out()
        expect(field(page, "Length", 4)).to_be_visible()
        assert whole(page) and page.evaluate(OUTSIDE) == []


def test_a_mechanism_is_built_otherwise_by_its_links_and_joints(anew):
    page = anew("four-bar")
    heads = page.tab.locator(".body summary b").all_inner_texts()
    assert heads[2:5] == ["Link: crank", "Link: coupler", "Link: bar"]
    joints = ["ground – crank", "crank – coupler", "coupler – bar", "ground – bar"]
    assert heads[5:] == [f"Joint: {names}" for names in joints]
    lengths = page.tab.locator(".body .facts").nth(2)
    expect(lengths).to_contain_text("300 mm")
    unfold(page, 7)
    typed(page, "Place y", "35 cm", 7)
    page.wait("() => location.search === '?scene=four-bar&target.joints.2.y=0.35&layout=laboratory'")
    expect(lengths).to_contain_text("350 mm")
    page.evaluate(KEEP)
    typed(page, "Place y", "", 7)
    expect(page.tab.locator(".of-story")).to_contain_text("Place y 350 mm (body 2, joint crank – coupler)")
    typed(page, "Place y", "500 mm", 7)
    type_into(field(page, "Place x", 7), "400 mm", "Enter")  # where the coupler ends: it would have no length
    expect(page.tab.locator(".wrong:visible")).to_contain_text("The mechanism cannot be like that. Allowed: ")
    expect(field(page, "Place x", 7)).to_have_value("400")


def test_what_is_refused_stays_in_its_field_whatever_is_drawn_meanwhile(anew):
    page = anew("four-bar")
    unfold(page, 7)
    typed(page, "Place y", "500 mm", 7)
    field(page, "Place x", 7).evaluate(
        """(input) => {
          input.value = '400 mm'; // where the coupler ends
          for (const name of ['input', 'change']) input.dispatchEvent(new Event(name));
          strikewave.page.bodies.load(strikewave.page.frame);
        }"""
    )
    expect(page.tab.locator(".wrong:visible")).to_contain_text("The mechanism cannot be like that. Allowed: ")
    expect(field(page, "Place x", 7)).to_have_value("400")


def test_sizes_are_tried_by_sliders_too(anew):
    page = anew("four-bar")
    unfold(page, 7)
    slider = body(page, 7).get_by_label("Place y, slider")
    expect(slider).to_have_value("100")
    page.answered(lambda: slide(slider, 120))
    page.wait("() => !strikewave.page.bodies.asked")
    expect(field(page, "Place y", 7)).to_have_value("350")  # a tenth of what the joints are apart, more
    page.answered(lambda: arrow(slider, 100))
    page.wait("() => location.search === '?scene=four-bar&layout=laboratory'")
    page.show_scene("fixed-rod")
    slider = body(page, 2).get_by_label("Length, slider")
    page.answered(lambda: slide(slider, 200))
    expect(field(page, "Length")).to_have_value("600")
    typed(page, "Length", "45 cm")
    expect(slider).to_have_value("158")
    assert slider.get_attribute("aria-valuetext") == "450 mm"


def test_a_value_that_has_no_answer_yet_comes_back_with_the_page(open_page):
    page = open_page()
    page.evaluate(
        """() => {
          const { bodies, model } = strikewave.page;
          strikewave.page.model = new Proxy(model, {  // nothing is sent
            set: (all, name, value) => name === 'body_value' || Reflect.set(all, name, value),
          });
          bodies.set('target.length', 0.6);
          bodies.set('impactor.mass', 0.5);
        }"""
    )
    page.tab.reload()
    page.laid_out()
    page.wait("() => strikewave.page.frame.chosen.bodies === 'target.length=0.6'")
    expect(field(page, "Mass, kg", 1)).to_have_value("0.5")


def test_a_value_whose_answer_is_lost_is_asked_for_again(anew):
    page = anew()
    page.evaluate(
        """() => {
          const { model } = strikewave.page;
          window.lost = 0;
          window.found = () => { strikewave.page.model = model; };
          strikewave.page.model = new Proxy(model, { set(all, name, value) {
            if (name === 'body_value' && value && !window.lost++) return true;  // on its way to the server
            return Reflect.set(all, name, value);
          } });
        }"""
    )
    typed(page, "Length", "600")
    page.wait("() => strikewave.page.frame.chosen.bodies === 'target.length=0.6' && !strikewave.page.bodies.asked")
    page.evaluate("() => window.found()")
    assert page.evaluate("() => window.lost") >= 2
