"""What the page relies on of Panel, param, Bokeh and Tornado is listed, is there, and is named by what it is for."""

import ast
import importlib
import inspect
import pkgutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import app
from tests.foreign import LIBRARIES, RELIED, Relied, lines
from tests.patience import SECONDS

ROOT = Path(app.__file__).parent
OURS = {"_exit", "_asdict", "_fields", "_replace"}  # of Python, which promises them
MADE = {  # by what makes classes of theirs, and by decorators
    "_all_slots_", "_abc_impl", "_param__private", "_param__parameters", "_data_model", "_data_model__initialized",
    "_stream_request_body",
}  # fmt: skip
BUILDING = "wasm"  # of Numba, while kernels are built: a development tool


@pytest.fixture(scope="module")
def said():
    """By a process of its own, in which the page has not put anything in their place yet."""
    call = [sys.executable, "-m", "tests.foreign"]
    return subprocess.run(call, cwd=ROOT.parent, capture_output=True, text=True, check=True, timeout=SECONDS).stdout


@pytest.mark.parametrize("relied", RELIED, ids=lambda each: f"{each.owner.rpartition('.')[2]}.{each.name}")
def test_it_is_there(said, relied):
    assert [line for line in said.splitlines() if line.startswith(f"{relied.owner}.{relied.name} ")] == []
    assert said.count("\n") > 1


def test_each_that_is_gone_has_a_line(monkeypatch):
    gone = (
        Relied("tornado.web:RequestHandler", "_never", "nothing"),
        Relied("bokeh.no_such", "x", "less"),
        Relied("tornado.web:RequestHandler", "finish", "answers", ("self",)),
    )
    monkeypatch.setattr("tests.foreign.RELIED", gone)
    assert list(lines()) == [
        "tornado.web:RequestHandler._never is gone: nothing",
        "bokeh.no_such.x is gone with its owner: less",
        "tornado.web:RequestHandler.finish takes self, chunk: answers",
    ]


def trees() -> list[ast.Module]:
    sources = (each for each in ROOT.rglob("*.py") if BUILDING not in each.relative_to(ROOT).parts)
    return [ast.parse(each.read_text(encoding="utf-8")) for each in sources]


def defined(tree: ast.Module) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            yield node.name
        elif isinstance(node, ast.Attribute | ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.attr if isinstance(node, ast.Attribute) else node.id


def is_private(name: str) -> bool:
    return name.startswith("_") and not name.startswith("__")


def test_no_private_name_of_theirs_is_used_that_is_not_listed():
    parsed = trees()
    own = {name for tree in parsed for name in defined(tree)}
    used = {node.attr for tree in parsed for node in ast.walk(tree) if isinstance(node, ast.Attribute)}
    imported = {
        name.name
        for tree in parsed
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] in LIBRARIES
        for name in node.names
    }
    foreign = {name for name in used - own - OURS if is_private(name)} | set(filter(is_private, imported))
    assert foreign - {each.name for each in RELIED} == set()


def test_no_private_method_of_theirs_is_overridden_that_is_not_listed():
    listed = {each.name for each in RELIED}
    for found in pkgutil.walk_packages(app.__path__, "app."):
        if BUILDING in found.name.split(".") or found.name.endswith("__main__"):
            continue
        module = importlib.import_module(found.name)
        for kind in (each for each in vars(module).values() if inspect.isclass(each) and each.__module__ == found.name):
            theirs = [base for base in kind.__mro__[1:] if base.__module__.split(".")[0] in LIBRARIES]
            again = {name for name in vars(kind) for base in theirs if name in vars(base) and is_private(name)}
            assert again - listed - MADE == set(), kind


def test_what_is_listed_is_used():
    text = "\n".join(each.read_text(encoding="utf-8") for each in ROOT.rglob("*.py"))
    assert [each.name for each in RELIED if each.name not in text] == []
