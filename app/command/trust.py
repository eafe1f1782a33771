"""The commands `impact ensemble`, `gradient` and `convergence`: how far to trust an impact, and what it follows."""

import json
from typing import Any

import solvers
from solvers import SceneError
from solvers.studies.convergence import convergence
from solvers.studies.ensemble import ensemble
from solvers.studies.gradient import USUAL, USUAL_KEY, gradient

from .interrupts import interruptible
from .words import text


def number(option: str, given: str, kind: type = float) -> Any:
    """The number that an option was given. Raises SceneError naming it."""
    try:
        return kind(given)
    except ValueError:
        raise SceneError(option, given, text("wanted.any-whole" if kind is int else "wanted.any-number")) from None


def print_ensemble(scene: solvers.Scene, runs: str, spread: str, key: str | None, seed: str, as_json: bool) -> int:
    """Print the spread of every figure as a table, or the whole ensemble in JSON."""
    counts = number("--runs", runs, int), number("--seed", seed, int)
    try:
        with interruptible() as interrupted:
            largest = number("--spread", spread)
            found = ensemble(scene, runs=counts[0], spread=largest, key=key, seed=counts[1], cancel=interrupted)
    except SceneError as refused:
        if interrupted():
            raise KeyboardInterrupt from None  # too few runs to show anything
        if refused.key in ("runs", "spread", "key", "seed"):
            raise SceneError(f"--{refused.key}", refused.value, refused.reason) from None
        raise
    print(json.dumps(found.table(), indent=1, allow_nan=False) if as_json else found)
    return 130 if interrupted() else 0


def print_gradient(scene: solvers.Scene, of: list[str] | None, to: list[str] | None, as_json: bool) -> int:
    """Print the derivatives of figures by keys as a table, or all that is known of them in JSON."""
    options = {"figures": "--of", "to": "--to"}
    try:
        found = gradient(scene, of or USUAL, to or USUAL_KEY)
    except SceneError as refused:
        if refused.key in options:
            raise SceneError(options[refused.key], refused.value, refused.reason) from None
        raise
    print(json.dumps(found.table(), indent=1, allow_nan=False) if as_json else found)
    return 0


def print_convergence(scene: solvers.Scene, lists: dict[str, str | None], as_json: bool) -> int:
    """Print a column for each level, and what they show, or all of it in JSON; `lists` by option, as written."""
    named, _ = solvers.read_method(scene.method, scene)
    own = {"modes", "elements"} & set(named.table()) and lists["elements"] is None
    values: dict[str, Any] = {
        option: [
            number(f"--{option}", part, int if option in ("modes", "elements") else float)
            for part in written.split(",")
        ]
        for option, written in lists.items()
        if written is not None
    }
    try:
        found = convergence(scene, method=named if own else None, **values)
    except SceneError as refused:
        if refused.key in lists:
            raise SceneError(f"--{refused.key}", refused.value, refused.reason) from None
        raise
    print(json.dumps(found.table(), indent=1, allow_nan=False) if as_json else found)
    return 0
