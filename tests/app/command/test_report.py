"""`impact report`: the page that it writes, on one sheet of A4, and the one line of each refusal."""

import json
import re

import pytest

import solvers

from .calls import answer, refusal

PAGES = re.compile(rb"/Type\s*/Page\b")
WIDTHS = (390, 794)  # px of a telephone and of A4


def test_it_writes_where_it_is_asked_to_in_place_of_what_is_there(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert answer(capsys, "report", "fixed-rod") == "written: fixed-rod.html\n"
    page = (tmp_path / "fixed-rod.html").read_text("utf-8")
    assert page == solvers.report("fixed-rod").html()
    out = tmp_path / "own.html"
    out.write_text("before")
    answer(capsys, "report", "fixed-rod", "--set", "impactor.mass=3", "--figure", "impulse", "--out", str(out))
    solution = solvers.solve(solvers.load("fixed-rod").replace({"impactor.mass": 3}))
    assert f"{solution.impulse:.6g} N s" in out.read_text("utf-8") and "peak stress" not in out.read_text("utf-8")


def test_a_scene_file_is_named_without_its_folder(capsys, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(solvers.to_toml("fixed-rod"))
    assert answer(capsys, "report", str(path)) == f"written: {path}.html\n"
    page = (tmp_path / "mine.toml.html").read_text("utf-8")
    assert "impact report mine.toml" in page and str(tmp_path) not in page


def test_json_has_all_that_is_in_it(capsys, tmp_path):
    out = str(tmp_path / "report.html")
    options = ("--tolerance", "impactor.velocity=5%", "--points", "8", "--workers", "1", "--out", out, "--json")
    found = json.loads(answer(capsys, "report", "fixed-rod", *options))
    assert found["out"] == out and found["link"] == "?scene=fixed-rod"
    assert found["figures"]["peak_force"]["value"] == solvers.solve("fixed-rod").peak_force
    assert found["figures"]["peak_force"]["spread"]["samples"] == 8
    assert {each["key"] for each in found["inputs"] if each["tolerance"]} == {"impactor.velocity"}
    assert len(found["notes"]) == len(found["note_codes"]) > 0


@pytest.mark.parametrize("options, said", [
    (("--out", "report.pdf"), "--out: got 'report.pdf'; allowed: the name of a file that ends in .html"),
    (("--out", "/nowhere/report.html"), "--out: got '/nowhere/report.html'; allowed: a file in a folder that is there"),
    (("--figure", "heat"), "--figure: got 'heat'"),
    (("--tolerance", "impactor.mass"), "--tolerance: got 'impactor.mass'"),
    (("--tolerance", "impactor.mass=broad"), "impactor.mass"),
    (("--page", "example.org"), "--page: got 'example.org'; allowed: the address of a page"),
    (("--points", "many"), "--points: got 'many'; allowed: a whole number"),
    (("--method", "guess"), "method.name: got 'guess'"),
    (("--set", "contact.law=velvet"), "contact.law: got 'velvet'"),
])  # fmt: skip
def test_each_refusal_is_one_line(capsys, options, said):
    assert said in refusal(capsys, "report", "fixed-rod", *options)


def test_what_is_no_scene_or_has_no_spread_is_refused(capsys):
    assert "scene: got 'nowhere'" in refusal(capsys, "report", "nowhere")
    assert "bodies on an axis" in refusal(capsys, "report", "brick-off-centre", "--tolerance", "impactor.mass=5%")


@pytest.mark.browser
@pytest.mark.slow
def test_every_built_in_scene_is_one_page_and_as_wide_as_its_window(browser):
    tab = browser.new_page()
    for name in solvers.scene_names():
        _one_page(tab, name, solvers.report(name))
    tab.close()


@pytest.mark.browser
@pytest.mark.parametrize("language", ["en", "es"])
def test_so_is_one_with_tolerances_and_a_link_that_holds_the_scene(browser, monkeypatch, language):
    monkeypatch.setenv("IMPACT_LANGUAGE", language)
    tolerances = {
        "impactor.velocity": "5%",
        "contact.stiffness": "10%",
        "target.section.height": "normal(0.02, 0.0002)",
    }
    scene = solvers.load("hammer-on-cantilever").replace({"impactor.mass": 0.6})
    tab = browser.new_page()
    _one_page(tab, language, solvers.report(scene, tolerances, points=8, workers=1))
    tab.close()


def _one_page(tab, name, report):
    tab.set_content(report.html())
    assert len(PAGES.findall(tab.pdf(prefer_css_page_size=True))) == 1, name
    for width in WIDTHS:
        tab.set_viewport_size({"width": width, "height": 800})
        assert tab.evaluate("document.documentElement.scrollWidth") <= width, (name, width)
        cells = "[...document.querySelectorAll('td, th, dd, li, p')]"
        cut = f"{cells}.filter(each => each.scrollWidth > each.clientWidth + 1)"
        assert tab.evaluate(f"{cut}.map(each => each.textContent)") == [], (name, width)
