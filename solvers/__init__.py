"""Impacts of one body on another that can bend and ring.

import solvers
solution = solvers.solve(solvers.load("fixed-rod"), method="modal", modes=50)
"""

from .auto import Auto
from .bodies import Beam, Body, Material, RigidMass, Rod, Rods, SpringMass, Wall
from .checks import SceneError
from .choosing import read_method, solve
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
from .studies import Figures, solve_many, sweep
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
    "Figures",
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
    "solve_many",
    "stability",
    "stored_tradeoff",
    "sweep",
    "tradeoff",
    "usual_method",
]
