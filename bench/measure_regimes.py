"""Measure where cheap models hold, and store it as the library's data: python -m bench.measure_regimes

Every point is one scene solved in full and by each cheap model; what is stored are the errors. A few minutes on two
cores; solvers/regimes/regimes.npz is written anew. Stopped half-way it goes on where it was, unless code has changed.
"""

import argparse
import itertools
import json
import multiprocessing
import os
import resource
import shutil
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from datetime import date
from pathlib import Path

import numpy as np

from solvers.accuracy.measured_code import code_of
from solvers.accuracy.reference import swept_reference
from solvers.contact import PlasticLinear, PlasticPower, YigitChristoforou
from solvers.jit.cache import cache_home
from solvers.methods import Modal, QuasiStatic, RigidImpulse, Waves
from solvers.provenance import machine
from solvers.regimes.models import (  # fmt: skip
    BEAMS,
    LAWS,
    LOSSES,
    RODS,
    errors,
    family_scene,
    figures,
    lossy_scene,
    model_errors,
    modes_errors,
)
from solvers.regimes.tables import STORED, encoded
from solvers.scene import Scene

ROD_AXES = np.geomspace(1e-2, 1e3, 51), np.concatenate(([0.0], np.geomspace(1e-2, 1e2, 49)))
BEAM_AXES = np.geomspace(0.1, 100.0, 19), np.geomspace(0.01, 10.0, 19)
ROD_MODES_AXES = np.geomspace(0.1, 100.0, 10), np.concatenate(([0.0], np.geomspace(1e-2, 10.0, 10)))
BEAM_MODES_AXES = np.geomspace(0.1, 100.0, 7), np.geomspace(0.01, 10.0, 7)
ROD_COUNTS = np.array([1, 2, 3, 5, 8, 12, 20, 30, 50, 80, 120])
BEAM_COUNTS = np.array([1, 2, 3, 5, 8, 12, 20])
SLENDER_AXES = np.geomspace(2.0, 100.0, 11), np.geomspace(0.01, 10.0, 10)
SLENDER_MODES = 15
ROD_LOSSY_AXES = np.geomspace(1e-2, 1e3, 16), np.geomspace(1e-2, 1e2, 17)
BEAM_LOSSY_AXES = np.geomspace(0.1, 100.0, 7), np.geomspace(0.01, 10.0, 10)
YIELD_RATIOS = np.geomspace(0.5, 500.0, 61)
METHODS_USED = [method.NAME for method in (Waves, Modal, QuasiStatic, RigidImpulse)]
PLASTIC = (YigitChristoforou, PlasticLinear, PlasticPower)


def models_row(task: tuple) -> np.ndarray:
    """(times, models, 4) of one mass ratio."""
    family, law, ratio, times = task
    rows = []
    for relative in times:
        scene = family_scene(family, ratio, relative, law)
        rows.append(model_errors(scene, figures(swept_reference(scene))))
    return np.array(rows)


def lossy_row(task: tuple) -> np.ndarray:
    """(times, models, 4) of one mass ratio, law and loss."""
    family, law, loss, ratio, times = task
    rows = []
    for relative in times:
        scene = lossy_scene(family, ratio, relative, law, loss)
        rows.append(model_errors(scene, figures(swept_reference(scene))))
    return np.array(rows)


def modes_row(task: tuple) -> np.ndarray:
    """(times, counts, 4) of one mass ratio."""
    family, ratio, times, counts = task
    rows = []
    for relative in times:
        scene = family_scene(family, ratio, relative)
        rows.append(modes_errors(scene, figures(swept_reference(scene)), counts))
    return np.array(rows)


def slender_row(task: tuple) -> np.ndarray:
    """(times, 4): Euler and Bernoulli against Timoshenko, at one slenderness and mass ratio 1."""
    family, slenderness, times = task
    rows = []
    for relative in times:
        scene = family_scene(family, 1.0, relative, slenderness=slenderness)
        pair = [
            figures(Modal(modes=SLENDER_MODES, estimate=False).solve(scene.replace({"target.theory": theory})))
            for theory in ("euler-bernoulli", "timoshenko")
        ]
        rows.append(errors(*pair))
    return np.array(rows)


def plastic_curve(law: type) -> np.ndarray:
    """(ratios, 3): restitution lost, peak force and contact time missed if the law stays elastic.

    `ratio` is the speed over that at which yield begins, mu v^2 / 2 = 2 K alpha_Y^(5/2) / 5.
    """
    begins = 1e-6
    rows = []
    for ratio in YIELD_RATIOS.tolist():
        stiffness, mass = 1e10, 1.0
        speed = ratio * (0.8 * stiffness * begins**2.5 / mass) ** 0.5
        found = []
        for contact in (
            {"law": law.NAME, "stiffness": stiffness, "yield_indentation": begins},
            {"law": "hertz", "stiffness": stiffness},
        ):
            given = {"impactor": {"mass": mass, "velocity": speed}, "target": {"kind": "stop"}, "contact": contact}
            found.append(figures(QuasiStatic(model="local").solve(Scene.from_table(given)), stresses=False))
        missed = errors(found[1], found[0])
        rows.append(missed[:3])
    return np.array(rows)


def sweeps() -> Iterator[tuple[str, Callable, list[tuple]]]:
    """Of each: its name, the work on one row, and the rows."""
    for family, law in itertools.product(RODS, LAWS):
        yield f"{family}/{law}", models_row, [(family, law, ratio, ROD_AXES[1]) for ratio in ROD_AXES[0]]
    for family in BEAMS:
        yield family, models_row, [(family, "linear", ratio, BEAM_AXES[1]) for ratio in BEAM_AXES[0]]
    for family in (*RODS, *BEAMS):
        (ratios, times), counts = (ROD_MODES_AXES, ROD_COUNTS) if family in RODS else (BEAM_MODES_AXES, BEAM_COUNTS)
        yield f"{family}/modes", modes_row, [(family, ratio, times, counts) for ratio in ratios]
    for family in BEAMS:
        yield f"{family}/theory", slender_row, [(family, each, SLENDER_AXES[1]) for each in SLENDER_AXES[0]]
    for family, (law, losses) in itertools.product((*RODS, *BEAMS), LOSSES.items()):
        ratios, times = ROD_LOSSY_AXES if family in RODS else BEAM_LOSSY_AXES
        for loss in losses:
            yield f"{family}/{law}/{loss:g}", lossy_row, [(family, law, loss, ratio, times) for ratio in ratios]


def code() -> dict[str, str]:
    """Fingerprints of what the map is made with."""
    return code_of(METHODS_USED, "regimes")


def measure() -> dict[str, np.ndarray]:
    """Every sweep; errors as bytes, see `regimes.tables.encoded`."""
    found: dict[str, np.ndarray] = {
        "rod_axes_ratio": ROD_AXES[0], "rod_axes_time": ROD_AXES[1],
        "beam_axes_ratio": BEAM_AXES[0], "beam_axes_time": BEAM_AXES[1],
        "rod_modes_axes_ratio": ROD_MODES_AXES[0], "rod_modes_axes_time": ROD_MODES_AXES[1], "rod_counts": ROD_COUNTS,
        "beam_modes_axes_ratio": BEAM_MODES_AXES[0], "beam_modes_axes_time": BEAM_MODES_AXES[1],
        "beam_counts": BEAM_COUNTS, "slender_axes_ratio": SLENDER_AXES[0], "slender_axes_time": SLENDER_AXES[1],
        "yield_ratios": YIELD_RATIOS,
        "rod_lossy_axes_ratio": ROD_LOSSY_AXES[0], "rod_lossy_axes_time": ROD_LOSSY_AXES[1],
        "beam_lossy_axes_ratio": BEAM_LOSSY_AXES[0], "beam_lossy_axes_time": BEAM_LOSSY_AXES[1],
    }  # fmt: skip
    seconds, scenes, own = {}, {}, code()
    parts = cache_home() / f"regimes-{'-'.join(own.values())}"
    parts.mkdir(parents=True, exist_ok=True)
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(os.cpu_count(), mp_context=context) as pool:
        for name, row, tasks in sweeps():
            kept, begun = parts / f"{name.replace('/', '-')}.npz", time.perf_counter()
            if not kept.exists():
                errors_found = np.array(list(pool.map(row, tasks)))
                with kept.with_suffix(".part").open("wb") as file:
                    np.savez(file, errors=encoded(errors_found), seconds=time.perf_counter() - begun)
                kept.with_suffix(".part").replace(kept)
            with np.load(kept) as part:
                found[name], seconds[name] = part["errors"], float(part["seconds"])
            scenes[name] = found[name].shape[0] * found[name].shape[1]
            print(f"  {name:28}{scenes[name]:6d} scenes  {seconds[name]:8.1f} s", flush=True)
    for law in PLASTIC:
        found[f"plastic/{law.NAME}"] = plastic_curve(law).astype(np.float32)
    children = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024.0
    made = {
        "script": "bench/measure_regimes.py",
        "machine": machine(),
        "date": str(date.today()),
        "code": own,
        "seconds": seconds,
        "scenes": scenes,
    }
    found["made"] = np.array(json.dumps(made | {"largest_process_mb": children}))
    return found


def store() -> None:
    """Measure and write."""
    beside = Path(STORED).with_suffix(".part.npz")
    np.savez_compressed(beside, **measure())
    beside.replace(STORED)
    for folder in cache_home().glob("regimes-*"):
        shutil.rmtree(folder)
    print(f"Stored {Path(STORED).stat().st_size / 1e3:.0f} kB in {STORED}")


if __name__ == "__main__":
    argparse.ArgumentParser(description=__doc__).parse_args()
    store()
