"""The laboratory as a folder: small, of itself alone, and answers as the library does, from the disk and served."""

import json
import shutil
from pathlib import Path

import pytest

import solvers
from app.choices.choices import SCENES
from app.command.main import main
from app.serving.folder import script
from app.wasm.covered import covered_of
from app.wasm.module import signed
from solvers.bodies import SpringMass
from solvers.scenes.library import scene_of

from .conftest import SECONDS, choose

MOST = 980_000  # bytes of all files: some 964 000 with the map and the table behind it
PHONE = {"width": 390, "height": 844}
TRAPPING = """const { instantiate } = WebAssembly;
WebAssembly.instantiate = async (...given) => {
  const { exports } = await instantiate(...given);
  const trapping = (act) => (...numbers) => {
    if (window.trapping) throw new WebAssembly.RuntimeError('unreachable');
    return act(...numbers);
  };
  const all = Object.entries(exports).map(([name, act]) => [name, typeof act === 'function' ? trapping(act) : act]);
  return { exports: Object.fromEntries(all) };
};"""
SAID = "() => document.querySelector('.closed')?.textContent"


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    place = tmp_path_factory.mktemp("static") / "impact"
    assert main(["export-static", str(place)]) == 0
    return place


def peak(tab) -> float:
    return tab.evaluate("() => (({ exact, main }) => (exact ?? main).peakForce)(strikewave.page.frame)")


@pytest.mark.browser  # needs Node, which packs the page
@pytest.mark.slow
def test_it_is_small_and_names_nothing_elsewhere(folder):
    files = [path for path in folder.rglob("*") if path.is_file()]
    assert sum(path.stat().st_size for path in files) <= MOST
    assert {path.suffix for path in files} == {".html", ".js", ".css"}
    document = (folder / "index.html").read_text("utf-8")
    assert "http:" not in document and "https:" not in document and 'type="module"' not in document


@pytest.mark.browser  # likewise
@pytest.mark.slow
def test_what_is_no_folder_or_no_address_is_refused_in_one_line(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert main(["export-static", str(tmp_path / "file")]) == 2
    assert capsys.readouterr().err.startswith("impact: FOLDER: got ")
    assert main(["export-static", str(tmp_path / "new"), "--laboratory", "ftp://x"]) == 2
    assert "--laboratory" in capsys.readouterr().err and not (tmp_path / "new").exists()


def test_kernels_of_other_sources_are_not_exported(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("app.serving.folder.sources", lambda: "others")
    assert main(["export-static", str(tmp_path / "new")]) == 2
    assert "make wasm" in capsys.readouterr().err and not (tmp_path / "new").exists()


def test_a_page_that_is_not_packed_is_not_exported(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("app.page.packed.pack", lambda: None)
    assert main(["export-static", str(tmp_path / "new")]) == 2
    assert "make package" in capsys.readouterr().err and not (tmp_path / "new").exists()


def test_the_command_lists_what_is_covered(capsys):
    assert main(["wasm", "--list"]) == 0
    *names, count = capsys.readouterr().out.splitlines()
    assert names == covered_of(SCENES) and count == f"{len(names)} of {len(SCENES)} scenes"


@pytest.mark.parametrize("where", ["disk", "server"])
def test_answers_are_those_of_the_library(served, opened, folder, where):
    base = folder.as_uri() if where == "disk" else served
    tab = opened(base=base)
    scene = scene_of("fixed-rod")
    assert peak(tab) == pytest.approx(solvers.solve(scene).peak_force, rel=1e-9)
    for ratio, speed in ((0.31, 1.0), (4.0, 1.0), (4.0, 3.5), (1.0, 1.0)):
        choose(tab, "mass_ratio", ratio)
        choose(tab, "speed", speed)
        other = scene.with_impactor_mass(scene.target.mass / ratio).replace({"impactor.velocity": speed})
        assert peak(tab) == pytest.approx(solvers.solve(other).peak_force, rel=1e-9)
    tab.keyboard.press("g")
    tab.get_by_role("button", name="Nothing holds the rod").click()
    tab.wait_for_function("() => strikewave.page.frame.chosen.scene === 'free-rod'", timeout=SECONDS)
    assert peak(tab) == pytest.approx(solvers.solve(scene_of("free-rod")).peak_force, rel=1e-9)
    assert [url for url in tab.asked if not url.startswith((f"{base}/", "data:", "blob:"))] == []
    assert tab.errors == []


def test_every_scene_that_is_covered_is_answered_here(opened):
    tab = opened()
    for name in covered_of(SCENES):
        choose(tab, "scene", name)
        assert tab.evaluate("() => strikewave.page.frame.chosen.scene") == name
        scene = SCENES[name]
        if isinstance(scene.target, SpringMass):  # balances, of which none lasts
            final = tab.evaluate("() => strikewave.page.frame.exact.final")
            assert peak(tab) is None and final == pytest.approx(solvers.solve(scene).impactor_velocity / scene.speed)
            continue
        method = None if scene.bends else "waves" if scene.target.rods else "modal"  # beside which others stand
        assert peak(tab) == pytest.approx(solvers.solve(scene, method=method).peak_force, rel=1e-8), name
    assert tab.errors == []


def test_it_opens_with_the_warnings_of_the_scene_and_a_slider_is_answered_at_once(opened):
    tab = opened()
    notes = "() => strikewave.page.frame.exact.notes.map(({ code }) => code)"
    assert "near-grazing" in tab.evaluate(notes)
    slider = tab.get_by_role("slider", name="Mass ratio")
    before = tab.evaluate("() => strikewave.frames")
    slider.focus()
    tab.keyboard.press("ArrowRight")
    tab.wait_for_function("n => strikewave.frames > n", arg=before, timeout=SECONDS)
    ratio = tab.evaluate("() => strikewave.page.frame.chosen.mass_ratio")
    assert ratio > 1.0 and not tab.evaluate("() => strikewave.page.own.count")


def test_the_method_beside_is_by_as_many_modes_as_are_chosen_and_a_beam_is_struck_by_what_is(opened):
    tab = opened()
    scene = scene_of("fixed-rod")
    for modes in (50, 7, 200):
        choose(tab, "modes", modes)
        marched = tab.evaluate("() => strikewave.page.frame.modalForce.length")
        beside = solvers.Modal(modes=modes, steps=marched).solve(scene, solvers.solve(scene).duration)
        shown = tab.evaluate("() => strikewave.page.frame.other")
        assert shown["peakForce"] == pytest.approx(beside.peak_force, rel=1e-9)
        assert len(shown["contacts"]) == len(beside.contacts)
    choose(tab, "scene", "xylophone-bar")  # and a beam is struck by what is chosen
    scene = scene_of("xylophone-bar")
    for ratio, speed in ((4.0, 1.0), (4.0, 2.5)):
        choose(tab, "mass_ratio", ratio)
        choose(tab, "speed", speed)
        other = scene.replace({"impactor.velocity": speed}).with_impactor_mass(scene.target.mass / ratio)
        assert peak(tab) == pytest.approx(solvers.solve(other).peak_force, rel=1e-8)
    assert tab.errors == []


def test_a_link_leads_to_a_scene_with_its_choices(opened):
    tab = opened("?scene=free-rod&mass_ratio=2.5&speed=3&layout=docks&tab=numbers")
    chosen = tab.evaluate("() => strikewave.page.frame.chosen")
    assert (chosen["scene"], chosen["mass_ratio"], chosen["speed"]) == ("free-rod", 2.5, 3)
    tab.get_by_role("tab", name="Numbers", selected=True).wait_for()
    choose(tab, "mass_ratio", 2)
    tab.wait_for_function("() => location.search.includes('mass_ratio=2&')", timeout=SECONDS)
    tab.reload()
    tab.wait_for_function("() => window.strikewave?.page.frame.chosen.mass_ratio === 2", timeout=SECONDS)
    assert tab.errors == []


@pytest.mark.parametrize(
    "query, said",
    [
        ("?scene=newtons-cradle", "This page works without a server and does not have this scene."),
        ("?elements=5", "Elements cannot be changed here: this page works without a server."),
        ("?mass_ratio=1e9", "Mass ratio: 1e9 is not possible. Choose a number from 0.001 to 1000."),
        ("?mass_ratio=1e999", "Mass ratio: 1e999 is not possible. Choose a number from 0.001 to 1000."),
        ("?mass_ratio=0x10", "Mass ratio: 0x10 is not possible. Choose a number from 0.001 to 1000."),
        ("?mass_ratio=", "Mass ratio: “…” is not possible. Choose a number from 0.001 to 1000."),
        ("?modes=1e2", "Modes: 1e2 is not possible. Choose a whole number from 1 to 200."),
        ("?mass_ratio=heavy", "Mass ratio: heavy is not possible. Choose a number from 0.001 to 1000."),
        ("?target.length=2", "this page works without a server."),
    ],
)
def test_what_a_link_cannot_have_is_said_in_one_sentence(opened, query, said):
    tab = opened(query)
    assert said in tab.locator(".toast").inner_text().replace("\u00a0", " ")
    assert peak(tab) == pytest.approx(solvers.solve(scene_of("fixed-rod")).peak_force, rel=1e-9)
    assert tab.errors == []


def test_what_cannot_be_chosen_is_set_back(opened):
    tab = opened()
    for speed, (name, value) in enumerate((("elements", 5), ("speed", 1e9), ("bodies", "target.length=2.0")), start=2):
        before = tab.evaluate("name => strikewave.page.model[name]", name)
        choose(tab, name, value)
        assert tab.evaluate("name => strikewave.page.model[name]", name) == before
        assert tab.evaluate("() => JSON.parse(strikewave.page.model.refused).length") == 1
        choose(tab, "speed", speed)
        assert tab.evaluate("() => strikewave.page.frame.speed") == speed
        assert tab.evaluate("() => strikewave.page.model.refused") == ""


@pytest.mark.parametrize("query", ["?law=lee-wang", "?law=hertz&mass_ratio=0.001"])
def test_a_link_to_what_cannot_be_answered_opens_the_scene_and_says_so(opened, query):
    tab = opened(query)
    assert tab.evaluate("() => strikewave.page.frame.chosen.law") == "rigid"
    assert len(tab.evaluate("() => JSON.parse(strikewave.page.model.refused)")) == 1
    assert tab.errors == []


def test_it_tries_what_is_other_than_what_is_shown(opened):
    tab = opened("?scene=free-rod&speed=5")
    trials = "() => Object.fromEntries(strikewave.page.frame.opens.trials.map(([say, , value]) => [say, value]))"
    assert tab.evaluate(trials)["faster"] == 10.0
    assert "softer" in tab.evaluate(trials)
    choose(tab, "law", "linear")
    assert "softer" not in tab.evaluate(trials)


def test_another_contact_law_and_its_stiffness_are_answered(opened):
    tab = opened("?scene=free-rod")
    choose(tab, "law", "hertz")
    choose(tab, "hertz_stiffness", 3e9)
    scene = scene_of("free-rod").replace({"contact": {"law": "hertz", "stiffness": 3e9}})
    assert peak(tab) == pytest.approx(solvers.solve(scene).peak_force, rel=1e-9)
    choose(tab, "law", "hunt-crossley")
    choose(tab, "restitution", 0.4)
    scene = scene.replace({"contact": {"law": "hunt-crossley", "stiffness": 3e9, "restitution": 0.4}})
    assert peak(tab) == pytest.approx(solvers.solve(scene).peak_force, rel=1e-8)
    choose(tab, "law", "rigid")
    assert peak(tab) == pytest.approx(solvers.solve(scene_of("free-rod")).peak_force, rel=1e-9)
    assert tab.errors == []


def test_only_what_needs_no_server_is_offered(opened):
    tab = opened()
    closer = tab.get_by_role("navigation", name="Look closer")
    assert closer.get_by_role("button").all_inner_texts() == ["What if …", "Charts", "Story", "Numbers"]
    fields = "() => [...strikewave.page.controls.root.querySelectorAll('.field')].filter((f) => !f.hidden).length"
    assert tab.evaluate(fields) == 5
    tab.get_by_role("button", name="Save", exact=True).click()
    assert tab.locator(".takes .drop button").count() == 3
    with tab.expect_download() as saved:
        tab.get_by_role("button", name="Picture (PNG)").click()
    assert saved.value.suggested_filename == "strikewave-fixed-rod.png"
    assert tab.errors == []


def test_a_phone_has_all_of_it(opened):
    tab = opened(viewport=PHONE, has_touch=True, is_mobile=True)
    assert tab.evaluate("() => document.documentElement.scrollWidth") <= PHONE["width"]
    assert tab.evaluate("() => strikewave.page.root.dataset.size") == "phone"
    choose(tab, "mass_ratio", 2.0)
    assert tab.errors == []


def test_it_works_in_a_frame_that_may_only_run_scripts(browser, folder, served):
    """As course pages have it: without an origin of its own, where nothing can be kept."""
    address = f"{folder.name}/index.html?mass_ratio=2"
    frame = f'<iframe sandbox="allow-scripts" src="{address}" width="900" height="700"></iframe>'
    (folder.parent / "course.html").write_text(frame)
    tab = browser.new_page()
    tab.goto(served.replace(folder.name, "course.html"))
    inside = tab.frames[1]
    inside.wait_for_function("() => window.strikewave?.frames > 0", timeout=SECONDS)
    assert inside.evaluate("() => strikewave.page.frame.chosen.mass_ratio") == 2
    tab.close()


def changed(folder: Path, tmp_path: Path, name: str, content: bytes | None) -> str:
    """The same folder with another file, or without it."""
    copy = shutil.copytree(folder, tmp_path / "copy")
    if content is None:
        (copy / name).unlink()
    else:
        (copy / name).write_bytes(content)
    return copy.as_uri()


def kernels(module: bytes) -> bytes:
    return script("strikewaveKernels", module)


HEAD = b"\0asm\1\0\0\0"
# memory, `__heap_base`, a stack and a function `rod` of two pointers, two numbers and fourteen pointers, which traps
TRAP = (
    HEAD
    + b"\x01\x17\x01\x60\x12\x7f\x7f\x7c\x7c" + 14 * b"\x7f" + b"\x01\x7f"
    + b"\x03\x02\x01\x00" + b"\x05\x03\x01\x00\x10" + b"\x06\x07\x01\x7f\x00\x41\x80\x08\x0b"
    + b"\x07\x30\x04\x06memory\x02\x00\x0b__heap_base\x03\x00\x0f__stack_pointer\x03\x00\x03rod\x00\x00"
    + b"\x0a\x05\x01\x03\x00\x00\x0b"
)  # fmt: skip


@pytest.mark.parametrize(
    "name, content, said",
    [
        ("kernels.js", None, "kernels.js is missing or damaged"),
        ("kernels.js", b"globalThis.strikewaveKernels = 'none';", "kernels.js is missing or damaged"),
        ("kernels.js", kernels(b"no module"), "kernels.js is missing or damaged"),
        ("kernels.js", kernels(HEAD), "kernels.js is of another version"),
        ("kernels.js", lambda: kernels(signed(HEAD)), "kernels.js is missing or damaged"),
        ("kernels.js", lambda: kernels(signed(TRAP)), "The kernels of this page have failed at this impact"),
        ("scenes.js", None, "a file of its folder is missing or damaged"),
        ("scenes.js", b"globalThis.strikewavePacked = [3, 'H4sI'];", "a file of its folder is missing or damaged"),
        ("page.js", None, "a file of its folder is missing or damaged"),
    ],
)
def test_a_file_that_is_missing_or_damaged_is_said_in_one_sentence(opened, folder, tmp_path, name, content, said):
    content = content() if callable(content) else content  # to sign is to read all sources
    tab = opened(base=changed(folder, tmp_path, name, content), script=SAID)
    assert said in tab.evaluate(SAID)
    assert tab.locator("body").inner_text().strip() == tab.evaluate(SAID)


def test_kernels_that_trap_later_leave_what_is_shown(opened):
    tab = opened(before=TRAPPING)
    tab.evaluate("() => { window.trapping = true; }")
    choose(tab, "speed", 2.0)
    assert tab.evaluate("() => strikewave.page.model.speed") == 1
    (why,) = json.loads(tab.evaluate("() => strikewave.page.model.refused"))
    assert why["code"] == "offline.trap"
