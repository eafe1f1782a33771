"""Values that keys of a scene take in a study: listed, over a range, or by chance."""

import math
import re
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from hashlib import sha256
from typing import Any

import numpy as np

from ... import validation
from ...scene import Scene
from ...validation import SceneError, allowed
from ..varied import WIDE, spaced, takes_whole_numbers, value_of

NUMBER = r"[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?"
RANGE = re.compile(
    rf"(?P<low>{NUMBER})\.\.(?P<high>{NUMBER})(?::(?P<count>\d{{1,9}}))?(?::(?P<spacing>log|linear))?", re.ASCII
)
SHARE = re.compile(rf"(?:±|\+-)?(?P<percent>{NUMBER}) ?%", re.ASCII)
LAW = re.compile(r"(?P<name>[a-z]+)\((?P<numbers>[^()]*)\)")
LAWS = {  # of chance, by name: what its numbers are
    "normal": ("mean", "deviation"),
    "uniform": ("low", "high"),
    "loguniform": ("low", "high"),
    "triangular": ("low", "mode", "high"),
    "lognormal": ("median", "deviation of the logarithm"),
}
USUAL_COUNT = 21
VALUES = (bool, int, float, str, Mapping)  # what a scene file has
MIDDLES = (np.arange(33) + 0.5) / 33  # shares at which an own distribution is known again
PAIRS = re.compile(r"\([^()]*\)(?:\s*,\s*\([^()]*\))*")


@dataclass(frozen=True)
class Axis:
    """Keys that take their values together: `rows`, one value for each key in each; or by chance, as `law` says."""

    keys: tuple[str, ...]
    rows: tuple[tuple[Any, ...], ...] = ()
    law: "Chance | None" = None
    own: tuple[float, ...] = ()  # values of the scene of which the law is a share
    whole: bool = False  # whether what is drawn is rounded

    @property
    def name(self) -> str:
        """That of the dimension: its first key."""
        return self.keys[0]

    @property
    def words(self) -> str:
        """What is said of its values."""
        if self.law:
            return self.law.text
        return ", ".join(str(row[0] if all(each == row[0] for each in row) else row) for row in self.rows)

    def at(self, shares: np.ndarray) -> list[tuple[Any, ...]]:
        """A row for each share from 0 to 1 of what is to come before it."""
        if self.law is None:
            places = np.minimum((shares * len(self.rows)).astype(int), len(self.rows) - 1)
            return [self.rows[place] for place in places.tolist()]
        drawn = self.law.quantiles(shares)
        columns = [drawn * value for value in self.own] or [drawn] * len(self.keys)
        return list(
            zip(*((np.rint(each).astype(int) if self.whole else each).tolist() for each in columns), strict=True)
        )

    def table(self) -> dict[str, Any]:
        """As plain lists and words."""
        said = {"law": self.law.text} if self.law else {"values": [list(row) for row in self.rows]}
        return {"keys": list(self.keys)} | validation.plain(said)


@dataclass(frozen=True)
class Chance:
    """A distribution, of a name with its numbers, or a frozen one of `scipy.stats`."""

    text: str
    frozen: Any

    def quantiles(self, shares: np.ndarray) -> np.ndarray:
        """The values below which these shares lie."""
        return np.asarray(self.frozen.ppf(shares), float)


def axes_of(scene: Scene, vary: Mapping[Any, Any], drawn: bool) -> tuple[Axis, ...]:
    """An axis for each entry; `drawn`: a range is a distribution, not a list.

    Raises SceneError naming the key for what is neither values, a range nor a distribution, and for a key that stands
    twice.
    """
    if not isinstance(vary, Mapping) or not vary:
        raise SceneError("vary", vary or None, allowed("study-vary"))
    scene = _by_first_method(scene, vary)
    found = tuple(_axis(scene, key, given, drawn) for key, given in vary.items())
    keys = [key for axis in found for key in axis.keys]
    twice = next((key for key in keys if keys.count(key) > 1), None)
    if twice is not None:
        raise SceneError("vary", twice, allowed("key-once"))
    return found


def _by_first_method(scene: Scene, vary: Mapping[Any, Any]) -> Scene:
    """The scene by the first method that is varied, whose options other keys may be."""
    given = vary.get("method.name", ())
    names = parse_values("method.name", given) if isinstance(given, str) else list(given)
    try:
        return scene.replace({"method.name": names[0]}) if names else scene
    except SceneError:
        return scene


def _axis(scene: Scene, key: Any, given: Any, drawn: bool) -> Axis:
    names = key.split(",") if isinstance(key, str) else key if isinstance(key, tuple) else ()
    keys = tuple(name.strip() for name in names if isinstance(name, str))
    if not keys or not all(keys) or len(keys) != len(names):
        raise SceneError("vary", key, allowed("study-vary"))
    if hasattr(given, "ppf"):
        return _by_law(scene, keys, Chance(_named(keys[0], given), given))
    if isinstance(given, str):
        spread = _spread(scene, keys, given.strip(), drawn)
        if spread is not None:
            return spread
        given = parse_values(keys[0], given)
    elif isinstance(given, Mapping) or not isinstance(given, Iterable) or getattr(given, "ndim", 1) == 0:
        given = [given]
    rows = tuple(_row(keys, value) for value in validation.plain(list(given)))
    for value in sum(rows, ()):
        if not isinstance(value, VALUES) or (isinstance(value, float) and not math.isfinite(value)):
            raise SceneError(keys[0], value, allowed("study-values"))
    if not rows:
        raise SceneError(keys[0], [], allowed("study-values"))
    return Axis(keys, rows)


def _row(keys: tuple[str, ...], value: Any) -> tuple[Any, ...]:
    """One value for all keys, or one each."""
    if not isinstance(value, (list, tuple)):
        return (value,) * len(keys)
    if len(value) != len(keys):
        raise SceneError(",".join(keys), list(value), allowed("value-for-each-key", count=len(keys)))
    return tuple(value)


def _spread(scene: Scene, keys: tuple[str, ...], given: str, drawn: bool) -> Axis | None:
    """Of a range, a share or a distribution; None for other words."""
    if span := RANGE.fullmatch(given):
        return _range(scene, keys, span, drawn)
    if share := SHARE.fullmatch(given):
        first, part = keys[0], 0.01 * validation.number(keys[0], float(share["percent"]), 1e-9, 1e3)
        if len(keys) > 1:
            own = tuple(number_of(scene, key) for key in keys)
            return Axis(keys, law=_chance(first, "uniform", [1.0 - part, 1.0 + part]), own=own)
        value = number_of(scene, first)
        ends = sorted((value * (1.0 - part), value * (1.0 + part)))
        return _by_law(scene, keys, _chance(first, "uniform", ends))
    law = LAW.fullmatch(given)
    if law is None and ".." not in given and not given.endswith("%"):
        return None
    if law is None or law["name"] not in LAWS:
        raise SceneError(keys[0], given, allowed("distribution", options=list(LAWS)))
    try:
        numbers = [float(each) for each in law["numbers"].split(",")]
    except ValueError:
        numbers = []
    return _by_law(scene, keys, _chance(keys[0], law["name"], numbers, given))


def _by_law(scene: Scene, keys: tuple[str, ...], law: Chance) -> Axis:
    """Raises SceneError for one that has not one number for each share."""
    try:
        middle = float(law.quantiles(MIDDLES)[16])
    except (TypeError, ValueError, IndexError):
        middle = math.nan
    if not math.isfinite(middle):
        raise SceneError(keys[0], law.text, allowed("distribution", options=list(LAWS)))
    return Axis(keys, law=law, whole=takes_whole_numbers(scene, keys[0], float(round(middle))))


def _range(scene: Scene, keys: tuple[str, ...], span: re.Match[str], drawn: bool) -> Axis:
    low, high = float(span["low"]), float(span["high"])
    count = USUAL_COUNT if span["count"] is None else int(span["count"])
    if drawn and span["count"] is not None:
        raise SceneError(keys[0], span[0], allowed("drawn-range"))
    try:
        values = spaced(low, high, 2 if drawn else count, span["spacing"])
    except SceneError as refused:
        raise SceneError(f"{keys[0]}: {refused.key}", refused.value, refused.reason) from None
    whole = any(takes_whole_numbers(scene, keys[0], float(end)) for end in (math.ceil(low), math.floor(high)))
    if drawn and not whole:
        wide = span["spacing"] is None and low > 0.0 and high / low >= WIDE
        spacing = "loguniform" if span["spacing"] == "log" or wide else "uniform"
        return Axis(keys, law=_chance(keys[0], spacing, [low, high]))
    if whole:
        first, last = math.ceil(low), math.floor(high)
        numbers = range(first, last + 1) if drawn else dict.fromkeys(round(value) for value in values.tolist())
        return Axis(keys, tuple((value,) * len(keys) for value in numbers))
    return Axis(keys, tuple((value,) * len(keys) for value in values.tolist()))


def _chance(key: str, name: str, numbers: list[float], given: str | None = None) -> Chance:
    from scipy import stats  # half a second, which nothing else here needs

    text = given or f"{name}({', '.join(map(repr, numbers))})"
    above = {"normal": numbers[1:], "loguniform": numbers, "lognormal": numbers}.get(name, [1.0])  # zero
    fits = len(numbers) == len(LAWS[name]) and all(map(math.isfinite, numbers)) and min(above) > 0.0
    if name not in ("normal", "lognormal"):
        fits = fits and numbers == sorted(numbers) and numbers[0] < numbers[-1]
    if not fits:
        raise SceneError(key, text, allowed("distribution-numbers", name=name, numbers=", ".join(LAWS[name])))
    if name == "normal":
        return Chance(text, stats.norm(*numbers))
    if name == "uniform":
        return Chance(text, stats.uniform(numbers[0], numbers[1] - numbers[0]))
    if name == "loguniform":
        return Chance(text, stats.loguniform(*numbers))
    if name == "lognormal":
        return Chance(text, stats.lognorm(numbers[1], scale=numbers[0]))
    low, mode, high = numbers
    return Chance(text, stats.triang((mode - low) / (high - low), low, high - low))


def _named(key: str, frozen: Any) -> str:
    """A frozen distribution in words, with letters that change with it, so that it is known again."""
    given = [*map(str, getattr(frozen, "args", ())), *(f"{k}={v}" for k, v in getattr(frozen, "kwds", {}).items())]
    name = getattr(getattr(frozen, "dist", frozen), "name", None) or type(frozen).__name__
    try:
        known = sha256(np.asarray(frozen.ppf(MIDDLES), float).tobytes()).hexdigest()[:8]
    except (TypeError, ValueError):
        raise SceneError(key, name, allowed("distribution", options=list(LAWS))) from None
    return f"{name}({', '.join(given)[:60]}) {known}"


def parse_values(key: str, written: str) -> list[Any]:
    """Of `a,b,c`: numbers and words; `(1,2),(3,4)` are pairs for keys that are varied together."""
    listed = written.replace("(", "[").replace(")", "]")
    try:
        return tomllib.loads(f"value = [{listed}]")["value"]
    except (ValueError, RecursionError):
        pass
    if PAIRS.fullmatch(written.strip()):
        return [[_value(word.strip()) for word in pair.split(",")] for pair in re.findall(r"\(([^()]*)\)", written)]
    words = [word.strip() for word in written.split(",")]
    if not all(words) or any("(" in word or ")" in word for word in words):
        raise SceneError(key, written, allowed("study-values"))
    return [_value(word) for word in words]


def _value(word: str) -> Any:
    """A number, or true, as TOML has it; else the word."""
    try:
        return tomllib.loads(f"value = {word}")["value"]
    except (ValueError, RecursionError):
        return word


def number_of(scene: Scene, key: str) -> float:
    """The number that the scene has for a key. Raises SceneError where it has none but zero."""
    value = value_of(scene, key)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not value:
        raise SceneError("key", key, allowed("perturbed-number"))
    return float(value)
