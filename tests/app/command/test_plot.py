"""`impact plot`: the page that it writes, and the one line of each refusal."""

import re
import sys

import pytest

import solvers
from app.command.plot import KINDS
from solvers.notebook import study_plots

from .calls import answer, refusal


@pytest.fixture(scope="module")
def map_of(tmp_path_factory):
    path = tmp_path_factory.mktemp("plot") / "map.nc"
    vary = {"impactor.mass": [1.0, 2.0, 3.0], "impactor.velocity": [1.0, 2.0]}
    solvers.study("fixed-rod", vary, figures=["peak_force", "impulse"], notes=False, workers=1, out=path)
    return str(path)


def test_a_page_that_needs_nothing_else(capsys, map_of, tmp_path):
    assert answer(capsys, "plot", map_of) == f"written: {map_of}.html\n"
    out = tmp_path / "own.html"
    answer(capsys, "plot", map_of, "--figure", "impulse", "--x", "impactor.velocity", "--out", str(out))
    page = out.read_text("utf-8")
    assert "impulse" in page and "impactor.velocity" in page and "<meta charset='utf-8'>" in page
    assert re.findall(r"<(?:script|link|img)\b[^>]*\b(?:src|href)=", page) == []


def test_pictures_without_a_page(capsys, map_of, tmp_path):
    for kind, ending, begin in (("map", "png", b"\x89PNG"), ("matrix", "svg", b"<?xml"), ("points", "svg", b"<?xml")):
        out = tmp_path / f"{kind}.{ending}"
        assert answer(capsys, "plot", map_of, "--kind", kind, "--out", str(out)) == f"written: {out}\n"
        assert out.read_bytes().startswith(begin)
    page = tmp_path / "matrix.html"
    answer(capsys, "plot", map_of, "--kind", "matrix", "--out", str(page))
    assert "figures over keys" in page.read_text("utf-8")


def test_a_full_disk_leaves_what_was_there(capsys, map_of, tmp_path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.replace", full)
    for name in ("map.html", "map.svg"):
        out = tmp_path / name
        out.write_text("before")
        assert "No space left" in refusal(capsys, "plot", map_of, "--out", str(out))
        assert out.read_text() == "before"
    assert len(list(tmp_path.iterdir())) == 2


def test_without_matplotlib_a_picture_is_refused_and_a_page_is_written(capsys, map_of, tmp_path, monkeypatch):
    monkeypatch.delitem(sys.modules, "solvers.notebook.pictures", raising=False)
    monkeypatch.delattr(solvers.notebook, "pictures", raising=False)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    said = refusal(capsys, "plot", map_of, "--out", str(tmp_path / "map.svg"))
    assert "a name that ends in .html, as PNG and SVG need matplotlib: pip install 'strikewave[plot]'" in said
    answer(capsys, "plot", map_of, "--out", str(tmp_path / "map.html"))


def test_kinds_are_those_of_the_library():
    assert KINDS == study_plots.KINDS


def test_each_refusal_is_one_line(capsys, map_of, tmp_path):
    other = tmp_path / "other.nc"
    other.write_bytes(b"none")
    for options, said in (
        ((map_of, "--out", "map.pdf"), "--out: got 'map.pdf'; allowed: the name of a file that ends in .html or .png"),
        ((map_of, "--out", "/nowhere/map.html"), "--out: got '/nowhere/map.html'"),
        ((map_of, "--out", "/nowhere/map.svg"), "--out: got '/nowhere/map.svg'"),
        ((map_of, "--kind", "pie"), "--kind: got 'pie'; allowed: 'curves', 'map', 'points'"),
        ((map_of, "--kind", "bars"), "--kind: got 'bars'; allowed: another kind: bars need at least 10 points"),
        (
            (map_of, "--kind", "matrix", "--x", "impactor.mass"),
            "--x: got 'impactor.mass'; allowed: nothing",
        ),
        ((map_of, "--figure", "heat"), "--figure: got 'heat'"),
        ((map_of, "--x", "heat"), "--x: got 'heat'"),
        ((map_of, "--x", "impactor.mass", "--y", "impactor.mass"), "--y: got 'impactor.mass'"),
        ((str(tmp_path / "none.nc"),), "a file that a study has written"),
        ((str(other),), "a file that a study has written"),
        (("map.toml",), "file: got 'map.toml'"),
    ):
        assert said in refusal(capsys, "plot", *options)
