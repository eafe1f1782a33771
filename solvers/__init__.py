"""Impacts of one body on another that can bend and ring.

import solvers
solution = solvers.solve(solvers.load("fixed-rod"), method="modal", modes=50)
"""

from . import records
from .accuracy.auto import Auto
from .accuracy.calibration import calibrate
from .accuracy.comparison import Row, compare
from .accuracy.reference import reference
from .accuracy.tradeoff import stored_tradeoff, tradeoff
from .accuracy.tradeoff_table import Point as TradeOffPoint
from .accuracy.tradeoff_table import TradeOff
from .bodies import (
    MATERIALS,
    Beam,
    Bending,
    Body,
    Material,
    Mechanism,
    RigidMass,
    Rod,
    Rods,
    Section,
    SpringMass,
    Wall,
    Waveguide,
)
from .contact import LAWS
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
from .methods.base import Method, SceneNotSupported
from .methods.multibody.method import Multibody
from .numerics import memory  # noqa: F401  (what it does holds for the process)
from .provenance import release
from .regimes.plan import Plan, plan
from .regimes.regime_map import RegimeMap, regime_map
from .scene import Scene
from .scenes.library import load, scene_names, to_toml
from .solution.motion import Motion
from .solution.solution import ContactPeriod, Solution
from .solve import read_method, solve
from .stability.maps import Stability, stability
from .studies.bounces import Bounce, Bounces, bounces
from .studies.contact_times import ContactTimes, compare_with_half_space, contact_times
from .studies.contour import Contour, contour
from .studies.convergence import Convergence, convergence
from .studies.ensemble import Ensemble, ensemble
from .studies.figures import Figures
from .studies.gradient import Gradient, gradient
from .studies.hopkinson.reduction import Hopkinson, hopkinson
from .studies.optimum import Optimum, optimise
from .studies.pareto import Pareto, pareto
from .studies.report.report import Report, report
from .studies.report.study import StudyReport
from .studies.scattering import JointScattering, joint_scattering
from .studies.seek import Sought, seek
from .studies.study.plot import plot_study
from .studies.study.study import study
from .studies.sweep import solve_many, sweep
from .studies.uncertain import Uncertain, uncertain
from .validation import SceneError

__version__ = release()

__all__ = [
    "LAWS",
    "MATERIALS",
    "METHODS",
    "Auto",
    "Balance",
    "Beam",
    "Bending",
    "Body",
    "Bounce",
    "Bounces",
    "ContactPeriod",
    "ContactTimes",
    "Contour",
    "Convergence",
    "Ensemble",
    "FeModal",
    "FeNodal",
    "Figures",
    "Gradient",
    "Hopkinson",
    "JointScattering",
    "Material",
    "Mechanism",
    "Method",
    "Modal",
    "ModeSwitch",
    "Motion",
    "Multibody",
    "Optimum",
    "Pareto",
    "Plan",
    "QuasiStatic",
    "RegimeMap",
    "Report",
    "RigidImpulse",
    "RigidMass",
    "Rod",
    "Rods",
    "Row",
    "Scene",
    "SceneError",
    "SceneNotSupported",
    "Section",
    "Solution",
    "Sought",
    "SpringMass",
    "Stability",
    "StudyReport",
    "TradeOff",
    "TradeOffPoint",
    "Uncertain",
    "Wall",
    "Waveguide",
    "Waves",
    "bounces",
    "calibrate",
    "compare",
    "compare_with_half_space",
    "contact_times",
    "contour",
    "convergence",
    "ensemble",
    "gradient",
    "hopkinson",
    "joint_scattering",
    "load",
    "optimise",
    "pareto",
    "plan",
    "plot_study",
    "read_method",
    "records",
    "reference",
    "regime_map",
    "report",
    "scene_names",
    "seek",
    "solve",
    "solve_many",
    "stability",
    "stored_tradeoff",
    "study",
    "sweep",
    "to_toml",
    "tradeoff",
    "uncertain",
    "usual_method",
]
