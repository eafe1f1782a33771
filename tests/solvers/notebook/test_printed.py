"""What `print` shows of results, in a line and whole; in a notebook the same as tables."""

import re
from pathlib import Path

import numpy as np
import pytest

import solvers
from app.command.main import main
from solvers.notebook import words
from solvers.text.catalogue import SOURCE, library
from tests.solvers.notebook.test_cards import HOSTILE, cells

SOURCES = "\n".join(path.read_text(encoding="utf-8") for path in Path(words.__file__).parent.glob("*.py"))
FOLDER = Path(words.__file__).parents[2] / "app" / "command"


@pytest.mark.parametrize("name", ["fixed-rod", "brick-on-floor", "newtons-cradle", "pressure-bar", "four-bar"])
def test_print_shows_what_the_command_does(name, capsys):
    solution = solvers.solve(name)
    assert main(["solve", name]) == 0
    printed, own = (re.sub(r"solved in .*", "", each) for each in (capsys.readouterr().out, f"{solution}\n"))
    assert printed == own and solution.method["name"] in own
    assert len(repr(solution)) < 200 and "\n" not in repr(solution)


def test_in_one_line_stands_what_is_asked_for_first():
    solution = solvers.solve("fixed-rod")
    assert repr(solution) == (
        "<Solution of 'Steel rod fixed at the far end, struck by its own mass' by waves: impactor leaves at "
        "-0.698876 m/s, 2 contacts, peak force 78276.6 N, one note>"
    )
    long = solvers.solve(solution.scene.replace({"title": "A very long title\n" * 15}))
    assert len(repr(long)) < 200 and "\n" not in repr(long)


@pytest.fixture(scope="module")
def studies():
    scene = solvers.load("fixed-rod").replace({"title": HOSTILE})
    return {
        "convergence": solvers.convergence(scene, (3, 5, 10)),
        "ensemble": solvers.ensemble(scene, runs=10),
        "sweep": solvers.sweep(scene, "impactor.mass", [1.0, 2.0]),
        "compare": solvers.compare(scene, ["waves", "rigid", "modal"], repeats=1),
    }


def test_studies_are_printed_as_tables(studies):
    assert "\n  peak force [N]" in str(studies["convergence"])
    assert str(studies["ensemble"].summary) in str(studies["ensemble"])
    first, *rows = str(studies["sweep"]).splitlines()
    assert "impactor.mass" in first and [row.split()[0] for row in rows] == ["1", "2"]
    assert [row.label for row in studies["compare"]] == ["waves", "rigid", "modal"]
    assert re.search(r"^  modal .* 2/2 +2 ", str(studies["compare"]), re.M)


@pytest.mark.parametrize("name", ["convergence", "ensemble"])
def test_studies_say_themselves_in_a_line(studies, name):
    """An ensemble once filled a notebook with 224 kB."""
    assert len(repr(studies[name])) < 200


def test_studies_have_cards(studies):
    shown = {name: cells(study) for name, study in studies.items()}
    assert all("<script" not in study._repr_html_() for study in studies.values())
    spread = studies["ensemble"].spread[0]
    assert f"{spread.median:.6g}" in shown["ensemble"] and str(spread.verdict) in shown["ensemble"]
    assert f"{studies['sweep'][1]['impulse']:.6g}" in shown["sweep"]
    convergence = studies["convergence"]
    assert str(convergence.summary["peak_force"]) in shown["convergence"]
    assert f"{float(np.max(convergence.values['peak_force'])):.6g}" in shown["convergence"]
    assert "2 of 2" in shown["compare"]
    assert {"cannot"} & set(cells(solvers.compare("bronze-rod-steel-ball", ["mode-switch"], repeats=1)))


def test_every_word_that_is_printed_is_there_and_asked_for():
    asked = set(re.findall(r"[\"']([a-z][\w-]*(?:\.[\w-]+)+)[\"']", SOURCES))
    families = set(re.findall(r"(?:family|named)\([\"']([\w.-]+)[\"']", SOURCES)) | {"residual"}
    asked |= set(re.findall(r"\"printed\.([\w.-]+)\"", "\n".join(path.read_text() for path in FOLDER.glob("*.py"))))
    for code in (code.removeprefix("printed.") for code in library(SOURCE).texts if code.startswith("printed.")):
        assert code in asked or code.rsplit(".", 1)[0] in families, code
