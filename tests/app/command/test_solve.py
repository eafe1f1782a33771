"""`impact solve`: results with exactly the promised keys, and one line for everything it refuses."""

import csv
import math
from pathlib import Path

import pytest
from pytest import approx

import solvers
from app.command.main import main
from tests.app.command.calls import KEYS, answer, refusal, result
from tests.catalog import T

DIAGNOSTICS = {"energy_error", "momentum_error", "steps", "wall_time", "compile_time", "estimated_error"}
MODAL_DIAGNOSTICS = {"raw_contacts", "raw_peak_force", "resolved_time", "frequencies"}
SERIES = [
    "time_s", "contact_force_N", "impactor_position_m", "impactor_velocity_m_per_s", "struck_end_position_m",
    "target_mean_velocity_m_per_s",
]  # fmt: skip


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


def test_the_report_says_for_how_long_they_are_in_contact(capsys):
    for scene, said in (("fixed-rod", "0.0001829458 s   (1.57205 T)"), ("rigid-pendulum", "one impulse, no duration")):
        assert main(["solve", scene]) == 0
        assert f"  in contact for       {said}\n" in capsys.readouterr().out


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


def below_the_head(file):
    return (line for line in file if not line.startswith("#"))


def test_a_rigid_impact_on_an_axis_jumps(capsys, tmp_path):
    path = tmp_path / "histories.csv"
    found = result(capsys, "free-rod", "--set", "method.name=rigid", "--series", str(path))
    assert found["contacts"] == [{"start": 0.0, "end": 0.0, "impulse": approx(2.133), "peak_force": None}]
    with path.open(newline="") as file:
        rows = [[float(value) for value in row.values()] for row in csv.DictReader(below_the_head(file))]
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
        rows = list(csv.DictReader(below_the_head(file)))
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


@pytest.mark.parametrize("name, came", [("figure-6.6", True), ("fixed-rod", False)])
def test_a_share_of_its_speed_is_given_only_where_that_is_the_speed_of_the_impact(capsys, name, came):
    """The crank of figure 6.6 comes to meet a mass that hardly moves: it left with "-31 of its speed"."""
    main(["solve", name])
    shown = capsys.readouterr().out
    assert ("came at" in shown) == came and ("of its speed" in shown) != came


@pytest.mark.parametrize(
    "before, law, changes, refused",
    [
        ("linear", "hertz", (), "contact.stiffness in N/m^1.5: the 1e+06 of the law before is in N/m"),
        ("linear", "hertz", ("contact.stiffness=1e9",), ""),
        ("linear", "kelvin-voigt", ("contact.damping=10",), ""),
        ("linear", "rigid", (), "contact.stiffness: got"),
        ("hertz", "linear", (), "contact.stiffness in N/m: the 1e+06 of the law before is in N/m^1.5"),
    ],
)
def test_a_stiffness_is_not_taken_over_by_a_law_that_has_it_in_another_unit(
    capsys, tmp_path, before, law, changes, refused
):
    file = tmp_path / "pad.toml"
    ball = {"impactor.radius": 0.02, "contact": {"law": before, "stiffness": 1e6}}
    file.write_text(solvers.to_toml(solvers.load("free-rod").replace(ball)), encoding="utf-8")
    given = [word for change in (f"contact.law={law}", *changes) for word in ("--set", change)]
    if refused:
        assert refused in refusal(capsys, "solve", str(file), *given)
    else:
        assert answer(capsys, "solve", str(file), *given)
