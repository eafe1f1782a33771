"""What Numba need not do again and again finds the same."""

import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import numba
import pytest
from llvmlite import ir as llvm
from numba import types
from numba.core import ir, typing
from numba.core.compiler import Flags
from numba.core.registry import cpu_target
from numba.core.typing import signature
from numba.core.typing.templates import AbstractTemplate

from solvers.jit import shortcuts

shortcuts.shorten()
ROOT = Path(__file__).parents[3]


def test_flags_of_compiling_are_alike_where_what_they_ask_for_is():
    plain, said, other = Flags(), Flags(), Flags()
    said.nrt = Flags.options["nrt"].default
    other.nrt = not said.nrt
    assert plain == said and hash(plain) == hash(said)
    assert plain != other and said != other and plain != "flags"


def test_a_product_of_two_types_is_looked_for_once():
    looked_for = []

    class Product(AbstractTemplate):
        key = "a product"

        def generic(self, arguments, _):
            looked_for.append(arguments)
            return signature(arguments[0], *arguments) if arguments[0] == arguments[1] else None

    product, context = types.Function(Product), typing.Context()
    pairs = (types.float64, types.float64), (types.int64, types.int64), (types.float64, types.float64)
    found = [product.get_call_type(context, pair, {}) for pair in pairs]
    assert [str(each.return_type) for each in found] == ["float64", "int64", "float64"]
    assert looked_for == list(pairs[:2])
    for _ in range(2):  # what does not fit is not remembered
        with pytest.raises(numba.TypingError):
            product.get_call_type(context, (types.float64, types.int64), {})


def test_variables_of_an_instruction_are_found_in_all_its_fields():
    where = ir.Loc("here", 1)
    scope = ir.Scope(None, where)
    a, b, c, d, e = (scope.define(name, where) for name in "abcde")
    call = ir.Expr.call(a, [b, (c, [d])], (("by", e),), where)
    assert call.list_vars() == [a, b, c, d, e]
    assert ir.Assign(ir.Expr.binop(len, b, c, where), a, where).list_vars() == [b, c, a]
    assert ir.Assign(ir.Const(1, where), a, where).list_vars() == [a]
    assert ir.Jump(3, where).list_vars() == []
    assert ir.Return(a, where).list_vars() == [a]


def test_a_size_in_memory_is_asked_for_once_a_type(monkeypatch):
    asked, of_numba = [], llvm.Type._get_ll_global_value_type
    monkeypatch.setattr(
        llvm.Type, "_get_ll_global_value_type", lambda self, *rest: (asked.append(self), of_numba(self, *rest))[1]
    )
    data = cpu_target.target_context.target_data
    kinds = [llvm.ArrayType(llvm.DoubleType(), count) for count in (1237, 1238, 1237)]
    assert [kind.get_abi_size(data) for kind in kinds] == [9896, 9904, 9896]
    assert asked == kinds[:2]


UNKNOWN = """
import logging, numba
numba.__version__ = "0.99.0"
import numpy as np
from solvers.jit import shortcuts
from solvers.numerics.multibody.moving import arm_of
shortcuts.shorten(), shortcuts.shorten()
assert not shortcuts.applied()
print(arm_of(np.zeros(3), 0, np.array([7.0, 2.0]))[0])
"""


@pytest.mark.slow
def test_on_a_numba_that_they_were_not_tried_on_kernels_are_compiled_without_with_one_line(tmp_path):
    where = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", UNKNOWN], cwd=ROOT, env=where, capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (0, "7.0\n"), done.stderr
    assert done.stderr.count("\n") == 1 and "Numba 0.99.0" in done.stderr


def test_every_version_that_may_be_installed_is_one_that_they_were_tried_on():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    (wanted,) = (each for each in project["dependencies"] if each.startswith("numba"))
    low, high = re.fullmatch(r"numba>=0\.(\d+),<0\.(\d+)", wanted).groups()
    assert tuple(f"0.{minor}" for minor in range(int(low), int(high))) == shortcuts.TESTED
    assert shortcuts.applied() and shortcuts.known(numba.__version__)
