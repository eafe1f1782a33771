"""What a visitor takes along: the picture as PNG and SVG, a clip of it, the scene with its command."""

import base64

import numpy as np
import pytest
from playwright.sync_api import expect

PARTS = ".ask, .caption, .stages, .section, .happens, .lens"
SIZE = f"""() => {{
  const boxes = [...strikewave.page.root.querySelectorAll('{PARTS}')].map((part) => part.getBoundingClientRect());
  const seen = boxes.filter(({{ height }}) => height);
  return [
    Math.max(...seen.map(({{ right }}) => right)) - Math.min(...seen.map(({{ left }}) => left)),
    Math.max(...seen.map(({{ bottom }}) => bottom)) - Math.min(...seen.map(({{ top }}) => top)),
  ];
}}"""
SAID = """text => {
  const { documentElement: root } = new DOMParser().parseFromString(text, 'image/svg+xml');
  const words = [...root.querySelectorAll('text')].map((each) => each.textContent);
  return { name: root.nodeName, words, drawn: root.querySelectorAll('path').length, box: root.getAttribute('viewBox') };
}"""
PLAYED = """async (data) => {
  const film = document.createElement('video');
  film.src = URL.createObjectURL(new Blob([Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0))]));
  film.muted = true;
  const once = (name) => new Promise((done, fail) => {
    film.addEventListener(name, done, { once: true });
    setTimeout(() => fail(new Error(`no ${name} at ${film.currentTime} of ${film.duration}`)), 10_000);
  });
  const ready = once('loadeddata');
  film.load();
  await ready;
  const at = async (time) => {
    const there = once('seeked');
    film.currentTime = time;
    await there;
    const c = Object.assign(document.createElement('canvas'), { width: 64, height: 64 }).getContext('2d');
    c.drawImage(film, 0, 0, 64, 64);
    return [...c.getImageData(0, 0, 64, 64).data];
  };
  const pictures = [];
  for (const time of [0.1, 0.5, 1, 1.5, 2, 2.5, 1e6]) pictures.push(await at(time));
  return { pictures, seconds: film.currentTime, size: [film.videoWidth, film.videoHeight] };
}"""


def saved(page, what: str, path):
    """The file that a choice of the menu gives; its name."""
    with page.tab.expect_download() as download:
        page.take(what)
    download.value.save_as(path)
    return download.value.suggested_filename


@pytest.mark.parametrize(
    ("query", "drawn"),
    [
        ("", "movement drawn"),
        ("?scene=hammer-on-cantilever&layout=opening", "movement drawn"),
        ("?scene=spinning-ball&layout=opening", "during the impact"),
    ],
)
@pytest.mark.parametrize("size", [(1280, 720), (390, 844)])
def test_what_is_seen_is_saved_as_it_is_seen(open_page, tmp_path, query, drawn, size):
    page = open_page(query, size=size)
    width, height = page.evaluate(SIZE)
    path = tmp_path / "picture"
    scene = page.header("chosen")["scene"]
    assert saved(page, "Picture (PNG)", path) == f"strikewave-{scene}.png"
    across, down = np.frombuffer(path.read_bytes()[16:24], ">u4")
    assert across == pytest.approx(2 * (width + 32), abs=4) and down == pytest.approx(2 * (height + 52), abs=4)
    assert saved(page, "Picture (SVG)", path) == f"strikewave-{scene}.svg"
    found = page.evaluate(SAID, path.read_text("utf-8"))
    assert found["name"] == "svg" and found["drawn"] > 20
    title = page.tab.locator(".topbar .scene .title").inner_text()
    assert f"{title} · Strikewave" in found["words"]
    together = " ".join(found["words"])
    for part in (".ask h2", ".caption"):
        shown = page.tab.locator(part).inner_text()
        assert " ".join(shown.split()) in together
    assert drawn in together


def test_the_page_is_as_it_was_once_a_picture_is_saved(open_page, tmp_path):
    page = open_page("")
    shown = "() => strikewave.page.root.querySelector('.section canvas').toDataURL()"
    before = page.evaluate(shown)
    saved(page, "Picture (SVG)", tmp_path / "picture")
    assert page.evaluate(shown) == before


def test_a_clip_shows_the_stretch_in_view_once(open_page, tmp_path):
    page = open_page("")
    page.evaluate("() => strikewave.page.zoom(0, 0.5)")
    assert saved(page, "Clip of what is in view", tmp_path / "clip") == "strikewave-fixed-rod.webm"
    assert not page.evaluate("() => strikewave.page.player.playing")
    shown, end = page.evaluate("() => [strikewave.page.player.t, strikewave.page.range()[1]]")
    assert shown == pytest.approx(end, abs=1e-6)
    film = base64.b64encode((tmp_path / "clip").read_bytes()).decode()
    cinema = page.context.new_page()  # of no address: the policy of the page lets it play nothing
    found = cinema.evaluate(PLAYED, film)
    cinema.close()
    changes = np.abs(np.diff(np.array(found["pictures"], float), axis=0)).max(axis=1)
    assert np.sum(changes > 20) >= 2  # it moves; a busy machine leaves pictures out
    assert 3 < found["seconds"] < 8
    width, height = page.evaluate(SIZE)
    assert found["size"][0] / found["size"][1] == pytest.approx((width + 32) / (height + 52), rel=0.02)


def test_a_clip_ends_when_it_is_stopped(open_page):
    page = open_page("")
    page.take("Clip of what is in view")
    page.wait("() => strikewave.page.player.t > 0.1")
    with page.tab.expect_download():
        page.tab.get_by_role("button", name="■ Stop", exact=True).click()
    expect(page.tab.get_by_role("button", name="Save", exact=True)).to_be_visible()
    assert page.evaluate("() => strikewave.page.player.t") < 3


def test_a_browser_that_cannot_record_says_so(open_page):
    page = open_page("")
    page.evaluate("() => { delete window.MediaRecorder; }")
    page.take("Clip of what is in view")
    expect(page.tab.locator(".toast")).to_contain_text("This browser cannot record clips")
    page.take("Picture (PNG)")


def test_the_scene_its_command_and_its_python_lines_are_one_click_away(open_page):
    page = open_page("")
    page.take("Scene, command, Python")
    expect(page.tab.locator(".code-part pre").first).to_contain_text("impact solve fixed-rod.toml")
