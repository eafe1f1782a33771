"""The command `impact`, in process: results with exactly the promised keys, and one line for everything it refuses."""

import csv
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
from tests.catalog import T

KEYS = {
    "scene", "method", "contacts", "impulse", "peak_force", "peak_indentation", "residual_indentation", "impactor",
    "target", "restitution", "energy", "diagnostics", "duration", "notes", "note_codes",
}  # fmt: skip
DIAGNOSTICS = {"energy_error", "momentum_error", "steps", "wall_time", "compile_time", "estimated_error"}
MODAL_DIAGNOSTICS = {"raw_contacts", "raw_peak_force", "resolved_time"}
SERIES = [
    "time_s", "contact_force_N", "impactor_position_m", "impactor_velocity_m_per_s", "struck_end_position_m",
    "target_mean_velocity_m_per_s",
]  # fmt: skip


def answer(capsys, *arguments: str) -> str:
    code = main(list(arguments))
    out, err = capsys.readouterr()
    assert (code, err) == (0, "")
    return out


def result(capsys, *arguments: str) -> dict:
    return json.loads(answer(capsys, "solve", *arguments, "--json"))


def refusal(capsys, *arguments: str) -> str:
    """The one line on standard error, with nothing on standard output."""
    code = main(list(arguments))
    out, err = capsys.readouterr()
    assert code == 2
    assert out == ""
    assert err.startswith("impact: ") and err.endswith("\n")
    assert err.count("\n") == 1
    assert "Traceback" not in err
    assert len(err) < 500
    return err


# --- solve ------------------------------------------------------------------------------------------------------------


def test_json_has_exactly_the_promised_keys(capsys):
    found = result(capsys, "fixed-rod")
    assert set(found) == KEYS
    assert set(found["diagnostics"]) == DIAGNOSTICS
    for contact in found["contacts"]:
        assert set(contact) == {"start", "end", "impulse", "peak_force"}
    assert set(found["impactor"]) == set(found["target"]) == {"final_velocity"}
    assert set(found["restitution"]) == {"newton", "poisson", "newton_at_contact"}
    assert set(found["energy"]) == {
        "initial", "impactor", "target_rigid", "target_vibration", "local", "dissipated"
    }  # fmt: skip
    assert set(found["scene"]) == {"title", "source", "impactor", "target", "contact"}
    assert found["method"] == {"name": "waves", "steps": None, "tolerance": 1e-9}


def test_json_is_in_si_units(capsys):
    found = result(capsys, "fixed-rod")
    # thesis 4.5 for the rod of 5.3: (4.25), (4.31), (4.35), (4.37), in seconds, newtons, metres per second
    first, second = found["contacts"]
    assert (first["start"], first["end"]) == approx((0.0, 1.784980427257793e-4), rel=1e-12)
    assert (second["start"], second["end"]) == approx((2.124623234942172 * T, 2.516981913950052e-4), rel=1e-12)
    assert found["peak_force"] == approx(78276.56848268454, rel=1e-12)
    assert found["impactor"]["final_velocity"] == approx(-0.6988755819961635, rel=1e-12)
    assert found["impulse"] == approx(2.133 * 1.6988755819961635, rel=1e-12)
    assert found["target"]["final_velocity"] == 0.0
    assert found["peak_indentation"] is None and found["residual_indentation"] is None
    assert found["energy"]["initial"] == approx(0.5 * 2.133, rel=1e-15)
    assert found["restitution"]["newton"] == approx(0.6988755819961635, rel=1e-12)


def test_json_of_the_modal_method_says_how_it_counted(capsys):
    found = result(capsys, "bronze-rod-steel-ball", "--set", "method.name=modal", "--set", "method.modes=30")
    assert set(found) == KEYS
    assert set(found["diagnostics"]) == DIAGNOSTICS | MODAL_DIAGNOSTICS
    assert found["method"] == {"name": "modal", "modes": 30, "steps": None, "frame": "mean-axis", "residual": True}
    assert found["peak_indentation"] > 0.0 and found["residual_indentation"] == 0.0


def test_the_scene_of_the_result_is_the_scene_solved(capsys):
    found = result(capsys, "free-rod", "--set", "target.length=0.7", "--set", "impactor.velocity=3")
    assert solvers.Scene.from_table(found["scene"]).target.length == 0.7
    assert found["scene"]["impactor"]["velocity"] == 3.0


@pytest.mark.parametrize(
    "change, key, value",
    [
        ("target.length=0.5", ("target", "length"), 0.5),
        ("target.length = 0.5", ("target", "length"), 0.5),
        ("impactor.mass=1_000", ("impactor", "mass"), 1000.0),
        ("impactor.velocity=2", ("impactor", "velocity"), 2.0),
        ("target.support=free", ("target", "support"), "free"),
        ('target.support="free"', ("target", "support"), "free"),
        ("target.section={ radius = 0.02 }", ("target", "section"), {"area": math.pi * 4e-4}),
        ("title=A bare sentence, nothing else", ("title",), "A bare sentence, nothing else"),
        ('contact={ law = "linear", stiffness = 1e9 }', ("contact", "stiffness"), 1e9),
    ],
)
def test_set(capsys, change, key, value):
    found = result(capsys, "fixed-rod", "--set", change)["scene"]
    for name in key:
        found = found[name]
    assert found == value


def test_several_changes_and_a_file(capsys, tmp_path):
    path = tmp_path / "my scene.toml"
    path.write_text((Path(solvers.__file__).parent / "scenes" / "free-rod.toml").read_text())
    found = result(capsys, str(path), "--set", "impactor.velocity=2", "--set", "impactor.mass=4.266")
    assert found["impactor"]["final_velocity"] == approx(2.0 * math.exp(-1.0), rel=1e-12)  # (4.13), beta = 1/2


def test_a_file_without_a_method_is_solved_and_compared(capsys, tmp_path):
    (tmp_path / "drop.toml").write_text(
        '[impactor]\nkind = "sphere"\nradius = 0.01\nvelocity = 1.0\n'
        '[target]\nkind = "half-space"\nmaterial = "steel"\n[contact]\nlaw = "hertz"\n'
    )
    found = result(capsys, str(tmp_path / "drop.toml"))
    assert found["method"]["name"] == "quasi-static"
    assert found["impactor"]["final_velocity"] == approx(-1.0, rel=1e-9)
    said = answer(capsys, "compare", str(tmp_path / "drop.toml"), "--set", "contact.law=rigid")
    assert "measured by                     rigid" in said


def test_the_report_for_people(capsys):
    text = answer(capsys, "solve", "fixed-rod")
    assert "Steel rod fixed at the far end" in text
    assert "1.533834" in text and "2.124623" in text and "2.162843" in text  # contacts in T
    assert "-0.69887558" in text
    assert "78.27" in text  # kN
    assert "not defined" not in text


def test_the_report_says_what_is_unfinished(capsys):
    text = answer(capsys, "solve", "fixed-rod", "--set", "method.duration=5e-5")
    assert "Note: The bodies are still in contact" in text
    assert "not defined" in text  # Poisson's restitution


def test_bodies_in_space(capsys, tmp_path):
    found = result(capsys, "note-rod", "--set", "target.centre=[0, 0, 0]")
    assert set(found) == KEYS | {"effective_mass"}
    assert set(found["diagnostics"]) == DIAGNOSTICS | {"angular_momentum_error"}
    assert found["effective_mass"] == approx(0.4)  # struck in the middle: m1 m2 / (m1 + m2)
    assert found["target"] == {"final_velocity": approx([-0.96, 0.0, 0.0]), "final_spin": [0.0, 0.0, 0.0]}
    text = answer(capsys, "solve", "note-rod")
    assert "effective mass                  0.25 kg" in text
    assert "target after    velocity (-0.6, 0, 0) m/s   spin (0, 0, 3) rad/s" in text
    assert "a stop" in answer(capsys, "solve", "note-rod", "--set", 'target={ kind = "stop" }')
    assert "no history" in refusal(capsys, "solve", "note-rod", "--series", str(tmp_path / "impact.csv"))


def test_a_rigid_impact_on_an_axis_jumps(capsys, tmp_path):
    path = tmp_path / "histories.csv"
    found = result(capsys, "free-rod", "--set", "method.name=rigid", "--series", str(path))
    assert found["contacts"] == [{"start": 0.0, "end": 0.0, "impulse": approx(2.133), "peak_force": None}]
    with path.open(newline="") as file:
        rows = [[float(value) for value in row.values()] for row in csv.DictReader(file)]
    assert [row[3] for row in rows] == approx([1.0, 0.0, 0.0], abs=1e-12)  # equal masses exchange their velocities
    assert [row[5] for row in rows] == approx([0.0, 1.0, 1.0], abs=1e-12)
    assert "no duration" in answer(capsys, "solve", "free-rod", "--set", "method.name=rigid")


@pytest.mark.parametrize(
    "change", ["method.name=waves", "method.name=modal", 'contact={ law = "hertz", stiffness = 1e10 }']
)
def test_series(capsys, tmp_path, change):
    path = tmp_path / "histories.csv"
    found = result(capsys, "fixed-rod", "--set", change, "--series", str(path))
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == SERIES
    columns = {name: [float(row[name]) for row in rows] for name in SERIES}
    assert all(math.isfinite(x) for values in columns.values() for x in values)
    times = columns["time_s"]
    assert times == sorted(times)
    assert times[0] == 0.0 and times[-1] <= found["duration"] * (1.0 + 1e-12)
    assert min(columns["contact_force_N"]) >= 0.0
    assert columns["impactor_velocity_m_per_s"][-1] == approx(found["impactor"]["final_velocity"], rel=1e-11)
    if change == "method.name=waves":
        assert max(columns["contact_force_N"]) == approx(found["peak_force"], rel=1e-11)  # 12 digits are written
        assert any(a == b and f != g for a, b, f, g in zip(
            times[:-1], times[1:], columns["contact_force_N"][:-1], columns["contact_force_N"][1:], strict=True
        )), "the time of a jump stands twice"  # fmt: skip


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


# --- refusals ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "change, key, value",
    [
        ("target.length=-1", "target.length", "-1"),
        ("target.length=0", "target.length", "0"),
        ("target.length=nan", "target.length", "nan"),
        ("target.length=inf", "target.length", "inf"),
        ("target.length=1e400", "target.length", "inf"),
        ("target.length=true", "target.length", "True"),
        ("target.length=long", "target.length", "'long'"),
        ("target.length=", "target.length", "''"),
        ("target.length=[1, 2]", "target.length", "[1, 2]"),
        ("target.length=1979-05-27", "target.length", "1979"),
        ("target.length=1\n2", "target.length", "1"),
        ("impactor.mass=" + "9" * 400, "impactor.mass", "999"),
        ("target.lenght=1", "target.lenght", "1"),
        ("target.length.x=1", "target.length.x", "1"),
        ("nonsense=1", "nonsense", "1"),
        ("target.section.area=1e-4", "target.section", "area"),
        ("contact.law=glue", "contact.law", "'glue'"),
        ("contact.law=hertz", "contact.stiffness", "nothing"),
        ("contact.stiffness=1e9", "contact.stiffness", "1000000000.0"),
        ("method.name=guess", "method.name", "'guess'"),
        ("method.modes=50", "method.modes", "50"),
        ("method.steps=3", "method.steps", "3"),
        ("method.duration=-1", "method.duration", "-1"),
        ("method.duration=never", "method.duration", "'never'"),
        ("title=" + "x" * 301, "title", "xxx"),
        ("target.length", "--set", "target.length"),
        ("=3", "--set", "=3"),
        ("", "--set", "''"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("as_json", [False, True], ids=["report", "json"])
def test_bad_values_are_refused_in_one_line(capsys, change, key, value, as_json):
    line = refusal(capsys, "solve", "fixed-rod", "--set", change, *(["--json"] if as_json else []))
    assert f"impact: {key}: got " in line
    assert value in line
    assert "allowed: " in line


@pytest.mark.parametrize("digits", [4_301, 50_000])
def test_integers_that_python_will_not_read_or_print(capsys, digits):
    refusal(capsys, "solve", "fixed-rod", "--set", "impactor.mass=" + "9" * digits)
    refusal(capsys, "solve", "fixed-rod", "--set", "impactor.mass=0x" + "f" * digits)


@pytest.mark.parametrize("depth", [100, 200, 240, 300, 330, 400, 10_000])
def test_deeply_nested_values(capsys, depth):
    refusal(capsys, "solve", "fixed-rod", "--set", "impactor.mass=" + "[" * depth + "]" * depth)


def test_two_values_for_one_key(capsys):
    line = refusal(capsys, "solve", "fixed-rod", "--set", "impactor.mass=1", "--set", "impactor.mass=2")
    assert "impactor.mass" in line and "2" in line


@pytest.mark.parametrize("name", ["no-such-scene", "", ".", "x" * 300, "/no/such/file.toml"])
def test_scenes_that_do_not_exist(capsys, name):
    line = refusal(capsys, "solve", name)
    assert "scene: got " in line
    assert "fixed-rod" in line


@pytest.mark.parametrize("content", [b"title = ", b"\xff\xfe\x00", b"a = " + b"[" * 9_999, b"a = " + b"9" * 5_000])
def test_files_that_cannot_be_read(capsys, tmp_path, content):
    path = tmp_path / "scene.toml"
    path.write_bytes(content)
    assert "scene: got " in refusal(capsys, "solve", str(path))


@pytest.mark.parametrize(
    "file, said",
    [
        ("histories.txt", "ends in .csv"),
        ("no/such/folder/a.csv", "can be written"),
        (".csv/", "ends in .csv"),
        ("a" * 300 + ".csv", "can be written"),
    ],
)
def test_series_that_cannot_be_written(capsys, tmp_path, file, said):
    line = refusal(capsys, "solve", "fixed-rod", "--series", f"{tmp_path}/{file}")
    assert "--series: got " in line and said in line


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
    ],
    ids=lambda arguments: " ".join(arguments)[:30] or "nothing",
)
def test_bad_command_lines_are_refused_in_one_line(capsys, arguments):
    refusal(capsys, *arguments)


def test_a_port_of_the_environment_is_checked_too(capsys, monkeypatch):
    monkeypatch.setenv("IMPACT_PORT", "eighty")
    assert "--port: got 'eighty'" in refusal(capsys, "serve")


# --- compare ----------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_compare_prints_a_row_for_every_method_or_says_why_not(capsys):
    said = answer(capsys, "compare", "bronze-rod-steel-ball")
    rows = {line.split()[0]: line for line in said.splitlines() if line.startswith("  ") and line.split()}
    assert set(solvers.METHODS) <= set(rows)
    assert " 1/1 " in rows["modal"]
    assert "cannot: " in rows["mode-switch"]


@pytest.mark.slow
def test_compare_in_json_for_scripts(capsys):
    found = json.loads(answer(capsys, "compare", "fixed-rod", "--set", "impactor.mass=1.0665", "--json"))
    assert set(found) == {"exact", "methods"}
    assert set(found["exact"]) == KEYS
    assert found["exact"]["scene"]["impactor"]["mass"] == 1.0665
    assert {row["method"]["name"] for row in found["methods"]} == set(solvers.METHODS)
    exact = found["methods"][0]
    assert exact["method"]["name"] == "waves" and exact["rebound_error"] == 0.0


def test_compare_of_a_prescribed_force_says_how_its_target_moves_on(capsys):
    said = answer(capsys, "compare", "pressure-bar")
    moved = solvers.solve(solvers.load("pressure-bar")).target_velocity
    assert f"its target moves on at          {moved:+.8g} m/s" in said
    assert "impactor leaves" not in said


def test_compare_refuses_what_has_no_exact_solution(capsys):
    assert "method.name: got 'waves'" in refusal(capsys, "compare", "note-rod")


# --- the extremes of what is allowed ----------------------------------------------------------------------------------


@pytest.mark.parametrize("support", ["fixed", "free"])
@pytest.mark.parametrize("contact", ['{ law = "rigid" }', '{ law = "linear", stiffness = 1e9 }'])
@pytest.mark.parametrize("mass", ["3e-9", "1e-3", "1e3", "1e5"])
def test_extreme_masses_are_solved_or_refused(capsys, support, contact, mass):
    changes = [f"impactor.mass={mass}", f"target.support={support}", f"contact={contact}"]
    arguments = ["fixed-rod"] + [word for change in changes for word in ("--set", change)]
    found = result(capsys, *arguments)
    assert abs(found["diagnostics"]["energy_error"]) < 1e-6
    assert abs(found["impactor"]["final_velocity"]) <= 1.0 + 1e-9


def test_a_rod_that_the_mass_does_not_feel_is_refused(capsys):
    # mass ratio 2e-23: the speed of the mass and of the common centre of mass are one and the same double
    changes = ["impactor.mass=1e12", "target.section={ area = 1e-14 }"]
    code = main(["solve", "free-rod", *(word for change in changes for word in ("--set", change))])
    assert code == 2
    assert "impactor.mass: got 1000000000000.0; allowed: " in capsys.readouterr().err


# --- installed --------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_installed_command(tmp_path):
    command = Path(sys.executable).with_name("impact")
    run = lambda *words: subprocess.run(  # noqa: E731
        [command, *words], cwd=tmp_path, capture_output=True, text=True, timeout=120
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
        done = subprocess.run([command, *words], cwd=tmp_path, capture_output=True, timeout=120)
        assert b"Traceback" not in done.stderr
        assert done.returncode in (0, 2)


# --- stability --------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_stability_draws_a_map_of_each_integrator(capsys):
    found = answer(capsys, "stability", "stiff-contact", "--grid", "4x12")
    for name in ("modal", "newmark", "newmark-frozen", "central-difference", "rk4", "moreau-jean"):
        assert f"\n  {name}: " in found
    assert "2 / omega_max, of the modes with the contact spring" in found
    assert "modal: 0 of 48 runs fail" in found and "thesis 8.2" in found
    assert all(len(line) <= 120 for line in found.splitlines())


def test_stability_as_json(capsys):
    found = json.loads(
        answer(
            capsys, "stability", "fixed-rod", "--axes", "step,speed", "--grid", "3x4", "--modes", "5",
            "--integrators", "modal,rk4", "--json",
        )
    )  # fmt: skip
    assert set(found) == {"axes", "modes", "here", "bound", "maps", "notes", "note_codes"}
    assert [axis["name"] for axis in found["axes"]] == ["step", "speed"] and found["modes"] == 5
    modal, rk4 = found["maps"]
    assert modal["ending"] == [[0] * 4] * 3 and modal["failures"] == 0 and modal["worst_energy_error"] < 1e-10
    assert modal["limit"] == [None] * 4 and rk4["limit"] == approx([8.0**0.5] * 4, rel=0.4)


@pytest.mark.parametrize(
    "arguments, named",
    [
        (("--axes", "step"), "axes"),
        (("--axes", "step,colour"), "'contact_stiffness'"),
        (("--grid", "4"), "ROWSxCOLUMNS"),
        (("--grid", "1x4"), "2 to 400"),
        (("--integrators", "leapfrog"), "'rk4'"),
        (("--modes", "many"), "--modes"),
    ],
)
def test_stability_refuses_by_name(capsys, arguments, named):
    assert named in refusal(capsys, "stability", "fixed-rod", *arguments)


def test_stability_of_a_scene_that_has_none(capsys):
    assert "prescribed force" in refusal(capsys, "stability", "pressure-bar")


# --- plan -------------------------------------------------------------------------------------------------------------


def test_plan_names_a_model_its_error_and_the_reason(capsys):
    found = answer(capsys, "plan", "bronze-rod-steel-ball", "--question", "final-velocities", "--tolerance", "0.1")
    assert "\n->" in found and "expected error" in found and "mass ratio" in found
    assert "impact solve SCENE --set method.name=" in found
    assert all(len(line) <= 120 for line in found.splitlines())


def test_plan_as_json(capsys):
    found = json.loads(answer(capsys, "plan", "fixed-rod", "--json"))
    assert found["chosen"]["model"] == "waves" and found["measured"]  # masses alike: nothing less will do
    assert found["chosen"]["changes"] == {"method": {"name": "waves"}}
    assert found["groups"] == {"mass_ratio": approx(1.0, rel=1e-3), "contact_time": 0.0}
    assert found["candidates"][0]["model"] == "rigid-impulse"
    solved = result(capsys, "fixed-rod", "--set", "method.name=waves")
    assert solved["method"]["name"] == "waves"


@pytest.mark.parametrize(
    "arguments, named",
    [
        (("--question", "colour"), "'peak-force'"),
        (("--tolerance", "0"), "tolerance"),
        (("--tolerance", "-1"), "tolerance"),
        (("--tolerance", "small"), "--tolerance"),
    ],
)
def test_plan_refuses_by_name(capsys, arguments, named):
    assert named in refusal(capsys, "plan", "fixed-rod", *arguments)
