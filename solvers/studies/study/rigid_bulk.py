"""Very many rigid masses on uniform rods, by the exact waves of each: columns of values in, of figures out."""

from collections.abc import Callable, Iterable, Mapping, Sequence

import numpy as np

from ...bodies import Rod
from ...methods import Waves
from ...methods.base import AFTERGLOW, Method
from ...methods.grazing import one_front
from ...numerics.processors import all_processors
from ...numerics.waves import rigid as rigid_waves
from ...numerics.waves import rigid_figures
from ...scene import Scene
from ...solve import solve
from ..figures import USUAL, figures_of
from ..mass_ratios import TERMS
from ..varied import with_values

CHUNK = 500  # of them that a thread takes at once
ROOM = (64, 1_000)  # pieces of a history, tried in turn
# Keys of scenes that follow from no other, by what they change: mass and speed of the impactor, length and area.
KEYS = {"impactor.mass", "impactor.velocity", "target.length", "target.area"}


def fits(scene: Scene, method: str | Method | None, figures: Sequence[str]) -> bool:
    """Whether the exact waves of a rigid mass on one rod are wanted, until the bodies part for good, and no fields."""
    if not USUAL.keys() >= set(figures):
        return False
    name = scene.method.get("name", Waves.NAME) if method is None else method
    options = scene.method.keys() - {"name"} if method is None else ()
    return name in ("waves", Waves()) and not options and one_front(scene)


def columns_fit(scene: Scene, keys: Iterable[str], method: str | Method | None, figures: Sequence[str]) -> bool:
    """Whether scenes that differ by these keys are not looked at one by one."""
    return fits(scene, method, figures) and set(keys) <= KEYS and scene.impactor.kind == "mass"


def of_columns(
    scene: Scene, columns: Mapping[str, np.ndarray], figures: Sequence[str], workers: int | None = None
) -> dict[str, np.ndarray]:
    """Figures by their names, of a scene with columns that `columns_fit`; all arrays (values,), on so many threads.

    Every extreme is read as a scene of its own: what lies between is allowed as well. Raises SceneError.
    """
    rod, size = scene.target.known_as(Rod), next(iter(columns.values())).size
    given = {"impactor.mass": scene.impactor.mass, "impactor.velocity": scene.impactor.velocity}
    given |= {"target.length": rod.length, "target.area": rod.area}
    mass, speed, length, area = (columns.get(key, np.full(size, value)) for key, value in given.items())
    rod_mass = rod.material.density * area * length
    with np.errstate(divide="ignore", invalid="ignore"):
        looked_at = (*columns.values(), rod_mass / mass)
    bad = [np.flatnonzero(~np.isfinite(values))[:1] for values in looked_at]
    numbers = [values for values in looked_at if not np.isnan(values).all()]
    rows = {int(row) for values in numbers for row in (np.nanargmin(values), np.nanargmax(values))}

    def scene_at(row: int) -> Scene:
        return with_values(scene, {key: float(values[row]) for key, values in columns.items()})

    for row in sorted(rows.union(*(found.tolist() for found in bad))):
        scene_at(row)
    held = np.full(size, 1.0 if rod.fixed else -1.0)
    bodies = mass, speed, rod_mass, area * (rod.impedance / rod.area), 2.0 * length / rod.wave_speed, held
    return _figures(np.stack(bodies), scene_at, figures, workers)


def of_scenes(scenes: Sequence[Scene], figures: Sequence[str], workers: int | None = None) -> dict[str, np.ndarray]:
    """The same of scenes, each of which `fits`."""
    bodies = np.empty((6, len(scenes)))
    for i, scene in enumerate(scenes):
        rod, striker = scene.target.known_as(Rod), scene.impactor
        reflection = 1.0 if rod.fixed else -1.0
        bodies[:, i] = striker.mass, striker.velocity, rod.mass, rod.impedance, rod.round_trip_time, reflection
    return _figures(bodies, scenes.__getitem__, figures, workers)


def _figures(
    bodies: np.ndarray, scene_of: Callable[[int], Scene], names: Sequence[str], workers: int | None
) -> dict[str, np.ndarray]:
    """Of `bodies` (6, impacts): mass and speed of the impactor; mass, impedance, round trip time and reflection of the
    rod. `scene_of` a row: for impacts so long that each is solved alone."""
    mass, speed, rod_mass, impedance, trip, reflection = bodies
    beta, found = rod_mass / mass, np.empty((mass.size, rigid_figures.COLUMNS))
    with all_processors(workers) as pool:
        parts = [slice(start, start + CHUNK) for start in range(0, mass.size, CHUNK)]
        list(pool.map(lambda part: _strike_all(beta[part], reflection[part], found[part]), parts))
    kernel = found.T
    final, force = speed * kernel[rigid_figures.FINAL], impedance * speed
    impulse = force * trip * kernel[rigid_figures.IMPULSE]
    target = np.where(reflection > 0.0, 0.0, speed * kernel[rigid_figures.TARGET])
    lost, initial = mass * (speed - final), 0.5 * mass * speed**2
    energy = 0.5 * mass * final**2 + force * speed * trip * kernel[rigid_figures.ROD]
    off = np.where(reflection > 0.0, 0.0, rod_mass * target - lost), lost - impulse
    momentum = np.where(np.abs(off[0]) > np.abs(off[1]), *off) / (mass * speed)
    compressing = np.where(kernel[rigid_figures.COMPRESSING] > 0.0, kernel[rigid_figures.COMPRESSING], np.nan)
    energy_error = energy / initial - 1.0
    nothing = np.full(mass.size, np.nan)  # rigid faces do not give way
    figures = {
        "contacts": kernel[rigid_figures.CONTACTS],
        "contact_time": trip * kernel[rigid_figures.TOUCHING],
        "duration": trip * (kernel[rigid_figures.PARTING] + AFTERGLOW),
        "impulse": impulse,
        "peak_force": force * kernel[rigid_figures.PEAK],
        "peak_indentation": nothing,
        "residual_indentation": nothing.copy(),
        "impactor_velocity": final,
        "target_velocity": target,
        "newton": (target - final) / speed,
        "poisson": kernel[rigid_figures.IMPULSE] / compressing - 1.0,
        "newton_at_contact": kernel[rigid_figures.FACE] - kernel[rigid_figures.FINAL],
        "dissipated": np.zeros(mass.size),
        "energy_error": energy_error,
        "momentum_error": momentum,
        "estimated_error": np.maximum(np.abs(energy_error) + np.abs(momentum), 1e-15),
    }
    figures = {name: figures[name] for name in names}
    for row in np.flatnonzero(kernel[rigid_figures.FOLLOWED] == 0.0).tolist():
        for name, value in zip(names, figures_of(solve(scene_of(row), Waves()), names), strict=True):
            figures[name][row] = np.nan if value is None else value
    return figures


def _strike_all(beta: np.ndarray, reflection: np.ndarray, out: np.ndarray) -> None:
    left = np.arange(beta.size)
    for pieces in ROOM:
        found = np.empty((left.size, rigid_figures.COLUMNS))
        sent = rigid_waves.Pieces.of(pieces, TERMS, pieces)
        rigid_figures.strike_all(beta[left], reflection[left], AFTERGLOW, sent, found)
        out[left] = found
        left = left[found[:, rigid_figures.FOLLOWED] == 0.0]
