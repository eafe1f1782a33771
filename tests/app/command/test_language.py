"""The command speaks the language that the environment names, down to refusals and titles of scenes."""

import os
import subprocess
import sys

import pytest

import solvers
from solvers.text.catalogue import CHOSEN

from ..pseudo import BARE, LANGUAGE
from ..servers import ROOT

SAID = """
import sys
from tests.app.pseudo import speak
speak()
from app.command.main import main
for line in sys.stdin:
    main(line.split())
"""
CALLS = """\
solve fixed-rod
solve brick-off-centre
plan fixed-rod
bounce bouncing-ball
solve nowhere
solve fixed-rod --set impactor.mass=-1
serve --port 0
"""
KEYS = {*solvers.METHODS, *solvers.LAWS, "tolerance", "restitution", "impact", "scene", "nothing"}  # of scene files


@pytest.mark.slow
def test_no_word_of_the_command_is_outside_its_catalogues():
    call = [sys.executable, "-c", SAID]
    environment = os.environ | {CHOSEN: LANGUAGE}
    done = subprocess.run(call, input=CALLS, capture_output=True, text=True, timeout=120, cwd=ROOT, env=environment)
    said = done.stdout + done.stderr
    assert said.count("⟦") > 100 and set(BARE.findall(said)) - KEYS == set()
