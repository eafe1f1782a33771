"""The command `impact tradeoff`: what each method costs at each resolution, and what it misses."""

import json
import sys
from dataclasses import replace

import solvers
from solvers import SceneError, TradeOff
from solvers.accuracy.quantities import QUANTITIES

SHARES = {"rebound": "rebound", "impulse": "impulse", "peak-force": "peak", "force-history": "force L2",
          "resolved-force": "resolved", "contact-time": "contact"}  # fmt: skip


def print_tradeoff(scene: solvers.Scene, quantity: str, as_json: bool, fresh: bool) -> int:
    """Measure and print; when interrupted, what there is by then. Returns the exit code."""
    if quantity not in QUANTITIES:
        raise SceneError("--quantity", quantity, ", ".join(QUANTITIES))
    known: list[TradeOff] = []

    def progress(found: TradeOff) -> None:
        known[:] = [found]
        if sys.stderr.isatty():
            print(f"\r{len(found.points)} points, {found.seconds:.1f} s ", end="", file=sys.stderr, flush=True)

    try:
        found, code = solvers.tradeoff(scene, progress=progress, fresh=fresh), 0
    except KeyboardInterrupt:
        if not known:
            raise
        found, code = replace(known[0], stopped="interrupted"), 130
    if known and sys.stderr.isatty():
        print("\r" + " " * 40 + "\r", end="", file=sys.stderr)
    print(json.dumps(found.table(), indent=1, allow_nan=False) if as_json else report(scene, found, quantity))
    return code


def report(scene: solvers.Scene, found: TradeOff, quantity: str) -> str:
    """A table of plain text, quickest first; a star where nothing is quicker and nearer at once."""
    best = found.front(quantity)
    rows = sorted(found.points, key=lambda point: point.wall_time)
    width = max(len(point.label) for point in rows)
    machine = found.machine
    lines = [
        "".join(sign if sign.isprintable() else "?" for sign in scene.title) or "Scene",
        f"  errors measured by  {found.reference.words}",
        f"  {quantity} uncertain by  {_shown(found.reference.uncertainty[quantity], '.1e')}",
        f"  times measured on   {machine['processor']}, {machine['cores']} cores, {found.date}",
        *([f"  not complete: {found.stopped}"] if found.stopped else []),
        f"  * nothing is quicker and nearer in {quantity} ({QUANTITIES[quantity]})",
        "",
        f"    {'method':{width}}{'time':>10}{'spread':>19}"
        + "".join(f"{name:>10}" for name in SHARES.values())
        + f"{'contacts':>10}{'energy':>10}{'says of itself':>16}",
        f"    {'':{width}}{'[ms]':>10}{'[ms]':>19}"
        + f"{'[%]':>10}" * len(SHARES)
        + f"{'':10}{'':10}{'rebound [%]':>16}",
    ]
    lines += [f"  {'*' if point in best else ' '} {_row(point, width)}" for point in rows]
    lines += ["", *(f"  {remark}" for remark in found.remarks)]
    lines += [f"  {name} cannot: {reason}" for name, reason in found.refused.items()]
    return "\n".join(lines).rstrip()


def _row(point: solvers.TradeOffPoint, width: int) -> str:
    spread = "-" if point.spread is None else " to ".join(f"{1e3 * part:.3g}" for part in point.spread)
    invented = f"+{point.invented_contacts}" if point.invented_contacts else ""
    shares = [_percent(point.errors[quantity]) for quantity in SHARES]
    return (
        f"{point.label:{width}}{1e3 * point.wall_time:10.3f}{spread:>19}"
        + "".join(f"{share:>10}" for share in shares)
        + f"{f'{point.true_contacts_found}/{point.true_contacts}{invented}':>10}"
        + f"{_shown(point.errors['energy'], '+.0e'):>10}{_percent(point.estimated_error):>16}"
    )


def _percent(share: float | None) -> str:
    if share is None:
        return "-"
    return f"{100.0 * share:+.3g}" if abs(share) >= 1e-6 else f"{100.0 * share:+.0e}"


def _shown(value: float | None, form: str) -> str:
    return "unknown" if value is None else f"{value:{form}}"
