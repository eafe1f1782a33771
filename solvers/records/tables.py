"""Tables in text files: cells by Python's `csv`, and numbers by one decimal sign for the whole file.

Which sign that is, is found from all cells: "1,25" and "0,125" can only have a decimal comma, "1.234,5" and "1.234.567"
too, with thousands apart; "2,770" may be either. What may be either is refused, unless other cells say it.
"""

import csv
import math
import re
from collections.abc import Sequence
from typing import NamedTuple

from .refused import RecordError

SEPARATORS = ";\t, "
SHOWN_LETTERS = 40  # of a cell, in a refusal
OTHER = {".": ",", ",": "."}
_SPELLED = str.maketrans({"\u00a0": " ", "\u2009": " ", "\u202f": " ", "\u2019": "'", "\u2212": "-"})
# In time that grows as the cell does: groups of three digits have one length.
_NUMBER = re.compile(
    r"[+-]?(?:(?P<whole>[0-9]++)|(?P<grouped>[1-9][0-9]{0,2}(?P<group>[ '.,])[0-9]{3}(?:(?P=group)[0-9]{3})*+))?"
    r"(?:(?P<sign>[.,])(?P<part>[0-9]*+))?(?P<power>[eE][+-]?[0-9]++)?"
)


class Row(NamedTuple):
    """A row of a table."""

    line: int  # of the file, from 1
    cells: list[str]


class Written(NamedTuple):
    """A cell that is a number in some country."""

    text: str
    decimal: str | None  # what its decimal sign can only be; None where it has none, or may have
    group: str | None  # what sets its thousands apart
    either: str | None  # the sign that may be decimal or set thousands apart


class Signs(NamedTuple):
    """Of the numbers of a file."""

    decimal: str | None  # None where no cell tells
    grouped: bool  # whether the other sign sets thousands apart in some cell


def written(cell: str) -> Written | None:
    """What the cell says of the signs, or None where it is no finite number anywhere."""
    text = (cell if cell.isascii() else cell.translate(_SPELLED)).strip()
    found = _NUMBER.fullmatch(text)
    if found is None or not (found["whole"] or found["grouped"] or found["part"]):
        return None
    group, sign, power = found["group"], found["sign"], found["power"]
    if (group is not None and group == sign) or (sign == "," and not found["part"]):
        return None
    if group in OTHER:
        return Written(text, OTHER[group], group, None)
    if sign is None:
        return Written(text, None, group, None)
    whole, part = found["whole"], found["part"]
    if whole and whole[0] != "0" and len(whole) <= 3 and len(part) == 3 and power is None:
        return Written(text, None, None, sign)
    return Written(text, sign, group, None)


def signs_of(rows: Sequence[Row], decimal: str | None = None) -> Signs:
    """Of all cells of all rows; `decimal`: what it is if the caller knows. Raises SceneError where rows differ."""
    given = None
    grouped = False
    for line, cells in rows:
        for cell in cells:
            number = written(cell)
            if number is None or number.decimal is None:
                continue
            if decimal is None:
                decimal, given = number.decimal, (line, cell)
            if number.decimal != decimal:
                raise RecordError("two-signs", cell, row=line, got=_short(cell), **_other(given))
            grouped = grouped or number.group in OTHER
    return Signs(decimal, grouped)


def digits(cell: str, signs: Signs, line: int, column: str) -> str:
    """The cell as Python writes finite numbers. Raises SceneError naming row and column."""
    known = written(cell)
    if known is None:
        raise RecordError("not-finite", cell, row=line, column=column, got=_short(cell), missing=not cell.strip())
    group = known.group
    if known.either is not None and known.either != signs.decimal:
        if not signs.grouped:
            raise RecordError("either", cell, row=line, column=column, got=_short(cell))
        group = known.either
    text = known.text.replace(group, "") if group else known.text
    text = text.replace(",", ".")
    if not math.isfinite(float(text)):
        raise RecordError("not-finite", cell, row=line, column=column, got=_short(cell), missing=False)
    return text


def read_rows(text: str, columns: int | None) -> list[Row]:
    """All rows without empty ones and comments. `columns`: how many there must be, if the caller knows.

    The separator is that which gives every row as many cells. Raises SceneError where two do, or none can be read.
    """
    lines = [
        (number, line.strip("\r\n \ufeff"))
        for number, line in enumerate(text.replace("\u03bc", "µ").splitlines(), 1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not lines:
        return []
    lines = _unwrapped(lines)
    several = [separator for separator in SEPARATORS if separator in lines[0][1]]
    split = {separator: _split(lines, separator) for separator in several or SEPARATORS[:1]}
    readable = {separator: rows for separator, rows in split.items() if isinstance(rows, list)}
    if not readable:
        raise RecordError("quotes", None, row=next(line for line in split.values() if not isinstance(line, list)))
    even = [rows for rows in readable.values() if _even(rows, columns)]
    if not even:
        return next((rows for rows in readable.values() if len(rows[0].cells) > 1), next(iter(readable.values())))
    numbers = [rows for rows in even if all(written(cell) for row in rows for cell in row.cells)]
    if len(numbers) > 1:  # "1 234,5" without names
        raise RecordError("separator", None, got=_short(lines[0][1]))
    return (numbers or even)[0]


def check_cells(rows: Sequence[Row], names: Sequence[str]) -> None:
    """Raises SceneError for a row that has not as many cells as there are names."""
    for line, cells in rows:
        if len(cells) != len(names):
            raise RecordError("cells", len(cells), row=line, cells=len(cells), names=len(names))


def _even(rows: list[Row], columns: int | None) -> bool:
    """Whether all rows have as many cells, and more than one."""
    wanted = columns or len(rows[0].cells)
    return wanted > 1 and all(len(row.cells) == wanted for row in rows)


def _split(lines: list[tuple[int, str]], separator: str) -> list[Row] | int:
    """The rows; or the number of the line whose quotation marks do not fit this separator."""
    reader = csv.reader((line for _, line in lines), delimiter=separator, skipinitialspace=True, strict=True)
    rows, start = [], 0
    try:
        for cells in reader:
            rows.append(Row(lines[start][0], [cell.strip() for cell in cells]))
            start = reader.line_num
    except csv.Error:
        return lines[min(start, len(lines) - 1)][0]
    return rows


def _unwrapped(lines: list[tuple[int, str]]) -> list[tuple[int, str]]:
    """Without the quotation marks that some loggers put around each line as a whole."""
    if not all(line[0] == line[-1] == '"' for _, line in lines):
        return lines
    rows = _split(lines, "\t")
    if not isinstance(rows, list) or len(rows) < len(lines) or any(len(row.cells) > 1 for row in rows):
        return lines
    return [(line, cells[0]) for line, cells in rows if cells[0]]


def _short(cell: str) -> str:
    return cell.strip()[:SHOWN_LETTERS]


def _other(given: tuple[int, str] | None) -> dict[str, object]:
    return {"other": "", "first": 0} if given is None else {"other": _short(given[1]), "first": given[0]}
