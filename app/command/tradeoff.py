"""The commands `impact tradeoff`, cost and error of each method at each resolution, and `impact calibrate`."""

import json
import sys
from dataclasses import replace

import solvers
from solvers import SceneError, TradeOff
from solvers.accuracy.calibration import factors
from solvers.accuracy.cost_model import stored_costs
from solvers.accuracy.quantities import QUANTITIES
from solvers.provenance import machine

from .words import family, figure, named, text

SHARES = ("rebound", "impulse", "peak-force", "force-history", "resolved-force", "contact-time")


def print_calibration(as_json: bool) -> int:
    """Measure how fast this machine is, keep that and print it. Returns the exit code."""
    found, costs = solvers.calibrate(), stored_costs()
    scale = factors(costs.get("calibration"))
    if as_json:
        print(json.dumps({"machine": machine(), "seconds": found, "scale": scale}, indent=1))
        return 0
    where = {"processor": costs["machine"]["processor"], "date": costs.get("date", "")}
    for kind, name in family("calibrate.kind").items():
        beside = text("calibrate.beside", times=scale[kind], **where) if scale else ""
        print(f"{name:16}{figure(1e3 * found[kind], '9.3g')} ms  {beside}".rstrip())
    print(text("calibrate.kept"))
    return 0


def print_tradeoff(scene: solvers.Scene, quantity: str, as_json: bool, fresh: bool, stored: bool = False) -> int:
    """Measure and print, or print what is `stored`; when interrupted, what there is by then. Returns the exit code."""
    if quantity not in QUANTITIES:
        raise SceneError("--quantity", quantity, ", ".join(QUANTITIES))
    if stored:
        table = solvers.stored_tradeoff(scene)
        if table is None:
            raise SceneError("--stored", scene.title or "scene", text("wanted.stored"))
        _print(scene, table, quantity, as_json)
        return 0
    known: list[TradeOff] = []

    def progress(found: TradeOff) -> None:
        known[:] = [found]
        if sys.stderr.isatty():
            print(
                "\r" + text("tradeoff.so-far", points=len(found.points), seconds=found.seconds) + " ",
                end="",
                file=sys.stderr,
                flush=True,
            )

    try:
        found, code = solvers.tradeoff(scene, progress=progress, fresh=fresh), 0
    except KeyboardInterrupt:
        if not known:
            raise
        found, code = replace(known[0], stopped=text("run.interrupted")), 130
    if known and sys.stderr.isatty():
        print("\r" + " " * 40 + "\r", end="", file=sys.stderr)
    _print(scene, found, quantity, as_json)
    return code


def _print(scene: solvers.Scene, found: TradeOff, quantity: str, as_json: bool) -> None:
    print(json.dumps(found.table(), indent=1, allow_nan=False) if as_json else report(scene, found, quantity))


def _reference_lines(found: TradeOff, quantity: str) -> list[str]:
    if found.reference is None:
        return []
    return [
        f"  {text('tradeoff.reference'):20}{found.reference.words}",
        f"  {text('tradeoff.uncertain', quantity=quantity)}  {_shown(found.reference.uncertainty[quantity], '.1e')}",
    ]


def report(scene: solvers.Scene, found: TradeOff, quantity: str) -> str:
    """A table of plain text, quickest first; a star at the Pareto-optimal points."""
    best = found.front(quantity)
    rows = sorted(found.points, key=lambda point: point.wall_time)
    width = max(len(point.label) for point in rows)
    where = {"processor": found.machine["processor"], "cores": found.machine["cores"]}
    heads = family("tradeoff.head")
    lines = [
        "".join(sign if sign.isprintable() else "?" for sign in scene.title) or text("printed.report.scene"),
        *_reference_lines(found, quantity),
        f"  {text('tradeoff.machine'):19} {text('tradeoff.on', date=found.date, **where)}",
        *([f"  {'':20}{text('tradeoff.shipped', **_whence(found))}"] if found.shipped else []),
        *([f"  {'':20}{text('tradeoff.changed')}"] if found.changed else []),
        *([f"  {text('tradeoff.stopped', why=found.stopped)}"] if found.stopped else []),
        f"  * {text('tradeoff.best', quantity=quantity, what=named('name.error-in', quantity))}",
        "",
        f"    {heads['method']:{width}}{heads['time']:>10}{heads['spread']:>19}"
        + "".join(f"{heads[name]:>10}" for name in SHARES)
        + f"{heads['contacts']:>10}{heads['energy']:>10}{heads['own']:>16}",
        f"    {'':{width}}{'[ms]':>10}{'[ms]':>19}"
        + f"{'[%]':>10}" * len(SHARES)
        + f"{'':10}{'':10}{heads['own-of']:>16}",
    ]
    lines += [f"  {'*' if point in best else ' '} {_row(point, width)}" for point in rows]
    lines += ["", *(f"  {remark}" for remark in found.remarks)]
    lines += ["  " + text("printed.report.cannot", name=name, reason=reason) for name, reason in found.refused.items()]
    return "\n".join(lines).rstrip()


def _whence(found: TradeOff) -> dict[str, bool]:
    return {"scaled": found.scale is not None, "elsewhere": found.machine != machine()}


def _row(point: solvers.TradeOffPoint, width: int) -> str:
    least, most = point.spread or (0.0, 0.0)
    spread = "-" if point.spread is None else text("tradeoff.spread", least=1e3 * least, most=1e3 * most)
    invented = f"+{point.invented_contacts}" if point.invented_contacts else ""
    shares = [_percent(point.errors[quantity]) for quantity in SHARES]
    return (
        f"{point.label:{width}}{figure(1e3 * point.wall_time, '10.3f')}{spread:>19}"
        + "".join(f"{share:>10}" for share in shares)
        + f"{f'{point.true_contacts_found}/{point.true_contacts}{invented}':>10}"
        + f"{_shown(point.errors['energy'], '+.0e'):>10}{_percent(point.estimated_error):>16}"
    )


def _percent(share: float | None) -> str:
    if share is None:
        return "-"
    return figure(100.0 * share, "+.3g" if abs(share) >= 1e-6 else "+.0e")


def _shown(value: float | None, form: str) -> str:
    return text("printed.report.unknown") if value is None else figure(value, form)
