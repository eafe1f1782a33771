"""Results as text: a report to read, a table of histories to plot elsewhere."""

import io
import math
import os
import textwrap
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from solvers import ContactPeriod, Row, Scene, SceneError, Solution
from solvers.accuracy.reference import rebound
from solvers.bodies import Mechanism
from solvers.text.notes import Note

from .words import family, named, text

SERIES_POINTS = 2_000
FIELD_INSTANTS, FIELD_PLACES = 401, 201
LEAST_REPORTED = 1e-3  # [s] of compiling kernels, or of loading compiled ones


def report(solution: Solution) -> str:
    """A page of plain text: what happened, with units and accuracy."""
    scene, found, head = solution.scene, solution.diagnostics, family("solve.head")
    if scene.normal is not None:
        return _bodies_report(solution)
    trip = scene.time_unit
    lines = [
        _title(solution),
        *_told(scene),
        _line("solve.mass-ratio", f"{scene.mass_ratio:.6g}"),
        f"  {_unit_name(scene):32}{trip * 1e6:.6g} us",
        _line("solve.method", _method_line(solution)),
        "",
        f"  {head['contact']:<7}{head['start']:>14}{head['end']:>14}{head['impulse']:>17}{head['peak-force']:>18}",
    ]
    lines += _periods(solution.contacts, trip)
    for number, joint in enumerate(solution.joints, 1):
        if joint:
            lines += ["  " + text("solve.joint", number=number), *_periods(joint, trip)]
    lines += [
        "",
        *_leaving(solution),
        *_rotation(solution),
    ]
    if solution.peak_indentation is not None:
        lines.append(f"  {text('solve.indentation'):21}{solution.peak_indentation * 1e6:.6g} um")
    lines += ["", "  " + text("solve.restitution")]
    for key, value in solution.restitution.items():
        shown = text("report.not-defined") if value is None else f"{value:.6f}"
        lines.append(f"    {named('restitution', key):30}{shown}")
    lines += ["", "  " + text("solve.energy")]
    initial = solution.energy["initial"]
    for key, value in solution.energy.items():
        if key != "initial":
            lines.append(f"    {named('energy', key):30}{100 * value / initial:10.5f}")
    residuals = [_residual(name, found[f"{name}_error"]) for name in ("energy", "momentum")]
    residuals.append(f"{text('solve.error')} {_estimate(found['estimated_error'])}")
    lines += [
        "",
        "  " + "   ".join(residuals),
        "  " + text("solve.steps", steps=found["steps"], time=_time_line(found)),
        *(_note(note) for note in solution.notes),
    ]
    return "\n".join(lines)


def _leaving(solution: Solution) -> list[str]:
    """How fast both bodies go at the end."""
    target = f"{solution.target_velocity:+.8g} m/s   ({text('solve.centre-of-mass')})"
    if solution.impactor_velocity is None:
        impactor = "  " + text("solve.prescribed")
    else:
        before = solution.scene.impactor.velocity
        if not before:
            share = ""
        elif math.isclose(abs(before), solution.scene.speed):
            share = text("solve.of-its-speed", share=solution.impactor_velocity / before)
        else:  # what it meets moves, too, and may be what makes it fast
            share = text("solve.came-at", velocity=before)
        share = text("solve.centre-of-mass") if isinstance(solution.scene.impactor, Mechanism) else share
        impactor = f"  {text('solve.impactor-leaves'):21}{solution.impactor_velocity:+.8g} m/s"
        impactor += f"   ({share})" if share else ""
    balls = [
        f"    {text('solve.ball', number=number):19}{velocity:+.8g} m/s"
        for number, velocity in enumerate(solution.ball_velocities or [], 1)
    ]
    moves = f"  {text('solve.target-moves'):21}{target}"
    return [impactor, moves, *balls, *_swinging(solution), *_jointed(solution)]


def _jointed(solution: Solution) -> list[str]:
    """How the links of a mechanism go on, and what its joints give."""
    lines = []
    for name, link in (solution.links or {}).items():
        moves = text("solve.link-moves", velocity=_vector(link["final_velocity"]), spin=link["final_spin"])
        lines.append(f"  {text('solve.link', name=name):21}{moves}")
    for number, joint in enumerate(solution.reactions or []):
        gives = text("solve.joint-gives", impulse=_vector(joint["impulse"]), moment=joint["moment_impulse"])
        lines.append(f"  {text('solve.joint', number=number):21}{gives}")
    return lines + _changed(solution)


def _changed(solution: Solution) -> list[str]:
    """Velocities of the nodes across a link, and coordinates along it, by every projection from one set of modes to
    another."""
    tables = [
        (text("solve.mode-change"), solution.mode_change, "across"),
        (text("solve.mode-change-coordinates"), solution.mode_change_coordinates, "along"),
    ]
    lines = []
    for title, change, way in tables:
        if change is None:
            continue
        lines += ["", "  " + title]
        for name, values in change.items():
            lines.append(f"    {named('projection', name):26}" + "".join(f"{value:14.7g}" for value in values[way]))
    return lines


def _rotation(solution: Solution) -> list[str]:
    """Of a rod that turns: its lowest frequencies, what is critical, and the steady stretch."""
    found = solution.scene.target.figures()
    if "critical_speed" not in found:
        return []
    lines = [
        f"  {text('solve.frequencies'):21}{_listed(found['frequencies'])} rad/s",
        f"  {text('solve.critical-speed'):21}{found['critical_speed']:.8g} rad/s",
        f"  {text('solve.steady-stretch'):21}{found['steady_stretch'] * 1e6:.6g} um",
    ]
    if "simplified" in found:
        lines.append(f"  {text('solve.bending'):21}{_listed(found['bending']['frequencies'])} rad/s")
        lines.append(f"  {text('solve.simplified'):21}{_listed(found['simplified']['frequencies'])} rad/s")
    return lines


def _listed(frequencies: list[float | None]) -> str:
    """The lowest three."""
    return ", ".join(text("solve.unstable") if each is None else f"{each:.8g}" for each in frequencies[:3])


def _swinging(solution: Solution) -> list[str]:
    """How pendulums turn on, what is felt of them at the contact, and what their pivots give."""
    lines = []
    for swing in solution.swings.values():
        felt = text("solve.felt", mass=swing.felt_mass)
        lines += [
            f"  {text('solve.pendulum-turns'):21}{swing.spin:+.8g} rad/s   ({felt})",
            f"  {text('solve.pivot-gives'):21}{swing.pivot_impulse:+.8g} N s",
        ]
    return lines


def _line(code: str, value: str) -> str:
    return f"  {text(code):32}{value}"


def _residual(name: str, value: float) -> str:
    return f"{text(f'residual.{name}')} {value:+.1e}"


def _note(note: Note) -> str:
    return "  " + text("report.note", note=note)


def _time_line(diagnostics: dict[str, float]) -> str:
    """Of the solve, and of what came before it once."""
    compiled = diagnostics["compile_time"]
    code = "solve.solved" if compiled < LEAST_REPORTED else "solve.solved-and-compiled"
    return text(code, ms=1e3 * diagnostics["wall_time"], compiled=compiled)


def _unit_name(scene: Scene) -> str:
    """What the unit of time T is."""
    rings = next((body for body in (scene.target, scene.impactor) if body.time_unit is not None), None)
    if rings is None:
        return text("solve.unit", of="contact")
    if rings.kind == "mechanism":
        return text("solve.unit", of="links")
    return text("solve.unit", of="beam" if rings.stress_source[0] == "moments" else "wave")


def comparison(exact: Solution, rows: list[Row]) -> str:
    """A table of plain text: every method against the exact solution, or the one taken for it."""
    scene = exact.scene
    moving = text("solve.target-moves" if exact.impactor_velocity is None else "solve.impactor-leaves")
    spans = [(each.start / scene.time_unit, each.end / scene.time_unit) for each in exact.contacts]
    periods = ", ".join(text("compare.period", start=start, end=end) for start, end in spans)
    head, units = family("compare.head"), family("compare.unit")
    lines = [
        _title(exact),
        _line("solve.mass-ratio", f"{scene.mass_ratio:.6g}"),
        _line("compare.reference", _method_line(exact)),
        _line("compare.contacts", textwrap.shorten(periods, 200, placeholder=" ...")),
        f"  {text('compare.moving', moving=moving):32}{rebound(exact):+.8g} m/s{_uncertainty(exact)}",
        "",
        f"  {head['method']:38}{head['rebound']:>10}{head['first']:>13}{head['true']:>7}{head['listed']:>8}"
        f"{head['raw']:>6}{head['force']:>10}{head['resolved']:>10}{head['time']:>9}",
        f"  {'':38}{units['rebound']:>10}{units['first']:>13}{units['true']:>7}{'':14}"
        f"{'[%]':>10}{'[%]':>10}{'[ms]':>9}",
    ]
    for row in rows:
        if row.reason is not None:
            lines.append(f"  {row.label:38}{text('stability.cannot', reason=row.reason)}")
            continue
        shares = [
            "-" if share is None else f"{100 * share:.1f}" for share in (row.force_error, row.resolved_force_error)
        ]
        lines.append(
            f"  {row.label:38}{100 * row.rebound_error:+10.4f}{row.duration_error:+13.5f}"
            f"{f'{row.true_contacts_found}/{row.true_contacts}':>7}{row.contacts:8d}{row.raw_contacts:6d}"
            f"{shares[0]:>10}{shares[1]:>10}{1e3 * (row.wall_time or 0.0):9.3f}"
        )
    return "\n".join(lines)


def _uncertainty(reference: Solution) -> str:
    error = reference.diagnostics["estimated_error"]
    return "" if reference.method["name"] == "waves" or error is None else "   " + text("compare.within", error=error)


def _bodies_report(solution: Solution) -> str:
    """Of bodies in space: vectors, and the checks of the impulse."""
    scene, found, energy = solution.scene, solution.diagnostics, solution.energy
    lines = [
        _title(solution),
        *_told(scene),
        _line("solve.method", _method_line(solution)),
        _line("bodies.normal", _vector(scene.normal)),
        _line("bodies.approach", f"{scene.speed:+.8g} m/s"),
        _line("bodies.effective-mass", f"{solution.effective_mass:.8g} kg"),
        *_pushes(solution),
    ]
    for name in ("impactor", "target"):
        body, velocity = getattr(scene, name), getattr(solution, f"{name}_velocity")
        spin = getattr(solution, f"{name}_spin")
        lines.append("")
        if body.kind == "body":
            whens = [text("bodies.when", body=name, when=when) for when in ("before", "after")]
            for when, *moves in zip(whens, (body.velocity, velocity), (body.spin, spin), strict=True):
                shown = dict(zip(("velocity", "spin"), map(_vector, moves), strict=True))
                lines.append(f"  {when:{max(map(len, whens)) + 3}}{text('bodies.moves', **shown)}")
        else:
            lines.append("  " + text("bodies.stop", body=name))
    lines += ["", "  " + text("bodies.energy")]
    lines += [f"    {named('energy', key):30}{value:14.8g}" for key, value in energy.items()]
    lines += _models(solution)
    residuals = [_residual(name, found[f"{name}_error"]) for name in ("energy", "momentum", "angular_momentum")]
    lines += ["", "  " + "   ".join(residuals), *(_note(note) for note in solution.notes)]
    return "\n".join(lines)


def _pushes(solution: Solution) -> list[str]:
    """The impulse; with friction as a vector, and how the bodies slide."""
    if solution.sliding is None:
        return [_line("bodies.impulse", f"{solution.impulse:.8g} N s")]
    lines = [
        _line("bodies.friction", f"{solution.scene.friction:.6g}"),
        _line("bodies.impulse-on-target", f"{_vector(solution.impulse)} N s"),
    ]
    for number, each in enumerate(solution.sliding):
        code = "bodies.sliding" if number == 0 else "bodies.then"
        lines.append(_line(code, text("bodies.until", kind=each.kind, impulse=each.until)))
    return lines


def _models(solution: Solution) -> list[str]:
    """What each model of restitution gives, where bodies rub."""
    if not solution.models or not solution.contacts:
        return []
    lines = ["", "  " + text("bodies.models")]
    for name, found in solution.models.items():
        values = {"parting": found["restitution"]["newton_at_contact"], **found["energy"]}
        lines.append(f"    {name:10}{_vector(found['impulse']):34}{text('bodies.model', **values)}")
    return lines


def _vector(values: Sequence[float]) -> str:
    return "(" + ", ".join(f"{value + 0.0:.6g}" for value in values) + ")"


def _title(solution: Solution) -> str:
    return _printable(solution.scene.title) or text("report.scene")


def _told(scene: Scene) -> list[str]:
    """What the scene says about itself, as lines."""
    return textwrap.wrap(_printable(scene.note), 100, initial_indent="  ", subsequent_indent="  ")


def _printable(words: str) -> str:
    return "".join(sign if sign.isprintable() else "?" for sign in words)


def _periods(contacts: list[ContactPeriod], trip: float) -> list[str]:
    return [
        f"  {number:7d}{contact.start / trip:14.6f}{contact.end / trip:14.6f}{contact.impulse:17.6g}"
        + (f"{text('solve.no-duration'):>18}" if contact.peak_force is None else f"{contact.peak_force / 1e3:18.6g}")
        for number, contact in enumerate(contacts, 1)
    ]


def _estimate(error: float | None) -> str:
    return text("report.unknown") if error is None else text("solve.of-impact-speed", error=error)


def _method_line(solution: Solution) -> str:
    options = {key: value for key, value in solution.method.items() if key != "name" and value is not None}
    shown = {key: f"{value:g}" if type(value) in (int, float) else value for key, value in options.items()}
    return solution.method["name"] + "".join(f", {key} {value}" for key, value in shown.items())


def _histories(solution: Solution) -> dict[str, tuple[str, np.ndarray]]:
    """Name: unit and values; at a jump of the force the time stands twice."""
    motion = solution.known_motion
    time, force = motion.force_history()
    kept = time <= solution.duration
    time, force = time[kept], force[kept]
    if time.size > 10 * SERIES_POINTS:
        time = np.linspace(0.0, solution.duration, SERIES_POINTS)
        force = motion.force(time)
    doubled = np.append(time[1:] == time[:-1], False)

    def jumping(velocity):
        return np.where(doubled, velocity(time, after=False), velocity(time))

    return {
        "time": ("s", time),
        "contact_force": ("N", force),
        "impactor_position": ("m", motion.impactor_position(time)),
        "impactor_velocity": ("m_per_s", jumping(motion.impactor_velocity)),
        "struck_end_position": ("m", motion.end_position(time)),
        "target_mean_velocity": ("m_per_s", jumping(motion.rigid_velocity)),
    }


def check_name(name: str, *endings: str) -> None:
    """Raises SceneError for what can be no file of histories, before anything is solved."""
    if not name.endswith(endings) or (os.path.exists(name) and not os.path.isfile(name)):
        raise SceneError("--series", name, text("wanted.ending", endings=text("wanted.or").join(endings)))
    if name.endswith(".nc") and find_spec("xarray") is None:
        raise SceneError("--series", name, text("wanted.no-xarray"))


def write_series(solution: Solution, path: Path) -> None:
    """Histories as comma-separated values, or histories and fields as NetCDF, by the ending of the name.

    Raises OSError if the file cannot be written, SceneError if the solution has no histories.
    """
    if solution.motion is None:
        raise SceneError("--series", str(path), text("wanted.no-history"))
    histories = _histories(solution)
    if path.suffix == ".csv":
        rows = io.StringIO()
        rows.write(",".join(f"{name}_{unit}" for name, (unit, _) in histories.items()) + "\n")
        np.savetxt(rows, np.column_stack([values for _, values in histories.values()]), delimiter=",", fmt="%.12g")
        path.write_text(rows.getvalue(), encoding="utf-8")
        return
    _write_netcdf(solution, histories, path)


def _write_netcdf(solution: Solution, histories: dict[str, tuple[str, np.ndarray]], path: Path) -> None:
    """Histories over their own `time`, in which every jump is kept; fields over `instant` and x in the target."""
    instants = np.linspace(0.0, solution.duration, FIELD_INSTANTS)
    data = solution.dataset(instants, np.linspace(0.0, solution.scene.target.length, FIELD_PLACES))
    fields = data[[name for name, values in data.items() if values.dims == ("time", "x")]]
    file = fields.rename(time="instant").assign(
        {name: ("time", values, {"units": unit.replace("_per_", "/")}) for name, (unit, values) in histories.items()}
    )
    encoding = {name: {"_FillValue": None} for name in file.variables}  # no value is missing
    file.to_netcdf(path, format="NETCDF3_CLASSIC", engine="scipy", encoding=encoding)
