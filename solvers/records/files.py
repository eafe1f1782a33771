"""Measured records in files: tables as text, checked before anything is computed with them."""

import re
from collections.abc import Mapping
from decimal import Decimal
from pathlib import Path
from typing import Any

import numpy as np

from .. import validation
from ..validation import SceneError, allowed
from .record import KINDS, Record
from .refused import RecordError
from .tables import Row, check_cells, digits, read_rows, signs_of, written

MAX_BYTES, MAX_ROWS, LEAST_ROWS = 2_000_000, 200_000, 8
NAME_LETTERS, ROW_LETTERS, PATH_LETTERS = 40, 60, 200  # of what was given, in a refusal
GAP = 5.0  # of the median step: a longer one is a hole in the record
SPANS = (1e-9, 10.0)  # [s] of a record of an impact; beyond it the unit of time is wrong
UNITS = {
    "time": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "ns": 1e-9},
    "strain": {"": 1.0, "1": 1.0, "millistrain": 1e-3, "microstrain": 1e-6, "um/m": 1e-6, "µm/m": 1e-6, "%": 1e-2},
    "stress": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9},
    "force": {"N": 1.0, "kN": 1e3, "MN": 1e6},
}
LARGEST = {"strain": 0.1, "stress": 1e10, "force": 1e9}  # in SI units; beyond it the unit of the column is wrong
SAVED = re.compile(r"^# \[saved\]$", re.MULTILINE)
SAVED_STEPS = 20_000
PLACE = re.compile(r"_at_(\d{1,6}(?:\.\d{1,6})?)_(mm|m)(?=_|$)")
COLUMNS = "time_s, time_ms, time_us, time_ns; strain, microstrain, stress_Pa, stress_MPa, force_N, force_kN"


def example() -> Path:
    """The file of a record that comes with the library, synthetic: strain of the scene `bronze-rod-steel-ball`, 1 m
    from the struck end, with 12 bits and noise of 0.3 % of the greatest strain; first touch at 37 us of its clock.
    """
    return Path(__file__).with_name("example.csv")


def load_record(path: str | Path, **how: Any) -> Record:
    """A record from a file; `how` as in `read_record`. Raises SceneError naming what is wrong."""
    try:
        if not Path(path).is_file():
            raise RecordError("no-file", str(path), path=str(path)[:PATH_LETTERS])
        check_size(Path(path).stat().st_size)
        content = Path(path).read_bytes()
    except (OSError, ValueError) as error:
        if isinstance(error, SceneError):
            raise
        why = getattr(error, "strerror", None)
        shown = str(path)[:PATH_LETTERS]
        if why:
            raise RecordError("unreadable", str(path), path=shown, why=why) from None
        raise RecordError("unreadable-name", str(path), path=shown) from None
    return read_record(content, **how)


def read_record(
    content: bytes | str,
    *,
    kind: str | None = None,
    gauge: int = 1,
    columns: tuple[str, ...] | None = None,
    sign: int = 1,
    decimal: str | None = None,
    skip: int = 0,
    scale: Mapping[str, tuple[float, float]] | None = None,
) -> Record:
    """A record from the text of a table: one row per sample, columns named with their units in the first row.

    Separators are semicolons, tabs, commas or blanks, and cells may be in quotation marks; the decimal sign is found
    from all cells of the file, or is `decimal`, a point or a comma; lines that start with # are skipped. Times that
    begin further from zero than a record can last are counted from the first row, see `Record.start`. Of histories that
    were saved by the page or by `impact solve`, which say so in these lines, the first column is the record if no
    `kind` is given. `kind`: which kind of column to read, where there are several; `gauge`: the how manieth of that
    kind. Without a row of names, `columns` gives them, or else the first column is time in seconds and the second of
    `kind` in its SI unit. Strain is positive in tension, stress and force in compression; `sign` -1 turns a record in
    which it is the other way round. `skip`: lines before the table. `scale`: by the name of a column, or its number
    from 1 on, the factor and the offset [SI units] of what a value stands for, such as strain per volt; a column whose
    name says no kind is of `kind`, or strain.
    Raises SceneError naming row and column.
    """
    if kind is not None:
        validation.choice("kind", kind, KINDS)
    validation.choice("sign", str(sign), ("1", "-1"))
    if decimal is not None:
        validation.choice("decimal", decimal, (".", ","))
    text = _text(content)
    text = "\n" * skip + "".join(text.splitlines(keepends=True)[skip:])  # rows keep their numbers
    rows = read_rows(text, None if columns is None else len(columns))
    if not rows:
        raise RecordError("few-rows", 0, rows=0, least=LEAST_ROWS)
    names, rows = _names(rows, columns, kind)
    saved = SAVED.search(text) is not None
    chosen, found, factors = _choose(names, kind, gauge, saved, scale or {})
    if len(rows) < LEAST_ROWS:
        raise RecordError("few-rows", len(rows), rows=len(rows), least=LEAST_ROWS)
    if len(rows) > MAX_ROWS:
        raise RecordError("many-rows", len(rows), rows=len(rows), most=MAX_ROWS)
    check_cells(rows, names)
    start, time, values = _columns(rows, names, chosen, factors, decimal)
    values = (values + _scale_of(chosen[1], names[chosen[1]], scale or {})[1]) * sign
    if saved:
        time, values = _even(time, values)
    _check_time(time, [line for line, _ in rows])
    _check_unit(values, found, names[chosen[1]])
    return Record(time, values, found, _place(names[chosen[1]]), start)


def _even(time: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Histories that a solver has given at instants of its own, twice at a jump, in even steps."""
    steps = np.diff(time)
    if not (steps >= 0.0).all() or np.ptp(steps) < 1e-3 * steps.mean():
        return time, values
    even = np.linspace(time[0], time[-1], SAVED_STEPS)
    return even, np.interp(even, time, values)


def _place(name: str) -> float | None:
    """Where the gauge is [m], where the name of its column says it."""
    found = PLACE.search(name[:NAME_LETTERS])
    return None if found is None else float(found[1]) * {"mm": 1e-3, "m": 1.0}[found[2]]


def _names(rows: list[Row], columns: tuple[str, ...] | None, kind: str | None) -> tuple[tuple[str, ...], list[Row]]:
    """Names of the columns, from the first row, from the caller or by default; and the rows below them."""
    first = rows[0].cells
    named = _are_names(first)
    if columns is None and not named:
        if kind is None:
            raise RecordError("no-names", first, row=", ".join(first)[:ROW_LETTERS], columns=COLUMNS)
        columns = ("time_s", {"stress": "stress_Pa", "force": "force_N"}.get(kind, kind))
    return columns or tuple(first), rows[1:] if named else rows


def check_size(size: int) -> None:
    """Raises SceneError for more bytes than are read."""
    if size > MAX_BYTES:
        raise RecordError("too-large", size, size=size, most=MAX_BYTES)


def _text(content: bytes | str) -> str:
    check_size(len(content))
    if isinstance(content, str):
        return content.lstrip("\ufeff")
    encodings = ("utf-16",) if content[:2] in (b"\xff\xfe", b"\xfe\xff") else ("utf-8-sig", "cp1252")
    for encoding in encodings:
        try:
            text = content.decode(encoding)
        except UnicodeDecodeError:
            continue
        if "\0" not in text:
            return text.lstrip("\ufeff")
    raise RecordError("no-text", None)


def _are_names(cells: list[str]) -> bool:
    """Whether the first row names the columns; one in which there is a number, or what fails to be one, does not."""
    odd = [cell.lower().lstrip("+-") in ("nan", "inf", "infinity", "") for cell in cells]
    return not all(odd) and all(written(cell) is None for cell in cells)


def _choose(
    names: tuple[str, ...], kind: str | None, gauge: int, saved: bool, scale: Mapping[str, tuple[float, float]]
) -> tuple[tuple[int, int], str, tuple[float, float]]:
    """Which columns are time and value, the kind of the latter, and the factors to SI units."""
    _check_scale(names, scale)
    meanings = [_scaled(index, name, kind, scale) for index, name in enumerate(names)]
    known = [(index, *meaning) for index, meaning in enumerate(meanings) if meaning is not None]
    times = [column for column in known if column[1] == "time"]
    values = [column for column in known if column[1] in ((kind,) if kind else KINDS)]
    shown = ", ".join(str(name)[:20] for name in names)[:60]
    if not times:
        raise RecordError("no-time", names, found=shown, columns=COLUMNS)
    if not values:
        raise RecordError("no-value", names, found=shown, kind=kind or "any", columns=COLUMNS)
    if kind is None and not saved and len({column[1] for column in values}) > 1:
        raise RecordError("several-kinds", names, kinds=list(KINDS))
    validation.whole_number("gauge", gauge, 1, len(values))
    value = values[gauge - 1]
    return (times[0][0], value[0]), value[1], (times[0][2], value[2])


def _check_scale(names: tuple[str, ...], scale: Mapping[str, tuple[float, float]]) -> None:
    """Raises SceneError for a column that is not there, or the time, and for what is no factor."""
    numbered = [(str(n), name.strip()) for n, name in enumerate(names, 1) if not _is_time(name)]
    for name, numbers in scale.items():
        if not any(name in column for column in numbered):
            known = [column[:NAME_LETTERS] for _, column in numbered]
            raise SceneError("scale", name, allowed("column-of", names=known))
        validation.number("scale", abs(numbers[0]), 1e-15, 1e15)
        validation.number("scale", numbers[1], -1e12, 1e12)


def _is_time(name: str) -> bool:
    """Whether a column is one of times; one with a unit that is not known is none."""
    try:
        return (_meaning(name) or ("",))[0] == "time"
    except RecordError:
        return False


def _scale_of(index: int, name: str, scale: Mapping[str, tuple[float, float]]) -> tuple[float, float]:
    """Factor and offset of a column."""
    return scale.get(name.strip(), scale.get(str(index + 1), (1.0, 0.0)))


def _scaled(
    index: int, name: str, kind: str | None, scale: Mapping[str, tuple[float, float]]
) -> tuple[str, float] | None:
    """`_meaning` of a column whose values may be scaled."""
    if not {name.strip(), str(index + 1)} & scale.keys():
        return _meaning(name)
    try:
        own = _meaning(name)
    except RecordError:  # its unit is that of an amplifier
        own = None
    own_kind, factor = own or (kind or "strain", 1.0)
    return own_kind, factor * _scale_of(index, name, scale)[0]


# In time that grows as the name does: no part of it can give back what it has taken, or matches what the next one does.
_NAME = re.compile(
    r"(?P<word>t|time|(?:micro|milli)?strain|stress|compression|(?:contact_)?force)(?P<of>(?:_++[^\W_]++(?:\.\d++)?)*?)"
    r"(?:\s*+[\[(](?P<bracket>[^\])]*+)[\])]|[_ ]++(?P<bare>[^\d_\s][^_]*+))?(?:_\d++)?",
    re.IGNORECASE,
)


def _meaning(name: str) -> tuple[str, float] | None:
    """Kind of a column and the factor to SI units; None for a column that is neither time nor value.

    Of what it is may stand before the unit, as in files that the page saves: `force_waves_N`.
    Raises SceneError where the unit of such a column is none.
    """
    parts = _NAME.fullmatch(name.strip())
    if parts is None:
        return None
    word, unit = parts["word"].lower(), (parts["bracket"] or parts["bare"] or "").strip()
    if word in UNITS["strain"]:
        return "strain", UNITS["strain"][word]
    kind = {"t": "time", "contact_force": "force", "compression": "stress"}.get(word, word)
    if parts["of"] and unit not in UNITS[kind]:
        return None
    if unit not in UNITS[kind]:
        spelled = [f"{kind}_{unit}" if unit else kind for unit in UNITS[kind]]
        raise RecordError("unit", unit, column=name[:NAME_LETTERS], got=unit or "none", names=spelled)
    return kind, UNITS[kind][unit]


def _columns(
    rows: list[Row],
    names: tuple[str, ...],
    chosen: tuple[int, int],
    factors: tuple[float, float],
    decimal: str | None,
) -> tuple[float, np.ndarray, np.ndarray]:
    """When the record starts on the clock of the file [s], its times after that [s], and its values in SI units."""
    signs = signs_of(rows, decimal)
    read = [[digits(row.cells[c], signs, row.line, str(names[c])[:NAME_LETTERS]) for c in chosen] for row in rows]
    time, values = np.array(read, float).T * np.array(factors)[:, np.newaxis]
    if abs(time[0]) <= SPANS[1]:
        return 0.0, time, values
    first = Decimal(read[0][0])  # times since 1970 have more digits than a float
    return float(time[0]), np.array([float(Decimal(cell) - first) for cell, _ in read]) * factors[0], values


def _check_unit(values: np.ndarray, kind: str, name: str) -> None:
    largest = float(np.abs(values).max())
    if largest > LARGEST[kind]:
        raise RecordError(
            "too-great", largest, column=name[:NAME_LETTERS], largest=largest, most=LARGEST[kind], kind=kind
        )


def _check_time(time: np.ndarray, numbers: list[int]) -> None:
    steps = np.diff(time)
    if not (steps > 0.0).all():
        at = int(np.argmax(steps <= 0.0)) + 1
        even = np.linspace(time[0], time[-1], time.size)
        if (steps >= 0.0).all() and np.abs(time - even).max() <= steps.max():
            raise RecordError("repeated", float(time[at]), row=numbers[at], time=time[at], step=even[1] - even[0])
        raise RecordError("not-later", float(time[at]), row=numbers[at], time=time[at], before=time[at - 1])
    span = float(time[-1] - time[0])
    if not SPANS[0] <= span <= SPANS[1]:
        raise RecordError("span", span, span=span, low=SPANS[0], high=SPANS[1])
    median = float(np.median(steps))
    at = int(np.argmax(steps))
    if steps[at] > GAP * median:
        raise RecordError("gap", float(steps[at]), row=numbers[at + 1], gap=steps[at], times=GAP, step=median)
