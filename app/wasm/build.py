"""Builds the module: `make wasm`, or `python -m app.wasm.build [FILE]`.

Numba makes the intermediate code of the entries as it does for this machine; before that is optimised, it is turned
into that of a machine of 32-bit pointers, and LLVM optimises it for that. A linker adds the exponential and the like,
of musl, so that answers hang on no browser's own. What long loops ask for the time is the one function that the module
is given: `app/static/wasm/memory.js` has it.
"""

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Any

os.environ["NUMBA_CACHE_DIR"] = tempfile.mkdtemp()  # kernels that are kept elsewhere are machine code of this machine

import llvmlite.binding as llvm
import numba
from numba.core import caching, codegen

from solvers.jit.shortcuts import shorten

from .entries import ENTRIES, room
from .module import MODULE, named_in, signed

TRIPLE = "wasm32-unknown-unknown"
STACK = "-Wl,-z,stack-size=262144"  # bytes, instead of 16 MB; it lies first, so that to overflow it is a trap
LINKER = ("-target", "wasm32-wasi", "-mexec-model=reactor", "-nostartfiles", "-O2", "-lm", STACK)
NO_COUNTING = ("NRT_incref", "NRT_decref")  # of references: all arrays are borrowed
CLOCK = "5clock10check_timeB"  # in the name of `solvers.jit.clock.check_time`
ASKED = ("  call void @check_time()", "  ret i32 0", "}")
IMPORTED = """declare void @check_time() nounwind memory(inaccessiblemem: readwrite)
  "wasm-import-module"="strikewave" "wasm-import-name"="check_time"
"""  # what it returns to goes on as if nothing were asked


class NoLinker(Exception):
    """The package that brings it is not installed."""


def build() -> bytes:
    """The module. Raises NoLinker; takes half a minute."""
    if find_spec("ziglang") is None:
        raise NoLinker("No linker: pip install ziglang, as pinned in constraints.txt. The module that came is used.")
    with tempfile.TemporaryDirectory() as folder:
        compiled, linked = Path(folder) / "kernels.o", Path(folder) / "kernels.wasm"
        compiled.write_bytes(_object())
        exports = [f"-Wl,--export={name}" for name in (*ENTRIES, "__heap_base", "__stack_pointer")]
        command = [sys.executable, "-m", "ziglang", "cc", *LINKER, "-Wl,--no-entry", "-Wl,--strip-all", *exports]
        subprocess.run([*command, compiled, "-o", linked], check=True)
        return signed(linked.read_bytes())


def _object() -> bytes:
    """All entries as one, so that what several call is there once."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    machine = llvm.Target.from_triple(TRIPLE).create_target_machine(opt=3, reloc="static")
    machine_of = {"triple": TRIPLE, "datalayout": str(machine.target_data)}
    nothing = [f"define linkonce_odr void @{each}(ptr %p) {{\n  ret void\n}}" for each in NO_COUNTING]
    module = llvm.parse_assembly("")
    for name, entry in ENTRIES.items():
        text, entered = _intermediate(entry.function, entry.signature)
        text = "\n".join([*_rewritten(text.split("\n"), machine_of), *nothing, IMPORTED]).replace(
            "= common ", "= linkonce_odr "
        )
        text = text.replace(f'@"{entered}"', f"@{name}").replace(f"@{entered}(", f"@{name}(")
        module.link_in(llvm.parse_assembly(text))
    module.verify()
    for each in module.functions:
        if not each.is_declaration and each.name not in ENTRIES:
            each.linkage = "internal"
    tuning = llvm.create_pipeline_tuning_options(speed_level=3)
    tuning.loop_unrolling = False  # a sixth of the module, and nothing is slower
    builder = llvm.create_pass_builder(machine, tuning)
    builder.getModulePassManager().run(module, builder)
    if "inttoptr (i64" in str(module):
        raise ValueError("an address of this process is left in the code")
    return machine.emit_object(module)


def _rewritten(lines: list[str], machine_of: dict[str, str]) -> Iterator[str]:
    """The code for another machine, without what counts references, and with a clock."""
    within = False
    for line in lines:
        counts = any(f"@{name}(" in line for name in NO_COUNTING)
        asks = CLOCK in line and line.startswith("define ")
        if asks:
            yield from (line, *ASKED)
        within = within or asks or (counts and line.startswith("define "))
        if not within and not (counts and line.startswith("declare ")):
            word, _, rest = line.removeprefix("target ").partition(" = ")
            yield (
                f'target {word} = "{machine_of[word]}"'
                if rest and line.startswith("target ") and word in machine_of
                else line
            )
        within = within and line != "}"


def _intermediate(function: Callable, signature: Any) -> tuple[str, str]:
    """The intermediate code of a function with all that it calls, before it is optimised; and its name there."""
    with _unoptimised():
        compiled = numba.njit(signature, error_model="numpy")(function)
    (built,) = compiled.overloads.values()
    return str(built.library._final_module), built.fndesc.llvm_func_name


@contextmanager
def _unoptimised() -> Iterator[None]:
    """Numba as it is, but for machine code: nothing is optimised, linked or taken from its cache."""

    def nothing(*_: Any, **__: Any) -> None:
        return None

    def finished(self: Any) -> None:
        self._finalized = True

    library, jit, cache = codegen.CPUCodeLibrary, codegen.JITCPUCodegen, caching.CompileResultCacheImpl
    changed = (
        (library, "_optimize_functions", nothing),
        (library, "_optimize_final_module", nothing),
        (library, "_finalize_final_module", finished),
        (jit, "set_env", nothing),
        (jit, "_library_class", codegen.JITCodeLibrary),  # not that of the shortcuts, which optimises what is asked for
        (cache, "check_cachable", nothing),
    )
    before = [(where, name, getattr(where, name)) for where, name, _ in changed]
    for where, name, new in changed:
        setattr(where, name, new)
    try:
        yield
    finally:
        for where, name, old in before:
            setattr(where, name, old)


def main() -> None:
    shorten()
    try:
        module = build()
    except NoLinker as why:
        sys.exit(str(why))
    place = Path(*sys.argv[1:]) if sys.argv[1:] else MODULE
    place.parent.mkdir(parents=True, exist_ok=True)
    place.write_bytes(module)
    place.with_name("room.js").write_text(room(), encoding="utf-8")
    print(f"{place.name}: {len(module)} bytes, of sources {named_in(module)}")


if __name__ == "__main__":
    main()
