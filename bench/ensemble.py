"""How far to trust an impact: an ensemble of 200 runs, and where its time goes."""

import numpy as np

import solvers
from solvers import Modal, ensemble
from solvers.methods.modal.march import again

from .kernels import bare_rotation
from .size import of
from .timing import median, processor_times, row

MODES, STEPS, RUNS = 40, 20_000, 200


def measure() -> dict[str, object]:
    scene, method = solvers.load("table-8.4"), Modal(modes=MODES, steps=STEPS, estimate=False)
    base = method.solve(scene)
    record = again(base.motion, scene)[1]
    runs = of(RUNS, 10)
    turn = np.ones(MODES), np.zeros(MODES)
    whole = median(lambda: ensemble(scene, method, runs=runs), 5)
    floor, kernel, reporting = processor_times(
        [
            lambda: bare_rotation(*turn, np.ones(MODES), np.zeros(MODES), STEPS),
            lambda: again(base.motion, scene, record),
            lambda: again(base.motion, scene, record)[0].contacts(),
        ]
    )
    rigid = solvers.load("fixed-rod")
    return dict(
        [
            row("ensemble of 200 runs, thesis beam, plastic law, 40 modes", whole, "s", "<= 0.5"),
            row("one of its runs: bare rotation of the oscillators", 1e3 * floor, "ms", "the floor"),
            row("one of its runs: the kernel", 1e3 * kernel, "ms"),
            row("one of its runs: times the floor", kernel / floor, "x", "<= 2.5"),
            row("one of its runs: telling its contacts", 1e3 * (reporting - kernel), "ms"),
            row("ensemble of 200 exact solves, fixed rod", median(lambda: ensemble(rigid, runs=runs), 5), "s"),
        ]
    )
