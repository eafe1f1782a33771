"""A solution as a page of plain text: what `print` shows of it, and the command."""

import math
import textwrap
from collections.abc import Mapping
from typing import Any

from .given import SOURCES, books_open, given
from .words import family, listed, named, shown, text, vector

LEAST_REPORTED = 1e-3  # [s] of compiling kernels, or of loading compiled ones
LEAST_GIVEN = 1e-7  # of the energy, that is named: shares have five decimals
PEAK_UNITS = {  # in which the largest values are printed
    "acceleration": (1.0, "m/s2"),
    "displacement": (1e3, "mm"),
    "deflection": (1e3, "mm"),
    "stress": (1e-6, "MPa"),
    "tension": (1e-6, "MPa"),
    "moment": (1.0, "N m"),
    "support_force": (1.0, "N"),
}


def report(solution: Any) -> str:
    """A page of plain text: what happened, with units and accuracy."""
    scene, found, head = solution.scene, solution.diagnostics, family("solve.head")
    if scene.normal is not None:
        return _bodies_report(solution)
    trip = scene.time_unit
    lines = [
        title_of(solution),
        *_told(scene),
        line("solve.mass-ratio", shown(scene.mass_ratio, ".6g")),
        f"  {_unit_name(scene):32}{shown(trip * 1e6, '.6g')} us",
        line("solve.method", method_line(solution.method)),
        "",
        f"  {head['contact']:<8}{head['start']:>13}{head['end']:>14}{head['impulse']:>17}{head['peak-force']:>18}",
    ]
    lines += _periods(solution.contacts, trip)
    for number, joint in enumerate(solution.joints, 1):
        if joint:
            lines += ["  " + text("solve.joint", number=number), *_periods(joint, trip)]
    lines += [
        "",
        f"  {text('solve.in-contact'):21}{_contact_time(solution)}",
        *_leaving(solution),
        *_rotation(solution),
    ]
    if solution.peak_indentation is not None:
        lines.append(f"  {text('solve.indentation'):21}{shown(solution.peak_indentation * 1e6, '.6g')} um")
    lines += _peaks(solution)
    lines += ["", "  " + text("solve.restitution")]
    for key, value in solution.restitution.items():
        known = text("report.not-defined") if value is None else shown(value, ".6f")
        lines.append(f"    {named('restitution', key):30}{known}")
    lines += ["", *_shares(solution)]
    residuals = [_residual(name, found[f"{name}_error"]) for name in ("energy", "momentum")]
    residuals.append(f"{text('solve.error')} {_estimate(found['estimated_error'])}")
    lines += [
        "",
        "  " + "   ".join(residuals),
        "  " + text("solve.steps", steps=found["steps"], time=_time_line(found)),
        *(_note(note) for note in [*solution.notes, *solution.peaks.remarks]),
    ]
    return "\n".join(lines)


def _shares(solution: Any) -> list[str]:
    """Where the energy is at the end, of all that was given; that it does not add up where it does not."""
    energy, found = solution.energy, solution.diagnostics
    if books_open(solution):
        gaps = {name: abs(found[f"{name}_error"]) for name in ("energy", "momentum")}
        return ["  " + text("solve.energy-open", **gaps)]
    gave = given(energy)
    since = {part: gave[part] for part in SOURCES if gave[part] > LEAST_GIVEN * gave["whole"]}
    named_since = [f"{named('energy', part)} {shown(joules, '.4g')} J" for part, joules in since.items()]
    head = text("solve.energy-given", parts=named_since) if since else text("solve.energy")
    shares = {part: joules / gave["whole"] for part, joules in energy.items() if part not in ("initial", *since)}
    return [
        "  " + head,
        *(f"    {named('energy', part):30}{shown(100 * share, '10.5f')}" for part, share in shares.items()),
    ]


def _peaks(solution: Any) -> list[str]:
    """The largest values, where and when; of a beam the deflection wherever it is largest."""
    lines = []
    for name, peak in solution.peaks.items():
        if name == "displacement" and "deflection" in solution.peaks:
            continue
        factor, unit = PEAK_UNITS[name]
        when = text("solve.after", time=peak.time)
        if peak.x is not None:
            when = text("solve.at", place=peak.x, time=peak.time)
        lines.append(f"  {named('peak', name):21}{shown(abs(peak.value) * factor, '.5g')} {unit}   ({when})")
    return lines


def brief(solution: Any) -> str:
    """One line, whatever there is to say."""
    moves, notes = solution.impactor_velocity, len(solution.notes)
    velocity = "-" if moves is None else (vector(moves) if isinstance(moves, tuple) else shown(moves, "+.6g")) + " m/s"
    title = textwrap.shorten(title_of(solution), 60, placeholder=" ...")
    found = {"method": solution.method["name"], "velocity": velocity, "contacts": len(solution.contacts)}
    return text("solve.brief", title=title, peak=solution.peak_force, notes=notes, **found)


def _contact_time(solution: Any) -> str:
    """For how long the bodies are in contact, or that they are not for any time."""
    if solution.contact_time > 0.0:
        trips = solution.contact_time / solution.scene.time_unit
        return text("solve.contact-time", seconds=solution.contact_time, trips=trips)
    return text("solve.sudden", impulses=len(solution.contacts))


def _leaving(solution: Any) -> list[str]:
    """How fast both bodies go at the end."""
    target = f"{shown(solution.target_velocity, '+.8g')} m/s   ({text('solve.centre-of-mass')})"
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
        share = text("solve.centre-of-mass") if solution.scene.impactor.kind == "mechanism" else share
        impactor = f"  {text('solve.impactor-leaves'):21}{shown(solution.impactor_velocity, '+.8g')} m/s"
        impactor += f"   ({share})" if share else ""
    balls = [
        f"    {text('solve.ball', number=number):19}{shown(velocity, '+.8g')} m/s"
        for number, velocity in enumerate(solution.ball_velocities or [], 1)
    ]
    moves = f"  {text('solve.target-moves'):21}{target}"
    return [impactor, moves, *balls, *_swinging(solution), *_jointed(solution)]


def _jointed(solution: Any) -> list[str]:
    """How the links of a mechanism go on, and what its joints give."""
    lines = []
    for name, link in (solution.links or {}).items():
        moves = text("solve.link-moves", velocity=vector(link["final_velocity"]), spin=link["final_spin"])
        lines.append(f"  {text('solve.link', name=name):21}{moves}")
    for number, joint in enumerate(solution.reactions or []):
        gives = text("solve.joint-gives", impulse=vector(joint["impulse"]), moment=joint["moment_impulse"])
        lines.append(f"  {text('solve.joint', number=number):21}{gives}")
    return lines + _changed(solution)


def _changed(solution: Any) -> list[str]:
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
            parts = (shown(value, "14.7g") for value in values[way])
            lines.append(f"    {named('projection', name):26}" + "".join(parts))
    return lines


def _rotation(solution: Any) -> list[str]:
    """Of a rod that turns: its lowest frequencies, what is critical, and the steady stretch."""
    found = solution.scene.target.figures()
    if "critical_speed" not in found:
        return []
    lines = [
        f"  {text('solve.frequencies'):21}{_listed(found['frequencies'])} rad/s",
        f"  {text('solve.critical-speed'):21}{shown(found['critical_speed'], '.8g')} rad/s",
        f"  {text('solve.steady-stretch'):21}{shown(found['steady_stretch'] * 1e6, '.6g')} um",
    ]
    if "simplified" in found:
        lines.append(f"  {text('solve.bending'):21}{_listed(found['bending']['frequencies'])} rad/s")
        lines.append(f"  {text('solve.simplified'):21}{_listed(found['simplified']['frequencies'])} rad/s")
    return lines


def _listed(frequencies: list[float | None]) -> str:
    """The lowest three."""
    return listed([text("solve.unstable") if each is None else shown(each, ".8g") for each in frequencies[:3]])


def _swinging(solution: Any) -> list[str]:
    """How pendulums turn on, what is felt of them at the contact, and what their pivots give."""
    lines = []
    for swing in solution.swings.values():
        felt = text("solve.felt", mass=swing.felt_mass)
        lines += [
            f"  {text('solve.pendulum-turns'):21}{shown(swing.spin, '+.8g')} rad/s   ({felt})",
            f"  {text('solve.pivot-gives'):21}{shown(swing.pivot_impulse, '+.8g')} N s",
        ]
    return lines


def line(code: str, value: str) -> str:
    return f"  {text(code):32}{value}"


def _residual(name: str, value: float) -> str:
    return f"{text(f'residual.{name}')} {shown(value, '+.1e')}"


def _note(note: Any) -> str:
    return "  " + text("report.note", note=note)


def _time_line(diagnostics: dict[str, float]) -> str:
    """Of the solve, and of what came before it once."""
    compiled = diagnostics["compile_time"]
    code = "solve.solved" if compiled < LEAST_REPORTED else "solve.solved-and-compiled"
    return text(code, ms=1e3 * diagnostics["wall_time"], compiled=compiled)


def _unit_name(scene: Any) -> str:
    """What the unit of time T is."""
    rings = next((body for body in (scene.target, scene.impactor) if body.time_unit is not None), None)
    if rings is None:
        return text("solve.unit", of="contact")
    if rings.kind == "mechanism":
        return text("solve.unit", of="links")
    return text("solve.unit", of="beam" if rings.stress_source[0] == "moments" else "wave")


def _bodies_report(solution: Any) -> str:
    """Of bodies in space: vectors, and the checks of the impulse."""
    scene, found, energy = solution.scene, solution.diagnostics, solution.energy
    lines = [
        title_of(solution),
        *_told(scene),
        line("solve.method", method_line(solution.method)),
        line("bodies.normal", vector(scene.normal)),
        line("bodies.approach", f"{shown(scene.speed, '+.8g')} m/s"),
        line("bodies.effective-mass", f"{shown(solution.effective_mass, '.8g')} kg"),
        line("solve.in-contact", _contact_time(solution)),
        *_pushes(solution),
    ]
    for name in ("impactor", "target"):
        body, velocity = getattr(scene, name), getattr(solution, f"{name}_velocity")
        spin = getattr(solution, f"{name}_spin")
        lines.append("")
        if body.kind == "body":
            whens = [text("bodies.when", body=name, when=when) for when in ("before", "after")]
            for when, *moves in zip(whens, (body.velocity, velocity), (body.spin, spin), strict=True):
                said = text("bodies.moves", **dict(zip(("velocity", "spin"), map(vector, moves), strict=True)))
                lines.append(f"  {when:{max(map(len, whens)) + 3}}{said}")
        else:
            lines.append("  " + text("bodies.stop", body=name))
    lines += ["", "  " + text("bodies.energy")]
    lines += [f"    {named('energy', key):30}{shown(value, '14.8g')}" for key, value in energy.items()]
    lines += _models(solution)
    residuals = [_residual(name, found[f"{name}_error"]) for name in ("energy", "momentum", "angular_momentum")]
    lines += ["", "  " + "   ".join(residuals), *(_note(note) for note in solution.notes)]
    return "\n".join(lines)


def _pushes(solution: Any) -> list[str]:
    """The impulse; with friction as a vector, and how the bodies slide."""
    if solution.sliding is None:
        return [line("bodies.impulse", f"{shown(solution.impulse, '.8g')} N s")]
    lines = [
        line("bodies.friction", shown(solution.scene.friction, ".6g")),
        line("bodies.impulse-on-target", f"{vector(solution.impulse)} N s"),
    ]
    for number, each in enumerate(solution.sliding):
        code = "bodies.sliding" if number == 0 else "bodies.then"
        lines.append(line(code, text("bodies.until", kind=each.kind, impulse=each.until)))
    return lines


def _models(solution: Any) -> list[str]:
    """What each model of restitution gives, where bodies rub."""
    if not solution.models or not solution.contacts:
        return []
    lines = ["", "  " + text("bodies.models")]
    for name, found in solution.models.items():
        values = {"parting": found["restitution"]["newton_at_contact"], **found["energy"]}
        lines.append(f"    {name:10}{vector(found['impulse']):34}{text('bodies.model', **values)}")
    return lines


def title_of(solution: Any) -> str:
    return _printable(solution.scene.title) or text("report.scene")


def _told(scene: Any) -> list[str]:
    """What the scene says about itself, as lines."""
    return textwrap.wrap(_printable(scene.note), 100, initial_indent="  ", subsequent_indent="  ")


def _printable(words: str) -> str:
    return "".join(sign if sign.isprintable() else "?" for sign in words)


def _periods(contacts: list[Any], trip: float) -> list[str]:
    return [
        f"  {number:7d}{shown(contact.start / trip, '14.6f')}{shown(contact.end / trip, '14.6f')}"
        + shown(contact.impulse, "17.6g")
        + (
            f"{text('solve.no-duration'):>18}"
            if contact.peak_force is None
            else shown(contact.peak_force / 1e3, "18.6g")
        )
        for number, contact in enumerate(contacts, 1)
    ]


def _estimate(error: float | None) -> str:
    return text("report.unknown") if error is None else text("solve.of-impact-speed", error=error)


def method_line(method: Mapping[str, Any]) -> str:
    """A method with its options."""
    options = {key: value for key, value in method.items() if key != "name" and value is not None}
    said = {key: shown(value, "g") if type(value) in (int, float) else value for key, value in options.items()}
    return method["name"] + "".join(f", {key} {value}" for key, value in said.items())
