"""Points of maps, by the browser's own code: equal to the server's answers to the same choices."""

import json
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.choices.choices import Choices
from app.choices.scene_of import choices_of
from app.messages.encoding import read_header
from app.messages.solve import solve_frame
from app.wasm.module import MODULE

HERE = Path(__file__).parent
SCENES: dict[str, dict[str, list]] = {  # what points differ by; values far from those of the scene among them
    "fixed-rod": {"mass_ratio": [0.2, 1.0, 7.0], "speed": [0.3, 4.0]},
    "free-rod": {"mass_ratio": [0.2, 1.0, 7.0], "law": ["rigid", "hertz", "hunt-crossley"]},
    "bronze-rod-steel-ball": {"mass_ratio": [30.0, 300.0], "speed": [0.2, 3.0]},
    "two-unequal-rods": {"speed": [0.5, 3.0]},
    "rod-with-gap": {"mass_ratio": [0.7, 1.4]},
    "two-balls": {"mass_ratio": [0.5, 2.0], "speed": [3.0]},
    "hammer-on-cantilever": {"mass_ratio": [0.5, 4.0], "speed": [0.7]},
}
SHARES = ("vibration", "dissipated", "newton")


def points_of(varied: dict[str, list]) -> list[dict[str, Any]]:
    grids = np.meshgrid(*(np.arange(len(values)) for values in varied.values()), indexing="ij")
    rows = np.stack([grid.ravel() for grid in grids], axis=1)
    return [{name: varied[name][k] for name, k in zip(varied, row, strict=True)} for row in rows]


def mapped(given: list[tuple[bytes, list[dict]]], folder: Path) -> list[list[dict[str, dict]]]:
    """Figures alone and of the whole answer, of points about each message."""
    asked = []
    for number, (message, points) in enumerate(given):
        file = folder / f"{number}"
        file.write_bytes(message)
        asked.append({"file": str(file), "points": points})
    command = ["node", HERE / "mapped.mjs", MODULE]
    done = subprocess.run(command, input=json.dumps(asked), capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def chosen(scene: str, **more: Any) -> dict[str, Any]:
    return Choices(scene=scene, **(choices_of(scene) | more)).chosen()


def known(header: dict[str, Any]) -> dict[str, float | None]:
    """What the server's answer has of these."""
    axial = header["kind"] == "axial"
    figures = header["exact" if axial else "main"]
    speed = header["speed"] if axial else 1.0
    energy = figures["energy"]
    found = {
        "impactor_velocity": speed * figures["final"],
        "target_velocity": speed * figures["targetFinal"],
        "peak_force": figures["peakForce"],
        "newton": figures["restitution"]["newton"],
        "vibration": energy["target_vibration"] / energy["initial"],
        "dissipated": energy["dissipated"] / energy["initial"],
        "peak_indentation": figures["peakIndentation"],
    }
    if axial:
        found["contacts"] = len(figures["contacts"])
        found["contact_time"] = header["trip"] * sum(end - start for start, end, *_ in figures["contacts"])
        return found
    return found | {"contacts": figures["contacts"], "contact_time": header["span"]["real"]}


@pytest.mark.browser  # needs Node
def test_they_are_those_of_the_server(tmp_path):
    given = [(name, solve_frame(chosen(name)), points_of(varied)) for name, varied in SCENES.items()]
    answers = mapped([(message, points) for _, message, points in given], tmp_path)
    for (name, _, points), found in zip(given, answers, strict=True):
        for point, both in zip(points, found, strict=True):
            here, where = both["alone"], (name, point)
            assert here["status"] == 0, where
            for figure, value in known(read_header(solve_frame(chosen(name, **point)))).items():
                close = 1e-8 if figure in SHARES else 0.0
                if value is None:
                    assert here[figure] is None, (figure, where)  # as JSON has what is no number
                else:
                    assert here[figure] == pytest.approx(value, rel=1e-8, abs=close or 1e-9), (figure, where)


@pytest.mark.browser  # needs Node
def test_figures_alone_are_those_of_the_whole_answer(tmp_path):
    given = [(solve_frame(chosen(name)), points_of(SCENES[name])) for name in ("fixed-rod", "free-rod")]
    seen = 0
    for found in mapped(given, tmp_path):
        for both in found:
            here, whole = both["alone"], both["whole"]
            assert here["peak_stress"] > 0.0 and whole["peak_stress"] is None
            for figure in here.keys() - {"peak_stress"}:
                assert here[figure] == (whole[figure] and pytest.approx(whole[figure], rel=1e-12, abs=1e-14)), figure
                seen += 1
    assert seen > 100


@pytest.mark.browser  # needs Node
@pytest.mark.parametrize("scene", ["timoshenko-1913-long", "xylophone-bar", "hammer-on-cantilever"])
def test_those_of_a_beam_are_too(tmp_path, scene):
    given = [(solve_frame(chosen(scene)), points_of({"mass_ratio": [0.7, 3.0, 11.0], "speed": [0.4, 2.0]}))]
    (found,) = mapped(given, tmp_path)
    for both in found:
        here, whole = both["alone"], both["whole"]
        assert here["status"] == 0
        close = 1e-9 if here["contacts"] < 4 else 1e-6  # each magnifies what rounding leaves
        for figure in here:
            assert here[figure] == (whole[figure] and pytest.approx(whole[figure], rel=close, abs=1e-9)), figure


@pytest.mark.browser  # needs Node
@pytest.mark.parametrize(
    "point",
    [
        {"mass_ratio": -1.0},
        {"speed": 0.0},
        {"restitution": 1.5},
        {"method": "finite-element"},
        {"law": "none of these"},
        {"elements": 7},
    ],
)
def test_what_is_refused_or_not_known_has_no_figures(tmp_path, point):
    ((both, after),) = mapped([(solve_frame(chosen("free-rod", law="hertz")), [point, {"speed": 2.0}])], tmp_path)
    assert both["alone"].pop("status") == 1 and set(both["alone"].values()) == {None}
    assert after["alone"]["status"] == 0 and after["alone"]["peak_force"] > 0.0
