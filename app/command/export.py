"""Results as text: a report to read, a table of histories to plot elsewhere."""

import io
import os
import textwrap
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from solvers import ContactPeriod, Row, Scene, SceneError, Solution
from solvers.accuracy.reference import rebound

SERIES_POINTS = 2_000
FIELD_INSTANTS, FIELD_PLACES = 401, 201
LEAST_REPORTED = 1e-3  # [s] of compiling kernels, or of loading compiled ones


def report(solution: Solution) -> str:
    """A page of plain text: what happened, with units and accuracy."""
    scene, found = solution.scene, solution.diagnostics
    if scene.normal is not None:
        return _bodies_report(solution)
    trip = scene.time_unit
    lines = [
        _title(solution),
        *_told(scene),
        f"  mass ratio (target / impactor)  {scene.mass_ratio:.6g}",
        f"  {_unit_name(scene):32}{trip * 1e6:.6g} us",
        f"  method                          {_method_line(solution)}",
        "",
        "  contact     start / T       end / T    impulse [N s]   peak force [kN]",
    ]
    lines += _periods(solution.contacts, trip)
    for number, joint in enumerate(solution.joints, 1):
        if joint:
            lines += [f"  joint {number}", *_periods(joint, trip)]
    lines += [
        "",
        "  a prescribed force: nothing strikes, nothing leaves"
        if solution.impactor_velocity is None
        else f"  impactor leaves at   {solution.impactor_velocity:+.8g} m/s"
        f"   ({solution.impactor_velocity / scene.impactor.velocity:+.6f} of its speed)",
        f"  target moves on at   {solution.target_velocity:+.8g} m/s   (centre of mass)",
    ]
    if solution.peak_indentation is not None:
        lines.append(f"  deepest indentation  {solution.peak_indentation * 1e6:.6g} um")
    names = {
        "newton": "by centre-of-mass velocities",
        "poisson": "by impulses",
        "newton_at_contact": "by the touching surfaces",
    }
    lines += ["", "  restitution"]
    for key, value in solution.restitution.items():
        lines.append(f"    {names[key]:30}{'not defined' if value is None else f'{value:.6f}'}")
    lines += ["", "  energy at the end [% of the impactor's before]"]
    initial = solution.energy["initial"]
    for key, value in solution.energy.items():
        if key != "initial":
            lines.append(f"    {key.replace('_', ' '):30}{100 * value / initial:10.5f}")
    lines += [
        "",
        f"  energy residual {found['energy_error']:+.1e}   momentum residual {found['momentum_error']:+.1e}"
        f"   estimated error of the velocity {_estimate(found['estimated_error'])}",
        f"  {found['steps']} steps, {_time_line(found)}",
        *(f"  Note: {note}" for note in solution.notes),
    ]
    return "\n".join(lines)


def _time_line(diagnostics: dict[str, float]) -> str:
    """Of the solve, and of what came before it once."""
    solved, compiled = f"solved in {diagnostics['wall_time'] * 1e3:.3g} ms", diagnostics["compile_time"]
    return (
        solved if compiled < LEAST_REPORTED else f"{solved}, besides {compiled:.3g} s of compiling and loading kernels"
    )


def _unit_name(scene: Scene) -> str:
    """What the unit of time T is."""
    rings = next((body.kind for body in (scene.target, scene.impactor) if body.time_unit is not None), None)
    names = {None: "about a contact time, T", "beam": "slowest period of the beam, T"}
    return names.get(rings, "round trip of a wave, T")


def comparison(exact: Solution, rows: list[Row]) -> str:
    """A table of plain text: every method against the exact solution, or the one taken for it."""
    scene = exact.scene
    moving = "impactor leaves at" if exact.impactor_velocity is not None else "target moves on at"
    periods = ", ".join(f"{c.start / scene.time_unit:.4f} to {c.end / scene.time_unit:.4f}" for c in exact.contacts)
    lines = [
        _title(exact),
        f"  mass ratio (target / impactor)  {scene.mass_ratio:.6g}",
        f"  measured by                     {_method_line(exact)}",
        f"  its contacts [T]                {textwrap.shorten(periods, 200, placeholder=' ...')}",
        f"  its {moving:28}{rebound(exact):+.8g} m/s{_uncertainty(exact)}",
        "",
        f"  {'method':38}{'rebound':>10}{'1st contact':>13}{'true':>7}{'listed':>8}{'raw':>6}"
        f"{'force L2':>10}{'resolved':>10}{'time':>9}",
        f"  {'':38}{'error [%]':>10}{'error [T]':>13}{'found':>7}{'':14}{'[%]':>10}{'[%]':>10}{'[ms]':>9}",
    ]
    for row in rows:
        if row.reason is not None:
            lines.append(f"  {row.label:38}cannot: {row.reason}")
            continue
        shares = [
            "-" if share is None else f"{100 * share:.1f}" for share in (row.force_error, row.resolved_force_error)
        ]
        lines.append(
            f"  {row.label:38}{100 * row.rebound_error:+10.4f}{row.duration_error:+13.5f}"
            f"{f'{row.true_contacts_found}/{row.true_contacts}':>7}{row.contacts:8d}{row.raw_contacts:6d}"
            f"{shares[0]:>10}{shares[1]:>10}{row.wall_time * 1e3:9.3f}"
        )
    return "\n".join(lines)


def _uncertainty(reference: Solution) -> str:
    error = reference.diagnostics["estimated_error"]
    return "" if reference.method["name"] == "waves" or error is None else f"   (to {error:.1e} of the impact speed)"


def _bodies_report(solution: Solution) -> str:
    """Of bodies in space: vectors, and the checks of the impulse."""
    scene, found, energy = solution.scene, solution.diagnostics, solution.energy
    lines = [
        _title(solution),
        *_told(scene),
        f"  method                          {_method_line(solution)}",
        f"  normal, impactor to target      {_vector(scene.normal)}",
        f"  approach of the touching points {scene.speed:+.8g} m/s",
        f"  effective mass                  {solution.effective_mass:.8g} kg",
        f"  impulse                         {solution.impulse:.8g} N s",
    ]
    for name in ("impactor", "target"):
        body, velocity = getattr(scene, name), getattr(solution, f"{name}_velocity")
        spin = getattr(solution, f"{name}_spin")
        lines.append("")
        if body.kind == "body":
            lines += [
                f"  {name} before   velocity {_vector(body.velocity)} m/s   spin {_vector(body.spin)} rad/s",
                f"  {name} after    velocity {_vector(velocity)} m/s   spin {_vector(spin)} rad/s",
            ]
        else:
            lines.append(f"  {name}: a stop, which does not move")
    lines += ["", "  energy at the end [J]"]
    lines += [f"    {key.replace('_', ' '):30}{value:14.8g}" for key, value in energy.items()]
    lines += [
        "",
        f"  energy residual {found['energy_error']:+.1e}   momentum residual {found['momentum_error']:+.1e}"
        f"   angular momentum residual {found['angular_momentum_error']:+.1e}",
        *(f"  Note: {note}" for note in solution.notes),
    ]
    return "\n".join(lines)


def _vector(values: tuple[float, float, float]) -> str:
    return "(" + ", ".join(f"{value + 0.0:.6g}" for value in values) + ")"


def _title(solution: Solution) -> str:
    return _printable(solution.scene.title) or "Scene"


def _told(scene: Scene) -> list[str]:
    """What the scene says about itself, as lines."""
    return textwrap.wrap(_printable(scene.note), 100, initial_indent="  ", subsequent_indent="  ")


def _printable(text: str) -> str:
    return "".join(sign if sign.isprintable() else "?" for sign in text)


def _periods(contacts: list[ContactPeriod], trip: float) -> list[str]:
    return [
        f"  {number:7d}{contact.start / trip:14.6f}{contact.end / trip:14.6f}{contact.impulse:17.6g}"
        + ("       no duration" if contact.peak_force is None else f"{contact.peak_force / 1e3:18.6g}")
        for number, contact in enumerate(contacts, 1)
    ]


def _estimate(error: float | None) -> str:
    return "unknown" if error is None else f"{error:.1e} of the impact speed"


def _method_line(solution: Solution) -> str:
    options = {key: value for key, value in solution.method.items() if key != "name" and value is not None}
    shown = {key: f"{value:g}" if type(value) in (int, float) else value for key, value in options.items()}
    return solution.method["name"] + "".join(f", {key} {value}" for key, value in shown.items())


def _histories(solution: Solution) -> dict[str, tuple[str, np.ndarray]]:
    """Name: unit and values; at a jump of the force the time stands twice."""
    motion = solution.motion
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
        raise SceneError("--series", name, f"the name of a file that ends in {' or '.join(endings)}")
    if name.endswith(".nc") and find_spec("xarray") is None:
        allowed = "a name that ends in .csv, as NetCDF needs xarray: pip install 'strikewave[notebook]'"
        raise SceneError("--series", name, allowed)


def write_series(solution: Solution, path: Path) -> None:
    """Histories as comma-separated values, or histories and fields as NetCDF, by the ending of the name.

    Raises OSError if the file cannot be written, SceneError if the solution has no histories.
    """
    if solution.motion is None:
        allowed = "nothing here: one impulse between bodies in space has no history; --json has all there is"
        raise SceneError("--series", str(path), allowed)
    histories = _histories(solution)
    if path.suffix == ".csv":
        text = io.StringIO()
        text.write(",".join(f"{name}_{unit}" for name, (unit, _) in histories.items()) + "\n")
        np.savetxt(text, np.column_stack([values for _, values in histories.values()]), delimiter=",", fmt="%.12g")
        path.write_text(text.getvalue(), encoding="utf-8")
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
