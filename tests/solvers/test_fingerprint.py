"""Fingerprints of code: what changes them, what does not, and what they reach."""

import subprocess
import sys
from pathlib import Path

import pytest

import solvers
from solvers import METHODS, fingerprint
from solvers.accuracy.measured_code import MEASURING, changed, code_now, code_of

FILES = {
    "methods/modal.py": '''
"""A method."""
from ..contact import Hertz
from ..text.notes import Note


def solve(steps=[], law=Hertz):  # of a scene
    """By modes."""
    from ..numerics.march import march

    return march(steps, law, f"{steps!r:>{4}}")
''',
    "numerics/march.py": "def march(*given):\n    return given[0] + 1\n",
    "contact/__init__.py": "from .elastic import Hertz\nfrom .plastic import Tabor\n",
    "contact/elastic.py": "class Hertz:\n    'A law.'\n    power = 1.5\n",
    "contact/plastic.py": "class Tabor:\n    power = 2.0\n",
    "text/notes.py": "class Note:\n    pass\n",
}


@pytest.fixture
def library(tmp_path, monkeypatch):
    """A small one."""
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    monkeypatch.setattr(fingerprint, "LIBRARY", tmp_path)
    return tmp_path


def of(library: Path, deep: bool = True) -> str:
    for kept in (fingerprint._tree, fingerprint._code, fingerprint._imported):
        kept.cache_clear()
    return fingerprint.fingerprint([library / "methods/modal.py"], deep)


def edit(path: Path, old: str, new: str) -> None:
    assert old in path.read_text()
    path.write_text(path.read_text().replace(old, new))


@pytest.mark.parametrize(
    "name, old, new",
    [
        ("methods/modal.py", '"""A method."""', '"""The same, otherwise said."""\n\n# A comment.\n'),
        ("methods/modal.py", '    """By modes."""\n', ""),
        ("methods/modal.py", "(steps=[], law=Hertz):", "(\n    steps=[],\n    law=Hertz,\n):"),
        ("contact/elastic.py", "'A law.'", "'Another.'"),
        ("text/notes.py", "pass", "words = 'more'"),
        ("contact/plastic.py", "2.0", "3.0"),  # which is not imported
    ],
)
def test_what_says_things_and_what_is_not_used_does_not_count(library, name, old, new):
    before = of(library)
    edit(library / name, old, new)
    assert of(library) == before


@pytest.mark.parametrize(
    "name, old, new",
    [
        ("methods/modal.py", "steps=[]", "steps=None"),
        ("methods/modal.py", "!r:>{4}", "!r:>{5}"),
        ("numerics/march.py", "+ 1", "- 1"),  # imported in a function
        ("contact/elastic.py", "1.5", "1.6"),  # by way of a package
    ],
)
def test_code_counts_wherever_it_is_imported_from(library, name, old, new):
    before = of(library), of(library, deep=False)
    edit(library / name, old, new)
    assert of(library) != before[0]
    assert (of(library, deep=False) == before[1]) == (not name.startswith("methods"))


def test_what_a_table_keeps_says_which_methods_have_changed_since():
    assert set(code_now()) == {*METHODS, *MEASURING}
    code = code_of(["waves", "modal"], "errors")
    assert set(code) == {"errors", "waves", "modal"} and changed(code) == []
    assert changed(code | {"modal": "of before"}) == ["modal"]
    assert changed(code | {"no longer a method": "of before"}) == ["no longer a method"]
    assert changed(None) == list(METHODS)


@pytest.mark.slow
def test_another_process_finds_the_same_and_a_third_reads_it(tmp_path):
    code = "from solvers.accuracy.measured_code import code_now; print(code_now())"
    for _ in range(2):
        run = subprocess.run(
            [sys.executable, "-c", code], check=True, capture_output=True, text=True,
            cwd=Path(solvers.__file__).parents[1], env={"XDG_CACHE_HOME": str(tmp_path), "PATH": ""},
        )  # fmt: skip
        assert run.stdout.strip() == str(code_now())
    (kept,) = tmp_path.rglob("fingerprints.json")
    kept.write_text("{half a")
    assert "modal" in fingerprint.remembered({"modal": ([Path(solvers.__file__)], False)})
