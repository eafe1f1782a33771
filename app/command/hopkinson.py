"""The command `impact hopkinson`: stress, strain and strain rate of a specimen between two bars with gauges."""

import json
from argparse import ArgumentParser, Namespace
from typing import Any

import solvers
from solvers import Hopkinson, SceneError, validation

from .export import check_name
from .reading import add_arguments, how
from .record import write_columns
from .words import family, figure, text


def add_command(commands: Any) -> None:
    """With its options."""
    parser: ArgumentParser = commands.add_parser("hopkinson", help=text("help.hopkinson.about"))
    parser.add_argument("file", metavar="FILE", help=text("help.hopkinson.file"))
    parser.add_argument("--bars", metavar="BARS.toml", required=True, help=text("help.hopkinson.bars"))
    parser.add_argument("--waves", metavar="1|2|3", default="1", help=text("help.hopkinson.waves"))
    parser.add_argument("--start", metavar="S", help=text("help.hopkinson.start"))
    parser.add_argument("--window", metavar="S", help=text("help.hopkinson.window"))
    parser.add_argument("--kind", help=text("help.hopkinson.kind"))
    add_arguments(parser)
    parser.add_argument("--series", metavar="FILE", help=text("help.hopkinson.series"))
    parser.add_argument("--json", action="store_true", help=text("help.json"))
    parser.set_defaults(run=print_hopkinson)


def print_hopkinson(options: Namespace) -> int:
    """Reduce the record, print the results, write the curves."""
    if options.series is not None:
        check_name(options.series, ".csv")
    validation.choice("--waves", options.waves, ("1", "2", "3"))
    try:
        found = solvers.hopkinson(
            options.file,
            options.bars,
            start=_seconds("--start", options.start),
            window=_seconds("--window", options.window),
            waves=int(options.waves),
            **how(options),
        )
    except SceneError as refused:
        if refused.key in ("start", "window", "bars", "kind", "decimal", "scale"):
            raise SceneError(f"--{refused.key}", refused.value, refused.reason) from None
        raise
    if options.series is not None:
        write_columns(options.series, found.series())
    print(json.dumps(found.table(), indent=1, allow_nan=False) if options.json else _report(found))
    return 0


def _seconds(key: str, word: str | None) -> float | None:
    try:
        return None if word is None else float(word)
    except ValueError:
        raise SceneError(key, word, text("wanted.any-number")) from None


def _report(found: Hopkinson) -> str:
    """Results, each with what noise makes of it, and where the pulses were found."""
    names, unsure = family("hopkinson.row"), found.uncertainty()
    stress = unsure[("stress_one_wave", "stress_two_waves", "stress_three_waves")[found.waves - 1]]
    rows = [
        ("strain-rate", found.strain_rate, unsure["strain_rate"] / len(found.plateau) ** 0.5, "1/s"),
        ("peak-stress", found.peak_stress / 1e6, stress / 1e6, "MPa"),
        ("strain", 100.0 * float(found.strain[-1]), 100.0 * unsure["strain"], "%"),
        ("equilibrium", 100.0 * found.equilibrium, None, "%"),
        ("momentum", 100.0 * found.momentum, None, "%"),
    ]
    lines = []
    for name, value, noise, unit in rows:
        beside = "" if noise is None or noise < 1e-9 * abs(value) else "  ± " + figure(noise, ".2g")
        lines.append(f"  {names[name]:22}{figure(value, '10.4g')} {unit:4}{beside}".rstrip())
    length, starts = found.windows.length, found.windows.starts(found.bars)
    lines += ["", "  " + text("hopkinson.windows", length=1e6 * length, count=found.time.size)]
    for name, start in zip(("incident", "reflected", "transmitted"), starts, strict=True):
        lines.append(f"  {names[name]:22}{figure(1e6 * start, '10.2f')} us")
    striker = found.striker()
    if striker is not None:
        lines += ["", f"  {'':22}{names['expected']:>10}  {names['measured']:>10}"]
        for name, factor, unit in (("strain", 1e6, "um/m"), ("duration", 1e6, "us")):
            pair = (striker[f"expected_{name}"], striker[name])
            cells = "  ".join(f"{'-':>10}" if each is None else figure(factor * each, "10.4g") for each in pair)
            lines.append(f"  {names[f'pulse-{name}']:22}{cells} {unit}")
    return "\n".join(lines + ["  " + text("printed.report.note", note=str(note)) for note in found.notes])
