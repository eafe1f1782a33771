"""What kernels are: with what they return, who calls them, and tuples by reference."""

import ast
import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import numba
import numpy as np
import pytest
from numba import types
from numba.core.dispatcher import Dispatcher

import solvers
from solvers.jit import cache, kernels, methods, reference
from solvers.jit.kernels import address, allocating_kernel, inner_kernel, kernel
from solvers.jit.reference import refer, referred

ROOT = Path(__file__).parents[3]


class Pair(NamedTuple):
    first: np.ndarray
    second: np.ndarray


class Nested(NamedTuple):
    pair: Pair
    number: float
    alone: np.ndarray


@inner_kernel
def _write(pair, row, value):
    pair.second[row] = value


@inner_kernel
def _sum(nested):
    return nested.number + nested.alone[0] + nested.pair.first.sum()


@kernel
def _through(nested):
    nested = refer(nested)
    for row in range(3):
        nested.pair.first[row] = 10.0 * row
        _write(nested.pair, row, 0.5 * row)
    return _sum(nested)


def test_a_tuple_by_reference_has_the_fields_of_its_value():
    given = Nested(Pair(np.zeros(3), np.zeros(3)), 0.25, np.array([4.0]))
    assert _through(given) == 34.25
    assert given.pair.first.tolist() == [0.0, 10.0, 20.0] and given.pair.second.tolist() == [0.0, 0.5, 1.0]


class Counted(NamedTuple):
    pairs: Nested
    order: np.ndarray
    table: np.ndarray
    count: int


@kernel
def _seen(counted, row):
    """Of a tuple by reference: its number of values, and what is in a row of its table."""
    counted.pairs.pair.first[row] = counted.pairs.number
    return counted.count * counted.order.size * counted.table.shape[1] + counted.table[row, 1]


def test_a_tuple_is_given_by_reference_from_python():
    given = Counted(Nested(Pair(np.zeros(3), np.zeros(3)), 0.25, np.ones(1)), np.arange(4), np.eye(2, 5)[:, ::2], 7)
    assert _seen(referred(given), 0) == 84.0 and given.pairs.pair.first.tolist() == [0.25, 0.0, 0.0]
    fixed = np.eye(2)
    fixed.flags.writeable = False
    assert _seen(referred(given._replace(table=fixed)), 1) == 57.0
    assert len(_seen.overloads) == 2 and referred(None) is None


def test_where_numba_lays_arrays_out_in_another_way_tuples_are_given_as_they_are(monkeypatch, caplog):
    """Kernels then take them by value, and refer to them within."""
    of_numba = reference.ARRAY_FIELDS
    monkeypatch.setattr(reference, "ARRAY_FIELDS", (*of_numba[1:], of_numba[0]))
    reference._type_of.cache_clear()
    given = Nested(Pair(np.zeros(3), np.zeros(3)), 0.25, np.array([4.0]))
    assert referred(given) is given and referred(given) is given and _through(referred(given)) == 34.25
    (line,) = caplog.messages
    assert numba.__version__ in line
    reference._type_of.cache_clear()


BENT = """
import solvers
from solvers.jit import reference, shortcuts
shortcuts.shorten()
{change}
print(solvers.solve(solvers.load('four-bar-moves')).impulse)
"""


@pytest.mark.slow
def test_links_that_bend_move_the_same_without_references():
    """All kernels that take tuples by reference take them by value too."""
    values = []
    for change in ("", "reference.ARRAY_FIELDS = ()"):
        code = BENT.format(change=change)
        done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
        assert ("another way" in done.stderr) is bool(change)
        values.append(float(done.stdout))
    assert values[0] == pytest.approx(values[1], rel=1e-9)  # compiled otherwise: rounding over thousands of steps


def test_what_is_given_by_reference_has_arrays_and_numbers_alone():
    with pytest.raises((TypeError, ValueError)):
        referred(Pair("a", np.zeros(1)))


@allocating_kernel
def _copied(pair):
    pair = refer(pair)
    return pair.first.copy() + pair.second.copy()


def test_arrays_of_a_tuple_outlive_a_kernel_that_counts_references():
    pair = Pair(np.ones(1000), np.ones(1000))
    counts = [sys.getrefcount(each) for each in pair]
    assert all(_copied(pair)[-1] == 2.0 for _ in range(100))
    assert [sys.getrefcount(each) for each in pair] == counts


def test_a_field_that_a_tuple_has_not_is_refused():
    @numba.njit
    def wrong(pair):
        return refer(pair).third

    with pytest.raises(numba.TypingError, match="third"):
        wrong(Pair(np.zeros(1), np.zeros(1)))


def test_only_what_python_calls_becomes_machine_code():
    within = numba.njit(no_cpython_wrapper=True, no_cfunc_wrapper=True)(lambda x: x + 1.0)
    called = numba.njit(lambda x: 2.0 * within(x))
    assert called(1.0) == 4.0
    made = [next(iter(each.overloads.values())).library._asked for each in (within, called)]
    assert made == [False, True]


def test_what_takes_arguments_from_c_is_there_for_addresses_alone():
    called = numba.njit(**kernels._USUAL)(lambda x: x + 1.0)
    by_address = numba.njit(**kernels._INNER | {"no_cfunc_wrapper": False})(lambda x: x + 2.0)
    assert called(1.0) == 2.0 and address(by_address, types.float64(types.float64)).address
    made = [next(iter(each.overloads.values())).library for each in (called, by_address)]
    names = [[function.name for function in library.get_defined_functions()] for library in made]
    assert [sum(name.startswith("cfunc.") for name in each) for each in names] == [0, 1]
    assert [sum("7cpython" in name for name in each) for each in names] == [1, 0]


def test_a_kernel_that_counts_no_references_returns_no_array_to_python():
    """Else what it returns would be freed while in use: such a kernel must be an `allocating_kernel`."""
    for method in (solvers.methods.Waves(), solvers.methods.Modal(10)):
        solvers.solve(solvers.load("bronze-rod-steel-ball"), method)
    modules = [module for name, module in list(sys.modules.items()) if name.startswith("solvers.")]
    kernels = [each for module in modules for each in vars(module).values() if isinstance(each, Dispatcher)]
    found = [
        (each.py_func.__qualname__, overload.signature.return_type)
        for each in kernels
        if each.targetoptions.get("_nrt") is False and not each.targetoptions.get("no_cpython_wrapper")
        for overload in each.overloads.values()
    ]
    assert found
    for name, kind in found:
        parts = kind.types if isinstance(kind, types.BaseTuple) else [kind]
        assert not any(isinstance(part, types.Array) for part in parts), name


OF_REFERENCES = set(
    re.findall(r'@overload_method\(Reference, "(\w+)"', Path(methods.__file__).read_text(encoding="utf-8"))
)


class OutsideKernels(ast.NodeVisitor):
    """Of one file: the functions that plain Python calls, what is imported from where, and its inner kernels."""

    def __init__(self, source):
        self.called, self.imported, self.inner, self.inside = set(), set(), set(), 0
        self.used = set()  # by kernels
        self.visit(ast.parse(source.read_text(encoding="utf-8")))

    def visit_FunctionDef(self, node):
        marks = {each.id for each in node.decorator_list if isinstance(each, ast.Name) and each.id.endswith("kernel")}
        if "inner_kernel" in marks:
            self.inner.add(node.name)
        inside = bool(marks) or node.name in OF_REFERENCES
        self.inside += inside
        self.generic_visit(node)
        self.inside -= inside

    def visit_ImportFrom(self, node):
        self.imported |= {((node.module or "").split(".")[-1], each.name) for each in node.names}

    def visit_Name(self, node):
        if self.inside:
            self.used.add(node.id)

    def visit_Call(self, node):
        if not self.inside and isinstance(node.func, ast.Name):
            self.called.add(node.func.id)
        self.generic_visit(node)


def test_kernels_use_nothing_of_what_is_said():
    """Whose changes do not have them compiled again."""
    said = {Path(each).stem for part in cache.SAID for each in (part, *(ROOT / "solvers" / part).glob("*.py"))}
    for source in (ROOT / "solvers").rglob("*.py"):
        file = OutsideKernels(source)
        assert not {name for module, name in file.imported if module in said} & file.used, source


@pytest.mark.slow
def test_inner_kernels_are_called_by_kernels_alone():
    """Python would crash: they are compiled without what takes arguments from it."""
    sources = [source for folder in ("solvers", "app", "bench", "tests") for source in (ROOT / folder).rglob("*.py")]
    files = {source: OutsideKernels(source) for source in sources}
    inner = {(source.stem, name) for source, file in files.items() for name in file.inner}
    assert len(inner) > 20
    for source, file in files.items():
        if source.name.endswith("_entries.py"):
            continue  # compiled as wholes, for browsers: Python calls none of them
        known = file.inner | {name for _, name in inner & file.imported}
        assert not known & file.called, source
