"""`impact report`: the page that it writes, on one sheet of A4, and the one line of each refusal."""

import json
import re
import sys

import pytest

import solvers
from solvers.studies.report.study import study_report
from solvers.studies.study.plot import study_of

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


@pytest.fixture(scope="module")
def studies(tmp_path_factory):
    """Files of studies of one key, of two, of many that are drawn, and of words of which some are refused."""
    folder, law = tmp_path_factory.mktemp("studies"), "contact.stiffness"
    drawn = {law: "20%", "impactor.mass": "normal(2,0.05)", "impactor.velocity": "5%", "target.length": "5%"}
    words = {"impactor.mass": [0.5, 2, 8], "contact.law": ["rigid", "velvet"], "method.name": ["waves", "modal"]}
    for name, scene, vary, given in (
        ("one", "fixed-rod", {"impactor.mass": "0.5..8:16"}, {}),
        ("two", "docs/hammer.toml", {law: "5e4..1.6e6:9:log", "impactor.velocity": "0.5..3:6"}, {}),
        ("many", "docs/hammer.toml", drawn | {"target.section.height": "2%"}, {"points": 40}),
        ("words", "fixed-rod", words, {}),
    ):
        solvers.study(scene, vary, workers=1, out=folder / f"{name}.nc", **given)
    return folder


def test_a_study_is_reported_under_its_own_name(capsys, studies, monkeypatch):
    monkeypatch.chdir(studies)
    assert answer(capsys, "report", "two.nc") == "written: two.nc.html\n"
    page = (studies / "two.nc.html").read_text("utf-8")
    report = study_report(study_of("two.nc"), name="two.toml")
    assert page == report.html() and "impact study two.toml --vary " in page
    found = json.loads(answer(capsys, "report", "two.nc", "--figure", "impulse", "--out", "own.html", "--json"))
    assert found["out"] == "own.html" and found["figures"].keys() == {"impulse"}
    assert found["figures"]["impulse"] == report.table()["figures"]["impulse"]
    assert (found["points"], found["solved"], found["version"]) == (54, 54, report.version)


@pytest.mark.parametrize("options, said", [
    (("--tolerance", "impactor.mass=5%"), "--tolerance: got ['impactor.mass=5%']; allowed: nothing, as it goes with"),
    (("--set", "impactor.mass=3"), "--set: got ['impactor.mass=3']"),
    (("--method", "modal"), "--method: got 'modal'"),
    (("--points", "8"), "--points: got '8'"),
    (("--seed", "0"), "--seed: got '0'"),
    (("--workers", "2"), "--workers: got '2'"),
    (("--figure", "heat"), "--figure: got 'heat'; allowed: 'contacts'"),
    (("--page", "example.org"), "--page: got 'example.org'"),
    (("--out", "report.pdf"), "--out: got 'report.pdf'"),
    (("--out", "/nowhere/report.html"), "--out: got '/nowhere/report.html'"),
])  # fmt: skip
def test_what_does_not_go_with_a_study_is_refused_in_one_line(capsys, studies, options, said):
    assert said in refusal(capsys, "report", str(studies / "one.nc"), *options)


def test_what_is_no_study_is_refused_in_one_line(capsys, studies, tmp_path):
    (tmp_path / "other.nc").write_bytes(b"none")
    (tmp_path / "alone.csv").write_text("a,b\n1,2\n")
    solvers.solve("fixed-rod").dataset().to_netcdf(tmp_path / "solution.nc")
    for name in ("other.nc", "alone.csv", "solution.nc", "nowhere.nc", "nowhere.zarr", "nowhere.parquet"):
        assert "a file that a study has written" in refusal(capsys, "report", str(tmp_path / name)), name
    cut = tmp_path / "cut.csv"
    solvers.study("fixed-rod", {"impactor.mass": [1.0, 2.0]}, figures=["impulse"], workers=1, out=cut)
    cut.write_text("\n".join(cut.read_text().splitlines()[:2]) + "\n")
    assert "got '1 points'; allowed: all points of its design, 2" in refusal(capsys, "report", str(cut))


def test_without_matplotlib_a_study_has_no_page(capsys, studies, tmp_path, monkeypatch):
    monkeypatch.delitem(sys.modules, "solvers.notebook.pictures", raising=False)
    monkeypatch.delattr(solvers.notebook, "pictures", raising=False)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    out = tmp_path / "page.html"
    said = refusal(capsys, "report", str(studies / "one.nc"), "--out", str(out))
    assert "matplotlib beside it: pip install 'strikewave[plot]'" in said and not out.exists()


@pytest.mark.browser
@pytest.mark.parametrize("language", ["en", "es"])
@pytest.mark.parametrize("name", ["one", "two", "many", "words"])
def test_a_study_is_one_page_and_as_wide_as_its_window(browser, studies, monkeypatch, name, language):
    monkeypatch.setenv("IMPACT_LANGUAGE", language)
    tab = browser.new_page()
    _one_page(tab, name, study_report(study_of(str(studies / f"{name}.nc")), name=f"{name}.toml"))
    drawn = tab.locator("img").evaluate("each => each.naturalWidth * each.naturalHeight")
    assert drawn > 10_000
    tab.close()


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
