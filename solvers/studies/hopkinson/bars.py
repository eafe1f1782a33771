"""A split Hopkinson bar: both bars with their gauges, the specimen between them, and the striker; read from a table."""

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ... import validation
from ...bodies import Material
from ...bodies.material import LENGTH_RANGE, YOUNG_RANGE, required_material
from ...validation import SceneError, allowed

KEYS = ("incident", "transmitted", "specimen", "striker", "dispersion")
BAR_KEYS = ("length", "diameter", "material", "wave_speed", "youngs_modulus", "poisson", "gauge")
STRIKER_KEYS = ("length", "velocity", "diameter", "material", "wave_speed", "youngs_modulus")
DISPERSION = ("none", "pochhammer")
SPEED_RANGE = (10.0, 20_000.0)  # m/s, of waves
POISSON_RANGE = (0.0, 0.499)
VELOCITY_RANGE = (1e-3, 1e3)  # m/s, of strikers
MOST_BYTES = 100_000


@dataclass(frozen=True)
class RoundBar:
    """What waves in it need of a bar."""

    length: float  # [m]
    diameter: float  # [m]
    wave_speed: float  # c0 [m/s], of long waves
    young: float  # E [Pa]

    @property
    def area(self) -> float:
        """[m2]"""
        return 0.25 * math.pi * self.diameter**2

    @property
    def impedance(self) -> float:
        """Force over velocity of a wave [N s/m]."""
        return self.young * self.area / self.wave_speed


@dataclass(frozen=True)
class GaugedBar(RoundBar):
    """With a strain gauge."""

    gauge: float  # [m] from the specimen
    poisson: float | None  # None where nothing says it

    @property
    def delay(self) -> float:
        """Time of a wave between gauge and specimen [s]."""
        return self.gauge / self.wave_speed


@dataclass(frozen=True)
class Specimen:
    """A cylinder between the bars."""

    length: float  # [m]
    diameter: float  # [m]

    @property
    def area(self) -> float:
        """[m2]"""
        return 0.25 * math.pi * self.diameter**2


@dataclass(frozen=True)
class Striker:
    """What sends the pulse: a bar, and its velocity as it was measured."""

    bar: RoundBar
    velocity: float | None  # [m/s]

    @property
    def pulse(self) -> float:
        """How long the pulse lasts that it sends [s]."""
        return 2.0 * self.bar.length / self.bar.wave_speed

    def strain(self, incident: RoundBar) -> float | None:
        """Of the pulse that it sends into a bar: v / 2 c0 where both have the same section and material."""
        if self.velocity is None:
            return None
        own, other = self.bar.impedance, incident.impedance
        return self.velocity * own / (own + other) / incident.wave_speed


@dataclass(frozen=True)
class Bars:
    """The whole apparatus."""

    incident: GaugedBar
    transmitted: GaugedBar
    specimen: Specimen
    striker: Striker | None
    dispersion: str  # none | pochhammer


def load_bars(given: "str | Path | Mapping[str, Any] | Bars") -> Bars:
    """From a TOML file, or a table with the keys of one. Raises SceneError naming the key."""
    if isinstance(given, Bars):
        return given
    if isinstance(given, Mapping):
        return read_bars(given)
    try:
        content = Path(given).read_bytes()
    except (OSError, ValueError, TypeError) as error:
        why = getattr(error, "strerror", None) or str(error)
        raise SceneError("bars", str(given)[:200], allowed("readable", why=why)) from None
    if len(content) > MOST_BYTES:
        raise SceneError("bars", str(given), allowed("scene-size", most=MOST_BYTES))
    try:
        return read_bars(tomllib.loads(content.decode()))
    except (UnicodeDecodeError, tomllib.TOMLDecodeError, RecursionError) as error:
        raise SceneError("bars", str(given), allowed("toml", why=str(error))) from None


def read_bars(given: Mapping[str, Any]) -> Bars:
    """From a table: `incident` and `transmitted` (length, diameter, gauge, and material or wave_speed with
    youngs_modulus), `specimen` (length, diameter), and, as wanted, `striker` (length, velocity) and `dispersion`.

    The striker is as thick as the incident bar and of its material, unless it says otherwise.
    Raises SceneError naming the key.
    """
    validation.table("", given, KEYS)
    dispersion = validation.choice("dispersion", given.get("dispersion", "none"), DISPERSION)
    bars = [_gauged(name, _table(name, given, BAR_KEYS), dispersion) for name in ("incident", "transmitted")]
    table = _table("specimen", given, ("length", "diameter"))
    specimen = Specimen(*(_length("specimen", table, name) for name in ("length", "diameter")))
    thinner = min(bar.diameter for bar in bars)
    if specimen.diameter > thinner:
        raise SceneError("specimen.diameter", specimen.diameter, allowed("specimen-within", most=thinner))
    return Bars(bars[0], bars[1], specimen, _striker(given, bars[0]), dispersion)


def _table(key: str, given: Mapping[str, Any], keys: tuple[str, ...]) -> Mapping[str, Any]:
    needed = allowed("table", keys=", ".join(keys))
    return validation.table(key, validation.required("", given, key, needed), keys)


def _length(key: str, table: Mapping[str, Any], name: str) -> float:
    return validation.required_number(key, table, name, *LENGTH_RANGE, "m")


def _gauged(key: str, table: Mapping[str, Any], dispersion: str) -> GaugedBar:
    length, diameter = _length(key, table, "length"), _length(key, table, "diameter")
    speed, young, poisson = _waves(key, table)
    if "poisson" in table:
        poisson = validation.number(f"{key}.poisson", table["poisson"], *POISSON_RANGE)
    if dispersion == "pochhammer":
        poisson = validation.number(f"{key}.poisson", poisson, *POISSON_RANGE)
    gauge = validation.required_number(key, table, "gauge", 0.0, length, "m")
    return GaugedBar(length, diameter, speed, young, gauge, poisson)


def _waves(key: str, table: Mapping[str, Any]) -> tuple[float, float, float | None]:
    """Speed of waves [m/s], modulus [Pa] and Poisson's ratio: of the material, and what is given in its place."""
    material: Material | None = None
    if "material" in table:
        material = required_material(key, table)
    elif not {"wave_speed", "youngs_modulus"} <= table.keys():
        half = {"wave_speed": "youngs_modulus", "youngs_modulus": "wave_speed"}  # one needs the other
        missing = next((half[name] for name in half if name in table), "material")
        raise SceneError(f"{key}.{missing}", None, allowed("material-or-speed"))
    young = table["youngs_modulus"] if material is None else table.get("youngs_modulus", material.young)
    young = validation.number(f"{key}.youngs_modulus", young, *YOUNG_RANGE, "Pa")
    speed = table["wave_speed"] if material is None else table.get("wave_speed", math.sqrt(young / material.density))
    speed = validation.number(f"{key}.wave_speed", speed, *SPEED_RANGE, "m/s")
    return speed, young, None if material is None else material.poisson


def _striker(given: Mapping[str, Any], incident: GaugedBar) -> Striker | None:
    if "striker" not in given:
        return None
    table = validation.table("striker", given["striker"], STRIKER_KEYS)
    length, diameter = _length("striker", table, "length"), incident.diameter
    if "diameter" in table:
        diameter = _length("striker", table, "diameter")
    speed, young = incident.wave_speed, incident.young
    if set(table) & {"material", "wave_speed", "youngs_modulus"}:
        speed, young, _ = _waves("striker", table)
    velocity = None
    if "velocity" in table:
        velocity = validation.number("striker.velocity", table["velocity"], *VELOCITY_RANGE, "m/s")
    return Striker(RoundBar(length, diameter, speed, young), velocity)
