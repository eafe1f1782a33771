"""What is told of a limit holds, against exact waves or much finer modes; of three levels nothing is told."""

import numpy as np
import pytest

import solvers
from solvers import LAWS, Modal, Scene, convergence
from solvers.studies.convergence import WHOLES, _figures, _solve_all
from solvers.studies.levels import levels_of
from solvers.studies.orders import MARGIN, orders_of, rate
from tests.catalog import SUPPORTS, contact_table, struck_beam, struck_rod

MODES, ELEMENTS = (3, 5, 10, 20), (5, 10, 20, 40)
FINE = Modal(modes=160, estimate=False)


def random_impact(draw: np.random.Generator) -> Scene:
    """A mass on a rod or a beam by any law, from far softer to stiffer than the body."""
    ratio, on_rod = 10.0 ** draw.uniform(-1.0, 1.0), draw.uniform() < 0.65
    law = draw.choice([law for law in LAWS if on_rod or law != "rigid"])
    contact = contact_table(str(law), 10.0 ** draw.uniform(-1.0, 1.3), draw.uniform(0.3, 0.9))
    if on_rod:
        return struck_rod(ratio, str(draw.choice(SUPPORTS)), contact)
    support = draw.choice(["cantilever", "pinned-pinned", "clamped-clamped", "free-free"])
    return struck_beam(ratio, contact, support=str(support), at=float(draw.choice([0.3, 0.5, 0.7])))


def told_and_true(scene: Scene, by: str) -> list[tuple[float, float]]:
    """Distances to limits: what is told at the finest level, and what a reference of the same duration shows."""
    counts = {"modes": MODES, "elements": ELEMENTS}[by]
    others = dict.fromkeys(("elements", "step", "restitution"))
    levels = levels_of(scene, None, counts if by == "modes" else None, others | ({by: counts} if by in others else {}))
    finest, rows = _solve_all(levels)
    waves = solvers.Waves().without_estimate()
    truth = _figures((FINE if waves.refusal(scene) else waves).solve(scene, finest.duration))
    found = []
    for name, last in rows[-1].items():
        values = np.array([row[name] for row in rows])
        if name == "contacts" or not (np.isfinite(values).all() and values.any()):
            continue
        wholes = {"speed": scene.speed, "energy": scene.initial_energy}
        scale = wholes.get(WHOLES.get(name, ""), np.abs(values).max())
        chaotic = scene.rigid_contact and scene.bends
        _, order, note = rate(name, np.array(counts, float), values, scale, by, orders_of(scene, by), chaotic)
        if note.code == "converges":
            assert order is not None and order <= MARGIN * orders_of(scene, by)[0]
            found.append((note.values["error"], abs(last - truth[name]) / scale))
    return found


@pytest.mark.slow
def test_of_random_impacts_limits_are_as_near_as_is_told():
    draw, found = np.random.default_rng(2026), []
    for number in range(70):
        found += told_and_true(random_impact(draw), "elements" if number % 4 == 0 else "modes")
    told, true = np.array(found).T
    assert told.size > 210
    assert np.mean(true <= told) >= 0.95
    assert np.median(told[true > 1e-9] / true[true > 1e-9]) < 10.0  # and not by telling nothing


@pytest.mark.parametrize("name", ["fixed-rod", "two-equal-rods", "table-8.4"])
def test_three_levels_show_no_order(name):
    """Of the first one said 'order 5.8, 6.3e-05 from its limit', where it was 1.4e-3, with one contact of two."""
    found = convergence(name, (3, 5, 10))
    assert set(found.order.values()) == {None}
    codes = {note.code for quantity, note in found.summary.items() if quantity != "contacts"}
    assert codes == {"too-few"}
    assert str(found.summary["final_velocity"]).startswith("within ")
    assert not any("limit" in str(note) for note in found.summary.values())
    if name == "fixed-rod":
        assert str(found.summary["contacts"]) == "1 from 3 to 10 modes"


def test_no_order_above_that_of_the_method():
    counts = np.array([3.0, 5.0, 10.0, 20.0, 40.0])
    for order, code in ((2.0, "converges"), (4.5, "settled")):
        _, found, note = rate("impulse", counts, 1.0 + 0.1 * counts**-order, 1.0, "modes", (3.0, 2.0))
        assert note.code == code and (found is None) == (code == "settled")


@pytest.mark.parametrize(
    ("scene", "kind", "orders"),
    [
        (struck_rod(contact=contact_table("hertz")), "modes", (3.0, 2.0)),
        (struck_rod(contact=contact_table("kelvin-voigt")), "modes", (2.0, 1.0)),
        (struck_rod(), "elements", (2.0, 1.0)),
        (struck_beam(), "modes", (7.0, 2.0)),
        (struck_beam(), "elements", (4.0, 2.0)),
        (struck_beam(theory="timoshenko"), "modes", (3.0, 2.0)),
        (struck_beam(theory="timoshenko"), "elements", (2.0, 2.0)),
    ],
)
def test_orders_are_those_of_the_methods(scene, kind, orders):
    assert orders_of(scene, kind) == orders
