"""An elastic pendulum and a slider-crank with their impacts, in the hands of Exudyn.

Each takes a scene, its duration [s], a solver of Exudyn and a number of steps, and gives a run without arguments; a run
gives the figures that are compared, and raises ArithmeticError where the solver gives up.
"""

import importlib
import sys
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from solvers import Scene
from solvers.bodies import Mechanism
from solvers.methods.multibody.linkage import centres, rates_of_centres
from solvers.numerics.modes import Modes
from solvers.numerics.multibody.system import PRISMATIC

from .peer_models import silent

ITERATION_TOLERANCE = 1.0  # [N] of a contact that changes inside a step, at most 1 % of the largest force
SHORTEST_STEP = 1e-6  # of the duration, where steps are shortened


class PendulumFigures(NamedTuple):
    """Velocities after the impact [m/s], of the pendulum where it strikes, turning as a whole, and of the rod's mean;
    largest contact force [N]."""

    pendulum: float
    rod: float
    peak_force: float


class SliderFigures(NamedTuple):
    """After the impact: velocity of the mass [m/s], spin of the crank [rad/s]; impulse of the crank's pin on the ground
    along the stroke [N s]."""

    mass: float
    crank: float
    pin_impulse: float


class Solver(NamedTuple):
    """Of Exudyn; whether it shortens its steps as its contact recommends."""

    name: str
    shortens: bool = False


class Bank(NamedTuple):
    """A free body by its modes, in coordinates of which the first is how far the place of contact has moved: its mass
    and stiffness matrices, (modes + 1, modes + 1) each, and the row that gives its motion as a whole, (modes + 1,)."""

    mass: np.ndarray
    stiffness: np.ndarray
    whole: np.ndarray

    @classmethod
    def of(cls, modes: Modes) -> "Bank":
        shape = np.concatenate(([modes.rigid_mass**-0.5], modes.at_contact))
        change = np.eye(shape.size)  # modal coordinates from the new ones
        change[0] = np.concatenate(([1.0], -shape[1:])) / shape[0]
        stiffness = np.diag(np.concatenate(([0.0], modes.frequencies**2)))
        return cls(change.T @ change, change.T @ stiffness @ change, shape[0] * change[0])


def exudyn_pendulum(scene: Scene, duration: float, solver: Solver, steps: int) -> Callable[[], PendulumFigures]:
    """Both bodies by the modal matrices of `modal`, the same modes, between them Exudyn's own contact with an exponent
    of 1.5: the same equations, so that only the integration differs."""
    exudyn, items, system = _system()
    banks = [Bank.of(scene.impactor.modes(0)), Bank.of(scene.target.modes(scene.method["modes"]))]
    nodes, markers = [], []
    for bank, speed in zip(banks, (scene.impactor.velocity, scene.target.velocity), strict=True):
        size, start = bank.whole.size, np.zeros(bank.whole.size)
        start[0] = speed
        node = system.AddNode(
            items.NodeGenericODE2(
                referenceCoordinates=np.zeros(size),
                initialCoordinates=np.zeros(size),
                initialCoordinates_t=start,
                numberOfODE2Coordinates=size,
            )
        )
        system.AddObject(
            items.ObjectGenericODE2(nodeNumbers=[node], massMatrix=bank.mass, stiffnessMatrix=bank.stiffness)
        )
        markers.append(system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0)))
        nodes.append(node)
    _contact(items, system, scene, markers)
    kind = exudyn.OutputVariableType.Coordinates
    places = [
        system.AddSensor(items.SensorNode(nodeNumber=node, outputVariableType=kind, storeInternal=True))
        for node in nodes
    ]
    system.Assemble()
    settings = _settings(exudyn, duration, steps, solver.shortens)
    settings.solution.sensors.writePeriod = 0.5 * duration / steps
    law = scene.contact

    def run() -> PendulumFigures:
        _solve(exudyn, system, settings, solver)
        rates = [system.GetNodeOutput(node, exudyn.OutputVariableType.Coordinates_t) for node in nodes]
        whole = [float(bank.whole @ rate) for bank, rate in zip(banks, rates, strict=True)]
        faces = [system.GetSensorStoredData(place)[:, 1] for place in places]
        return PendulumFigures(*whole, float(law.stiffness * (faces[0] - faces[1]).max() ** law.EXPONENT))

    return run


def exudyn_slider(scene: Scene, duration: float, solver: Solver, steps: int) -> Callable[[], SliderFigures]:
    """Rigid bodies in the plane, with Exudyn's joints; its contact with an exponent of 1.5 between the coordinates of
    the piston and of the mass along the stroke."""
    exudyn, items, system = _system()
    mechanism = scene.target.known_as(Mechanism)
    place, rates = (values.reshape(-1, 3) for values in (centres(mechanism), rates_of_centres(mechanism)))
    nodes, bodies = [], [system.AddObject(items.ObjectGround())]  # the ground is link -1, which comes first
    for link, start, rate in zip(mechanism.system.links, place, rates, strict=True):
        node = system.AddNode(items.Rigid2D(referenceCoordinates=start, initialVelocities=rate))
        bodies.append(system.AddObject(items.RigidBody2D(mass=link.mass, inertia=link.inertia, nodeNumber=node)))
        nodes.append(node)
    _add_joints(items, system, mechanism, bodies, place)
    mass = system.AddNode(
        items.Node1D(referenceCoordinates=[0.0], initialCoordinates=[0.0], initialVelocities=[-scene.impactor.velocity])
    )
    system.AddObject(items.Mass1D(mass=scene.impactor.mass, nodeNumber=mass))
    piston = nodes[[link.name for link in mechanism.links].index(mechanism.struck.link)]
    faces = [system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=0)) for node in (piston, mass)]
    _contact(items, system, scene, faces)
    system.Assemble()
    settings = _settings(exudyn, duration, steps, solver.shortens)
    masses = np.array([link.mass for link in mechanism.system.links])
    before = float(masses @ rates[:, 0])

    def run() -> SliderFigures:
        _solve(exudyn, system, settings, solver)
        found = np.array([system.GetNodeOutput(node, exudyn.OutputVariableType.Coordinates_t) for node in nodes])
        speed = float(np.ravel(system.GetNodeOutput(mass, exudyn.OutputVariableType.Coordinates_t))[0])
        given = scene.impactor.mass * (speed + scene.impactor.velocity)  # by the piston to the mass
        return SliderFigures(-speed, float(found[0, 2]), float(masses @ found[:, 0]) - before + given)

    return run


def _add_joints(items, system, mechanism: Mechanism, bodies: list[int], place: np.ndarray) -> None:
    for joint in mechanism.system.joints:
        markers = [
            system.AddMarker(
                items.MarkerBodyRigid(bodyNumber=bodies[link + 1], localPosition=_local(link, joint, place))
            )
            for link in (joint.first, joint.second)
        ]
        if joint.kind == PRISMATIC:
            across = [-joint.axis[1], joint.axis[0], 0.0]
            system.AddObject(
                items.PrismaticJoint2D(markerNumbers=markers, axisMarker0=[*joint.axis, 0.0], normalMarker1=across)
            )
        else:
            system.AddObject(items.RevoluteJoint2D(markerNumbers=markers))


def _local(link: int, joint: Any, place: np.ndarray) -> list[float]:
    """Where a joint is on a link, in its frame, which Exudyn turns by the angle of the link."""
    if link < 0:
        return [*joint.at, 0.0]
    x, y = joint.at - place[link, :2]
    cosine, sine = np.cos(place[link, 2]), np.sin(place[link, 2])
    return [cosine * x + sine * y, cosine * y - sine * x, 0.0]


def _contact(items, system, scene: Scene, markers: list[int]) -> int:
    state = system.AddNode(items.NodeGenericData(initialCoordinates=[0.0], numberOfDataCoordinates=1))
    return system.AddObject(
        items.ObjectContactCoordinate(
            markerNumbers=markers,
            nodeNumber=state,
            contactStiffness=scene.contact.stiffness,
            contactStiffnessExponent=scene.contact.EXPONENT,
        )
    )


def _system() -> tuple[Any, Any, Any]:
    """Exudyn, its items and an empty system."""
    sys.exudynFast = True  # its build without range checks
    with silent():
        exudyn = importlib.import_module("exudyn")
    return exudyn, importlib.import_module("exudyn.itemInterface"), exudyn.SystemContainer().AddSystem()


def _settings(exudyn, duration: float, steps: int, shortens: bool):
    settings = exudyn.SimulationSettings()
    settings.solution.file.write = False
    settings.solution.file.information = ""
    integration = settings.timeIntegration
    integration.numberOfSteps, integration.endTime, integration.verboseMode = steps, duration, 0
    integration.adaptiveStep = integration.discontinuous.useRecommendedStepSize = shortens
    integration.minimumStepSize = SHORTEST_STEP * duration
    integration.discontinuous.iterationTolerance = ITERATION_TOLERANCE
    return settings


def _solve(exudyn, system, settings, solver: Solver) -> None:
    try:
        with silent():
            system.SolveDynamic(settings, solverType=getattr(exudyn.DynamicSolverType, solver.name))
    except Exception as stopped:
        raise ArithmeticError(solver.name) from stopped
