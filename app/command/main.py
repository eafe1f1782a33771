"""The command `impact`: solve scenes, list them, serve the page."""

import argparse
import json
import os
import sys
import threading
import tomllib
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import solvers
from solvers import SceneError
from solvers.contact.duration import exponent_of
from solvers.jit.shortcuts import shorten

from .hopkinson import add_command as add_hopkinson_command
from .lesson import add_commands as add_lesson_commands
from .parser import Parser, Refused
from .plot import add_command as add_plot_command
from .reading import add_arguments as add_reading_arguments
from .seek import add_arguments as add_seek_arguments
from .seek import print_sought, turned_round
from .serve import add_arguments as add_serve_arguments
from .static import add_export_arguments, add_wasm_arguments
from .words import text

QUIET_SECONDS = 3.0  # [s] until one line says what takes long


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns the exit code: 0, or 2 after one line on standard error; 130 if interrupted;
    1 where a lesson file has errors."""
    shorten()
    try:
        options = _parser().parse_args(arguments)
        with _patience():
            code = options.run(options)
        sys.stdout.flush()
        return code
    except (Refused, SceneError) as refusal:
        line = " ".join(str(refusal).split())
        print(f"impact: {line}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(text("run.stopped"), file=sys.stderr)
        return 130
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        missing = error.filename is not None  # of a part of the program, as all that users name is checked before
        why = {"why": error.strerror or str(error)}
        said = text("run.no-file", file=error.filename, **why) if missing else text("run.no-output", **why)
        print(said, file=sys.stderr)
        return 2


@contextmanager
def _patience():
    """Say, to whoever waits, that kernels may be compiling: once for a machine and these sources."""
    from solvers.jit.cache import all_compiled

    if not sys.stderr.isatty() or all_compiled().exists():
        yield
        return
    timer = threading.Timer(QUIET_SECONDS, print, (text("run.compiling"),), {"file": sys.stderr, "flush": True})
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


def _parser() -> argparse.ArgumentParser:
    from . import joints, optimise, plan, stability, study, uncertain

    parser = Parser(prog="impact", description=text("help.impact"))
    parser.add_argument("--version", action="version", version=solvers.__version__, help=text("help.version"))
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=Parser)

    solve = commands.add_parser("solve", help=text("help.solve.about"))
    _scene_arguments(solve)
    solve.add_argument("--series", metavar="FILE", help=text("help.solve.series"))
    solve.add_argument("--at", action="append", default=[], metavar="X", help=text("help.solve.at"))
    add_seek_arguments(solve)
    solve.set_defaults(run=_solve)

    compare = commands.add_parser("compare", help=text("help.compare"))
    _scene_arguments(compare)
    compare.set_defaults(run=_compare)

    _tradeoff_command(commands)
    _calibrate_command(commands)
    _sweep_command(commands)
    _scene_command(commands, "study", text("help.study.about"), study.add_arguments, study.print_study)
    _scene_command(commands, "optimise", text("help.optimise.about"), optimise.add_arguments, optimise.print_optimum)
    _scene_command(
        commands, "uncertain", text("help.uncertain.about"), uncertain.add_arguments, uncertain.print_uncertain
    )
    add_plot_command(commands)
    _report_command(commands)
    _bounce_command(commands)
    _ensemble_command(commands)
    _gradient_command(commands)
    _convergence_command(commands)
    _record_command(commands)
    add_hopkinson_command(commands)
    _scene_command(
        commands, "stability", text("help.stability.about"), stability.add_arguments, stability.print_stability
    )
    _scene_command(commands, "plan", text("help.plan.about"), plan.add_arguments, plan.print_plan)
    _scene_command(commands, "joints", text("help.joints.about"), joints.add_arguments, joints.print_joints)

    lesson = commands.add_parser("lesson", help=text("help.lesson.about"))
    add_lesson_commands(lesson)

    scenes = commands.add_parser("scenes", help=text("help.scenes"))
    scenes.set_defaults(run=_scenes)

    serve = commands.add_parser("serve", help=text("help.serve.about"))
    add_serve_arguments(serve)

    static = commands.add_parser("export-static", help=text("help.export-static.about"))
    add_export_arguments(static)

    wasm = commands.add_parser("wasm", help=text("help.wasm.about"))
    add_wasm_arguments(wasm)

    warm = commands.add_parser("warm", help=text("help.warm"))
    warm.set_defaults(run=_warm)
    return parser


def _scene_command(
    commands: Any,
    name: str,
    about: str,
    add_arguments: Callable[[Any], None],
    run: Callable[[solvers.Scene, argparse.Namespace], int],
) -> None:
    """One of a scene, with options of its own."""
    parser = commands.add_parser(name, help=about)
    _scene_arguments(parser)
    add_arguments(parser)
    parser.set_defaults(run=lambda options: run(_scene(options), options))


def _tradeoff_command(commands: Any) -> None:
    parser = commands.add_parser("tradeoff", help=text("help.tradeoff.about"))
    _scene_arguments(parser)
    parser.add_argument("--quantity", default="rebound", help=text("help.tradeoff.quantity"))
    parser.add_argument("--fresh", action="store_true", help=text("help.tradeoff.fresh"))

    parser.add_argument("--stored", action="store_true", help=text("help.tradeoff.stored"))

    def run(options: argparse.Namespace) -> int:
        from .tradeoff import print_tradeoff

        return print_tradeoff(_scene(options), options.quantity, options.json, options.fresh, options.stored)

    parser.set_defaults(run=run)


def _calibrate_command(commands: Any) -> None:
    parser = commands.add_parser("calibrate", help=text("help.calibrate"))
    parser.add_argument("--json", action="store_true", help=text("help.json"))

    def run(options: argparse.Namespace) -> int:
        from .tradeoff import print_calibration

        return print_calibration(options.json)

    parser.set_defaults(run=run)


def _sweep_command(commands: Any) -> None:
    parser = commands.add_parser("sweep", help=text("help.sweep.about"))
    _scene_arguments(parser)
    span = "KEY=LOW..HIGH[:COUNT][:log|:linear]"
    parser.add_argument("--vary", required=True, metavar=span, help=text("help.sweep.vary"))
    parser.add_argument("--figure", action="append", metavar="NAME", help=text("help.sweep.figure"))

    def run(options: argparse.Namespace) -> int:
        from .sweep import print_sweep

        return print_sweep(_scene(options), options.vary, options.figure, options.json)

    parser.set_defaults(run=run)


def _report_command(commands: Any) -> None:
    from . import report

    parser = commands.add_parser("report", help=text("help.report.about"))
    _scene_arguments(parser)
    report.add_arguments(parser)
    parser.set_defaults(run=lambda options: report.print_any(options, _scene, parse_changes))


def _bounce_command(commands: Any) -> None:
    parser = commands.add_parser("bounce", help=text("help.bounce.about"))
    _scene_arguments(parser)
    parser.add_argument("--cut", default="1e-6", metavar="PART", help=text("help.bounce.cut"))
    parser.add_argument("--bounces", default="200", metavar="N", help=text("help.bounce.bounces"))

    def run(options: argparse.Namespace) -> int:
        from .bounce import print_bounces

        return print_bounces(_scene(options), options.cut, options.bounces, options.json)

    parser.set_defaults(run=run)


def _ensemble_command(commands: Any) -> None:
    parser = commands.add_parser("ensemble", help=text("help.ensemble.about"))
    _scene_arguments(parser)
    parser.add_argument("--runs", default="200", metavar="N", help=text("help.ensemble.runs"))
    parser.add_argument("--spread", default="1e-2", metavar="S", help=text("help.ensemble.spread"))
    parser.add_argument("--key", help=text("help.ensemble.key"))
    parser.add_argument("--seed", default="0", metavar="N", help=text("help.ensemble.seed"))

    def run(options: argparse.Namespace) -> int:
        from .trust import print_ensemble

        return print_ensemble(_scene(options), options.runs, options.spread, options.key, options.seed, options.json)

    parser.set_defaults(run=run)


def _gradient_command(commands: Any) -> None:
    parser = commands.add_parser("gradient", help=text("help.gradient.about"))
    _scene_arguments(parser)
    parser.add_argument("--of", nargs="+", action="extend", metavar="FIGURE", help=text("help.gradient.of"))
    parser.add_argument("--to", nargs="+", action="extend", metavar="KEY", help=text("help.gradient.to"))

    def run(options: argparse.Namespace) -> int:
        from .trust import print_gradient

        return print_gradient(_scene(options), options.of, options.to, options.json)

    parser.set_defaults(run=run)


def _convergence_command(commands: Any) -> None:
    parser = commands.add_parser("convergence", help=text("help.convergence.about"))
    _scene_arguments(parser)
    parser.add_argument("--modes", metavar="N,N,...", help=text("help.convergence.modes"))
    parser.add_argument("--elements", metavar="N,N,...", help=text("help.convergence.elements"))
    parser.add_argument("--steps", metavar="S,S,...", help=text("help.convergence.steps"))
    parser.add_argument("--restitutions", metavar="E,E,...", help=text("help.convergence.restitutions"))

    def run(options: argparse.Namespace) -> int:
        from .trust import print_convergence

        lists = {name: getattr(options, name) for name in ("modes", "elements", "steps", "restitutions")}
        return print_convergence(_scene(options), lists, options.json)

    parser.set_defaults(run=run)


def _record_command(commands: Any) -> None:
    parser = commands.add_parser("record", help=text("help.record.about"))
    parser.add_argument("file", nargs="?", help=text("help.record.file"))
    parser.add_argument("--example", action="store_true", help=text("help.record.example"))
    _scene_arguments(parser, option=True)
    parser.add_argument("--kind", help=text("help.record.kind"))
    parser.add_argument("--at", action="append", default=[], metavar="X", help=text("help.record.at"))
    add_reading_arguments(parser)
    parser.add_argument("--shift", metavar="S", help=text("help.record.shift"))
    parser.add_argument("--recover", action="store_true", help=text("help.record.recover"))
    parser.add_argument("--series", metavar="FILE", help=text("help.record.series"))

    def run(options: argparse.Namespace) -> int:
        from .record import print_record

        return print_record(_scene(options), options)

    parser.set_defaults(run=run)


def _scene_arguments(parser: argparse.ArgumentParser, option: bool = False) -> None:
    known = text("help.scene")
    if option:
        parser.add_argument("--scene", required=True, help=known)
    else:
        parser.add_argument("scene", help=known)
    parser.add_argument(
        "--set", action="append", default=[], metavar="KEY=VALUE", dest="changes", help=text("help.set")
    )
    parser.add_argument("--json", action="store_true", help=text("help.json"))


def _scene(options: argparse.Namespace) -> solvers.Scene:
    scene = solvers.load(options.scene)
    scene = _changed(scene, parse_changes(options.changes)) if options.changes else scene
    solvers.read_method(scene.method, scene)  # one that is named must exist, though a study may use others
    return scene


def _changed(scene: solvers.Scene, changes: dict[str, Any]) -> solvers.Scene:
    """The scene with these values. Raises SceneError, too, where another law has the stiffness in another unit."""
    found = scene.replace(changes)
    given = (scene.given or scene.table()).get("contact", {})
    kept = "contact.law" in changes and "stiffness" in given and "contact.stiffness" not in changes
    before, now = (f"N/m^{exponent_of(each.contact):g}".removesuffix("^1") for each in (scene, found))
    if kept and "stiffness" in found.contact.KEYS and before != now:
        stiffness = found.table()["contact"]["stiffness"]
        raise SceneError(
            "contact.law",
            found.contact.NAME,
            text("wanted.unit-of-stiffness", stiffness=f"{stiffness:g}", before=before, now=now),
        )
    return found


def _warm(options: argparse.Namespace) -> int:
    from solvers.numerics.processors import processors

    from ..jobs.compiler import compile_at_once

    compile_at_once(processors())
    print(text("run.compiled"))
    return 0


def _scenes(options: argparse.Namespace) -> int:
    from solvers.text.catalogue import spoken

    from ..choices.choices import SCENES
    from ..page.picker import scene_groups
    from ..text.refusals import said

    for heading, scenes in scene_groups(SCENES):
        print(said(heading, spoken()))
        for name, _ in scenes:
            scene = solvers.load(name)
            print(f"  {name:24}{scene.title or name}  [{scene.source}]")
    return 0


def parse_changes(changes: list[str]) -> dict[str, Any]:
    """`KEY=VALUE` words as a dictionary; values are TOML, and a bare word is text."""
    found: dict[str, Any] = {}
    for change in changes:
        key, equals, written = change.partition("=")
        key = key.strip()
        if not equals or not key:
            raise SceneError("--set", change, text("wanted.setting"))
        try:
            value = tomllib.loads(f"value = {written}")["value"] if "\n" not in written else written
        except (ValueError, RecursionError):
            value = written.strip()
        if key in found and found[key] != value:
            raise SceneError(f"--set {key}", value, text("wanted.one-value", before=repr(found[key])))
        found[key] = value
    return found


def _solve(options: argparse.Namespace) -> int:
    from .export import check_name, check_places, write_series

    if turned_round(options):
        return print_sought(_scene(options), options.find, options.such_that, options.json)
    scene, places = _scene(options), check_places(options.at, options.series)
    if options.series is not None:
        check_name(options.series, ".csv", ".nc")
    solution = solvers.solve(scene)
    if options.series is not None:
        try:
            write_series(solution, Path(options.series), places)
        except OSError as error:
            raise SceneError("--series", options.series, text("wanted.writable", why=error.strerror)) from None
    if options.json:
        print(json.dumps(solution.table(), indent=1, allow_nan=False))
    else:
        print(solution)
    return 0


def _compare(options: argparse.Namespace) -> int:
    scene = _scene(options)
    rows = solvers.compare(scene)
    exact = rows.exact
    if options.json:
        called = "exact" if exact.method["name"] == "waves" else "reference"
        found = {called: exact.table(), "methods": [row.table() for row in rows]}
        print(json.dumps(found, indent=1, allow_nan=False))
    else:
        print(rows)
    return 0
