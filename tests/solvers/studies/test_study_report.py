"""The report of a study: its numbers are those of the Dataset, its lines find the same again, its text is escaped."""

import contextlib
import io
import shlex
import tomllib
from urllib.parse import parse_qs

import numpy as np
import pytest
from pytest import approx

import solvers
from app.command.main import main
from solvers import SceneError
from solvers.studies.study.plot import study_of
from solvers.text.catalogue import CHOSEN

from .test_report import HOSTILE, Rows, number

FIGURES = ["peak_force", "impulse", "contacts", "estimated_error"]


@pytest.fixture(scope="module")
def over_two():
    vary = {"impactor.mass": "0.5..8:7", "impactor.velocity": [1.0, 2.0]}
    return solvers.study("fixed-rod", vary, figures=FIGURES, workers=1)


@pytest.fixture(scope="module")
def refused_in_part():
    vary = {"impactor.mass": [0.5, 2.0], "contact.law": ["velvet", "rigid"], "method.name": ["waves", "modal"]}
    return solvers.study("fixed-rod", vary, figures=FIGURES, workers=1)


def test_least_median_and_largest_are_those_of_the_arrays_and_stand_where_they_are(over_two):
    report = solvers.report(over_two)
    assert [each.name for each in report.reaches] == ["peak_force", "impulse", "contacts"]
    rows = {row[0]: row[1:] for row in Rows(report.html()).rows}
    for each, named in zip(report.reaches[:2], ("peak force", "impulse"), strict=True):
        values = over_two[each.name]
        known = sorted(values.values.ravel())
        assert (each.least.value, each.largest.value) == (known[0], known[-1])
        assert each.median.value == known[6]  # of fourteen the lower one of two
        for end, cell in zip((each.least, each.median, each.largest), rows[named], strict=True):
            assert float(values.sel(end.at)) == end.value
            size, _, place = cell.partition(f"{each.unit} ")
            assert number(f"{size}{each.unit}", each.unit) == approx(end.value, rel=1e-5)
            assert place == f"mass {end.at['impactor.mass']:g}, velocity {end.at['impactor.velocity']:g}"


def test_what_is_varied_stands_with_range_unit_and_count(over_two):
    rows = [row for row in Rows(solvers.report(over_two).html()).rows if row and row[0].startswith("impactor.")]
    assert rows == [
        ["impactor.mass", "mass", "0.5 … 8 kg", "7 values"],
        ["impactor.velocity", "velocity", "1 … 2 m/s", "2 values"],
    ]
    keys = {each.key for each in solvers.report(over_two).inputs}
    assert "target.length" in keys and not keys & {"impactor.mass", "impactor.velocity", ""}  # nor what follows


def test_error_is_that_of_the_methods_where_it_stands(over_two):
    report = solvers.report(over_two)
    assert report.error.largest.value == float(over_two.estimated_error.max())
    assert "as the methods estimate it" in report.html()
    without = solvers.report(solvers.study("fixed-rod", {"impactor.mass": [1.0]}, figures=["impulse"], workers=1))
    assert without.error is None and "No estimate of the errors" in without.html()


def test_refusals_and_notes_stand_once_each_with_their_count_and_first_point(refused_in_part):
    report = solvers.report(refused_in_part)
    (refusal,) = report.refusals
    first = {"impactor.mass": 0.5, "contact.law": "velvet", "method.name": "waves"}
    assert (refusal.points, refusal.at) == (4, first)
    assert refusal.said == str(refused_in_part.reason.sel(first).values)
    for note in report.notes:
        codes = refused_in_part.notes.sel(note.at).item()
        assert note.code in codes.split()
        assert note.points == sum(note.code in each.split() for each in refused_in_part.notes.values.ravel())
    said = " ".join(" ".join(Rows(report.html()).said).split())
    assert f"4 points, the first at mass 0.5, law velvet, method waves: {refusal.said}" in said
    assert len(report.notes) >= 2 and all(note.said in said for note in report.notes)
    assert "4 solved, 4 refused" in said


def test_methods_and_laws_are_those_that_solve_it(refused_in_part, over_two):
    report = solvers.report(refused_in_part)
    assert [each["name"] for each in report.methods] == ["waves", "modal"] and report.laws == ["rigid"]
    assert report.why == "varied" and "It is varied." in report.html()
    assert (solvers.report(over_two).why, solvers.report(over_two).methods[0]["name"]) == ("usual", "waves")
    asked = solvers.study(
        "fixed-rod", {"impactor.mass": [1.0, 2.0]}, method=solvers.Modal(modes=7), figures=["impulse"], workers=1
    )
    report = solvers.report(asked)
    assert report.why == "asked" and "modal, modes 7" in report.html()
    assert tomllib.loads(report.toml)["method"]["modes"] == 7


def test_where_no_point_is_solved_it_says_so(over_two):
    none = over_two.copy(deep=True)
    for name in FIGURES:
        none[name][:] = np.nan
    none["refused"][:], none["reason"][:], none["notes"][:] = "allowed.choice", HOSTILE, ""
    report = solvers.report(none)
    found = Rows(report.html())
    assert "No point is solved: 14 of 14 are refused." in " ".join(found.said)
    assert HOSTILE in " ".join(found.said) and not {"script", "img"} & {tag for tag, _ in found.tags}
    assert report.table()["figures"] == {} and report.picture() is None


def test_what_a_scene_says_is_escaped_and_a_page_needs_nothing_else(over_two):
    scene = solvers.load("fixed-rod").replace({"title": HOSTILE})
    data = solvers.study(scene, {"impactor.mass": [1.0, 2.0]}, figures=["impulse"], workers=1)
    page = solvers.report(data).html()
    found = Rows(page)
    assert "script" not in {tag for tag, _ in found.tags} and HOSTILE in " ".join(found.said)
    sources = [value for _, given in found.tags for key, value in given.items() if key in ("src", "href")]
    assert len(sources) == 2 and all(each.startswith("data:") for each in sources)
    assert page == solvers.report(data).html()  # it holds no date: the same again


DRAWN = {"impactor.mass": "5%", "target.length": "normal(0.3, 0.01)"}
PAIRS = {("target.section.width", "target.section.height"): [(0.03, 0.02), (0.02, 0.03)]}


@pytest.mark.parametrize("given", [
    {"vary": {"impactor.mass": "0.5..50:9:log", "target.length": [0.3, 0.5]}},
    {"vary": {"impactor.mass": [0.5, 2, 3.7], "method.name": ["waves", "modal"]}, "notes": False},
    {"vary": PAIRS, "method": solvers.Modal(modes=7), "figures": ["impulse", "newton"]},
    {"vary": {"method": [{"name": "waves"}, {"name": "modal", "modes": 20}]}},
    {"vary": {"method.modes": "5..9:5"}, "method": None, "scene": "hammer-on-cantilever"},
    {"vary": DRAWN, "points": 20, "seed": 3, "sample": "sobol"},
    {"vary": {"impactor.mass,target.length": "5%", "impactor.velocity": "1..2"}, "points": 8},
    {"vary": {"target.material.young": "1e11..2e11:3"}, "scene": "drop-test"},
])  # fmt: skip
def test_command_and_python_lines_find_the_same_numbers(given, tmp_path, monkeypatch):
    scene = given.pop("scene", "fixed-rod") if "scene" in given else "fixed-rod"
    data = solvers.study(scene, workers=1, **given)
    report = solvers.report(data)
    monkeypatch.chdir(tmp_path)
    (tmp_path / report.file).write_text(report.toml)
    study, page = report.command.splitlines()
    with contextlib.redirect_stdout(io.StringIO()):
        assert main(shlex.split(study)[1:]) == main(shlex.split(page)[1:]) == 0
    known: dict = {}
    exec(report.python, known)
    assert (tmp_path / "report.html").is_file() and (tmp_path / "scene.nc.html").is_file()
    for again in (study_of("scene.nc"), known["study"]):
        for name in data.attrs["figures"].split():
            np.testing.assert_array_equal(again[name].values, data[name].values)


def test_what_has_no_words_has_no_command():
    from scipy import stats

    data = solvers.study("fixed-rod", {"impactor.mass": stats.norm(2.0, 0.1)}, points=4, figures=["impulse"], workers=1)
    assert solvers.report(data).command is None and "no words for the command" in solvers.report(data).html()
    pairs = solvers.uncertain("fixed-rod", {"impactor.mass": "5%"}, ["impulse"], points=8, workers=1).dataset
    assert solvers.report(pairs).command is None


def test_fingerprint_and_link(over_two):
    report = solvers.report(over_two, page="https://example.org/strikewave/")
    vary = {"impactor.mass": "0.5..8:7", "impactor.velocity": [1, 2]}
    again = solvers.report(solvers.study("fixed-rod", vary, figures=FIGURES, workers=1))
    assert report.fingerprint == again.fingerprint and len(report.fingerprint) == 12
    other = solvers.study("fixed-rod", vary | {"impactor.velocity": [1, 3]}, figures=FIGURES, workers=1)
    assert solvers.report(other).fingerprint != report.fingerprint
    assert parse_qs(report.query.removeprefix("?")) == {"scene": ["fixed-rod"]}
    assert "href='https://example.org/strikewave/?scene=fixed-rod'" in report.html()


@pytest.mark.parametrize("ending", [".nc", ".zarr", ".parquet", ".csv"])
def test_it_is_the_same_of_every_kind_of_file(over_two, tmp_path, ending):
    path = tmp_path / f"study{ending}"
    vary = {"impactor.mass": "0.5..8:7", "impactor.velocity": [1.0, 2.0]}
    solvers.study("fixed-rod", vary, figures=FIGURES, workers=1, out=path)
    assert solvers.report(study_of(str(path))).table() == solvers.report(over_two).table()


def test_figures_are_shown_as_they_are_named_and_others_are_named(over_two):
    assert [each.name for each in solvers.report(over_two, figures=["impulse"]).reaches] == ["impulse"]
    usual = solvers.report(solvers.study("fixed-rod", {"impactor.mass": [1.0, 2.0]}, workers=1))
    assert "contacts" in {each.name for each in usual.reaches} and "momentum_error" in usual.more
    assert "dissipated" not in {each.name for each in usual.reaches}  # which is zero throughout


@pytest.mark.parametrize("given, key", [
    ({"tolerances": {"impactor.mass": "5%"}}, "tolerances"), ({"method": "modal"}, "method"), ({"seed": 1}, "seed"),
    ({"changes": {"impactor.mass": 1.0}}, "changes"), ({"points": 8}, "points"), ({"workers": 1}, "workers"),
    ({"figures": ["heat"]}, "figures"), ({"figures": "impulse"}, "figures"), ({"page": "example.org"}, "page"),
])  # fmt: skip
def test_what_cannot_be_is_refused_by_key(over_two, given, key):
    with pytest.raises(SceneError) as refused:
        solvers.report(over_two, **given)
    assert refused.value.key == key


def test_what_is_no_whole_study_is_refused(over_two):
    solution = solvers.solve("fixed-rod").dataset()
    for data in (solution, over_two.isel({"impactor.mass": slice(3)}), over_two.drop_vars("refused")):
        with pytest.raises(SceneError, match="study: got"):
            solvers.report(data)


def test_it_speaks_spanish(over_two, monkeypatch):
    monkeypatch.setenv(CHOSEN, "es")
    page = solvers.report(over_two).html()
    assert "Informe de estudio" in page and "Qué se varía" in page and "mediana" in page


def test_a_full_disk_leaves_what_was_there(over_two, tmp_path, monkeypatch):
    path = tmp_path / "report.html"
    path.write_text("before")

    def full(*_):
        raise OSError(28, "No space left on device")

    report = solvers.report(over_two)
    monkeypatch.setattr("pathlib.Path.replace", full)
    with pytest.raises(OSError, match="No space"):
        report.save(path)
    assert path.read_text() == "before" and list(tmp_path.iterdir()) == [path]
