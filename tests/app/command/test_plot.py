"""`impact plot`: the page that it writes, and the one line of each refusal."""

import re

import pytest

import solvers

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


def test_each_refusal_is_one_line(capsys, map_of, tmp_path):
    other = tmp_path / "other.nc"
    other.write_bytes(b"none")
    for options, said in (
        ((map_of, "--out", "map.png"), "--out: got 'map.png'; allowed: the name of a file that ends in .html"),
        ((map_of, "--out", "map.svg"), "ends in .html"),
        ((map_of, "--out", "/nowhere/map.html"), "--out: got '/nowhere/map.html'"),
        ((map_of, "--figure", "heat"), "--figure: got 'heat'"),
        ((map_of, "--x", "heat"), "--x: got 'heat'"),
        ((map_of, "--x", "impactor.mass", "--y", "impactor.mass"), "--y: got 'impactor.mass'"),
        ((str(tmp_path / "none.nc"),), "a file that a study has written"),
        ((str(other),), "a file that a study has written"),
        (("map.toml",), "file: got 'map.toml'"),
    ):
        assert said in refusal(capsys, "plot", *options)
