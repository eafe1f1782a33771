"""Three solves by which machines are compared: one takes the time of Python, one of kernels, one of linear algebra."""

import time

from threadpoolctl import threadpool_limits

from ..methods import FeModal, Modal, RigidImpulse
from ..methods.base import Method
from ..scene import Scene

SECONDS = 1.0  # of all three together
ROD = {
    "impactor": {"kind": "mass", "mass": 2.0, "velocity": 1.0},
    "target": {
        "kind": "rod",
        "length": 0.3,
        "section": {"width": 0.03, "height": 0.03},
        "material": {"young": 210e9, "density": 7900.0},
        "support": "fixed",
    },
    "contact": {"law": "hertz", "stiffness": 1e10},
}
SOLVES: dict[str, Method] = {  # by what nearly all of their time goes into
    "python": RigidImpulse(),
    "kernels": Modal(modes=200, steps=40_000, estimate=False),
    "algebra": FeModal(elements=1200, estimate=False),
}

Times = dict[str, float]  # by kind of solve [s]


def measured(seconds: float = SECONDS) -> Times:
    """Processor time of each of the solves [s], the shortest of those that there is time for; what else runs on the
    machine counts little. Kernels that are not compiled yet are compiled first, which takes longer.
    """
    scene, found = Scene.from_table(ROD), {}
    with threadpool_limits(1, user_api="blas"):
        for kind, method in SOLVES.items():
            method.solve(scene)  # compiled
            times, ends = [], time.thread_time() + seconds / len(SOLVES)
            while len(times) < 3 or time.thread_time() < ends:
                begun = time.thread_time()
                method.solve(scene).complete()
                times.append(time.thread_time() - begun)
            found[kind] = min(times)
    return found
