"""Machines that can be had on one: libraries that choose other instructions, other versions of them, other Pythons.

`python -m tests.machines` runs what is quick of the tests on each (`make machines`), `python -m bench --only machines`
compares what every scene gives, a share of which is done with all tests.
"""

import argparse
import functools
import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from . import foreign

ROOT = Path(__file__).parents[1]
BUILT = ROOT / "build" / "machines"
PYTHONS = "3.12", "3.13", "3.14"  # besides the one that runs this
VARIED = "numpy", "scipy", "numba"  # whose lowest and newest allowed versions are tried
PAGE = "newest-page"  # the place of the newest Panel, param, Bokeh and Tornado
FOLLOW = "llvmlite", "pandas", "xarray", "contourpy"  # which some of those ask for in other versions
NUDGES = -3e-12, -1e-12, 1e-12, 3e-12  # relative changes of what is given, far above rounding
CHAOTIC = 1e4  # times what is given is changed, above which a result hangs on the last bits


class Machine(NamedTuple):
    python: Path
    environment: dict[str, str]


def of_this_processor() -> dict[str, Machine]:
    """By name."""
    here = Path(sys.executable)
    found = {f"OpenBLAS of {core}": Machine(here, {"OPENBLAS_CORETYPE": core}) for core in _cores()}
    generic = {
        "NUMBA_CPU_NAME": "generic",
        "XDG_CACHE_HOME": str(BUILT / "generic" / "cache"),
    }  # else both compile anew
    found["kernels for any processor"] = Machine(here, generic)
    found["NumPy without dispatch"] = Machine(here, {"NPY_DISABLE_CPU_FEATURES": " ".join(dispatched())})
    return found


def machines() -> dict[str, Machine]:
    """Those of this processor, and those of the versions and Pythons that are installed, by name."""
    places = ("lowest", "newest", *(f"python-{version}" for version in PYTHONS))
    return of_this_processor() | {
        place: _installed(place) for place in places if (BUILT / place / ".installed").exists()
    }


def dispatched() -> list[str]:
    """Sets of instructions that NumPy looks for when it starts, and finds here."""
    from numpy._core import _multiarray_umath as numpy

    return [each for each in numpy.__cpu_dispatch__ if numpy.__cpu_features__.get(each)]


def _cores() -> list[str]:
    from numpy._core._multiarray_umath import __cpu_features__ as has

    needed = {"Prescott": "SSE3", "Haswell": "AVX2", "SkylakeX": "AVX512F"}
    return [core for core, instructions in needed.items() if has.get(instructions)]


# --- figures of scenes ------------------------------------------------------------------------------------------------

Figures = dict[str, list[tuple[float, float]]]  # by name: values with the sizes that their differences count against


def figures(scene: Any) -> Figures:
    """What a scene gives by its own method."""
    import solvers

    table = solvers.solve(scene).table()
    energy, speed = table["energy"]["initial"], abs(scene.speed)
    found = {f"energy {name}": _sized(value, energy) for name, value in table["energy"].items()}
    for body in ("impactor", "target"):
        found[f"velocity of {body}"] = _sized(table[body].get("final_velocity"), speed)
    found["impulse"] = _sized(table["impulse"], None)
    found["peak force"] = _sized(table["peak_force"], None)
    for name in ("start", "end"):
        found[f"{name} of contacts"] = _sized([contact[name] for contact in table["contacts"][:3]], None)
    reactions = [size for joint in table.get("joints", []) if "moment_impulse" in joint for size in joint["impulse"]]
    found["impulses at joints"] = _sized(reactions, None)
    for name, link in table.get("links", {}).items():
        found[f"velocity of {name}"] = _sized(link["final_velocity"], speed)
    return {name: values for name, values in found.items() if values}


def _sized(value: Any, size: float | None) -> list[tuple[float, float]]:
    values = [] if value is None else value if isinstance(value, (list, tuple)) else [value]
    numbers = [float(each) for each in values if each is not None]
    size = size or max(map(abs, numbers), default=0.0)
    return [(number, size or 1.0) for number in numbers]


def difference(first: Figures, second: Figures) -> tuple[float, str]:
    """The largest relative one, and of which figure; infinite where the other has more or fewer of them."""
    worst = 0.0, ""
    for name in first.keys() | second.keys():
        ours, theirs = first.get(name, []), second.get(name, [])
        found = float("inf") if len(ours) != len(theirs) else 0.0
        for (a, size), (b, _) in zip(ours, theirs, strict=False):
            found = max(found, abs(a - b) / size)
        worst = max(worst, (found, name))
    return worst


def sensitivity(scene: Any, own: Figures) -> float:
    """How many times a change of what is given is found in the figures, at worst."""
    return max(difference(own, figures(_nudged(scene, nudge)))[0] / abs(nudge) for nudge in NUDGES)


def _nudged(scene: Any, nudge: float) -> Any:
    """The scene with another mass of what strikes; where that is none of its own, with another force."""
    impactor = scene.table()["impactor"]
    if impactor["kind"] == "mechanism":
        links = [link | {"mass": link["mass"] * (1.0 + nudge)} for link in impactor["links"]]
        return scene.replace({"impactor.links": links})
    key = next(name for name in ("mass", "velocity", "length", "force") if isinstance(impactor.get(name), float))
    return scene.replace({f"impactor.{key}": impactor[key] * (1.0 + nudge)})


class Seen(NamedTuple):
    """Of a scene on a machine."""

    key: str  # of the tables that are stored of it
    figures: Figures


def seen(name: str) -> Seen:
    """Of a built-in scene, here."""
    import solvers
    from solvers.accuracy.store import scene_key

    scene = solvers.load(name)
    return Seen(scene_key(scene), figures(scene))


def measured(machine: Machine, scenes: Iterable[str]) -> dict[str, Seen]:
    """These scenes on a machine, by a process of its own."""
    done = subprocess.run(
        [machine.python, "-m", "tests.machines", "--figures", *scenes], cwd=ROOT, text=True, capture_output=True,
        env=os.environ | {"PYTHONPATH": str(ROOT)} | machine.environment, check=False,
    )  # fmt: skip
    if done.returncode:
        raise RuntimeError(done.stderr)
    return {name: Seen(*each) for name, each in json.loads(done.stdout).items()}


# --- versions and Pythons ---------------------------------------------------------------------------------------------


def install() -> None:
    """Have the lowest and the newest allowed versions, and the other Pythons that there are, each in a place of its
    own."""
    pinned = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    free = [line for line in pinned if line.partition("==")[0].lower() not in (*VARIED, *FOLLOW)]
    lowest = [f"{name}=={number}" for name, number in lower_bounds().items()]
    wanted = {"lowest": (sys.executable, free + lowest), "newest": (sys.executable, free)}
    for version in PYTHONS:
        if python := _python(version):
            wanted[f"python-{version}"] = python, pinned
        else:
            print(f"Python {version} is not installed, and is left out.")
    for place, (python, constraints) in wanted.items():
        _install(place, python, constraints, ["-e", ".[test]"])
    _install(PAGE, sys.executable, [], list(foreign.LIBRARIES))


def _install(place: str, python: str, constraints: list[str], what: list[str]) -> None:
    """Have these packages in an environment of that name."""
    folder = BUILT / place
    if not (folder / ".installed").exists():
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "constraints.txt").write_text("\n".join(constraints) + "\n", encoding="utf-8")
        subprocess.run([python, "-m", "venv", folder], check=True)
        pip = [folder / "bin" / "pip", "install", "--quiet", "--no-compile", "--disable-pip-version-check"]
        subprocess.run([*pip, "--constraint", folder / "constraints.txt", *what], cwd=ROOT, check=True)
        (folder / ".installed").touch()


def _installed(place: str) -> Machine:
    return Machine(BUILT / place / "bin" / "python", {"XDG_CACHE_HOME": str(BUILT / place / "cache")})


def _python(version: str) -> str | None:
    """One that runs: a name on the path may be a shim that only says where there are some, as pyenv's are."""
    folders = os.environ["PATH"].split(os.pathsep)
    if shutil.which("pyenv"):
        root = subprocess.run(["pyenv", "root"], capture_output=True, text=True, check=False).stdout.strip()
        folders += [str(each / "bin") for each in sorted(Path(root, "versions").glob(f"{version}.*"))]
    for folder in folders:
        python = shutil.which(f"python{version}", path=folder)
        if python and not subprocess.run([python, "-c", ""], capture_output=True, check=False).returncode:
            return python
    return None


@functools.cache
def lower_bounds() -> dict[str, str]:
    """Of the packages whose versions are varied, as pyproject.toml has them."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    split = (re.fullmatch(r"(\w+)>=([\d.]+).*", each) for each in project["dependencies"])
    return {found[1]: found[2] for found in split if found and found[1] in VARIED}


def run_tests(names: Sequence[str]) -> int:
    """Run the quick tests on each machine; how many failed there."""
    failed = []
    for name, machine in machines().items():
        if names and name not in names:
            continue
        print(f"\n== {name} {machine.environment or ''}", flush=True)
        call = [machine.python, "-m", "pytest", "-q", "-n", "auto", "--dist", "worksteal", "-p", "no:cacheprovider"]
        done = subprocess.run(
            [*call, "-m", "not browser and not slow"], cwd=ROOT, env=os.environ | machine.environment, check=False
        )
        failed += [name] if done.returncode else []
    print("\nFailed: " + ", ".join(failed) if failed else "\nAll machines agree.")
    return len(failed)


def rehearse() -> None:
    """Say what would break the page with the newest of what it relies on."""
    print(f"\n== {PAGE}", flush=True)
    subprocess.run([_installed(PAGE).python, "-m", "tests.foreign"], cwd=ROOT, check=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--figures", nargs="+", metavar="SCENE", help="print what these scenes give")
    parser.add_argument("--only", action="append", default=[], metavar="NAME", help="one of: " + ", ".join(machines()))
    options = parser.parse_args()
    if options.figures:
        from solvers.jit.shortcuts import shorten

        shorten()
        print(json.dumps({name: seen(name) for name in options.figures}))
        return 0
    install()
    rehearse()
    return run_tests(options.only)


if __name__ == "__main__":
    sys.exit(main())
