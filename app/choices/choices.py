"""What a visitor has chosen: bounded values, no widget. The same bounds guard sliders, address and socket."""

from collections.abc import Iterator, Mapping
from functools import cache
from typing import Any, ClassVar

import param

import solvers
from solvers import LAWS, METHODS, Scene
from solvers.bodies.beams import LARGEST_DAMPING, SUPPORTS, THEORIES
from solvers.bodies.pendulum import SHAPES
from solvers.contact.friction import MODELS
from solvers.methods.base import Method
from solvers.methods.modal.method import FRAMES
from solvers.methods.multibody.method import Multibody
from solvers.scenes.library import built_in
from solvers.text.catalogue import SOURCE
from solvers.validation import shown

from ..text.refusals import SOME_TEXT, Refused, code_or, reason_of
from .bodies import BodyValues, read_values
from .facts import facts_of
from .own import is_own, own_scene


@cache
def _loaded(name: str) -> Scene:
    """In one language, as a server speaks to visitors of several."""
    return built_in(name, SOURCE)


@cache
def _struck(name: str) -> Scene:
    return _loaded(name).struck


class Scenes(Mapping[str, Scene]):
    """Built-in scenes by name, each read when it is first asked for, those of visitors by their text; a mechanism is
    shown as what is struck.
    """

    def __init__(self) -> None:
        self._names = dict.fromkeys(solvers.scene_names())

    def __getitem__(self, name: str) -> Scene:
        if name in self._names:
            return _struck(name)
        if is_own(name):
            return own_scene(name).struck
        raise KeyError(name)

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


SCENES = Scenes()
START = next(iter(SCENES))
LINKS = "flexible", "rigid"
SOLVED_BY: dict[str, type[Method]] = {**METHODS, Multibody.NAME: Multibody}  # one for mechanisms only
OF_LAWS = {name: values for law in LAWS.values() for name, values in law.VARIED.items()}  # constants of their own


def strikes(name: str) -> bool:
    """Whether it is the mechanism that strikes in this scene."""
    scene = own_scene(name) if is_own(name) else _loaded(name)
    return scene.struck is not scene


class SceneName(param.Selector):
    """A built-in scene, or one of a visitor's own that can be read."""

    def _validate(self, val: Any) -> None:
        if is_own(val):
            facts_of(val).check()
        else:
            super()._validate(val)


class Choices(param.Parameterized):
    """Everything that can be set on the page, in the order of its controls.

    SI units; a value out of bounds raises ValueError.
    """

    scene = SceneName(default=START, objects=list(SCENES))
    bodies = BodyValues(default="", doc="values of bodies that are changed, see app.choices.bodies")
    mass_ratio = param.Number(default=1.0, bounds=(1e-3, 1e3))  # target / impactor
    speed = param.Number(default=1.0, bounds=(1e-2, 1e2))  # of approach [m/s]
    place = param.Number(default=1.0, bounds=(0.0, 1.0))  # where along a beam, or a rod in space, the impact falls
    support = param.Selector(default=SUPPORTS[0], objects=list(SUPPORTS))  # of a beam
    theory = param.Selector(default=THEORIES[0], objects=list(THEORIES))
    slenderness = param.Number(default=10.0, bounds=(1.0, 1e3))  # length of a beam over its depth
    damping = param.Number(default=0.0, bounds=(0.0, LARGEST_DAMPING))  # of every mode of a beam, of the critical
    law = param.Selector(default="rigid", objects=list(LAWS))
    linear_stiffness = param.Number(default=1.3e10, bounds=(1e2, 1e14))  # [N/m]
    hertz_stiffness = param.Number(default=1e10, bounds=(1e6, 1e14))  # [N/m^1.5]
    force_at_depth = param.Number(default=1e4, bounds=(1e-1, 1e9))  # [N], of laws with an exponent of their own
    for _name, (_usual, _low, _high) in OF_LAWS.items():
        locals()[_name] = param.Number(default=_usual, bounds=(_low, _high))
    restitution = param.Number(default=0.8, bounds=(0.0, 1.0))
    friction = param.Number(default=0.0, bounds=(0.0, 2.0))  # of bodies in space
    restitution_model = param.Selector(default=MODELS[0], objects=list(MODELS))  # of restitution, where they rub
    tilt = param.Number(default=0.0, bounds=(0.0, 80.0))  # of their normal, away from that of the scene [degrees]
    tilt_way = param.Number(default=0.0, bounds=(-180.0, 180.0))  # where to, about it [degrees]
    shapes = param.Selector(default=SHAPES[0], objects=list(SHAPES))  # of a pendulum that bends
    floating_frame = param.Selector(default=FRAMES[0], objects=list(FRAMES[:2]))  # of the modes of a free rod
    modes = param.Integer(default=50, bounds=(1, 200))
    elements = param.Integer(default=50, bounds=(1, 200))
    method = param.Selector(default="waves", objects=list(SOLVED_BY))
    motion_seconds = param.Number(default=0.0, bounds=(0.0, 20.0))  # for which links move on; 0: as long as is usual
    motion_links = param.Selector(default=LINKS[0], objects=list(LINKS))  # as what links that bend move on

    # of choices that stand in scene files as they are
    KEYS: ClassVar = {"damping": "target.damping", "shapes": "impactor.shapes"}
    CHOSEN = tuple(name for name, each in dict(locals()).items() if isinstance(each, param.Parameter))

    def chosen(self) -> dict[str, Any]:
        """All values by name, as one consistent set that a worker thread can keep."""
        return {name: getattr(self, name) for name in self.CHOSEN}


_TRIAL = Choices()


def accepts(name: str, value: object) -> bool:
    """Whether a choice may have this value."""
    if isinstance(value, bool):  # which Python counts among the numbers
        return False
    try:
        setattr(_TRIAL, name, value)  # `update` reads all others first
    except (ValueError, TypeError, OverflowError):
        return False
    return True


def within(name: str, value: float) -> float:
    """The nearest value that a choice may have."""
    low, high = Choices.param[name].bounds
    return min(max(value, low), high)


def refusal(name: str, value: object, of: type[param.Parameterized] = Choices, key: str | None = None) -> Refused:
    """For who uses the page: the control, the value and what is allowed; `key` where it has no title."""
    parameter, given = of.param[name], SOME_TEXT if value is SOME_TEXT else shown(value)
    said = {"control": title_of(name, key), "value": given}
    if name == "scene" and is_own(value):
        return _refused_scene(value)
    if name == "scene":
        return Refused("refused.scene", **said, count=len(SCENES))
    if isinstance(parameter, param.Selector):
        options = [code_or(f"name.{name}.{each}", each) for each in parameter.objects]
        return Refused("refused.choice", **said, options=options)
    if isinstance(parameter, param.Boolean):
        return Refused("refused.switch", **said)
    if isinstance(parameter, BodyValues) and isinstance(value, str):
        return Refused("refused.bodies", control=said["control"], why=_wrong_in(value))
    if isinstance(parameter, param.String):
        return Refused("refused.text", **said)
    low, high = parameter.bounds
    unit, whole = code_or(f"unit.{name}", "none"), isinstance(parameter, param.Integer)
    return Refused("refused.number", **said, whole=whole, low=low, high=high, unit=unit)


def _refused_scene(name: Any) -> Refused:
    try:
        Choices.param.scene._validate(name)
    except Refused as why:
        return why
    return Refused("refused.own-cut")


def _wrong_in(text: str) -> Any:
    try:
        read_values(text)
    except ValueError as refusal:
        return reason_of(refusal)
    return ""


def title_of(name: str, key: str | None = None) -> str:
    """Code of what the page calls a choice or a question."""
    return code_or(f"control.{name}", code_or(f"question.{name}", key or name))
