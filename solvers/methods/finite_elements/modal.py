"""Finite elements in the modes of the mesh."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, NamedTuple, Self

import numpy as np

from ...bodies import AnyBody, Bending
from ...contact import Linear
from ...numerics.elements.mesh import AVERAGED, CONSISTENT
from ...numerics.elements.modes import mesh_modes
from ...numerics.modes import Modes, front_time
from ...numerics.oscillators import Record, Residual, march, oscillator_bank
from ...scene import Scene
from ...solution.sampled_motion import ShapeField, given_up, growth
from ...text.notes import Note, Severity
from ..options import option, whole, word
from ..parting import End
from .follow import March, Plan, follow
from .march import ELEMENTS_RANGE, FINER, MUCH_FINER, FiniteElements
from .motion import Course, given, shape_field

STEPS_PER_PERIOD = 20  # of the highest mode kept
USUAL_MODES = 20  # with a consistent boundary
BOUNDARIES = ("consistent", "massless")
NOTHING = 1e-12  # of a compliance: rounding


@dataclass(frozen=True, kw_only=True)
class FeModal(FiniteElements):
    """The lowest eigenvectors of a mesh (component mode synthesis); the modes left out act as a spring.

    scheme "energy-exact": exact oscillators; "newmark": constant mean acceleration. The contact force of a step does
    exactly the law's work in both. boundary "massless": the inertia of the struck node is moved to the next one and
    the mass of the mesh averaged between consistent and lumped, so that a rigid contact needs no local stiffness and
    hardly chatters; all modes are kept unless `modes` says otherwise. A contact with a law of its own does better with
    the "consistent" mass. A beam keeps 20 modes; "massless", at most half of those of its mesh, and its struck section
    gives way without inertia by all that are left out, as in 'modal'.
    Error: second order in the step; in elements of a rod second, but 4/5 where the front parts rigid faces (free rod,
    massless boundary) and 4/3 if a law's force jumps at first touch; in elements of a beam with a law of its own
    fourth, second where it shears. Cost: steps * modes and, once, elements * modes, or elements^3 where more than a few
    modes are kept.
    Source: thesis 6.4.1 and 8.2; massless boundary: Monjaraz Tec, Gross and Krack (2022).
    Differs: table 8.2 leaves out the compliance of the modes not kept, and its rows of 5 to 20 modes follow from no
    stiffness and step that was tested.
    """

    modes: int | None = option(None, whole(1, ELEMENTS_RANGE[1]))  # 20, or all of a rod with a massless boundary
    scheme: str = option("energy-exact", word(("energy-exact", "newmark")))
    boundary: str | None = option(None, word(BOUNDARIES))  # "massless" if the contact is rigid, else "consistent"

    NAME = "fe-modal"
    RESOLUTIONS = ("elements",)

    def _massless(self, scene: Scene) -> bool:
        return scene.rigid_contact if self.boundary is None else self.boundary == "massless"

    def _calmer(self, scene: Scene) -> str:
        if self._massless(scene) and self.modes is None:
            return "shorter"
        return super()._calmer(scene)

    def _miscounts(self) -> str:
        return "fe-modes"

    def _needs_stiffness(self, scene: Scene) -> bool:
        return not self._massless(scene)

    def _with_share(self, scene: Scene, share: float) -> Self:
        """Itself with a share of the elements and of the modes kept."""
        kept, other = self._kept(scene), super()._with_share(scene, share)
        elements = other.elements if other._gives_way(scene) else self.elements
        return replace(other, elements=elements, modes=None if kept is None else max(1, round(share * kept)))

    def _of_rigid_contact(self, scene: Scene, alone: bool) -> tuple[float, float]:
        if not self._massless(scene):
            return super()._of_rigid_contact(scene, alone)
        if self._shares(scene) is MUCH_FINER:
            return 1.0, 1.5
        return 1.0, 2.0 if self._shares(scene) is FINER or len(scene.target.rods) == 1 else 3.0

    def why_not(self, scene: Scene) -> Note | None:
        reason = super().why_not(scene)
        if reason is None and not self._gives_way(scene):
            reason = Note("refusals.stiff-element", Severity.REFUSAL)
        return reason

    def _gives_way(self, scene: Scene) -> bool:
        """Whether something of the mesh is left for the face to move by: one element clamped at both ends is stiff."""
        clamped = isinstance(scene.target, Bending) and scene.target.support == "clamped-clamped"
        return not (clamped and self._massless(scene) and self.elements < 2)

    def _kept(self, scene: Scene) -> int | Any:
        """How many modes; None: all of them."""
        beam = scene.bends
        return self.modes or (None if self._massless(scene) and not beam else USUAL_MODES)

    def _modes_of(self, body: Any, kept: int | Any, massless: bool) -> Modes:
        if body.time_unit is None:
            return body.modes(1)
        mesh = body.mesh(self.elements, AVERAGED if massless else CONSISTENT)
        if not mesh.bends:
            return mesh_modes(mesh, kept, massless).excited()
        if massless:  # the upper half is the mesh's own, and something must be left out to give way
            kept = min(kept, (mesh.size - mesh.free.shape[0]) // 2)
        modes = mesh_modes(mesh, kept).excited()
        while massless and modes.residual_compliance < NOTHING * float(
            ((modes.at_contact / modes.frequencies) ** 2).sum()
        ):
            kept -= 1  # on the coarsest meshes those left out may all be at rest where the beam is struck
            modes = mesh_modes(mesh, kept).excited()
        return modes

    def _course(self, scene: Scene, duration: float | None) -> Course:
        if duration is None and self.steps is not None:
            duration = replace(self, steps=None)._course(scene, None).duration
        return self._histories(scene, *self._march(scene, duration))

    def _given(self, scene: Scene, duration: float) -> tuple[float, float]:
        _, _, _, plan, record, steps, _ = self._march(scene, duration)
        impulse = plan.step * np.append(0.0, np.cumsum(record.contact_force[:steps]))
        return given(scene, plan.step, impulse, record.indentation[: steps + 1])

    def _march(
        self, scene: Scene, duration: float | None
    ) -> tuple[tuple[Modes, Modes], Any, float, Plan, Record, int, End]:
        """Modes of both, law, compliance of what is left out, plan, record, steps, and how it ended."""
        massless = self._massless(scene)
        first, second = (self._modes_of(body, self._kept(scene), massless) for body in (scene.impactor, scene.target))
        frequencies = np.concatenate((second.frequencies, first.frequencies))
        at_contact = np.concatenate((second.at_contact, first.at_contact))
        law, residual = self._law(scene), first.residual_compliance + second.residual_compliance
        if self._face_goes_along(scene):
            law, residual = Linear(1.0 / residual), 0.0
        highest = float(frequencies.max(initial=0.0))
        fine = 2.0 * np.pi / highest / STEPS_PER_PERIOD if highest else math.inf
        plan = Plan.of(scene, law, fine, math.inf, self.steps, duration, frequencies.size)
        turning = 2.0 / plan.step * np.arctan(0.5 * frequencies * plan.step) if self.scheme == "newmark" else None
        bank = oscillator_bank(frequencies, at_contact, plan.step, turning)
        displacement, velocity = np.zeros(frequencies.size), np.zeros(frequencies.size)

        settling = min(0.5, plan.step * highest / (2.0 * np.pi)) if law.JUMPS or law.PLASTIC else 0.0
        spring = Residual(residual, settling, law.JUMPS)

        def make(steps: int) -> Record:
            record = Record(
                *(np.zeros(steps + 1) for _ in range(8)),
                *(np.zeros((steps // plan.stride + 1, frequencies.size)) for _ in range(2)),
            )
            record.velocity[0], record.rigid_velocity[0] = scene.impactor.velocity, scene.target.velocity
            return record

        def advance(begin, end, record):
            march(
                law, spring, first.rigid_mass, second.rigid_mass, scene.weight_acceleration, 0.0, plan.step, bank,
                displacement, velocity, plan.stride, begin, end, record,
            )  # fmt: skip
            return end

        def impulse(record, instant):
            return plan.step * float(record.contact_force[:instant].sum())

        def room(record, instant):
            row = instant // plan.stride
            swings = np.hypot(record.checkpoint_displacement[row], record.checkpoint_velocity[row]).sum()
            swings += residual * abs(record.spring_force[instant])
            dent = float(law.dent(max(float(record.indentation[: instant + 1].max()), 0.0)))
            return record.rigid_position[instant] - record.position[instant] + dent - swings

        masses = first.rigid_mass, second.rigid_mass

        def pushes(record, instant):
            return plan.step * record.contact_force[:instant]

        def rings(record, instant):
            energy = float((bank.energy * (displacement**2 + velocity**2)).sum())
            return energy + 0.5 * residual * float(record.spring_force[instant]) ** 2

        what = March(masses, law, make, advance, impulse, room, pushes, rings)
        record, done, how = follow(scene, plan, what)
        return (first, second), law, residual, plan, record, done, how

    def _face_goes_along(self, scene: Scene) -> bool:
        """Whether a face has no compliance but its own: that of the massless element, and of the modes left out."""
        return self._massless(scene) and scene.rigid_contact

    def _histories(self, scene, modes, law, residual, plan, record, steps, end) -> Course:
        """Histories at all instants, fields and energies at the snapshots."""
        instants, rows = slice(0, steps + 1), slice(0, steps + 1, plan.stride)
        bodies, times = (scene.impactor, scene.target), plan.step * np.arange(steps + 1)
        split = modes[1].frequencies.size  # the record holds the target's modes first, the impactor's with their sign
        kept = record.checkpoint_displacement, record.checkpoint_velocity
        snapshots = [values[: times[rows].size] for values in kept]
        impactor, target = ((record.position, record.velocity), (record.rigid_position, record.rigid_velocity))
        fall, begun = scene.weight_acceleration, [-v[:, split:] for v in snapshots]
        sides = (
            _side(bodies[0], modes[0], begun, [v[rows] for v in impactor], times[rows], fall),
            _side(bodies[1], modes[1], [v[:, :split] for v in snapshots], [v[rows] for v in target], times[rows]),
        )
        push, depth = record.contact_force[:steps], record.indentation[instants]
        force = 0.5 * (np.append(push[:1], push) + np.append(push, push[-1:]))
        deepest = np.maximum(np.maximum.accumulate(depth), 0.0)
        deep = zip(depth[rows].tolist(), deepest[rows].tolist(), strict=True)
        stored = np.array([law.stored(a, most) for a, most in deep])
        lost = given_up(law, stored, np.arange(steps + 1)[rows], push)
        energies = [side.energies() for side in sides]
        gained = np.append(0.0, np.cumsum(push)) * plan.step
        spring = record.spring_force[rows]
        if self._face_goes_along(scene):  # all the depth is in it
            spring = np.maximum(depth[rows], 0.0) / sum(known.residual_compliance for known in modes)
        field = self._field(scene, modes, sides, spring, force[rows], gained, times[rows])
        closing = np.minimum(depth, 0.0) if self._face_goes_along(scene) else depth
        if scene.impactor.time_unit is None:
            face = record.position[instants] - closing
        else:
            struck = np.array([scene.target.place if isinstance(scene.target, Bending) else 0.0])
            face = np.interp(times, times[rows], field.displacement(times[rows], struck)[:, 0])
        freely = times * (scene.impactor.velocity + 0.5 * fall * times)
        ringing = [(m, body) for m, body in zip(modes, bodies, strict=True) if body.time_unit is not None]
        velocities = record.velocity[instants], record.rigid_velocity[instants]
        before = scene.impactor.velocity + fall * times, scene.target.velocity
        momenta = [_mean(own, free, m) for own, free, m in zip(velocities, before, modes, strict=True)]
        return Course(
            step=plan.step,
            stride=plan.stride,
            force=force,
            impulse=gained,
            indentation=depth,
            position=_mean(record.position[instants], freely, modes[0]),
            end_position=face,
            end_velocity=np.gradient(face, plan.step),
            target_velocity=momenta[1][rows] + sides[1].mean_rate(modes[1]),
            field=field,
            energies={
                "impactor": energies[0].sum(1),
                "target_rigid": energies[1][:, : sides[1].wholes].sum(1),
                "target_vibration": energies[1][:, sides[1].wholes :].sum(1),
                "local": stored - lost + 0.5 * residual * record.spring_force[rows] ** 2,
                "dissipated": record.lost[rows] + lost,
            },
            momenta=(_momentum(bodies[0], momenta[0]), _momentum(bodies[1], momenta[1])),
            resolved_time=max(self._resolved_time(scene, m, body) for m, body in ringing),
            shortest_period=min(m.shortest_period for m, _ in ringing),
            end=end,
            diverged=False,
        )

    def _resolved_time(self, scene: Scene, modes: Modes, body: Any) -> float:
        if body.bends:  # bending waves disperse: no front runs through it
            return modes.shortest_period
        order = 4 if self._massless(scene) else 2  # of the dispersion of averaged and of consistent mass
        return front_time(modes.frequencies.size, modes.shortest_period, order)

    def _field(self, scene: Scene, modes, sides: tuple["_Side", "_Side"], spring, force, gained, times) -> ShapeField:
        """Sums of the modes, and what the force leaves beside them, as if it were steady: how far the modes left out
        and a massless first element give way, how that is strained, and what the modes left out of a beam carry.

        spring, force (rows,) [N]: in the modes left out, and of the contact; impulse `gained` at all instants.
        """
        parts, bodies = [], (scene.impactor, scene.target)
        for body, known, side, sign in zip(bodies, modes, sides, (-1.0, 1.0), strict=True):
            first = self._massless(scene) and body.time_unit is not None and not body.bends
            moving = np.gradient(spring, times[1]) if first else np.zeros_like(spring)
            side = side.beside(sign * spring, sign * moving, {"shapes": partial(known.left_out, "shapes")})
            if body.bends:
                slow = sign * self._slow_force(scene, modes, gained, times)
                fields = {name: partial(known.left_out, name) for name in ("moments", "shears")}
                side = side.beside(slow, np.zeros_like(slow), fields)
            elif first:
                mesh = body.mesh(self.elements, AVERAGED)
                strained = sign * force / mesh.neighbour
                side = side.beside(
                    strained, np.zeros_like(strained), {"slopes": lambda x, mesh=mesh: mesh.slopes(x)[0]}
                )
            parts.append(side)
        coordinates, rates = np.hstack([p.coordinates for p in parts]), np.hstack([p.rates for p in parts])
        return shape_field(scene, times, coordinates, rates, parts)

    def _slow_force(self, scene: Scene, modes, gained: np.ndarray, times: np.ndarray) -> np.ndarray:
        """The force without the chatter of a rigid contact, at `times`."""
        step = times[-1] / (gained.size - 1)
        periods = [known.shortest_period for known in modes] if scene.rigid_contact else []
        return growth(times, step * np.arange(gained.size), gained, max(2.0 * step, *periods, 0.0))


class _Side(NamedTuple):
    """A body at the snapshots: mass-normalised coordinates and rates (rows, all), the first `wholes` those as a whole.

    Fields (all, x) per 1 of each coordinate.
    """

    coordinates: np.ndarray
    rates: np.ndarray
    frequencies: np.ndarray
    wholes: int
    shapes: Callable[[np.ndarray], np.ndarray]
    slopes: Callable[[np.ndarray], np.ndarray]
    moments: Callable[[np.ndarray], np.ndarray] | None
    shears: Callable[[np.ndarray], np.ndarray] | None

    def energies(self) -> np.ndarray:
        """Of each coordinate, (rows, all) [J]."""
        return 0.5 * (self.rates**2 + (self.frequencies * self.coordinates) ** 2)

    def beside(self, coordinate: np.ndarray, rate: np.ndarray, fields: Mapping[str, Callable]) -> "_Side":
        """With one more coordinate (rows,) and the fields (x,) per 1 of it."""
        names = [name for name in ("shapes", "slopes", "moments", "shears") if getattr(self, name) is not None]
        return self._replace(
            coordinates=np.column_stack((self.coordinates, coordinate)),
            rates=np.column_stack((self.rates, rate)),
            **{name: _below(getattr(self, name), fields.get(name)) for name in names},
        )

    def mean_rate(self, modes: Modes) -> np.ndarray | float:
        """What the vibration adds to the mean velocity (rows,) [m/s]: of what is held."""
        return 0.0 if modes.means is None else self.rates[:, self.wholes :] @ modes.means


def _side(
    body: Any, known: Modes, amplitudes: Sequence, whole: Sequence, times: np.ndarray, fall: float = 0.0
) -> _Side:
    """From at_contact * q and at_contact * q' / omega of the modes, and place and velocity where it is struck; `fall`
    is what weight gives it [m/s2]."""
    q, rates = amplitudes[0] / known.at_contact, amplitudes[1] * known.frequencies / known.at_contact
    fields: dict[str, Any] = {name: known.with_rigid(name) for name in ("shapes", "slopes", "moments", "shears")}
    if known.moments is None:
        fields["moments"] = fields["shears"] = None
    free = np.isfinite(known.rigid_mass)
    if free:
        root = np.sqrt(known.rigid_mass)
        q, rates = (np.column_stack((root * moved, own)) for moved, own in zip(whole, (q, rates), strict=True))
    turning = free and body.velocity != 0.0 and known.rigid_mean < 1.0 - 1e-12
    if turning:  # the translation that it comes with is more than the motion that an impact gives it
        root = np.sqrt(body.mass - known.rigid_mass)
        q = np.column_stack((root * times * (body.velocity + 0.5 * fall * times), q))
        rates = np.column_stack((root * (body.velocity + fall * times), rates))
        fields = {name: field and _in_front(field, name == "shapes", known, root) for name, field in fields.items()}
    wholes = int(free) + int(turning)
    return _Side(q, rates, np.append(np.zeros(wholes), known.frequencies), wholes, **fields)


def _in_front(field: Callable, moves: bool, modes: Modes, root: float) -> Callable:
    """A field with that of the translation left over in front."""
    return lambda x: np.vstack(((1.0 - modes.rigid_shape(x)[None, :]) / root * moves, field(x)))


def _mean(struck: np.ndarray, untouched: np.ndarray | float, modes: Modes) -> np.ndarray:
    """Of a body as a whole, from the place where it is struck, and from where it would be untouched."""
    return struck if modes.rigid_mean == 1.0 else untouched + modes.rigid_mean * (struck - untouched)


def _momentum(body: AnyBody, velocity: np.ndarray) -> float:
    """At the end [kg m/s]; zero of a body that stands still, whose mass may be infinite."""
    return body.mass * float(velocity[-1]) if velocity[-1] else 0.0


def _below(field: Callable, row: Callable | None) -> Callable:
    """A field with one more row, (x,), which is zero if it is not given."""
    return lambda x: np.vstack((field(x), np.zeros(np.size(x)) if row is None else row(x)))
