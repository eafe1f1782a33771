"""Mechanisms: how long an impact on a flexible four-bar takes, and how far joints and energy drift as one moves on."""

import numpy as np

import solvers
from solvers import Balance, Modal, Multibody
from solvers.methods.multibody.linkage import centres, rigid_linkage
from solvers.numerics.multibody.free import joints_at, step_on
from solvers.numerics.multibody.moving import STAGES, work

from .size import of, some
from .timing import median, row

MODES = 15  # of bending, of the bar
PERIODS, STEPS = 1_000, 120  # of the double pendulum, steps in each
PERIOD = 2.0 * np.pi * np.sqrt(0.4 / 9.81)


def measure() -> dict[str, object]:
    return dict(_impacts() + _moving() + _drift())


def _impacts() -> list:
    """From the tables of the scene to the last parting, shapes of the bar and modes of the mechanism with it."""
    rows = []
    for name, method in some((("table-6.8", Balance()), ("four-bar", Modal(estimate=False)))):
        tables = solvers.load(name).table()
        tables["target"]["links"][2]["modes"] = MODES

        def solve(tables=tables, method=method):
            return method.solve(solvers.Scene.from_table(tables)).impactor_velocity

        what = f"four-bar, {MODES} modes, {method.NAME}"
        rows.append(row(f"{what}: an impact", 1e3 * median(solve), "ms", "<= 150"))
    return rows


def _moving() -> list:
    """Half a turn of a four-bar with a flexible bar, through its impacts: as impulses, and by a contact law."""
    method, rows = Multibody(restitution=1.0, estimate=False), []
    for contact in some(({"law": "rigid"}, {"law": "hertz", "stiffness": 1e9})):
        scene = solvers.load("four-bar-moves").replace({"contact": contact})

        def solve(scene=scene):
            return method.solve(scene, scene.method["duration"])

        found = solve().diagnostics
        what = f"four-bar with 4 modes as it moves, {contact['law']}, {found['steps']} steps"
        rows += [
            row(f"{what}: half a turn", 1e3 * median(solve), "ms", ""),
            row(f"{what}: energy", found["energy_drift"], "", "<= 1e-8"),
            row(f"{what}: joints", found["constraint_error"], "m", "<= 1e-9"),
        ]
    return rows


def _drift() -> list:
    """Of the double pendulum of the scene, thrown by its impact."""
    scene = solvers.load("double-pendulum")
    linkage, rows_of = rigid_linkage(scene.target)
    q, v = centres(scene.target), solvers.solve(scene, duration=1e-5).motion.course.rates[1].copy()
    count = rows_of.joint.size
    room, reactions = work(count, q.size), np.zeros(count)
    inertia = np.tile([1.0, 1.0, 0.16 / 12.0], 2)

    def energy() -> float:
        return float(0.5 * v**2 @ inertia + 9.81 * (q[1] + q[4]))

    periods = of(PERIODS, 2)
    first, worst, gap, step = energy(), 0.0, 0.0, PERIOD / STEPS
    for number in range(periods * STEPS):
        step_on(linkage, room, STAGES, q, v, number * step, step, reactions)
        worst = max(worst, abs(energy() / first - 1.0))
        joints_at(linkage, q, 0.0, room.gap, room.jacobian, room.moving)
        gap = max(gap, float(np.abs(room.gap).max()))
    what = f"double pendulum, {periods} periods of {STEPS} steps"
    return [
        row(f"{what}: energy", worst, "", "<= 1e-8"),
        row(f"{what}: joints", gap, "m", "<= 1e-9"),
    ]
