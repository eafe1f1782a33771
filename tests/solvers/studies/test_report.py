"""The report of one impact: its numbers are those of the solution, its errors hold, its text is escaped."""

import base64
import json
import math
import re
import shlex
import tomllib
from html.parser import HTMLParser
from urllib.parse import parse_qs
from xml.etree import ElementTree

import numpy as np
import pytest
from pytest import approx

import solvers
from app.choices.own import own_scene
from app.command.main import main
from solvers import SceneError
from solvers.methods import METHODS
from solvers.notebook.sheet_pictures import colours, png, scaled
from solvers.studies.figures import FIGURES
from solvers.text.catalogue import CHOSEN, library

HOSTILE = "<script>alert('&')</script>\"><img src=x onerror=alert(1)>"
SHORT = "'><img src=x onerror=alert(1)>"  # of a link, whose name has few letters
PREFIX = {"n": 1e-9, "µ": 1e-6, "m": 1e-3, "k": 1e3, "M": 1e6, "G": 1e9}
RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-")


class Rows(HTMLParser):
    """Texts of all rows of tables, and all tags with their attributes."""

    def __init__(self, page: str):
        super().__init__()
        self.rows: list[list[str]] = []
        self.tags: list[tuple[str, dict]] = []
        self.said: list[str] = []
        self.inside = ""  # the cell, or the style, that is open
        self.feed(page)

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))
        if tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.rows[-1].append("")
        self.inside = tag if tag in ("td", "th", "style") else self.inside

    def handle_endtag(self, tag):
        self.inside = "" if tag == self.inside else self.inside

    def handle_data(self, data):
        if self.inside != "style":
            self.said.append(data)
        if self.inside in ("td", "th"):
            self.rows[-1][-1] += data


def number(cell: str, unit: str) -> float:
    """In SI units, of a cell with a number and a unit that may have a prefix."""
    said = cell.removeprefix("± ").split(" (")[0]
    digits, _, given = said.partition(" ")
    power = re.fullmatch(r"(.*)·10(.*)", digits)
    value = float(f"{power[1]}e{power[2]}".translate(RAISED)) if power else float(digits.translate(RAISED))
    return value * (PREFIX[given[0]] if given != unit and given[1:] == unit else 1.0)


def figures_in(report) -> dict[str, list[str]]:
    """Cells of the rows of figures, by their plain names."""
    rows = Rows(report.html()).rows
    return {row[0]: row[1:] for row in rows}


@pytest.fixture(scope="module")
def of_hammer():
    return solvers.report("hammer-on-cantilever")


@pytest.fixture(scope="module")
def within():
    tolerances = {"impactor.velocity": "5%", "contact.stiffness": "10%"}
    return solvers.report("hammer-on-cantilever", tolerances, points=16, workers=1)


@pytest.mark.parametrize("name", ["fixed-rod", "hammer-on-cantilever", "stiff-contact", "drop-test"])
def test_its_numbers_are_those_of_solve(name):
    report, solution = solvers.report(name), solvers.solve(name)
    rows, names = figures_in(report), library("en").family("printed.quantity")
    assert {each.name for each in report.numbers} >= {"impactor_velocity", "peak_force", "contact_time"}
    for each in report.numbers:
        unit, figure = FIGURES[each.name]
        assert each.value == figure(solution)
        assert number(rows[names[each.name]][0], unit) == approx(figure(solution), rel=1e-5)  # six digits are shown
        if each.error and each.error > 1e-9 * abs(each.value):
            assert number(rows[names[each.name]][1], unit) == approx(each.error, rel=0.06)  # two


@pytest.mark.parametrize(
    "name, method",
    [
        ("fixed-rod", solvers.Modal(modes=20)),
        ("fixed-rod", solvers.FeModal(elements=50)),
        ("bronze-rod-steel-ball", solvers.Modal(modes=20)),
        ("bronze-rod-steel-ball", solvers.FeNodal(elements=50)),
        ("fixed-rod", solvers.FeNodal(elements=50)),
    ],
)
def test_its_errors_hold_against_exact_waves(name, method):
    """But for largest stresses behind steep fronts, of which a note warns."""
    report, exact = solvers.report(name, method=method), solvers.solve(name, "waves")
    known = [each for each in report.numbers if each.name in ("impulse", "impactor_velocity", "newton", "contact_time")]
    assert len(known) == 4
    for each in known:
        true = FIGURES[each.name][1](exact)
        assert each.error is not None and abs(each.value - true) <= 3.0 * each.error, each
        assert each.error < 0.5 * abs(true)  # and they say something


def test_ripples_behind_a_front_are_no_error_that_a_finer_mesh_shows():
    """Of two rods that meet 23 % in the force, and of twice the elements the same 23 %."""
    report = solvers.report("two-equal-rods", method=solvers.FeModal(elements=40))
    force = next(each for each in report.numbers if each.name == "peak_force")
    assert abs(force.finer - force.value) < 1e-3 * force.value
    assert force.value > 1.2 * solvers.solve("two-equal-rods").peak_force
    assert force.error is None and figures_in(report)["peak force"][1] == "see the warnings"
    assert any("ripple behind a front" in str(note) for note in report.notes)


@pytest.mark.parametrize("name", ["figure-8.10", "figure-5.12", "figure-6.3"])
def test_what_is_ill_conditioned_has_no_error_but_that_of_the_velocity(name):
    known = {each.name for each in solvers.report(name).numbers if each.error is not None}
    assert known == {"impactor_velocity"}


def test_an_error_is_that_of_twice_the_modes(of_hammer):
    finer = solvers.solve("hammer-on-cantilever", modes=40)
    force = next(each for each in of_hammer.numbers if each.name == "peak_force")
    assert force.error == approx(2.0 * abs(finer.peak_force - of_hammer.solution.peak_force), rel=1e-12)
    assert "twice as many modes" in of_hammer.html()
    velocity = next(each for each in of_hammer.numbers if each.name == "impactor_velocity")
    assert velocity.error == of_hammer.solution.diagnostics["estimated_error"] * of_hammer.scene.speed


@pytest.mark.parametrize("impactor", [
    {"kind": "rod", "length": 0.3, "section": {"radius": 0.01}},
    {"kind": "beam", "length": 0.3, "section": {"width": 0.02, "height": 0.01}, "at": 0.5},
    {"kind": "beam", "length": 0.3, "section": {"width": 0.02, "height": 0.01}, "at": 1.0},
    {"kind": "mass", "mass": 0.5},
])  # fmt: skip
def test_impulse_and_restitution_are_as_uncertain_as_the_velocity_they_follow_from(impactor):
    tables = solvers.load("docs/hammer.toml").table()
    steel = {} if impactor["kind"] == "mass" else {"material": "steel"}
    found = solvers.report(solvers.Scene.from_table(tables | {"impactor": impactor | steel | {"velocity": 1.0}}))
    errors = {each.name: each.error for each in found.numbers}
    velocity, mass = errors["impactor_velocity"], found.scene.impactor.mass
    assert velocity > 0.0
    assert errors["impulse"] >= mass * velocity * (1.0 - 1e-9)
    assert errors["newton"] >= velocity * (1.0 - 1e-9)  # at 1 m/s


def test_what_no_solution_is_finer_than_has_no_error_and_says_so():
    report = solvers.report("drop-test")
    assert {each.error for each in report.numbers} == {None}
    assert "no finer solution" in report.html() and figures_in(report)["peak force"][1] == "not known"


def test_tolerances_stand_at_their_inputs_and_spread_beside_figures(within):
    own = solvers.uncertain(
        "hammer-on-cantilever",
        {"impactor.velocity": "5%", "contact.stiffness": "10%"},
        ["peak_force", "impulse"],
        points=16,
        workers=1,
    )
    assert within.uncertain.figures["peak_force"] == own.figures["peak_force"]
    rows = figures_in(within)
    low, high = (own.figures["impulse"].quantiles[part] for part in (5, 95))
    assert rows["impulse"][2] == f"{low:.4g} … {high:.4g} N s"
    assert rows["impulse"][3].startswith(f"{own.figures['impulse'].ranking[0]}, ")
    by_key = {each.key: each for each in within.inputs}
    assert by_key["impactor.velocity"].tolerance and by_key["contact.stiffness"].tolerance
    assert by_key["contact.stiffness"].follows and not by_key["target.length"].tolerance
    assert "± 5 %, evenly" in within.html() and "± 10 %, evenly" in within.html()


def test_one_side_of_a_section_with_a_tolerance_stands_apart_by_its_name():
    laws = {"target.section.height": "normal(0.02, 0.0002)"}
    report = solvers.report("hammer-on-cantilever", laws, ["impulse"], points=8, workers=1)
    rows = [row for row in Rows(report.html()).rows if row and row[0].startswith("section")]
    assert rows[0][:3] == ["section", "section", "width 0.03 m"]
    assert rows[1] == ["section.height", "height", "0.02 m", "normal(0.02, 0.0002)"]


def test_inputs_have_units_and_what_follows_from_them(of_hammer):
    values = {(each.key, one.name): (one.value, one.unit) for each in of_hammer.inputs for one in each.values}
    scene = of_hammer.scene
    assert values["impactor.mass", "mass"] == (scene.impactor.mass, "kg")
    assert values["target.section", "height"] == (0.02, "m")
    assert values["target.material", "yield"] == (400e6, "Pa")
    assert values["contact.stiffness", "stiffness"] == (scene.contact.stiffness, "N/m^1.5")
    assert values["", "approach"] == (scene.speed, "m/s")
    assert values["", "mass"] == (scene.target.mass, "kg")
    steel = {one.name: one.value for each in solvers.report("fixed-rod").inputs for one in each.values}
    assert (steel["material"], steel["young"], steel["density"]) == ("steel", 210e9, 7900.0)


@pytest.mark.parametrize("key", ["title", "source", "note"])
def test_what_a_scene_says_is_escaped(key):
    report = solvers.report(solvers.load("fixed-rod").replace({key: HOSTILE}))
    found = Rows(report.html())
    assert not {"script", "img"} & {tag for tag, _ in found.tags}
    assert HOSTILE in " ".join(found.said)
    ElementTree.fromstring(report._repr_html_())  # well formed


def test_names_of_links_are_escaped_too():
    text = solvers.to_toml("four-bar").replace('"crank"', json.dumps(SHORT))
    report = solvers.report(solvers.Scene.from_table(tomllib.loads(text)))
    found = Rows(report.html())
    assert not {"script", "img"} & {tag for tag, _ in found.tags}
    assert "alert(1)" in " ".join(found.said)


def test_a_page_needs_nothing_else(within):
    page = within.html()
    found = Rows(page)
    sources = [attributes.get(key) for _, attributes in found.tags for key in ("src", "href") if attributes.get(key)]
    assert sources and all(each.startswith("data:") for each in sources)
    assert "@import" not in page and "url(" not in page
    assert page == within.html()  # it holds no date: the same again


def test_the_link_and_the_file_are_of_the_scene(tmp_path):
    scene = solvers.load("fixed-rod").replace({"impactor.mass": 3.0, "title": "Mine"})
    report = solvers.report(scene, page="https://example.org/strikewave/")
    name = parse_qs(report.query.removeprefix("?"))["scene"][0]
    assert own_scene(name) == scene
    links = [attributes["href"] for tag, attributes in Rows(report.html()).tags if tag == "a"]
    assert links[0].startswith("https://example.org/strikewave/?scene=own.") and len(links) == 2
    file = base64.b64decode(links[1].partition("base64,")[2]).decode()
    assert solvers.Scene.from_table(tomllib.loads(file)) == scene
    assert solvers.report("fixed-rod").query == "?scene=fixed-rod"


def test_a_scene_too_long_for_a_link_says_so():
    forces = 1e3 * np.random.default_rng(1).random(400)
    points = [[1e-7 * number, force] for number, force in enumerate(forces.tolist())]
    scene = solvers.load("pressure-bar").replace({"impactor": {"kind": "pulse", "points": points}})
    report = solvers.report(scene)
    assert report.query is None and "too long for a link" in report.html()


@pytest.mark.parametrize(
    "given",
    [
        {"scene": "fixed-rod"},
        {"scene": "fixed-rod", "changes": {"impactor.mass": 3.0}, "figures": ["impulse", "peak_stress"]},
        {"scene": "fixed-rod", "method": "modal"},
        {"scene": "fixed-rod", "method": solvers.Modal(modes=7)},
    ],
)
def test_command_and_python_lines_make_it_again(given, tmp_path, monkeypatch, capsys):
    report = solvers.report(**given)
    monkeypatch.chdir(tmp_path)
    exec(report.python, {})
    by_python = (tmp_path / "report.html").read_text("utf-8")
    assert main([*shlex.split(report.command)[1:], "--out", "again.html"]) == 0
    by_command = (tmp_path / "again.html").read_text("utf-8")
    rows = [Rows(page).rows for page in (report.html(), by_python, by_command)]
    assert rows[0] == rows[1] == rows[2]


def test_the_lines_of_one_with_tolerances_name_them(within):
    laws = "--tolerance impactor.velocity=5% --tolerance contact.stiffness=10%"
    assert within.command == f"impact report hammer-on-cantilever {laws} --points 16"
    assert "tolerances={'impactor.velocity': '5%', 'contact.stiffness': '10%'}, points=16" in within.python


def test_notes_stand_with_how_grave_they_are():
    report = solvers.report("fixed-rod", method=solvers.Modal(modes=3))
    page = report.html()
    assert report.solution.notes
    for note in report.solution.notes:
        assert str(note) in " ".join(Rows(page).said)
    grave = [str(note.severity) for note in report.notes]
    assert grave == sorted(grave, key=["invalid", "warning", "remark"].index)
    assert ("Not to be trusted as they stand" in page) == ("invalid" in grave)


def test_a_figure_not_to_be_trusted_is_said_above_the_figures():
    report = solvers.report(solvers.load("fixed-rod").replace({"impactor.mass": 0.01}), method=solvers.Modal(modes=5))
    assert "invalid" in {str(note.severity) for note in report.notes}
    assert report.html().index("Not to be trusted as they stand") < report.html().index("'row'>peak force")


def test_auto_says_why():
    report = solvers.report("fixed-rod", method="auto")
    assert report.why == "auto" and str(report.chosen) in " ".join(Rows(report.html()).said)
    assert report.chosen not in report.notes
    assert "the usual one" in solvers.report("fixed-rod").html()
    assert "The scene asks for it" in solvers.report("stiff-contact").html()


@pytest.mark.parametrize("language", ["en", "es"])
def test_every_method_and_law_has_its_words(language):
    texts = library(language)
    methods = {*METHODS, "multibody"}
    for family, names in (("assumes", methods), ("limits", {*methods, "all"}), ("law-of", set(solvers.LAWS))):
        assert texts.family(f"printed.sheet.{family}").keys() == names


def test_it_speaks_spanish(monkeypatch):
    monkeypatch.setenv(CHOSEN, "es")
    page = solvers.report("hammer-on-cantilever").html()
    assert "<html lang='es'>" in page and "Informe de impacto" in page and "3,4359 kN" in page
    said = " ".join(Rows(page).said)
    assert not re.search(r"\b(the|figure|tolerance|Warning|left out)\b", said.split("import solvers")[0])


def test_the_peak_of_the_picture_is_the_peak_of_the_figures(of_hammer):
    force = of_hammer.pictures[0]
    for report in (of_hammer, *map(solvers.report, ("stiff-contact", "fixed-rod", "figure-8.4"))):
        force = report.pictures[0]
        drawn = max(values.max() for name, (_, values) in force.lines.items() if name != "raw")
        assert force.name == "force" and drawn == approx(report.solution.peak_force, rel=1e-3)


def test_bodies_in_space_have_vectors_and_no_picture():
    report = solvers.report("brick-off-centre")
    assert report.pictures == [] and "no history to draw" in report.html()
    assert figures_in(report)["impactor velocity"][0].startswith("(0.313802, 0.5, 0.418403) m/s")


@pytest.mark.parametrize("given, key", [
    ({"figures": ["heat"]}, "figures"), ({"page": "example.org"}, "page"), ({"page": "javascript:alert(1)"}, "page"),
    ({"changes": {"impactor.weight": 1.0}}, "impactor.weight"), ({"method": "guess"}, "method.name"),
    ({"tolerances": {"impactor.weight": "5%"}}, "impactor.weight"),
])  # fmt: skip
def test_what_cannot_be_is_refused_by_key(given, key):
    with pytest.raises(SceneError) as refused:
        solvers.report("fixed-rod", **given)
    assert refused.value.key == key


def test_where_it_cannot_be_written(tmp_path):
    report = solvers.report("fixed-rod")
    for path in (tmp_path / "report.pdf", tmp_path / "nowhere" / "report.html"):
        with pytest.raises(SceneError, match="out: got"):
            report.save(path)
    path = tmp_path / "report.html"
    path.write_text("before")
    assert report.save(str(path)) == path and path.read_text("utf-8") == report.html()


@pytest.mark.slow
def test_every_built_in_scene_gives_a_report():
    for name in solvers.scene_names():
        report = solvers.report(name)
        page = report.html()
        assert report.numbers and report.inputs and len(report.pictures) in (0, 2), name
        assert not re.search(r"\bnan\b|\binf\b|None", " ".join(Rows(page).said).replace("True", "")), name


def test_colours_and_prefixes():
    assert colours(np.array([[-1.0, 0.0, 1.0]])).tolist() == [[[12, 58, 120], [246, 247, 248], [138, 24, 30]]]
    assert png(np.zeros((2, 3, 3), np.uint8)).startswith(b"\x89PNG\r\n\x1a\n")
    assert scaled(78_276.0, "N") == (1e-3, "kN") and scaled(1e-6, "s") == (approx(1e6), "µs")
    assert scaled(999.9999, "m") == (1.0, "m") and scaled(0.0, "N") == (1.0, "N") and scaled(math.inf, "N")[1] == "N"
