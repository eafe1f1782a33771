"""The contact law of a scene as the integrator of a mechanism takes it."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ...bodies import Mechanism
from ...contact.duration import contact_time
from ...contact.protocol import Yielding
from ...numerics.law_functions import MEMORY, constants_of, step_function
from ...numerics.multibody.pressing import Surface
from ...scene import Scene

LONG_CONTACT = 5.0  # times the shortest one: from then on a step is the same share of what the contact has lasted


def law_of(
    scene: Scene, mechanism: Mechanism, steps: int, longest: float
) -> tuple[Callable, Surface] | tuple[None, None]:
    """Its function, and the surface that follows it, in so many steps of the shortest contact that there can be, none
    `longest` [s] or longer; neither where the contact is rigid: kernels have no code for it then."""
    if scene.rigid_contact:
        return None, None
    modes = mechanism.frozen.modes
    law: Any = scene.contact
    step = min(shortest_contact(scene, mechanism) / steps, longest)
    settling = 0.0
    if modes.residual_compliance and (law.JUMPS or law.PLASTIC):
        settling = min(0.5, step / modes.shortest_period)
    memory = np.zeros(MEMORY)
    memory[2:4] = law.unloading(0.0)
    return step_function(type(law)), Surface(
        constants=constants_of([law])[0],
        memory=memory,
        deepest=np.zeros(1),
        step=step,
        growth=1.0 / (LONG_CONTACT * steps),
        longest=longest,
        compliance=modes.residual_compliance,
        weight=1.0 / (0.5 + settling),
        jumps=law.JUMPS,
    )


def shortest_contact(scene: Scene, mechanism: Mechanism) -> float:
    """About how long a contact by the law lasts [s] with all of what a sudden force can move of the struck link, where
    the modes left out give way."""
    modes = mechanism.frozen.modes
    mobility = 1.0 / scene.impactor.mass + 1.0 / modes.rigid_mass + float(modes.at_contact @ modes.at_contact)
    by_law = contact_time(scene.contact, 1.0 / mobility, scene.speed)
    if isinstance(scene.contact, Yielding):
        stiffness = _unloading_stiffness(scene.contact, 0.5 / mobility * scene.speed**2)
        by_law = min(by_law, math.pi / math.sqrt(mobility * stiffness)) if stiffness else by_law
    return math.hypot(by_law, math.pi * math.sqrt(modes.residual_compliance / mobility))


def _unloading_stiffness(law: Any, energy: float) -> float:
    """Of a law that has taken up an energy [J], where it is deepest [N/m]: it is stiffer on the way back from there,
    and the next way in; zero if it has not yielded."""
    deepest = law.yield_indentation
    if law.mean(0.0, deepest, 0.0, 0.0)[0] * deepest >= energy:
        return 0.0
    while law.mean(0.0, deepest, 0.0, 0.0)[0] * deepest < energy:
        deepest *= 1.1
    return float(law.slopes((1.0 - 1e-9) * deepest, 0.0, deepest)[0])
