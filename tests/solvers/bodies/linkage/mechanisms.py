"""Mechanisms that tests use, as tables of scene files."""

from solvers import Scene, Solution

STEEL = {"young": 207e9, "density": 7900.0}
FLAT = {"width": 0.06, "height": 0.008}
CRANK = {"name": "crank", "from": [0.0, 0.0], "to": [0.0, 0.3], "mass": 2.133}
COUPLER = {"name": "coupler", "from": [0.0, 0.3], "to": [0.4, 0.5], "mass": 3.178}
BAR = {"name": "bar", "from": [0.4, 0.0], "to": [0.4, 0.8], "mass": 3.034, "section": FLAT, "material": STEEL}
JOINTS = [
    {"kind": "revolute", "links": ["ground", "crank"], "at": [0.0, 0.0]},
    {"kind": "revolute", "links": ["crank", "coupler"], "at": [0.0, 0.3]},
    {"kind": "revolute", "links": ["coupler", "bar"], "at": [0.4, 0.5]},
    {"kind": "revolute", "links": ["ground", "bar"], "at": [0.4, 0.0]},
]


def four_bar(modes: int = 0, initial: bool = False, **changes) -> Scene:
    """Thesis 6.4.3: the crank at -5.236 rad/s, a mass ahead of the tip of the bar that moves away from it."""
    target = {
        "kind": "mechanism",
        "links": [CRANK, COUPLER, BAR | {"modes": modes, "shapes": "pinned-pinned"}],
        "joints": JOINTS,
        "drives": [{"joint": 0, "speed": -5.236, "initial": initial}],
        "struck": {"link": "bar", "at": 1.0, "normal": [-1.0, 0.0]},
    }
    impactor = {"kind": "mass", "mass": 2.133, "velocity": -1.513}
    return Scene.from_table({"impactor": impactor, "target": target}).replace(changes)


def rotating_bar(modes: int = 0, **changes) -> Scene:
    """Thesis 6.4.2: a bar held at 3.142 rad/s runs into a mass that comes towards its tip."""
    bar = {"name": "bar", "from": [0.0, 0.0], "to": [0.3, 0.0], "mass": 1.138, "section": FLAT, "material": STEEL}
    target = {
        "kind": "mechanism",
        "links": [bar | {"modes": modes}],
        "joints": [{"kind": "revolute", "links": ["ground", "bar"], "at": [0.0, 0.0]}],
        "drives": [{"joint": 0, "speed": 3.142}],
        "struck": {"link": "bar", "at": 1.0, "normal": [0.0, -1.0]},
    }
    impactor = {"kind": "mass", "mass": 1.138, "velocity": 0.0574}
    return Scene.from_table({"impactor": impactor, "target": target}).replace(changes)


def closes(found: Solution, rounding: float) -> bool:
    """Whether the parts of the energy, each found by itself, add up: to rounding, or where links turn meanwhile to what
    the note says of velocities that are taken in the first configuration."""
    frozen = [note.values["whole"] / 100.0 for note in found.notes if note.code == "configuration-frozen"]
    assert not [note for note in found.notes if note.code == "books-open"]
    return abs(found.diagnostics["energy_error"]) < max(rounding, *frozen, 0.0)
