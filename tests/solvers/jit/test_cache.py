"""Kernels in the cache, damaged or not, and who must not compile one."""

import os
import pickle
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import ModuleType

import numba
import pytest

from solvers.jit import cache as kept

from ...patience import SECONDS

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize(
    "changed, again",
    [
        ("numerics/waves/nodes.py", True),
        ("numerics/waves/record.py", True),  # called by what is called
        ("contact/elastic.py", True),  # whose methods are compiled into it
        ("jit/kernels.py", True),
        ("jit/reference.py", True),
        ("numerics/waves/rigid.py", False),
        ("methods/waves/method.py", False),
        ("validation.py", False),  # which the laws import, as they do words
        ("text/notes.py", False),
    ],
)
def test_a_kernel_is_compiled_again_when_a_source_of_its_code_has_changed(tmp_path, monkeypatch, changed, again):
    key_changes(tmp_path, monkeypatch, "numerics/waves/network.py", changed, again)


@pytest.mark.parametrize(
    "kernels, changed, again",
    [
        ("numerics/elements/banded.py", "numerics/elements/newmark.py", True),  # which may give them its tuples
        ("numerics/oscillators.py", "stability/integrators.py", True),  # from another folder
        ("numerics/oscillators.py", "numerics/arrays.py", True),
        ("numerics/elements/newmark.py", "numerics/arrays.py", True),  # imported from the folder above
        ("numerics/elements/newmark.py", "numerics/elements/__init__.py", False),
        ("numerics/elements/newmark.py", "numerics/waves/nodes.py", False),
    ],
)
def test_files_are_found_in_folders_of_folders(tmp_path, monkeypatch, kernels, changed, again):
    key_changes(tmp_path, monkeypatch, kernels, changed, again)


def key_changes(tmp_path, monkeypatch, kernels: str, changed: str, again: bool) -> None:
    """Whether the key of the file of kernels is another one after a change of another file."""
    library = tmp_path / "solvers"
    shutil.copytree(ROOT / "solvers", library, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(kept, "LIBRARY", library)

    def key() -> str:
        kept.kernels_key.cache_clear()
        kept._imports.cache_clear()
        return kept.kernels_key(library / kernels)

    before = key()
    with open(library / changed, "a", encoding="utf-8") as source:
        source.write("# changed\n")
    assert (key() != before) is again
    kept.kernels_key.cache_clear()


# --- a cache that is damaged, full or cannot be written ---------------------------------------------------------------

CALLS = """
import numpy as np
from solvers.jit.cache import _KernelFile
from solvers.jit.compiling import NotCompiled, compiled_only
from solvers.numerics.multibody.moving import arm_of
from solvers.numerics.parting import backwards, reach, swing_and_give
from solvers.numerics.single_degree import SAMPLES, spread
one = np.ones(1)
calls = (
    (arm_of, (np.zeros(3), 0, np.array([7.0, 2.0]))),
    (reach, (2.0, 4.0)),
    (backwards, (2.0, 0.0, 1.0, np.inf)),
    (swing_and_give, (one, one, 1.0, 1.0)),
    (spread, (1.0, 2.0, np.zeros(SAMPLES + 3))),
)

def found():
    for kernel, given in calls{some}:
        _KernelFile._told.clear()
        print(kernel(*given))

"""
TRY = """
try:
    with compiled_only():
        found()
except NotCompiled as wanted:
    print(wanted)
    found()
"""
ONE, SEVERAL = CALLS.format(some="[:1]"), CALLS.format(some="")
FOUND = "found()\n"
ANSWER = ["(7.0,", "2.0)"]  # of the first


def ran(code: str, cache: Path, **more: str) -> subprocess.CompletedProcess:
    where = os.environ | {"NUMBA_CACHE_DIR": str(cache)} | more
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, env=where, capture_output=True, text=True, timeout=SECONDS
    )
    assert done.returncode == 0, done.stderr
    return done


@pytest.fixture(scope="module")
def first(tmp_path_factory):
    """A cache that was empty, and what was found there."""
    cache = tmp_path_factory.mktemp("filled")
    done = ran(SEVERAL + TRY, cache)
    assert done.stderr == ""
    return cache, done.stdout.splitlines()


@pytest.fixture(scope="module")
def filled(first):
    """A cache with the kernels of some calls."""
    return first[0]


@pytest.mark.slow
def test_a_kernel_is_refused_until_it_is_in_the_cache(first):
    cache, (refused, *answers) = first
    assert refused == "arm_of" and len(answers) == len(DAMAGES)
    assert ran(SEVERAL + TRY, cache).stdout.splitlines() == answers


def cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:40])


def flipped(path: Path) -> None:
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 0xFF
    path.write_bytes(content)


DAMAGES = {  # of a kernel each: in which of its files, and how
    "arm_of": ("nbi", lambda path: path.write_bytes(b"garbage")),
    "reach": ("nbi", cut),
    "backwards": ("nbc", lambda path: path.write_bytes(b"")),
    "swing_and_give": ("nbc", cut),
    "spread": ("nbc", flipped),
}


@pytest.mark.slow
def test_a_damaged_kernel_is_put_aside_with_one_line_and_compiled_again(tmp_path, first):
    cache, (_, *answers) = first
    shutil.copytree(cache, tmp_path, dirs_exist_ok=True)
    for kernel, (ending, damage) in DAMAGES.items():
        (path,) = tmp_path.rglob(f"*.{kernel}-*.{ending}")
        damage(path)
    found = ran(SEVERAL + FOUND, tmp_path)
    assert found.stdout.splitlines() == answers
    lines = found.stderr.splitlines()
    assert len(lines) == len(DAMAGES) and all("put aside" in line for line in lines)
    assert len(list(tmp_path.rglob("*.damaged"))) == len(DAMAGES)
    again = ran(SEVERAL + TRY, tmp_path)  # they are in the cache again
    assert (again.stdout.splitlines(), again.stderr) == (answers, "")


@pytest.fixture
def other_sources(monkeypatch):
    """A class of a module that these sources have, until it is forgotten."""
    module = ModuleType("other_sources")
    module.Law = type("Law", (), {"__module__": "other_sources"})
    monkeypatch.setitem(sys.modules, "other_sources", module)
    return module


@pytest.mark.parametrize("gone", ["class", "module"])
@pytest.mark.parametrize("where", ["key", "data"])
def test_a_kernel_of_other_sources_is_compiled_again_without_a_word(
    tmp_path, monkeypatch, caplog, other_sources, gone, where
):
    """Branches share a cache: what one knows the other may not."""
    monkeypatch.setattr(kept._KernelFile, "_told", set())
    key, data = (other_sources.Law, "code") if where == "key" else ("kernel", other_sources.Law)
    kept._KernelFile(str(tmp_path), "kernel", "stamp").save(key, data)
    if gone == "class":
        del other_sources.Law
    else:
        monkeypatch.setitem(sys.modules, "other_sources", None)
    again = kept._KernelFile(str(tmp_path), "kernel", "stamp")
    assert again.load("kernel") is None
    again.save("kernel", "code")
    assert again.load("kernel") == "code"
    assert not caplog.records and not list(tmp_path.glob("*.damaged"))


NOWHERE = """
import solvers.jit.cache as jit, tempfile
from pathlib import Path

def refuse(*given, **more):
    raise OSError(28, "No space left on device")
tempfile.TemporaryFile = refuse
own = jit._usable(Path({cache!r}))
print(own, len(list(own.rglob("*.nbc"))))
tempfile.mkdtemp = refuse
print(jit._usable(Path({cache!r})))
"""


@pytest.mark.slow
def test_a_full_disk_is_seen_before_anything_is_kept_there(tmp_path, filled):
    """What is in the cache is taken along to where there is room; if there is none, it is read where it is."""
    shutil.copytree(filled, tmp_path, dirs_exist_ok=True)
    kept = len(list(tmp_path.rglob("*.nbc")))
    found = ran(NOWHERE.format(cache=str(tmp_path)), tmp_path / "other")
    elsewhere, number, nowhere = found.stdout.split()
    assert elsewhere != str(tmp_path) and int(number) == kept
    assert "No space left" in found.stderr
    assert not Path(elsewhere).exists()  # nor is anything left behind
    assert nowhere == str(tmp_path)


def test_what_is_copied_of_a_cache_that_may_only_be_read_can_be_written(tmp_path, filled, monkeypatch, caplog):
    """Modes were copied too, and the next kernel ended the program."""
    shutil.copytree(filled, tmp_path / "cache")
    folders = [tmp_path / "cache", *(each for each in (tmp_path / "cache").rglob("*") if each.is_dir())]
    for folder in folders:
        folder.chmod(0o555)

    def refuse(dir):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(kept.tempfile, "TemporaryFile", refuse)
    own = kept._usable(tmp_path / "cache")
    for folder in folders:
        folder.chmod(0o755)
    copies = [own, *own.rglob("*")]
    assert len(copies) == 1 + len(list((tmp_path / "cache").rglob("*")))
    assert all(each.stat().st_mode & 0o200 for each in copies)
    assert len(caplog.records) == 1 and "Permission denied" in caplog.text


FULL = """
from solvers.jit import cache
def refuse(*given):
    raise OSError(28, "No space left on device")
cache._KernelFile._save_index = refuse
"""


@pytest.mark.slow
def test_a_kernel_that_cannot_be_kept_is_used_all_the_same(tmp_path):
    found = ran(FULL + ONE + FOUND, tmp_path)
    assert found.stdout.split() == ANSWER
    assert found.stderr.count("\n") == 1 and "cannot be kept" in found.stderr


# --- a cache from another machine or another Numba --------------------------------------------------------------------


@pytest.mark.slow
def test_kernels_of_another_processor_are_compiled_again_with_one_line(tmp_path, filled):
    """Also what a wheel or an image brings to a processor without AVX2. Both are kept, side by side."""
    shutil.copytree(filled, tmp_path, dirs_exist_ok=True)
    older = {"NUMBA_CPU_NAME": "generic"}
    found = ran(ONE + FOUND, tmp_path, **older)
    assert found.stdout.split() == ANSWER
    assert found.stderr.count("\n") == 1 and "another processor" in found.stderr
    for more in (older, {}):
        again = ran(ONE + TRY, tmp_path, **more)
        assert (again.stdout.split(), again.stderr) == (ANSWER, "")


@pytest.mark.slow
def test_kernels_of_another_numba_are_compiled_again_with_one_line(tmp_path, filled):
    shutil.copytree(filled, tmp_path, dirs_exist_ok=True)
    own, older = (pickle.dumps(version, protocol=-1) for version in (numba.__version__, "0.60.0"))
    for index in tmp_path.rglob("*.nbi"):
        content = index.read_bytes()
        assert content.startswith(own)
        index.write_bytes(older + content.removeprefix(own))
    found = ran(ONE + FOUND, tmp_path)
    assert found.stdout.split() == ANSWER
    assert found.stderr.count("\n") == 1 and "0.60.0" in found.stderr
    again = ran(ONE + TRY, tmp_path)
    assert (again.stdout.split(), again.stderr) == (ANSWER, "")


def test_what_is_compiled_for_one_processor_is_not_taken_to_be_for_another(monkeypatch):
    """The sign that all usual kernels are there."""
    found = set()
    for processor in ("generic", "another"):
        monkeypatch.setattr("numba.config.CPU_NAME", processor)
        found.add(kept.all_compiled())
    assert len(found) == 2


@pytest.mark.parametrize("caller", ["bouncing.py", "free.py", "pressing.py"])
def test_kernels_that_are_given_a_linkage_are_compiled_again_when_its_file_has_changed(caller):
    folder = kept.LIBRARY / "numerics" / "multibody"
    assert {folder / "moving.py", folder / "variational.py", folder / "inertia.py"} <= kept._sources_of(folder / caller)


def test_a_file_of_the_cache_is_whole_however_many_write_it(tmp_path):
    path, length = tmp_path / "folder" / "known.json", 200_000
    kept.keep_text(path, "0" * length)
    with ThreadPoolExecutor(4) as pool:
        writing = [pool.submit(kept.keep_text, path, str(digit) * length) for digit in range(10) for _ in range(5)]
        while not all(each.done() for each in writing):
            assert len(found := path.read_text(encoding="utf-8")) == length and len(set(found)) == 1
    assert [each.result() for each in writing] == [None] * 50
    assert list(path.parent.iterdir()) == [path]


def test_where_nothing_can_be_kept_nothing_is_left(tmp_path):
    (tmp_path / "known.json").mkdir()  # a folder in its place
    with pytest.raises(OSError):
        kept.keep_text(tmp_path / "known.json", "{}")
    assert [each.name for each in tmp_path.iterdir()] == ["known.json"]


def test_kernels_beside_the_library_may_import_what_is_beside_them(tmp_path):
    (tmp_path / "timing.py").write_text("STEP = 0.1\n", encoding="utf-8")
    (tmp_path / "own.py").write_text("from .timing import STEP\n", encoding="utf-8")
    assert kept._closure(tmp_path / "own.py") == {tmp_path / "own.py", tmp_path / "timing.py"}
