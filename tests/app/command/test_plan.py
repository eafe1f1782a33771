"""`impact plan`: a model, its error and the reason."""

import json

import pytest
from pytest import approx

from tests.app.command.calls import answer, refusal, result


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
