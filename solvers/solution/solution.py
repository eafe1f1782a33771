"""What happened: one type of result for every method."""

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import ArrayLike

from ..bodies import Mechanism, Pivoted, Swing
from ..scene import Scene
from ..text.notes import Note, coded
from ..validation import SceneError, allowed, plain
from . import closures
from .motion import BoundedMotion, ChangesModes, Joined, Motion, ShowsModes
from .peaks import Peaks, peaks_of
from .target_modes import TargetModes

if TYPE_CHECKING:
    from ..notebook.datasets import Dataset
    from ..notebook.plots import Drawn
    from .spectrum import Spectrum
    from .touch import Touch


@dataclass(frozen=True)
class ContactPeriod:
    """One stretch of time in which the bodies press on each other."""

    start: float  # [s]
    end: float  # [s]
    impulse: float  # [N s]
    peak_force: float | Any  # [N]; None: an impact of no duration

    @property
    def duration(self) -> float:
        """[s]; 0 of a sudden impulse."""
        return self.end - self.start


@dataclass(frozen=True)
class Sliding:
    """One stretch of an impact with friction: the touching points slide, stick, or slide anew another way."""

    kind: str  # of `solvers.contact.friction.SLIDING`
    until: float  # normal impulse [N s]


def apparent_time(contacts: Sequence[ContactPeriod]) -> float | None:
    """The contact time: from first touch to last parting [s], thesis 8.3; None for none, or one of no duration."""
    lasted = contacts[-1].end - contacts[0].start if contacts else 0.0
    return lasted if lasted > 0.0 else None


VELOCITIES = ("impulse", "impactor_velocity", "target_velocity")
SUMMARY = (*VELOCITIES, "restitution", "energy", "diagnostics")


class Later:
    """A figure of a solution that is worked out from it when it is first read: in a study most never are."""

    def __init__(self, work: Callable[["Solution"], Any]):
        self.work = work


def later(work: Callable[[], dict[str, Any]], cheap: Callable[[], dict[str, Any]] | None = None) -> dict[str, Any]:
    """The figures of `summary`, worked out together when one is read; `cheap`: those of `summary.velocities` alone."""
    found = dict.fromkeys(SUMMARY, cache(work)) | dict.fromkeys(VELOCITIES, cache(cheap or work))
    return {name: Later(lambda _, name=name: found[name]()[name]) for name in SUMMARY}


class _Figure:
    """A field of a solution that may come later."""

    def __new__(cls) -> Any:  # to type checkers each field is of the type it says
        return super().__new__(cls)

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = f"_{name}"

    def __get__(self, solution: Any, owner: type | None = None) -> Any:
        if solution is None:
            raise AttributeError(self._name)  # for the dataclass: there is no default
        value = solution.__dict__[self._name]
        if isinstance(value, Later):
            value = solution.__dict__[self._name] = value.work(solution)
        return value

    def __set__(self, solution: Any, value: Any) -> None:
        solution.__dict__[self._name] = value


class _Spin(_Figure):
    """Of a pendulum it follows from its velocity; None of what does not turn."""

    def __get__(self, solution: Any, owner: type | None = None) -> Any:
        value = None if solution is None else super().__get__(solution)
        if value is not None or solution is None:
            return value
        swing = solution.swings.get(self._name.removeprefix("_").removesuffix("_spin"))
        return swing and swing.spin

    def __set__(self, solution: Any, value: Any) -> None:
        super().__set__(solution, value if isinstance(value, tuple) else None)  # a number follows anew


@dataclass(frozen=True, kw_only=True, repr=False)
class Solution:
    """The answer to a scene, SI units, time zero at first touch, velocities positive the way the impactor came.

    Besides the figures below, `motion` gives force, positions, velocities and fields at any time and place up to
    `duration` [s]. A figure that does not exist (no indentation in a rigid contact) is None. Bodies in space have
    vectors of velocity, spins besides, and no motion but that of free bodies before and after.
    """

    scene: Scene
    method: dict[str, Any]
    contacts: list[ContactPeriod]
    duration: float  # [s], up to which it is solved
    motion: Motion | None  # None: bodies in space, which move freely before and after
    impulse: Any = _Figure()  # of all contacts [N s]; on the target, a vector, where bodies in space rub
    impactor_velocity: float | Any = _Figure()  # [m/s]; a prescribed force has none
    target_velocity: float | Any = _Figure()  # of its centre of mass [m/s]
    restitution: dict[str, float | None] = _Figure()  # newton, poisson, newton_at_contact
    energy: dict[str, float] = _Figure()  # at the end, by parts, and the initial one [J]
    diagnostics: dict[str, Any] = _Figure()
    notes: list[Note] = _Figure()
    peak_force: float | Any  # [N]; None: an impact of no duration
    peak_indentation: float | None = _Figure()  # [m]
    residual_indentation: float | None = _Figure()  # left in the surfaces [m]
    effective_mass: float | None = None  # of the contact [kg], where the impact is one impulse
    impactor_spin: Any = _Spin()  # [rad/s]; of bodies in space a vector, of pendulums a number
    target_spin: Any = _Spin()
    sliding: list[Sliding] | None = None  # of bodies in space that rub
    ball_velocities: list[float] | None = None  # of each of a row of balls at the end [m/s]
    models: dict[str, dict[str, Any]] | None = None  # what each model of restitution gives for them
    # contact periods at joints; of bonded ones with tension
    joints: list[list[ContactPeriod]] = field(default_factory=list)

    @property
    def links(self) -> dict[str, dict[str, Any]] | None:
        """Of a mechanism at the end, by link: `final_velocity` (2,) of its centre [m/s] and `final_spin` [rad/s]."""
        return None if (motion := self._joined_motion) is None else motion.link_rates(self.duration)

    @property
    def reactions(self) -> list[dict[str, Any]] | None:
        """Of a mechanism, by joint, what the impact makes the first link do to the second: `impulse` (2,) [N s] and
        `moment_impulse` [N m s], that of its drive with it, up to the last parting. Of repeated balances the sum of
        their sudden reactions, thesis (6.12), and `..._to_parting`, with what the links pass on as they vibrate."""
        if (motion := self._joined_motion) is None:
            return None
        return motion.reactions(self.contacts[-1].end if self.contacts else 0.0)

    @property
    def _joined_motion(self) -> Joined | None:
        """Of a mechanism, which every method finds with its links and joints; else none."""
        if not isinstance(self.scene.struck.target, Mechanism):
            return None
        assert isinstance(self.motion, Joined)
        return self.motion

    @property
    def time(self) -> np.ndarray:
        """Instants (n,) [s] of `force`, those of the method's steps or as close; a jump's twice, for before and after.

        Raises SceneError for bodies in space, which have no history.
        """
        return self._force_history[0]

    @property
    def force(self) -> np.ndarray:
        """Contact force (n,) [N] at `time`, compression positive; for other instants ask `motion.force(time)`."""
        return self._force_history[1]

    @cached_property
    def _force_history(self) -> tuple[np.ndarray, np.ndarray]:
        time, force = self.known_motion.force_history()
        inside = time <= self.duration
        return time[inside], force[inside]

    @property
    def contact_time(self) -> float:
        """For how long the bodies are in contact, all periods together [s]; 0 of sudden impulses."""
        return sum((contact.duration for contact in self.contacts), 0.0)

    @property
    def normal_impulse(self) -> float:
        """Of all contacts along their normal [N s]."""
        return float(np.dot(self.impulse, self.scene.normal)) if isinstance(self.impulse, tuple) else self.impulse

    @cached_property
    def peaks(self) -> Peaks:
        """The largest values by size, those that exist: `acceleration` of a rigid impactor, `displacement` of the face
        of what is held, `deflection` of a held beam, `stress`, `tension` along rods, bending `moment`, `support_force`.
        Error: 1e-3 of it, besides that of the method; see *How exact*. Cost: 5 to 50 ms."""
        return peaks_of(self)

    @property
    def mode_change(self) -> dict[str, dict[str, list[float]]] | None:
        """Of a link of finite elements struck on a node, thesis 6.4.4: by projection, velocities of nodes `along` and
        `across` [m/s] and of `turn` [rad/s] just after an impact without restitution."""
        return self._mode_change("velocities")

    @property
    def mode_change_coordinates(self) -> dict[str, dict[str, list[float]]] | None:
        """The same of their coordinates [m, rad], as the link is bent and stretched steadily before the impact."""
        return self._mode_change("coordinates")

    def _mode_change(self, what: str) -> dict[str, dict[str, list[float]]] | None:
        if not isinstance(self.motion, ChangesModes) or (change := self.motion.mode_change()) is None:
            return None
        parts = {"along": 0, "across": 1, "turn": 2}
        return {
            name: {part: values[start::3].tolist() for part, start in parts.items()}
            for name, values in getattr(change, what)._asdict().items()
        }

    @property
    def target_modes(self) -> TargetModes:
        """Shapes, frequencies and masses of the target's modes, and how strongly each rings.

        Raises SceneError where it was not solved by them, or where they have no shape along one body.
        """
        if not isinstance(self.motion, ShowsModes) or not self.scene.target.length:
            raise SceneError("solution", self.method["name"], allowed("shapes-of-modes"))
        return TargetModes(self.motion, self.scene.target.length)

    def spectrum(
        self,
        what: str = "contact_force",
        place: float | None = None,
        window: str = "none",
        frequency: ArrayLike | None = None,
    ) -> "Spectrum":
        """How much there is of each `frequency` [Hz] in a history: one that `dataset` has, or a field of it at a
        `place` [m], its first one by default; up to 100 periods in the time solved by default. Under a `window` "none",
        or "hann", by which a vibration that is cut off at the end does not spread over other frequencies.

        Error: rounding for the contact force of waves and of modes; a field is sampled 16 times in the shortest period.
        Raises SceneError for what the solution does not have, and above a frequency of 12500 periods in its time.
        """
        from . import spectrum  # which most solutions are not asked

        return spectrum.spectrum(self, what, place, window, frequency)

    def touch(self, time: ArrayLike) -> "Touch | None":
        """Radius and mean pressure of the circle on which the bodies touch, at instants (time,) [s] that ascend; None
        where the law is neither `hertz` nor `plastic-power`, or both bodies are flat. Raises SceneError as above."""
        from . import touch  # likewise

        return touch.touch(self, time)

    @property
    def known_motion(self) -> BoundedMotion:
        """The motion. Raises SceneError for bodies in space, which have no history."""
        if self.motion is None:
            raise SceneError("solution", self.method["name"], allowed("with-history"))
        return cast(BoundedMotion, self.motion)

    def complete(self) -> "Solution":
        """The same, its figures worked out: until one is read they may not be, which takes less time."""
        _ = self.energy, self.diagnostics
        return self

    def refine(self, name: str, change: Callable[["Solution", Any], Any]) -> None:
        """Have a figure that may come later changed, given the solution and the figure, when it is first read."""
        before = self.__dict__[f"_{name}"]
        work = before.work if isinstance(before, Later) else lambda _: before
        self.__dict__[f"_{name}"] = Later(lambda solution: change(solution, work(solution)))

    def dataset(self, time: ArrayLike | None = None, x: ArrayLike | None = None) -> "Dataset":
        """An xarray.Dataset of histories over `time` (time,) [s] and fields over (time, x), `x` (x,) [m]; names, units
        and what they mean are with the values.

        Without `time` and `x`: evenly over all of the solution and of the bodies. Contact force, impulse, positions and
        velocities of the impactor and the struck face, `energy` by `energy_part`; displacement, velocity, stress; of
        beams bending moment and shear force. At a jump the value after it. The scene, method, diagnostics and notes are
        attributes, so that `dataset().to_netcdf(path)` keeps all of it.
        Raises SceneError for bodies in space, which have no history; ImportError without the extra `notebook`.
        """
        from ..notebook import datasets  # loads xarray, which nothing else here needs

        return datasets.dataset(self, time, x)

    def plot(self, what: str = "force") -> "Drawn":
        """A HoloViews object: the contact `force` over time, the `motion` of the impactor and the struck face, `waves`
        of stress over place and time, or the parts of the `energy` over time; SI units on the axes.

        Raises SceneError for another word, for bodies in space, and for waves where nothing has a length.
        """
        from ..notebook import plots  # loads HoloViews, which nothing else here needs

        return plots.plot(self, what)

    def __copy__(self) -> "Solution":
        other = object.__new__(Solution)
        other.__dict__.update(self.__dict__)
        return other

    def __reduce__(self) -> tuple[Any, ...]:
        for name in (*SUMMARY, "notes", "peak_indentation", "residual_indentation"):
            getattr(self, name)  # what comes later comes now
        return _solution_of, (closures.written(self.__dict__),)

    def __str__(self) -> str:
        from ..notebook import report

        return report.report(self)

    def __repr__(self) -> str:
        from ..notebook import report

        return report.brief(self)

    def _repr_html_(self) -> str:
        from ..notebook import cards

        return cards.solution_card(self)

    @property
    def swings(self) -> dict[str, Swing]:
        """How each pendulum goes on: `impactor`, `target` or both."""
        found = {}
        for name, sign in (("impactor", -1.0), ("target", 1.0)):
            body = getattr(self.scene, name)
            if isinstance(body, Pivoted):
                found[name] = body.swing(getattr(self, f"{name}_velocity"), sign * self.impulse)
        return found

    def table(self) -> dict[str, Any]:
        """The result as plain tables, with the keys that scripts rely on."""
        effective_mass = {} if self.effective_mass is None else {"effective_mass": self.effective_mass}
        joints: list[Any] = [[asdict(contact) for contact in joint] for joint in self.joints]
        joints += self.reactions or []
        x, y = self.scene.target.struck.normal if isinstance(self.scene.target, Mechanism) else (1.0, 0.0)
        joints += [
            {"impulse": [swing.pivot_impulse * x, swing.pivot_impulse * y], "moment_impulse": 0.0}
            for swing in self.swings.values()
        ]
        names = dict(zip(self.swings, ("pendulum", "struck pendulum"), strict=False))
        links = {
            names[body]: {
                "final_velocity": [swing.centre_velocity * x, swing.centre_velocity * y],
                "final_spin": swing.spin,
            }
            for body, swing in self.swings.items()
        } | (self.links or {})
        felt = {body: {"effective_mass": swing.felt_mass} for body, swing in self.swings.items()}
        moved = self.ball_velocities
        balls = {} if moved is None else {"balls": [{"final_velocity": velocity} for velocity in moved]}
        slid = self.sliding
        rubbed = {} if slid is None else {"sliding": [asdict(each) for each in slid], "models": self.models}
        changed = self.mode_change
        return plain(
            {
                "scene": self.scene.table(),
                "method": self.method,
                "contacts": [asdict(contact) for contact in self.contacts],
                "contact_time": self.contact_time,
                **({"links": links} if links else {}),
                **(
                    {"mode_change": changed, "mode_change_coordinates": self.mode_change_coordinates} if changed else {}
                ),
                **({"joints": joints} if joints or self.reactions is not None else {}),
                "impulse": list(self.impulse) if isinstance(self.impulse, tuple) else self.impulse,
                **effective_mass,
                "peak_force": self.peak_force,
                "peak_indentation": self.peak_indentation,
                "residual_indentation": self.residual_indentation,
                "peaks": {name: peak._asdict() for name, peak in self.peaks.items()},
                "impactor": final(self.impactor_velocity, self.impactor_spin) | felt.get("impactor", {}),
                "target": final(self.target_velocity, self.target_spin) | felt.get("target", {}),
                **self.scene.target.figures(),
                **balls,
                "restitution": self.restitution,
                "energy": self.energy,
                **rubbed,
                "diagnostics": self.diagnostics,
                "duration": self.duration,
                **coded([*self.notes, *self.peaks.remarks]),
            }
        )


def _solution_of(known: bytes) -> Solution:
    """One that was pickled."""
    solution = object.__new__(Solution)
    solution.__dict__.update(closures.read(known))
    return solution


def final(velocity: Any, spin: Any) -> dict[str, Any]:
    """Of one body, as in results."""
    if spin is None:
        return {"final_velocity": velocity}
    if isinstance(spin, float):
        return {"final_velocity": velocity, "final_spin": spin}
    return {"final_velocity": list(velocity), "final_spin": list(spin)}
