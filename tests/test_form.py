"""One form for all sources: ruff's rules and layout, and pyright's types, as pyproject.toml sets them, and lengths."""

import ast
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from .patience import SECONDS

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize("arguments", [["check"], ["format", "--check"]], ids=" ".join)
def test_ruff(arguments):
    call = [sys.executable, "-m", "ruff", *arguments, "--no-cache", "solvers", "app", "tests"]
    done = subprocess.run(call, cwd=ROOT, capture_output=True, text=True, timeout=SECONDS)
    assert done.returncode == 0, done.stdout + done.stderr


SOURCES = [
    path
    for folder, ends in (("solvers", ".py"), ("app", ".py .js .css"), ("bench", ".py"), ("tests", ".py .js"))
    for path in sorted((ROOT / folder).rglob("*"))
    if path.suffix in ends.split() and "packed" not in path.parts
]


def test_no_file_is_longer_than_400_lines():
    lengths = {path.relative_to(ROOT): len(path.read_text().splitlines()) for path in SOURCES}
    assert {path: lines for path, lines in lengths.items() if lines > 400} == {}


def test_no_function_is_longer_than_60_lines():
    functions = [
        (path.relative_to(ROOT), found.name, found.end_lineno - found.lineno + 1)
        for path in SOURCES
        if path.suffix == ".py" and "tests" not in path.parts
        for found in ast.walk(ast.parse(path.read_text()))
        if isinstance(found, (ast.FunctionDef, ast.AsyncFunctionDef))
    ]
    assert [function for function in functions if function[-1] > 60] == []


def test_no_test_gives_another_process_a_time_that_a_busy_machine_misses():
    """Of subprocess and HTTP, by `patience.SECONDS`, unless the time is what is tested."""
    calls = re.compile(r"(subprocess\.\w+|HTTPRequest|fetch)\([^#]*timeout=\d")
    found = [
        (path.relative_to(ROOT), number, line.strip())
        for path in SOURCES
        if path.suffix == ".py" and "tests" in path.relative_to(ROOT).parts
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if calls.search(line)
    ]
    assert found == []


def test_no_class_answers_by_getattr():
    """Since Python 3.12 protocols look at what a class has, and what it answers otherwise is missed in silence."""
    found = [
        (path.relative_to(ROOT), each.name)
        for path in SOURCES
        if path.suffix == ".py" and "__getattr" in path.read_text()
        for each in ast.walk(ast.parse(path.read_text()))
        if isinstance(each, ast.FunctionDef) and each.name in ("__getattr__", "__getattribute__")
    ]
    assert found == []


def test_tests_of_the_page_have_hands():
    """What `fill` of Playwright puts into a field has come by no key: a page that takes none passes."""
    found = [
        f"{path.relative_to(ROOT)}:{each.lineno}"
        for path in sorted((ROOT / "tests/app").rglob("*.py"))
        if "fill" in path.read_text()
        for each in ast.walk(ast.parse(path.read_text()))
        if isinstance(each, ast.Call) and isinstance(each.func, ast.Attribute) and each.func.attr == "fill"
        if not (isinstance(each.func.value, ast.Name) and each.func.value.id == "np")
    ]
    assert found == [], "use type_into, paste_into, slide or arrow of tests/app/page/hands.py"


# Words that an engineer who reads would stumble over, and what we say instead.
WORDS = {
    "told": "said, summary, given",
    "blows?": "impact",
    "doubts?": "warning",
    "frighten(s|ed|ing)?": "too large",
    "stirs?": "moves",
    "beholds?": "sees",
}
KEY_OF_OLD = '"told": '  # which tables keep beside "summary", as programs read them


def test_words_are_those_of_an_engineer():
    refused = re.compile(rf"\b({'|'.join(WORDS)})\b", re.IGNORECASE)
    texts = [path for folder in ("solvers", "app") for path in sorted((ROOT / folder).rglob("*.toml"))]
    texts += [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
    found = [
        (path.relative_to(ROOT), number, line.strip())
        for path in [*texts, *(path for path in SOURCES if path.parts[len(ROOT.parts)] in ("solvers", "app"))]
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if refused.search(line.replace(KEY_OF_OLD, ""))
    ]
    assert found == []


@pytest.mark.slow
def test_types():
    call = [sys.executable, "-m", "pyright", "--level", "warning", "--pythonpath", sys.executable]
    room = os.environ | {"NODE_OPTIONS": "--max-semi-space-size=64"}  # for what is young: a sixth of the time
    done = subprocess.run(call, cwd=ROOT, env=room, capture_output=True, text=True, timeout=SECONDS)
    assert done.returncode == 0, done.stdout + done.stderr
