"""What others are measured by: the one place that decides it, for each use the cheapest that is near enough."""

from dataclasses import replace
from typing import Any

from ..bodies import FlexiblePendulum, Mechanism
from ..methods import METHODS, Balance, Modal, RigidImpulse, Waves, usual_method
from ..methods.base import Method
from ..methods.modal.estimate import MOST_MODES
from ..scene import Scene
from ..scenes.library import SceneOrName, scene_of
from ..solution.solution import Solution
from ..validation import SceneError, allowed

# Where no exact solution is known; usual: more than any method beside it keeps. With fewer, 'modal' with as many modes
# seems exact. Orders in the number of modes: `tests/solvers/methods/test_orders.py`.
REFERENCE_MODES = 80
# Of waves by which `auto` and the trade-off measure errors down to 1e-9. Larger, and finer levels seem to be wrong.
EXACT_TOLERANCE = 1e-11
# Of the sweeps behind the regime maps, whose levels are 1 % and more; `bench/measure_regimes.py` solves thousands.
SWEEP_TOLERANCE, SWEEP_MODES = 1e-6, 30
# Modes shown beside others on a beam, at least, and as a multiple of those shown, so that they are more; and steps, at
# which a slider is still answered at once.
MODES_BESIDE, TIMES_BESIDE, STEPS_BESIDE = 40, 2, 20_000
# Of a bar that bends as it swings, as far as its theory reaches; the others give way as if at rest.
SHAPES_OF_PENDULUM = 30


def reference(scene: SceneOrName) -> Solution:
    """The solution that others are measured by: exact waves, or else many modes, whose estimate is its uncertainty.

    Where neither can, as nothing gives way, the scene's usual method. Raises SceneNotSupported for bodies in space.
    """
    scene = scene_of(scene)
    for method in (Waves(), Modal(modes=REFERENCE_MODES)):
        if scene.normal is not None or (method.refusal(scene) is None and not method.neglects_weight(scene)):
            return method.solve(scene)
    return METHODS[usual_method(scene)].read({}).solve(scene)


def exact_waves(scene: Scene) -> Waves | None:
    """Waves as exact as they come, if they can solve the scene with all that acts in it."""
    method = Waves(tolerance=EXACT_TOLERANCE)
    return method if method.refusal(scene) is None and not method.neglects_weight(scene) else None


def swept_reference(scene: Scene) -> Solution:
    """Of the sweeps of a regime map: waves, or many modes of a beam."""
    waves = Waves(tolerance=SWEEP_TOLERANCE)
    return (waves if scene.target.rods else Modal(modes=SWEEP_MODES, estimate=False)).solve(scene)


def exact_solution(scene: Scene, restitution: float, duration: float | None = None) -> Solution:
    """Waves; for bodies without waves one integrated to rounding; many modes of what else rings.

    Where nothing gives way at the contact of bodies without waves, the restitution stands for it; a row of balls is
    integrated by its usual method. Without a duration [s] as long as the scene says, or as is usual. Raises SceneError
    for beams, of which no exact solution is known.
    """
    known, method = exact_method(scene, restitution)
    return method.solve_in_full(known, duration or scene.method.get("duration"))


def exact_method(scene: Scene, restitution: float) -> tuple[Scene, Method]:
    """By what `exact_solution` solves, and the scene that it solves, a pendulum with as many shapes as are used."""
    if scene.target.bends:
        raise SceneError("target.kind", scene.target.kind, allowed("not-bending"))
    rings = any(body.time_unit is not None for body in (scene.impactor, scene.target))
    modes = Modal(modes=REFERENCE_MODES, estimate=False) if rings else Modal(modes=1)
    if isinstance(scene.impactor, FlexiblePendulum):
        bar = replace(scene.impactor, count=SHAPES_OF_PENDULUM, shapes="pinned-free")
        known = max(bar.modes_within_reach(bar.count), scene.impactor.count)
        scene = replace(scene, impactor=replace(bar, count=known))
    for method in (Waves(), modes, RigidImpulse(restitution), Balance(restitution=restitution)):
        if not method.refusal(scene):
            return scene, method
    return scene, METHODS[usual_method(scene)].read({})


def modes_beside(scene: Scene, shown: Solution) -> Solution | None:
    """The same impact by modes, by more of them than the one shown; None if modes cannot solve it."""
    own = shown.method["modes"] if shown.method["name"] == Modal.NAME else 0
    modes = max(MODES_BESIDE, min(TIMES_BESIDE * own, MOST_MODES))
    method = Modal(modes=modes, steps=STEPS_BESIDE, estimate=False)
    return None if method.refusal(scene) else method.solve(scene, shown.duration)


def rebound(solution: Solution) -> Any:
    """Final velocity [m/s] of the impactor; of the target where a force has pushed it, or a mechanism what is held."""
    held = isinstance(solution.scene.target, Mechanism) and solution.scene.impactor.held
    return solution.target_velocity if solution.impactor_velocity is None or held else solution.impactor_velocity
