"""What the browser needs of repeated balances to follow other choices by itself: see app/wasm."""

from typing import Any

import numpy as np

from solvers import Rod, Scene, Solution
from solvers.bodies import RigidMass, SpringMass
from solvers.methods.balance.motion import BalanceMotion
from solvers.numerics.balance_drawn import MOST_LOCATED, MOST_MODES
from solvers.numerics.balances import SAMPLES_PER_PERIOD

from ..choices.request import Request


def balanced(
    request: Request, exact: Solution, other: Solution | None, places: int
) -> tuple[dict[str, Any] | None, dict[str, Any]]:
    """The record of a mass balanced against a rod at rest, or against a mass on a spring, and its fields at so many
    places along the rod; None for other impacts, and where a hand moves on."""
    scene, target = request.scene, request.scene.target
    found = next((each for each in (other, exact) if each and isinstance(each.motion, BalanceMotion)), None)
    if found is None or request.draft or request.stretch or not isinstance(scene.impactor, RigidMass):
        return None, {}
    plain = isinstance(target, Rod) and target.support in ("fixed", "free") and not target.end_mass
    if not (plain or isinstance(target, SpringMass)) or target.velocity or "duration" in scene.method:
        return None, {}
    return _record(scene, found, places)


def _record(scene: Scene, found: Solution, places: int) -> tuple[dict[str, Any] | None, dict[str, Any]]:
    motion, method = found.motion, found.method
    assert isinstance(motion, BalanceMotion)
    run = motion.run
    own, step = run.pair.modes[1], method["step"]
    located = method["variant"] == "event-located"
    most = MOST_LOCATED if located else MOST_MODES
    if own.frequencies.size > most or method["variant"] == "step-halving" or run.full:
        return None, {}
    record = {
        "located": located,
        "step": run.pair.shortest_period / SAMPLES_PER_PERIOD if step is None else step,
        "shown": step is not None,
        "resolved": run.pair.resolved_time,
        "frequencies": own.frequencies.tolist(),
        "atContact": own.at_contact.tolist(),
        "means": (np.zeros(own.frequencies.size) if own.means is None else own.means).tolist(),
    }
    if not scene.target.rods:
        return record, {}
    fields, x = run.pair.fields(), np.linspace(0.0, scene.target.length, places)
    shapes, slopes = (fields[name](x)[1:-2] for name in ("shapes", "slopes"))  # of the target alone
    return record, {"balanceShapes": shapes, "balanceStresses": slopes}
