"""What newcomers look for beside the code holds for the code: hosted tests, hooks before a commit, forms of issues."""

import re
import tomllib
from pathlib import Path

import yaml

from .machines import PYTHONS

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
HOSTED = ROOT / ".github"


def read(path: Path):
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def test_hosted_tests_run_the_gate_on_each_python_that_is_promised():
    job = read(HOSTED / "workflows/tests.yml")["jobs"]["tests"]
    first = PROJECT["requires-python"].removeprefix(">=")
    assert job["strategy"]["matrix"]["python"] == [first, *PYTHONS]
    assert job["steps"][-1] == {"run": ".ci/run"} and (ROOT / ".ci/run").stat().st_mode & 0o100
    classifiers = [each.rpartition(" ")[2] for each in PROJECT["classifiers"] if each.startswith("Programming")]
    assert classifiers == [first, *PYTHONS]


def test_hooks_call_what_the_tests_install():
    (repository,) = read(ROOT / ".pre-commit-config.yaml")["repos"]
    development = (ROOT / "package.json").read_text() + str(PROJECT["optional-dependencies"]["test"])
    for hook in repository["hooks"]:
        place, _, tool = hook["entry"].split()[0].rpartition("/")
        assert place in (".venv/bin", "node_modules/.bin") and tool in development
        re.compile(hook.get("files", ""))


def test_forms_of_issues_ask_for_something():
    forms = [read(each) for each in sorted((HOSTED / "ISSUE_TEMPLATE").glob("*.yml"))]
    assert len(forms) == 3
    for form in forms:
        assert form["name"] and form["description"]
        asked = [field["attributes"]["label"] for field in form["body"]]
        assert len(asked) == len(set(asked)) > 1 and any(field["validations"]["required"] for field in form["body"][:1])
