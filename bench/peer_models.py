"""The same impact in the hands of other programs: each prepared as its own documentation says, then run at will.

Every `prepare` takes the problem and a number of elements and gives a run without arguments; a run gives a `Record`.
"""

import contextlib
import importlib
import io
import math
import os
import sys
import warnings
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import scipy.sparse
from scipy.integrate import solve_ivp
from scipy.sparse.linalg import splu

from solvers import Scene
from solvers.jit.kernels import allocating_kernel

SOLVE_IVP_TOLERANCE = 1e-3  # relative, its own default; DOP853 holds it with the fewest evaluations of its methods
VERLET_COURANT = 0.5  # 1/sqrt(2) and more is unstable with the penalty spring


class Record(NamedTuple):
    """Contact force at times, straight in between [s, N], and the velocity the mass leaves with [m/s]."""

    time: np.ndarray
    force: np.ndarray
    velocity: float


class Problem(NamedTuple):
    """A uniform rod fixed at its far end, struck by a rigid mass; SI units."""

    length: float
    area: float
    young: float
    density: float
    mass: float
    speed: float
    duration: float

    @classmethod
    def of(cls, scene: Scene, duration: float) -> "Problem":
        rod, material = scene.target, scene.target.material
        bodies = scene.impactor.mass, scene.impactor.velocity
        return cls(rod.length, rod.area, material.young, material.density, *bodies, duration)

    def element(self, elements: int) -> tuple[float, float, float]:
        """Mass [kg], stiffness [N/m] and transit time [s] of one of so many."""
        length = self.length / elements
        transit = length * math.sqrt(self.density / self.young)
        return self.density * self.area * length, self.young * self.area / length, transit


Run = Callable[[], Record]


def solve_ivp_elements(problem: Problem, elements: int) -> Run:
    """SciPy's DOP853 on finite elements with lumped masses, the right-hand side compiled."""
    mass, stiffness, _ = problem.element(elements)
    start = np.zeros(2 * elements + 2)  # free nodes from the struck one, then the mass; then their velocities
    start[-1] = problem.speed
    scale = np.repeat((problem.speed * problem.duration, problem.speed), elements + 1)

    def run() -> Record:
        found = solve_ivp(
            _rates,
            (0.0, problem.duration),
            start,
            method="DOP853",
            rtol=SOLVE_IVP_TOLERANCE,
            atol=SOLVE_IVP_TOLERANCE * 1e-2 * scale,
            args=(mass, stiffness, stiffness, problem.mass),
        )
        pressed = np.maximum(found.y[elements] - found.y[0], 0.0)
        return Record(found.t, stiffness * pressed, float(found.y[-1, -1]))

    return run


@allocating_kernel
def _rates(time, state, element_mass, stiffness, penalty, mass):
    nodes = state.size // 2 - 1
    rates = np.empty_like(state)
    rates[: nodes + 1] = state[nodes + 1 :]
    force = penalty * max(state[nodes] - state[0], 0.0)
    rates[nodes + 1] = 2.0 * (force - stiffness * (state[0] - state[1])) / element_mass
    for i in range(1, nodes - 1):
        rates[nodes + 1 + i] = stiffness * (state[i - 1] - 2.0 * state[i] + state[i + 1]) / element_mass
    rates[2 * nodes] = stiffness * (state[nodes - 2] - 2.0 * state[nodes - 1]) / element_mass
    rates[2 * nodes + 1] = -force / mass
    return rates


def scikit_fem_newmark(problem: Problem, elements: int, courant: float) -> Run:
    """Matrices of scikit-fem, linear elements; Newmark 1/2 1/4 with both of its matrices factorised beforehand.

    Steps of `courant` transit times of an element.
    """
    import skfem
    from skfem.models.poisson import laplace, mass

    _, penalty, transit = problem.element(elements)
    basis = skfem.Basis(skfem.MeshLine(np.linspace(0.0, problem.length, elements + 1)), skfem.ElementLineP1())
    held = basis.get_dofs(lambda x: np.isclose(x[0], problem.length))
    stiffness, inertia = skfem.condense(
        problem.young * problem.area * laplace.assemble(basis),
        problem.density * problem.area * mass.assemble(basis),
        D=held,
        expand=False,
    )
    inertia = scipy.sparse.block_diag((inertia, [[problem.mass]]), format="csc")
    apart = scipy.sparse.block_diag((stiffness, [[0.0]]), format="csc")
    gap = np.zeros(elements + 1)
    gap[0], gap[-1] = -1.0, 1.0  # indentation = gap @ displacement
    touching = (apart + penalty * scipy.sparse.csc_array(np.outer(gap, gap))).tocsc()
    steps = math.ceil(problem.duration / (courant * transit))
    step = problem.duration / steps
    matrices = apart, touching
    factors = [splu((inertia + 0.25 * step**2 * matrix).tocsc()) for matrix in matrices]

    def run() -> Record:
        displacement, velocity, acceleration = np.zeros((3, elements + 1))
        velocity[-1] = problem.speed
        pressing, force = True, np.zeros(steps + 1)
        for k in range(1, steps + 1):
            guess = displacement + step * velocity + 0.25 * step**2 * acceleration
            for _ in range(2):  # the state of the contact that agrees with what comes of it
                found = factors[pressing].solve(-(matrices[pressing] @ guess))
                reached = guess + 0.25 * step**2 * found
                if (reached[-1] > reached[0]) == pressing:
                    break
                pressing = not pressing
            velocity = velocity + 0.5 * step * (acceleration + found)
            displacement, acceleration = reached, found
            force[k] = penalty * max(displacement[-1] - displacement[0], 0.0)
        return Record(np.linspace(0.0, problem.duration, steps + 1), force, float(velocity[-1]))

    return run


def exudyn_trapezoidal(problem: Problem, elements: int, courant: float) -> Run:
    """Exudyn's implicit trapezoidal rule, consistent masses, sparse, Newton's matrix kept while it serves."""
    return _exudyn(problem, elements, "TrapezoidalIndex2", courant, lumped=False)


def exudyn_verlet(problem: Problem, elements: int) -> Run:
    """Exudyn's explicit velocity Verlet rule ("test phase" in 1.13), lumped masses."""
    return _exudyn(problem, elements, "VelocityVerlet", VERLET_COURANT, lumped=True)


def _exudyn(problem: Problem, elements: int, solver: str, courant: float, lumped: bool) -> Run:
    sys.exudynFast = True  # its build without range checks
    with silent():
        exudyn = importlib.import_module("exudyn")
    items = importlib.import_module("exudyn.itemInterface")
    element_mass, stiffness, transit = problem.element(elements)
    system = exudyn.SystemContainer().AddSystem()
    zeros = np.zeros(elements)
    rod = system.AddNode(
        items.NodeGenericODE2(
            referenceCoordinates=zeros,
            initialCoordinates=zeros,
            initialCoordinates_t=zeros,
            numberOfODE2Coordinates=elements,
        )
    )
    diagonal = 1.0 if lumped else 2.0 / 3.0
    inertia = _tridiagonal(elements, element_mass * diagonal, 0.0 if lumped else element_mass / 6.0)
    inside = _tridiagonal(elements, 2.0 * stiffness, -stiffness)
    matrices = [_container(exudyn, matrix) for matrix in (inertia, inside)]
    system.AddObject(items.ObjectGenericODE2(nodeNumbers=[rod], massMatrix=matrices[0], stiffnessMatrix=matrices[1]))
    mass = system.AddNode(
        items.Node1D(referenceCoordinates=[0.0], initialCoordinates=[0.0], initialVelocities=[problem.speed])
    )
    system.AddObject(items.Mass1D(mass=problem.mass, nodeNumber=mass))
    faces = [system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0)) for node in (mass, rod)]
    state = system.AddNode(items.NodeGenericData(initialCoordinates=[0.0], numberOfDataCoordinates=1))
    system.AddObject(items.ObjectContactCoordinate(markerNumbers=faces, nodeNumber=state, contactStiffness=stiffness))
    kinds = exudyn.OutputVariableType.Coordinates_t, exudyn.OutputVariableType.Coordinates_tt
    sensors = [
        system.AddSensor(items.SensorNode(nodeNumber=mass, outputVariableType=kind, storeInternal=True))
        for kind in kinds
    ]
    system.Assemble()
    settings = _exudyn_settings(exudyn, problem.duration, math.ceil(problem.duration / (courant * transit)))

    def run() -> Record:
        with silent():
            system.SolveDynamic(settings, solverType=getattr(exudyn.DynamicSolverType, solver))
        velocity, acceleration = (system.GetSensorStoredData(sensor) for sensor in sensors)
        force = np.maximum(-problem.mass * acceleration[:, 1], 0.0)
        return Record(acceleration[:, 0], force, float(velocity[-1, 1]))

    return run


def _exudyn_settings(exudyn, duration: float, steps: int):
    settings = exudyn.SimulationSettings()
    settings.solution.file.write = False
    settings.solution.file.information = ""
    settings.solution.sensors.writePeriod = 0.5 * duration / steps
    settings.linearSolver.solverType = exudyn.LinearSolverType.EigenSparse
    integration = settings.timeIntegration
    integration.numberOfSteps, integration.endTime, integration.verboseMode = steps, duration, 0
    integration.adaptiveStep = False
    # a contact that changes inside a step is iterated, but the step is kept: smaller ones cost more than they give
    integration.discontinuous.useRecommendedStepSize = False
    integration.discontinuous.iterationTolerance = 1e3  # [N], 1 % of the force
    return settings


def _tridiagonal(size: int, diagonal: float, beside: float) -> scipy.sparse.csr_array:
    main = np.full(size, diagonal)
    main[0] *= 0.5  # the struck node has one element
    return scipy.sparse.diags_array([main, *[np.full(size - 1, beside)] * 2], offsets=[0, 1, -1]).tocsr()


def _container(exudyn, matrix: scipy.sparse.csr_array):
    container = exudyn.MatrixContainer()
    container.SetWithSparseMatrix(matrix, useDenseMatrix=False)
    return container


def elwaspatid_bars(problem: Problem, elements: int) -> Run:
    """elwaspatid's WP2, waves by steps of an element's transit time; the mass is a thick bar one element long."""
    os.environ.setdefault("MPLBACKEND", "agg")  # it imports matplotlib
    elwaspatid = importlib.import_module("elwaspatid")
    length = problem.length / elements
    areas = np.array([problem.mass / (problem.density * length), problem.area])
    with silent():
        bars = elwaspatid.BarSet(
            [problem.young] * 2,
            [problem.density] * 2,
            [length, problem.length],
            list(np.sqrt(4.0 * areas / np.pi)),
            nmin=1,
            right="fixed",
        )
    steps = math.ceil(problem.duration / bars.dt)

    def run() -> Record:
        with silent():
            elwaspatid.WP2(bars, nstep=steps, left="free", right="fixed", Vinit=problem.speed)
        striker, rod = bars.seg
        return Record(striker.time, np.maximum(-rod.Force[:, 0], 0.0), float(striker.Veloc[-2:].mean()))

    return run


@contextlib.contextmanager
def silent():
    with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
        warnings.simplefilter("ignore")
        yield
