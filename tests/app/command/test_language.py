"""The command speaks the language that the environment names, down to refusals and titles of scenes."""

import os
import re
import subprocess
import sys

import pytest

import solvers
from solvers.accuracy.quantities import QUANTITIES
from solvers.studies.figures import FIGURES
from solvers.text.catalogue import CHOSEN

from ...patience import SECONDS
from ..pseudo import BARE, LANGUAGE
from ..servers import ROOT

SAID = """
import sys
from tests.app.pseudo import speak
speak()
from app.command.main import main
for line in sys.stdin:
    try:
        main(line.split())
    except SystemExit as end:  # of --help
        assert end.code == 0
"""
CALLS = """\
solve fixed-rod
solve brick-off-centre
solve four-bar
solve fixed-rod --find impactor.mass=-1..3:20 --such-that contacts=1.5
solve fixed-rod --find impactor.mass=1..3:20 --such-that impactor_velocity=-0.9
solve fixed-rod --find impactor.mass=1..3:20 --such-that contacts=2
solve fixed-rod --find impactor.mass=-1..3:5 --find target.length=0.4..1:5 --such-that contacts=1.5
solve fixed-rod --find impactor.mass=1..3:5 --find target.length=0.4..1:5 --such-that impactor_velocity=-0.9
solve fixed-rod --find impactor.mass=1..3:5 --find target.length=0.2..1:5 --such-that contacts=2
solve fixed-rod --find impactor.mass=1..3:5 --find impactor.mass=1..2 --such-that contacts=2
solve fixed-rod --find impactor.mass=1..3 --find target.length=1..2 --find impactor.velocity=1..2 --such-that contacts=2
plan fixed-rod
bounce bouncing-ball
sweep fixed-rod --vary impactor.velocity=0.5..1.5:2
study fixed-rod --vary impactor.velocity=0.5..1.5:2 --vary contact.law=rigid,velvet
study fixed-rod --vary impactor.velocity
study fixed-rod
optimise fixed-rod --vary impactor.mass=1..3 --minimise peak_force --such-that peak_stress<=1e8 --solves 60
optimise fixed-rod --vary impactor.mass=1..3 --minimise peak_force --such-that peak_stress<=1 --solves 60
optimise fixed-rod --vary impactor.mass=1..3
optimise fixed-rod --vary impactor.mass=1..3 --minimise peak_force --maximise newton --solves 200 --points 5
optimise fixed-rod --vary impactor.mass=1..3 --minimise peak_force --maximise newton --such-that peak_stress<=1
optimise fixed-rod --vary impactor.mass=1..3 --minimise peak_force --maximise peak_force
optimise fixed-rod --vary impactor.mass=1..3 --minimise peak_force --points 3
plot nowhere.nc
plot map.nc --out map.pdf
report fixed-rod --out map.png
report fixed-rod --page nowhere
report --help
plot --help
uncertain fixed-rod --tolerance impactor.mass=uniform(1,3) --points 9 --figure impulse --figure contacts
convergence fixed-rod --modes 2,4,8,16
ensemble fixed-rod --runs 10
gradient fixed-rod
stability fixed-rod --grid 2x2 --modes 4
tradeoff fixed-rod --stored
joints bent-rods
record --scene fixed-rod --example
hopkinson docs/hopkinson.csv --bars docs/hopkinson-bars.toml
lesson --help
lesson check --help
lesson new --help
lesson
solve nowhere
solve fixed-rod --set impactor.mass=-1
serve --port 0
nowhere
solve
solve fixed-rod --bogus
solve fixed-rod --set
solve fixed-rod --find impactor.mass=1..2
solve fixed-rod --such-that contacts=2
solve fixed-rod --find impactor.mass=1..2 --such-that contacts
solve fixed-rod --json=3
tradeoff fixed-rod --s
--help
solve --help
"""
KEYS = {
    *solvers.METHODS,
    *solvers.LAWS,
    *QUANTITIES,
    *FIGURES,
    "MPa",
    "newmark",
    "structural",
    "first",
    "second",
    "tolerance",
    "restitution",
    "impact",
    "scene",
    *("modes", "frame", "residual", "True", "crank", "coupler", "bar", "contacts"),
}  # of scene files
TYPED = {  # in a call, as it stands
    *("solve", "compare", "tradeoff", "calibrate", "sweep", "bounce", "ensemble", "convergence", "record", "stability"),
    *("curves", "map", "points", "parallel", "matrix", "bars"),
    "hopkinson",
    *("study", "optimise", "velvet", "uncertain", "plot", "report", "file", "NAME"),
    *(
        "plan",
        "joints",
        "gradient",
        "FIGURE",
        "KEY",
        "lesson",
        "check",
        "new",
        "print",
        "scenes",
        "serve",
        "warm",
        "wasm",
        "COMMAND",
        "FILE",
        "VALUE",
        "COUNT",
        "log",
        "SCENE",
        "LANGUAGE",
        "URL",
    ),
}
DOTTED = re.compile(r"(?<!=)\b\d+\.\d")  # a number as English has it, but for values of keys


@pytest.mark.slow
def test_no_word_of_the_command_is_outside_its_catalogues():
    call = [sys.executable, "-c", SAID]
    environment = os.environ | {CHOSEN: LANGUAGE}
    done = subprocess.run(call, input=CALLS, capture_output=True, text=True, timeout=SECONDS, cwd=ROOT, env=environment)
    said = done.stdout + done.stderr
    table = solvers.stored_tradeoff("fixed-rod")
    assert table is not None and said.count("⟦") > 100
    assert set(BARE.findall(said)) - KEYS - TYPED - set(BARE.findall(table.machine["processor"])) == set()
    assert [line for line in done.stdout.splitlines() if DOTTED.search(line)] == []
