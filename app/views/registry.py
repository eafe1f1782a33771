"""All views: one line here makes a view's properties, its place in the address, its workers and its compilation."""

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from ..choices.facts import facts_of
from ..choices.kinds import KINDS as EVERY
from ..choices.opened import opening_of
from ..choices.own import is_own
from ..choices.questions import Question
from . import bounces, convergence, joints, mode_change, plan, spectrum, stability, stretch, tolerance, tradeoff
from .energy import energy_data, energy_figure, of_impacts
from .mass_ratios import one_rod_support, ratios_data, ratios_figure
from .methods import methods_table
from .modes import modes_data, modes_figure, of_modes
from .record import record_figure
from .trust import trust_data, trust_figure

KINDS = frozenset(kind.NAME for kind in EVERY.values())
OF_THE_METHOD = ("method", "modes", "elements", "motion_seconds", "motion_links")


def opened_with(scene: str, before: str = "") -> dict[str, Any]:
    """The openers of the views that a scene is opened with, and what is asked in them; and, shut, of those that the
    scene `before` it was opened with."""
    shown, gone = (facts_of(name).views if is_own(name) else opening_of(name).views for name in (scene, before))
    found: dict[str, Any] = {view.opener: view.name in shown for view in VIEWS if view.name in (*shown, *gone)}
    asked = (question for view in VIEWS if view.name in shown for question in view.asked.items())
    return found | {name: question.parameter.default for name, question in asked}


def everything(asked: dict[str, Any]) -> Hashable:
    """What an answer depends on: all that was asked."""
    return tuple(asked.items())


def any_method(asked: dict[str, Any]) -> Hashable:
    """What was asked, without the method and its resolution."""
    return tuple((name, value) for name, value in asked.items() if name not in OF_THE_METHOD)


@dataclass(frozen=True)
class View:
    """What can be opened beside the solution: property `NAME_shown` opens it, and its answer is in property `NAME`.

    Works take a dict of the choices and of what is asked, and return text; see `app.views.answering`.
    """

    name: str
    work: Callable | None = None  # follows the choices while the view is open
    more: Mapping[str, Callable] = field(default_factory=dict)  # further answers: property, and its work
    run: Callable | None = None  # of many seconds, (asked, cancelled, report): the visitor starts and stops it
    kernels: Callable | None = None  # a little of `run`, by which what it needs is compiled first
    kept: bool = False  # whether `run` finds the same whenever the same is asked
    asked: Mapping[str, Question] = field(default_factory=dict)  # by property
    address: str = ""  # its name there, where it is another
    panel: str = ""  # the file in app/static/panels that shows it, where it has another name
    kinds: frozenset[str] = KINDS  # of scene that it is for
    depends_on: Callable[[dict[str, Any]], Hashable] = everything  # of what was asked; None: not for this scene
    looks: bool = False  # whether that looks at the scene
    figure: Callable | None = None  # of a catalogue: plots that the browser fills, see app.views.figures
    rests: bool = False  # whether choices must stand a moment before they are asked about
    stoppable: bool = False  # whether `work` takes `cancelled`, and the visitor may stop it
    every_law: bool = False  # whether it is compiled ahead for every contact law
    late: bool = False  # whether few ask for it, so that it is compiled after all others
    scenes: tuple[str, ...] = ()  # with which it is compiled, where the first of its kinds would not do

    @property
    def opener(self) -> str:
        """Property: whether it is open."""
        return f"{self.name}_shown"

    @property
    def running(self) -> str:
        """Property: whether it is under way, where the visitor may stop it."""
        return f"{self.name}_running"

    @property
    def key(self) -> str:
        """Its name in the address."""
        return self.address or self.name

    @property
    def answers(self) -> dict[str, Callable]:
        """By property: the works that follow the choices."""
        return ({self.name: self.work} if self.work else {}) | dict(self.more)

    @property
    def sent(self) -> list[str]:
        """Questions that its works are asked."""
        return [name for name, question in self.asked.items() if question.sent]

    @property
    def compiled(self) -> list[Callable]:
        """Works whose kernels are compiled before they are needed; a long run is compiled by its `kernels`."""
        leading = [question.leads for question in self.asked.values() if question.leads]
        return [*self.answers.values(), *leading, *([self.kernels] if self.kernels else [])]

    @property
    def compiled_kinds(self) -> frozenset[str]:
        """Kinds of scene for which they are; what is for all scenes meets most of its kernels on an axis."""
        return self.kinds if self.kinds != KINDS else frozenset(("axial",))

    @property
    def examples(self) -> dict[str, Any]:
        """A value of every question that a work is asked, as long as nobody changes it."""
        works = {name: question for name, question in self.asked.items() if question.sent or question.leads}
        return {name: each.example if each.leads else each.parameter.default for name, each in works.items()}


AXIAL, BEAMS, MECHANISMS = (frozenset((name,)) for name in ("axial", "beam", "mechanism"))
BENDING = BEAMS | MECHANISMS
VIEWS = (  # in the order in which an address names them
    View("energy", energy_data, figure=energy_figure, kinds=AXIAL | BENDING, depends_on=of_impacts, looks=True),
    View("plan", plan.plan_data, {"regimes": plan.regimes_data}, asked=plan.QUESTIONS, address="needs", panel="plan"),
    View("auto", tolerance.auto_data, asked=tolerance.QUESTIONS, address="tolerance", depends_on=any_method,
         stoppable=True),
    View("tradeoff", tradeoff.stored_data, run=tradeoff.tradeoff_data, kernels=tradeoff.tradeoff_kernels,
         figure=tradeoff.tradeoff_figure, asked=tradeoff.QUESTIONS, depends_on=any_method),
    View("trust", trust_data, figure=trust_figure, kinds=BENDING, rests=True),
    View("convergence", convergence.convergence_data, figure=convergence.convergence_figure,
         asked=convergence.QUESTIONS, kinds=AXIAL | BENDING, rests=True),
    View("methods", methods_table, kinds=AXIAL, rests=True, every_law=True),
    View("stability", run=stability.stability_data, kernels=stability.stability_kernels, kept=True,
         figure=stability.stability_figure, asked=stability.QUESTIONS, late=True),
    View("bounces", bounces.bounces_data, asked=bounces.QUESTIONS, kinds=AXIAL | BEAMS, rests=True,
         stoppable=True, scenes=("bouncing-ball",)),
    View("joints", joints.joints_data, figure=joints.joints_figure, kinds=MECHANISMS,
         depends_on=joints.of_joined_links, looks=True, scenes=("bent-rods",)),
    View("stretch", stretch.stretch_data, figure=stretch.stretch_figure, kinds=AXIAL,
         depends_on=stretch.of_turning_rods, looks=True, scenes=("figure-5.24",)),
    View("mode_change", mode_change.mode_change_data, kinds=MECHANISMS,
         depends_on=mode_change.of_struck_nodes, looks=True, scenes=("table-6.10",)),
    View("ratios", ratios_data, figure=ratios_figure, panel="mass_ratios", kinds=AXIAL,
         depends_on=one_rod_support, looks=True),
    View("ringing", modes_data, figure=modes_figure, address="modes", panel="modes", kinds=AXIAL | BEAMS,
         depends_on=of_modes),
    View("spectrum", spectrum.spectrum_data, asked=spectrum.QUESTIONS, kinds=AXIAL | BENDING, rests=True),
    View("code"),
    View("record", figure=record_figure, kinds=AXIAL | BEAMS),  # its answers come by another door: they need a file
)  # fmt: skip
PANELS = [(view.key, view.panel or view.key, sorted(view.kinds)) for view in VIEWS]  # with their files
FIGURES = {view.name: view.figure for view in VIEWS if view.figure} | {
    "stability-linear": partial(stability.stability_figure, across="linear"),
}
