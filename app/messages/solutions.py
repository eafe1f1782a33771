"""Which solutions the page shows: the exact one, and the chosen method beside it."""

from dataclasses import replace
from typing import Any

from solvers import Modal, Rod, Solution
from solvers.accuracy.reference import exact_solution
from solvers.methods.multibody.method import Multibody
from solvers.numerics.modal_steps import steps_drawn
from solvers.solution.summary import touching

from ..choices.choices import SOLVED_BY
from ..choices.kinds import RESTORING, has_frames, own_options, resolutions
from ..choices.request import Request

LEAST_STEPS = 1_000  # of a draft, where a scene sets more
MOST_LONGER = 4.0  # times the usual duration, for a method whose contacts last longer
LEAST_SWITCHED = 2  # modes that can change with the contact


def by_modes(exact: Solution) -> bool:
    """Whether many modes stand for an exact solution: then the chosen number of them can be shown beside it."""
    bodies = exact.scene.impactor, exact.scene.target
    return exact.method["name"] == Modal.NAME and any(body.time_unit is not None for body in bodies)


def both(request: Request) -> tuple[Solution, Solution | None]:
    """The exact solution and the method beside it, over so much time that contacts of either are seen to their end."""
    exact = exact_solution(request.scene, request.restitution)
    other, longest = beside(request, exact), MOST_LONGER * exact.duration
    while other and other.contacts and exact.duration < longest and touching(other.contacts, exact.duration):
        if "duration" in request.scene.method or request.draft:
            break
        exact = exact_solution(request.scene, request.restitution, 2.0 * exact.duration)
        other = beside(request, exact)
    return exact, other


def beside(request: Request, exact: Solution) -> Solution | None:
    """The chosen method, or modes if waves are chosen; None if it cannot solve this scene or is the exact one."""
    scene, name = request.scene, request.method_beside
    if name == exact.method["name"] and not by_modes(exact):
        name = "quasi-static"
    if name == exact.method["name"] and not by_modes(exact):
        return None  # the same
    method = SOLVED_BY[name].read(method_options(name, request, exact))
    if method.refusal(scene):
        return None
    if isinstance(method, Modal):
        method = replace(method, estimate=False)  # the exact solution shows the error
    return method.solve(scene, exact.duration)


def method_options(name: str, request: Request, exact: Solution | None = None) -> dict[str, Any]:
    """Those of a method's options that the page sets."""
    scene = request.scene
    own = own_options(scene, name)
    if scene.rigid_contact:
        own.pop("residual", None)  # without the modes left out nothing gives way
    if name == "modal":
        options = own | {"modes": request.modes}
        if has_frames(scene):
            options["frame"] = request.chosen["floating_frame"]
        if exact is not None and isinstance(scene.target, Rod) and "steps" not in own:
            period = scene.target.modes(request.modes).shortest_period
            options["steps"] = steps_drawn(period, exact.contacts[-1].end, exact.duration)
        return options
    options = own | {option: getattr(request, option) for option in resolutions(scene, name)}
    if name == "mode-switch":
        options["modes"] = max(options["modes"], LEAST_SWITCHED)
    if name == Multibody.NAME and not scene.rigid_contact:  # which knows contact laws besides
        options.pop("restitution", None)
    elif name in RESTORING:
        options["restitution"] = request.restitution
    if request.draft and "steps" in options:
        options["steps"] = max(int(request.share * options["steps"]), min(LEAST_STEPS, options["steps"]))
    return options
