"""Impacts of one body on another that can bend and ring.

import solvers
solution = solvers.solve(solvers.load("fixed-rod"), method="modal", modes=50)
"""

from .auto import Auto
from .bodies import Beam, Body, Material, RigidMass, Rod, Rods, SpringMass, Wall
from .checks import SceneError
from .choosing import read_method
from .comparison import Row, compare, reference
from .contact import LAWS
from .contact_times import ContactTimes, compare_with_half_space, contact_times
from .convergence import Convergence, convergence
from .ensemble import Ensemble, ensemble
from .method import Method, SceneNotSupported
from .methods import (
    METHODS,
    Balance,
    FeModal,
    FeNodal,
    Modal,
    ModeSwitch,
    QuasiStatic,
    RigidImpulse,
    Waves,
    usual_method,
)
from .regimes import Plan, RegimeMap, plan, regime_map
from .scene import Scene, load, scene_names
from .solution import ContactPeriod, Solution
from .stability import Stability, stability
from .tradeoff import stored_tradeoff, tradeoff
from .tradeoff_table import Point as TradeOffPoint
from .tradeoff_table import TradeOff

__all__ = [
    "LAWS",
    "METHODS",
    "Auto",
    "Balance",
    "Beam",
    "Body",
    "ContactPeriod",
    "ContactTimes",
    "Convergence",
    "Ensemble",
    "FeModal",
    "FeNodal",
    "Material",
    "Method",
    "Modal",
    "ModeSwitch",
    "Plan",
    "QuasiStatic",
    "RegimeMap",
    "RigidImpulse",
    "RigidMass",
    "Rod",
    "Rods",
    "Row",
    "Scene",
    "SceneError",
    "SceneNotSupported",
    "Solution",
    "SpringMass",
    "Stability",
    "TradeOff",
    "TradeOffPoint",
    "Wall",
    "Waves",
    "compare",
    "compare_with_half_space",
    "contact_times",
    "convergence",
    "ensemble",
    "load",
    "plan",
    "read_method",
    "reference",
    "regime_map",
    "scene_names",
    "solve",
    "stability",
    "stored_tradeoff",
    "tradeoff",
    "usual_method",
]


def solve(scene: Scene, method: str | Method | None = None, duration: float | None = None, **options) -> Solution:
    """Solve a scene by the method it names, by `usual_method` if it names none, or by another one.

    `options` are those of the method (`modes`, `steps`, `tolerance`). Duration in seconds; without one, until the
    bodies part for good. Raises SceneError for options that do not exist or are out of range, SceneNotSupported if the
    method cannot solve the scene.
    """
    table = dict(scene.method)
    if duration is None:
        duration = table.pop("duration", None)
    table.pop("duration", None)
    if isinstance(method, Method):
        if options:
            raise SceneError("method", options, "no options beside a method object; give them to the object")
        return method.solve_in_full(scene, duration)
    if method is not None and method != (table.get("name") or usual_method(scene)):
        table = {"name": method}
    chosen, _ = read_method(table | options, scene)
    return chosen.solve_in_full(scene, duration)
