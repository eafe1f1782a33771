"""PNG and SVG of studies: what stands in them, and that the caller's Matplotlib is as it was."""

import subprocess
import sys
from html import unescape
from xml.etree import ElementTree

import holoviews as hv
import matplotlib
import numpy as np
import pytest
from matplotlib import pyplot

import solvers
from solvers import SceneError, plot_study

from ...patience import SECONDS
from .test_plot_study import rod

VARY = {"impactor.mass": "0.1..10:9:log", "impactor.velocity": [-0.5, 1.0, 2.0]}


@pytest.fixture(scope="module")
def found():
    return rod(VARY)


def words(path) -> set[str]:
    """What Matplotlib writes as outlines: the words stand beside them as comments."""
    parser = ElementTree.XMLParser(target=ElementTree.TreeBuilder(insert_comments=True))
    return {str(each.text).strip() for each in ElementTree.parse(path, parser).iter(ElementTree.Comment)}


def colours(path) -> np.ndarray:
    """Of a PNG (rows, columns, 3), from 0 to 1."""
    return pyplot.imread(path)[..., :3]


def test_a_map_as_svg_has_axes_with_units_and_a_legend(found, tmp_path):
    drawn = plot_study(found, "peak_force", out=tmp_path / "map.svg")
    assert isinstance(drawn, hv.Overlay)
    said = words(tmp_path / "map.svg")
    assert {"impactor.mass (kg)", "impactor.velocity (m/s)", "peak force (N)"} <= said
    assert {"other number of contacts", "refused"} <= said
    again = tmp_path / "again.svg"
    plot_study(found, "peak_force", out=str(again))
    assert again.read_bytes() == (tmp_path / "map.svg").read_bytes()


def test_a_map_as_png_has_red_borders_white_contours_and_a_light_ground(found, tmp_path):
    plot_study(found, "peak_force", out=tmp_path / "map.png")
    shown = colours(tmp_path / "map.png")
    assert shown.shape[1] > 1_000
    np.testing.assert_array_equal(shown[0], 1.0)
    red = (shown[..., 0] > 0.99) & (shown[..., 1:].max(-1) < 0.01)
    assert red.sum() > 500


def test_a_curve_has_named_axes_beside_the_lines_where_contacts_change(tmp_path):
    plot_study(rod({"impactor.mass": "0.1..10:13:log"}), "peak_force", out=tmp_path / "curve.svg")
    said = words(tmp_path / "curve.svg")
    assert {"impactor.mass (kg)", "peak force (N)"} <= said
    assert not {"x", "y"} & said


@pytest.mark.parametrize("kind", ["points", "matrix", "parallel", "bars"])
def test_each_kind_is_drawn(kind, found, tmp_path):
    plot_study(found, "peak_force", kind=kind, out=tmp_path / "own.svg")
    said = words(tmp_path / "own.svg")
    named = {"impactor.mass", "impactor.velocity"} if kind == "bars" else {"peak force (N)"}
    assert named <= said
    assert any("Steel rod" in each for each in said)


def test_many_marks_are_pixels_within_an_svg(tmp_path):
    found = rod({"impactor.mass": np.linspace(1.0, 2.0, 60), "impactor.velocity": np.linspace(1.0, 2.0, 60)})
    plot_study(found, "peak_force", out=tmp_path / "map.svg")
    assert "<image" in (tmp_path / "map.svg").read_text("utf-8")
    assert (tmp_path / "map.svg").stat().st_size < 300_000


def test_the_caller_finds_matplotlib_and_holoviews_as_they_were(found, tmp_path, monkeypatch):
    plot_study(found, out=tmp_path / "first.png")  # loads what HoloViews changes once
    monkeypatch.setattr(pyplot, "figure", lambda *_, **__: pytest.fail("a window"))
    before, backend = matplotlib.rcParams.copy(), matplotlib.get_backend(auto_select=False)
    current = hv.Store.current_backend
    for interactive in (True, False):
        matplotlib.interactive(interactive)
        before["interactive"] = interactive
        plot_study(found, out=tmp_path / "map.png")
        plot_study(found, kind="matrix", out=tmp_path / "map.png")
        assert matplotlib.rcParams == before
    assert matplotlib.get_backend(auto_select=False) == backend
    assert hv.Store.current_backend == current
    assert pyplot.get_fignums() == []


def test_the_usual_pictures_are_as_before_once_matplotlib_is_loaded(found, tmp_path):
    plot_study(found, out=tmp_path / "map.png")
    figure = hv.render(plot_study(found, "peak_force"), backend="bokeh")
    assert figure.xaxis[0].axis_label == "impactor.mass (kg)"
    assert figure.width == 950
    curve = solvers.solve(solvers.load("fixed-rod")).plot("force")
    assert hv.render(curve, backend="bokeh").width == 700


def test_without_matplotlib_the_sentence_names_the_extra_and_nothing_loads_it():
    call = (
        "import sys; sys.modules['matplotlib'] = None\n"
        "import solvers\n"
        "data = solvers.study('fixed-rod', {'impactor.mass': [1.0, 2.0]}, figures=['impulse'], workers=1)\n"
        "solvers.plot_study(data)\n"
        "try:\n    solvers.plot_study(data, out='map.svg')\n"
        "except ImportError as error:\n    print(error)\n"
    )
    done = subprocess.run([sys.executable, "-c", call], capture_output=True, text=True, timeout=SECONDS)
    assert done.stdout == "PNG and SVG need matplotlib: pip install 'strikewave[plot]'\n", done.stderr


def test_refusals(found, tmp_path):
    with pytest.raises(SceneError, match=r"out: got 'map\.pdf'; allowed: the name of a file that ends in .*png"):
        plot_study(found, out="map.pdf")
    with pytest.raises(SceneError, match=r"out: .*; allowed: a file in a folder that is there"):
        plot_study(found, out=tmp_path / "nowhere" / "map.svg")
    with pytest.raises(SceneError, match="figure: got 'heat'"):
        plot_study(found, "heat", out=tmp_path / "map.svg")
    assert not (tmp_path / "map.svg").exists()


TITLES = ["from $5 to $6", "$x^2_$ and $\\frac{$", "<b>&' \\n {0} %s", "\U0001f528 \u202e\u0645 \u6f22"]
KINDS = ["map", "curves", "points", "parallel", "matrix", "bars"]


@pytest.mark.parametrize(
    ("title", "kind"), [*((title, "map") for title in TITLES), *((TITLES[1], kind) for kind in KINDS[1:])]
)
def test_titles_stand_as_they_are_written(found, tmp_path, title, kind, recwarn):
    scene = f"title = '''{title}'''\n" + found.attrs["scene"].split("\n", 1)[1]
    plot_study(found.assign_attrs(scene=scene), "peak_force", kind=kind, out=tmp_path / "it.svg")
    assert any(unescape(each).startswith(title.split(" and")[0]) for each in words(tmp_path / "it.svg"))
    assert not [each for each in recwarn if "Glyph" in str(each.message)]
