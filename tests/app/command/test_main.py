"""The command `impact`: its scenes, its help, bad command lines, and as it is installed."""

import json
import math
import os
import subprocess
import sys
from pathlib import Path

import pytest
from pytest import approx

import solvers
from app.command.main import main
from solvers.studies.study import cluster
from tests.app.command.calls import answer, refusal

from ...patience import SECONDS


def test_scenes(capsys):
    lines = answer(capsys, "scenes").splitlines()
    headings = [line for line in lines if not line.startswith("  ")]
    scenes = [line for line in lines if line.startswith("  ")]
    assert lines[0] in headings and scenes[0].split()[0] == "fixed-rod"
    assert sorted(line.split()[0] for line in scenes) == sorted(solvers.scene_names())
    assert all(line.endswith(f"[{solvers.load(line.split()[0]).source}]") and "[]" not in line for line in scenes)
    chapters = [int(line.rsplit(" ", 1)[1]) for line in headings if line.startswith("Thesis, chapter")]
    assert chapters == [3, 4, 5, 6, 7, 8, 9, 10]


def test_help(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["--help"])
    assert ended.value.code == 0
    assert "solve" in capsys.readouterr().out


def test_version(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["--version"])
    assert ended.value.code == 0
    assert capsys.readouterr().out == f"{solvers.__version__}\n"


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["dance"],
        ["solve"],
        ["solve", "fixed-rod", "--loud"],
        ["solve", "fixed-rod", "free-rod"],
        ["solve", "fixed-rod", "--set"],
        ["compare"],
        ["compare", "fixed-rod", "--set"],
        ["scenes", "all"],
        ["serve", "--port", "no"],
        ["serve", "--port", "0"],
        ["serve", "--port", "70000"],
        ["serve", "--port", "-1"],
        ["serve", "--port", "9" * 5_000],
        ["serve", "--allow-origin", "http://a b/"],
        ["serve", "--allow-origin", "*"],
        *(["serve", "--cluster", cluster] for cluster in ("nonsense", "local:0", "tcp://host", "http://host:8786")),
        *(
            ["serve", "--frame-origin", origin]
            for origin in (
                *("moodle.example.org", "http://moodle.example.org", "https://*", "https://*.org", "*"),
                *("https://moodle.example.org/", "https://a.org;script-src", "https://a.org:99999", "https://a*.b.org"),
                *("https://a.org 'none'", "", "null", "https://a..org", "https://\u00e4.org", "https://" + "a" * 300),
            )
        ),
    ],
    ids=lambda arguments: " ".join(arguments)[:30] or "nothing",
)
def test_bad_command_lines_are_refused_in_one_line(capsys, arguments):
    refusal(capsys, *arguments)


def test_what_the_environment_sets_is_checked_too(capsys, monkeypatch):
    monkeypatch.setenv("IMPACT_PORT", "eighty")
    assert "--port: got 'eighty'" in refusal(capsys, "serve")
    monkeypatch.setenv("IMPACT_PORT", "5006")
    monkeypatch.setenv("IMPACT_DOCUMENTATION", "javascript:alert(1)")
    assert "IMPACT_DOCUMENTATION: got 'javascript:alert(1)'" in refusal(capsys, "serve")
    monkeypatch.setenv("IMPACT_DOCUMENTATION", "")
    monkeypatch.setenv("IMPACT_CLUSTER", "local:many")
    assert "--cluster: got 'local:many'; allowed: tcp://HOST:PORT" in refusal(capsys, "serve")
    monkeypatch.setattr(cluster, "find_spec", lambda name: None)
    assert "pip install 'strikewave[cluster]'" in refusal(capsys, "serve")


@pytest.mark.slow
def test_the_installed_command(tmp_path):
    command = Path(sys.executable).with_name("impact")
    run = lambda *words: subprocess.run(  # noqa: E731
        [command, *words], cwd=tmp_path, capture_output=True, text=True, timeout=SECONDS
    )
    good = run("solve", "free-rod", "--json")
    assert (good.returncode, good.stderr) == (0, "")
    assert json.loads(good.stdout)["impactor"]["final_velocity"] == approx(math.exp(-2.0), rel=1e-12)  # (4.13)
    bad = run("solve", "free-rod", "--set", "target.length=-1")
    assert (bad.returncode, bad.stdout) == (2, "")
    assert bad.stderr.count("\n") == 1 and "target.length: got -1" in bad.stderr


@pytest.mark.slow
def test_bytes_that_are_no_text_do_not_end_in_a_traceback(tmp_path):
    command = os.fsencode(Path(sys.executable).with_name("impact"))
    for words in ([b"solve", b"\xff\xfe"], [b"solve", b"fixed-rod", b"--set", b"title=\xff"]):
        done = subprocess.run([command, *words], cwd=tmp_path, capture_output=True, timeout=SECONDS)
        assert b"Traceback" not in done.stderr
        assert done.returncode in (0, 2)


def test_a_port_that_browsers_refuse_is_warned_of(monkeypatch, capsys):
    """It is served none the less: not only browsers ask."""
    served = []
    monkeypatch.setattr("app.serving.server.serve", lambda *given: served.append(given[0]) or 0)
    monkeypatch.setattr("app.command.serve._port", lambda port, address: [])
    for port, warned in (("5060", True), ("5061", True), ("6000", True), ("5062", False)):
        assert main(["serve", "--port", port]) == 0
        assert (f"Browsers refuse port {port}" in capsys.readouterr().err) == warned
    assert served == [5060, 5061, 6000, 5062]


@pytest.mark.parametrize("outdated", [True, False])
def test_a_page_packed_of_other_sources_is_warned_of(monkeypatch, capsys, outdated):
    monkeypatch.setattr("app.page.packed.outdated", lambda: outdated)
    monkeypatch.setattr("app.serving.server.serve", lambda *_: 0)
    monkeypatch.setattr("app.command.serve._port", lambda port, address: [])
    assert main(["serve", "--port", "5062"]) == 0
    assert ("make package" in capsys.readouterr().err) == outdated
