"""Stress, strain and strain rate of a specimen between two bars, from the strains that a gauge on each has measured.

With strains positive in loading, moved to the faces of the specimen, and i, r, t for incident, reflected and
transmitted:

    v1 = c1 (e_i - e_r),   v2 = c2 e_t,   F1 = E1 A1 (e_i + e_r),   F2 = E2 A2 e_t
    strain rate = (v1 - v2) / L,   stress = F2 / A (one wave), F1 / A (two), (F1 + F2) / 2 A (three)

Source: Kolsky, Proc. Phys. Soc. B 62 (1949) 676; Gray, ASM Handbook 8 (2000) 462.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from ...records import Record, load_record
from ...records.refused import RecordError
from ...text.notes import Note, Severity, coded
from ...validation import SceneError, whole_number
from .bars import Bars, load_bars
from .dispersion import carried, check_content
from .windows import Windows, find_windows

TOLERATED = 0.05  # of equilibrium, momentum, striker and noise: beyond it a note
KINDS = ("strain", "stress", "force")


@dataclass(frozen=True)
class Hopkinson:
    """What a test has measured; arrays are over `time`, (n,). Strain and stress are engineering ones, positive as the
    test loads, in compression or in tension."""

    bars: Bars
    windows: Windows
    waves: int  # 1, 2 or 3: by how many waves `stress` is found
    time: np.ndarray  # [s] from the beginning of the windows
    incident: np.ndarray  # strain of the bar at the specimen's face
    reflected: np.ndarray  # the same
    transmitted: np.ndarray  # the same, at the other face
    notes: tuple[Note, ...] = field(default=())

    @cached_property
    def front_velocity(self) -> np.ndarray:
        """Of the face at the incident bar [m/s]."""
        return self.bars.incident.wave_speed * (self.incident - self.reflected)

    @cached_property
    def back_velocity(self) -> np.ndarray:
        """Of the face at the transmitted bar [m/s]."""
        return self.bars.transmitted.wave_speed * self.transmitted

    @cached_property
    def strain_rate_history(self) -> np.ndarray:
        """[1/s]"""
        return (self.front_velocity - self.back_velocity) / self.bars.specimen.length

    @cached_property
    def strain(self) -> np.ndarray:
        """Shortening, or lengthening, over the length."""
        rate = self.strain_rate_history
        return np.append(0.0, np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(self.time)))

    @cached_property
    def stress_one_wave(self) -> np.ndarray:
        """At the transmitted bar [Pa]."""
        bar = self.bars.transmitted
        return bar.young * bar.area / self.bars.specimen.area * self.transmitted

    @cached_property
    def stress_two_waves(self) -> np.ndarray:
        """At the incident bar [Pa]."""
        bar = self.bars.incident
        return bar.young * bar.area / self.bars.specimen.area * (self.incident + self.reflected)

    @cached_property
    def stress_three_waves(self) -> np.ndarray:
        """Mean of both faces [Pa]."""
        return 0.5 * (self.stress_one_wave + self.stress_two_waves)

    @property
    def stress(self) -> np.ndarray:
        """By as many waves as `waves` says [Pa]."""
        return (self.stress_one_wave, self.stress_two_waves, self.stress_three_waves)[self.waves - 1]

    @property
    def _sign(self) -> float:
        return 1.0 if self.windows.tension else -1.0

    @property
    def true_strain(self) -> np.ndarray:
        """Logarithmic."""
        return self._sign * np.log1p(self._sign * self.strain)

    @property
    def true_stress(self) -> np.ndarray:
        """Of a specimen that keeps its volume [Pa]."""
        return self.stress * (1.0 + self._sign * self.strain)

    @cached_property
    def plateau(self) -> np.ndarray:
        """Indices of the instants at which the incident pulse is above half of its largest.

        Without their first quarter, in which the specimen comes into equilibrium.
        """
        above = np.flatnonzero(self.incident > 0.5 * self.incident.max())
        return above[above.size // 4 :]

    @property
    def strain_rate(self) -> float:
        """Mean over the plateau [1/s]."""
        return float(self.strain_rate_history[self.plateau].mean())

    @property
    def peak_stress(self) -> float:
        """[Pa]"""
        return float(self.stress.max())

    @property
    def equilibrium(self) -> float:
        """How far stresses at both faces are apart: mean of |two - one| over mean of three waves, over the plateau."""
        apart = np.abs(self.stress_two_waves - self.stress_one_wave)[self.plateau].mean()
        return float(apart / max(abs(float(self.stress_three_waves[self.plateau].mean())), 1e-300))

    @property
    def momentum(self) -> float:
        """By how much more momentum has gone into the specimen than out of it, as a share of the latter."""
        given, taken = (float(np.trapezoid(each, self.time)) for each in (self.stress_two_waves, self.stress_one_wave))
        return (given - taken) / taken if taken else math.inf

    def uncertainty(self) -> dict[str, float]:
        """What noise and bits of the gauges make of the results, one standard deviation: of a sample of stress [Pa] by
        one, two and three waves and of strain rate [1/s], and of the strain at the end."""
        one, two, specimen = self.bars.incident, self.bars.transmitted, self.bars.specimen
        first, second = self.windows.incident, self.windows.transmitted
        front = one.young * one.area / specimen.area * first.noise * math.sqrt(2.0 + 4.0 / first.quiet)
        back = two.young * two.area / specimen.area * second.noise * math.sqrt(1.0 + 1.0 / second.quiet)
        velocity = math.hypot(math.sqrt(2.0) * one.wave_speed * first.noise, two.wave_speed * second.noise)
        rate = velocity / specimen.length
        length = self.windows.length
        drift = two.wave_speed * second.noise / math.sqrt(second.quiet) / specimen.length * length
        return {
            "stress_one_wave": back,
            "stress_two_waves": front,
            "stress_three_waves": 0.5 * math.hypot(front, back),
            "strain_rate": rate,
            "strain": math.hypot(rate * math.sqrt(length * first.step), drift),
        }

    def striker(self) -> dict[str, float | None] | None:
        """The pulse that the striker should have sent, beside that of the record; None without a striker."""
        striker = self.bars.striker
        if striker is None:
            return None
        return {
            "expected_strain": striker.strain(self.bars.incident),
            "strain": self.windows.height,
            "expected_duration": striker.pulse,
            "duration": self.windows.duration,
        }

    def series(self) -> dict[str, np.ndarray]:
        """All histories, with their units in their names."""
        return {
            "time_s": self.time,
            "strain": self.strain,
            "stress_Pa": self.stress,
            "stress_one_wave_Pa": self.stress_one_wave,
            "stress_two_waves_Pa": self.stress_two_waves,
            "stress_three_waves_Pa": self.stress_three_waves,
            "strain_rate_per_s": self.strain_rate_history,
            "true_strain": self.true_strain,
            "true_stress_Pa": self.true_stress,
            "front_velocity_m_per_s": self.front_velocity,
            "back_velocity_m_per_s": self.back_velocity,
        }

    def table(self) -> dict[str, Any]:
        """For JSON."""
        names = ("time", "strain", "stress", "stress_one_wave", "stress_two_waves", "stress_three_waves")
        curves = {name: getattr(self, name).tolist() for name in names}
        curves |= {"strain_rate": self.strain_rate_history.tolist()}
        curves |= {name: getattr(self, name).tolist() for name in ("true_strain", "true_stress")}
        starts = self.windows.starts(self.bars)
        gauges = {"incident": self.windows.incident, "transmitted": self.windows.transmitted}
        return {
            "strain_rate": self.strain_rate,
            "peak_stress": self.peak_stress,
            "equilibrium": self.equilibrium,
            "momentum": self.momentum,
            "loading": "tension" if self.windows.tension else "compression",
            "waves": self.waves,
            "dispersion": self.bars.dispersion,
            "windows": {"length": self.windows.length}
            | dict(zip(("incident", "reflected", "transmitted"), starts, strict=True)),
            "gauges": {name: {"noise": gauge.noise, "offset": gauge.offset} for name, gauge in gauges.items()},
            "striker": self.striker(),
            "uncertainty": self.uncertainty(),
            "stress_strain": curves,
            **coded(list(self.notes)),
        }


def hopkinson(
    record: str | Path | tuple[Record, Record],
    bars: str | Path | Mapping[str, Any] | Bars,
    *,
    start: float | None = None,
    window: float | None = None,
    waves: int = 1,
    **how: Any,
) -> Hopkinson:
    """A test of a split Hopkinson bar, from the records of both gauges.

    `record`: a file with time and two columns of strain, stress or force of the bars, incident gauge first, or two
    records; `how` it is read, see `records.read_record`. `bars`: a TOML file or a table, see `read_bars`. `start`, when
    the incident pulse begins in the record [s], and `window`, for how long to evaluate [s], are found if not given.
    `waves`: 1, 2 or 3, by which `Hopkinson.stress` is found.
    Assumes: elastic bars, a specimen of negligible mass, one pulse at a time at each gauge.
    Error: second order in the step of the record; a jump is blurred over one step.
    Source: Kolsky (1949); Gray (2000); dispersion: Follansbee and Frantz, J. Eng. Mater. Technol. 105 (1983) 61.
    Raises SceneError naming key, row or column, and where pulses overlap at a gauge.
    """
    apparatus = load_bars(bars)
    waves = whole_number("waves", waves, 1, 3)
    records = record if isinstance(record, tuple) else load_gauges(record, **how)
    windows = find_windows(records, apparatus, start, window)
    time, strains = _at_faces(windows, apparatus)
    incident, reflected, transmitted = strains
    found = Hopkinson(apparatus, windows, waves, time, incident, reflected, transmitted)
    shortest = float((found._sign * found.strain).min())
    if shortest <= -1.0:
        raise RecordError("hopkinson-gone", shortest, strain=-shortest)
    return replace(found, notes=(*windows.notes, *_notes(found)))


def load_gauges(path: str | Path, kind: str | None = None, **how: Any) -> tuple[Record, Record]:
    """The records of two gauges in a file: of strain, or else of stress or force. Raises SceneError."""
    kinds = KINDS if kind is None else (kind,)
    for each in kinds:
        try:
            first = load_record(path, kind=each, gauge=1, **how)
            return first, load_record(path, kind=each, gauge=2, **how)
        except RecordError as error:
            if error.note.code != "record.refused.no-value" or each == kinds[-1]:
                raise
        except SceneError as error:
            raise (RecordError("hopkinson-columns", 1, kind=each) if error.key == "gauge" else error) from None
    raise AssertionError("a kind has been tried")


def _at_faces(windows: Windows, bars: Bars) -> tuple[np.ndarray, list[np.ndarray]]:
    """Instants from the beginning of the windows, and the strains of the three pulses at its faces."""
    step = windows.incident.step
    time = step * np.arange(1 + int(windows.length / step * (1.0 + 1e-9)))
    starts = windows.starts(bars)
    gauges = (windows.incident, windows.incident, windows.transmitted)
    if bars.dispersion == "none":
        return time, [gauge.at(start + time) for gauge, start in zip(gauges, starts, strict=True)]
    one, two = bars.incident, bars.transmitted
    # the foot of a pulse that has been found late belongs to it: half of what is quiet before the reflected one
    quiet = starts[1] - starts[0] - windows.length
    lead = min(0.5 * max(quiet, 0.0), 0.1 * windows.length)
    ends = (
        starts[1] - lead,
        starts[1] + 2.0 * (one.length - one.gauge) / one.wave_speed,
        starts[2] + 2.0 * (two.length - two.gauge) / two.wave_speed,
    )
    first = starts[0] - float(windows.incident.time[0])
    ways = ((one, one.gauge, first), (one, -one.gauge, lead), (two, -two.gauge, lead))
    found = []
    for gauge, start, end, (bar, way, before) in zip(gauges, starts, ends, ways, strict=True):
        count = int((min(end, float(gauge.time[-1])) - start) / step * (1.0 + 1e-9))
        times = step * np.arange(-int(before / step), count)
        pulse = gauge.at(start + times)
        if way > 0.0:
            check_content(pulse, step, bar, gauge.noise)
        found.append(np.interp(time, times, carried(pulse, step, bar, way)))
    return time, found


def _notes(found: Hopkinson) -> list[Note]:
    """What is off by more than is usual."""
    notes, unsure = [], found.uncertainty()
    level = max(abs(float(found.stress_three_waves[found.plateau].mean())), 1e-300)
    noise = 0.8 * math.hypot(unsure["stress_one_wave"], unsure["stress_two_waves"]) / level  # mean of |noise|
    if found.equilibrium > max(TOLERATED, 2.0 * noise):
        notes.append(Note("hopkinson.no-equilibrium", Severity.WARNING, share=found.equilibrium))
    if abs(found.momentum) > TOLERATED:
        notes.append(Note("hopkinson.momentum", Severity.WARNING, share=found.momentum))
    used = unsure[("stress_one_wave", "stress_two_waves", "stress_three_waves")[found.waves - 1]]
    if used > TOLERATED * level:
        notes.append(Note("hopkinson.noisy", Severity.WARNING, noise=used, share=used / level))
    striker = found.striker()
    if striker is None:
        return notes
    for what in ("strain", "duration"):
        expected, measured = striker[f"expected_{what}"], striker[what]
        if expected is None or measured is None or abs(measured - expected) <= TOLERATED * expected:
            continue
        share = measured / expected - 1.0
        scaled = 1e6  # µm/m, µs
        values = {"expected": scaled * expected, "found": scaled * measured, "share": share}
        notes.append(Note("hopkinson.striker", Severity.WARNING, what=what, **values))
    return notes
