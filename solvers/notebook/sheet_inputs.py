"""The inputs of a report: a row for each value of its scene, with its plain name and its unit."""

from collections.abc import Callable, Iterable, Sequence
from html import escape
from typing import Any

from .sheet_frame import number, printed_unit, table
from .sheet_pictures import scaled
from .words import named, text, vector

SYMBOLS = {"young": "E", "density": "ρ", "poisson": "ν", "yield": "σ_Y"}
KINDS = ("impactor.kind", "target.kind", "contact.law")


def inputs_table(inputs: Sequence[Any], heads: Sequence[str], cells: Callable[[Any], Iterable[str]]) -> str:
    """A row for each, under the part of the scene it belongs to: key, name, and the `cells` of its values."""
    rows, part = [], ""
    for each in inputs:
        if each.part != part:
            part = each.part
            name = escape(text("sheet.part", part=part) + _kind(inputs, part))
            rows.append(f"<tr class='part'><th scope='rowgroup' colspan='{len(heads)}'>{name}</th></tr>")
        if each.key in KINDS and not each.tolerance:  # stands in the head of the part
            continue
        first = f"<td class='key'>{key_of(each.key, 1)}</td><td>{escape(name_of(each))}</td>"
        kind = " class='follows'" if each.follows else ""
        rows.append(f"<tr{kind}>{first}{''.join(cells(each))}</tr>")
    return table(heads, rows)


def _kind(inputs: Sequence[Any], part: str) -> str:
    """What kind of body it is, or which law."""
    said = [str(each.values[0].value) for each in inputs if each.part == part and each.key in KINDS]
    return f": {said[0]}" if said else ""


def key_of(key: str, start: int = 0) -> str:
    """Breakable before points; without its first word where it stands under that."""
    return "<wbr/>.".join(escape(word) for word in key.split(".")[start:])


def name_of(each: Any) -> str:
    """In plain words, by the last word of the key; of one in a list with its number."""
    words = each.key.split(".") if each.key else [each.values[0].name]
    if words[-1].isdecimal():
        return f"{named('sheet.key', words[-2])} {words[-1]}"
    if len(words) > 3 and words[-2].isdecimal():
        return f"{named('sheet.key', words[-3])} {words[-2]}, {named('sheet.key', words[-1])}"
    return named("sheet.key", words[-1])


def values_of(each: Any) -> str:
    """Number and unit; of several each behind its name, but for a word that stands for all of them."""
    parts, apart = [], each.key.endswith(".struck") or each.key.rpartition(".")[2].isdecimal()  # of lists: as in files
    for one in each.values:
        plain = one.name == each.key.rpartition(".")[2] or not each.key
        own = apart or SYMBOLS.get(one.name)
        name = one.name if own is True else own or named("sheet.key", one.name)
        parts.append(_value(one) if plain else f"{name} {_value(one)}")
    return "; ".join(parts)


def _value(one: Any) -> str:
    if isinstance(one.value, bool) or not isinstance(one.value, (int, float)):
        return _words(one.value, one.unit)
    factor, unit = scaled(abs(one.value), one.unit) if one.unit == "Pa" else (1.0, one.unit)
    return f"{number(one.value * factor)} {printed_unit(unit)}".rstrip()


def _words(value: Any, unit: str) -> str:
    """What is no single number."""
    if isinstance(value, (list, tuple)):
        numbers = bool(value) and all(isinstance(each, (int, float)) for each in value)
        inner = vector(value).replace("-", "−") if numbers else f"({', '.join(_words(each, '') for each in value)})"
        return f"{inner} {printed_unit(unit)}".rstrip()
    return number(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else str(value)
