"""Numbers of tables: what a file says is read as it was meant, or refused, wherever it was written."""

import csv
import io
import itertools

import numpy as np
import pytest
from pytest import approx

from solvers import SceneError
from solvers.records.files import read_record

SPACES = (" ", "\u00a0", "\u2009", "\u202f")
GROUPS = ("", ",", ".", "'", *SPACES[:3])
LOCALES = [(decimal, group) for decimal in ".," for group in GROUPS if group != decimal]
SEPARATORS = (",", ";", "\t", " ")
QUOTING = {"none": None, "all": csv.QUOTE_ALL, "minimal": csv.QUOTE_MINIMAL}
TIMES = {"fractions": 1.25 * np.arange(9), "whole": 1.0 * np.arange(9), "late": 1.001 + 0.001 * np.arange(9)}
FORCES = {
    "mixed": [0.0, 962.0, 2770.0, 5321.5, 1234567.25, -7460.125, 3.25, 0.5, 12.0],
    "whole": [0, 962, 2770, 5321, 123456, 7460, 3, 2, 12],
    "large": [0, 962, 2770, 5321, 1234567, 7460, 3, 2, 12],
    "thousandths": [9.125, 2.77, 5.321, 1.125, 7.461, 3.001, 2.125, 4.5, 1.001],
    "thousands": [1000, 2770, 5321, 1234, 7460, 3001, 2125, 4500, 1001],
    "small": [0, 1, 2, 3, 5, 3, 2, 1, 0],
}


def spelled(value, decimal, group, places):
    """The number as people write it there; `places` of decimals, or as many as it takes."""
    text = f"{value:,.{places}f}" if places is not None else f"{value:,.9f}".rstrip("0").rstrip(".")
    return text.translate({ord(","): group, ord("."): decimal})


def table(rows, separator, quoting, end):
    if QUOTING[quoting] is None:
        return end.join(separator.join(row) for row in rows) + end
    text = io.StringIO()
    csv.writer(text, delimiter=separator, quoting=QUOTING[quoting], lineterminator=end).writerows(rows)
    return text.getvalue()


@pytest.mark.parametrize("separator", SEPARATORS, ids=["comma", "semicolon", "tab", "space"])
@pytest.mark.parametrize("quoting", QUOTING)
def test_a_record_of_any_country_is_read_as_it_was_meant_or_refused(separator, quoting):
    heads, ends = itertools.cycle(([["time_us", "force_N"]], [])), itertools.cycle(("\n", "\r\n", "\r"))
    read = refused = 0
    meant = itertools.product(LOCALES, TIMES.values(), FORCES.values(), (None, 3))
    for (decimal, group), times, forces, places in meant:
        rows = [[spelled(v, decimal, group, places) for v in row] for row in zip(times, forces, strict=True)]
        text = table(next(heads) + rows, separator, quoting, next(ends))
        try:
            record = read_record(text, columns=("time_us", "force_N"))
        except SceneError:
            refused += 1
        else:
            read += 1
            assert record.values == approx(np.array(forces, float), abs=1e-9), text
            assert record.time == approx(1e-6 * times, abs=1e-15), text
    assert read > 0.3 * refused  # without quotation marks only semicolons and tabs leave commas alone


@pytest.mark.parametrize("decimal", [".", ","])
@pytest.mark.parametrize("separator", SEPARATORS, ids=["comma", "semicolon", "tab", "space"])
@pytest.mark.parametrize("quoting", ["all", "minimal"])
@pytest.mark.parametrize("times", ["fractions", "whole"])
@pytest.mark.parametrize("forces", ["mixed", "whole", "small"])
def test_what_a_csv_writer_writes_without_thousands_is_read(decimal, separator, quoting, times, forces):
    rows = [[spelled(v, decimal, "", None) for v in row] for row in zip(TIMES[times], FORCES[forces], strict=True)]
    record = read_record(table([["time_us", "force_N"], *rows], separator, quoting, "\n"))
    assert record.values == approx(np.array(FORCES[forces], float)) and record.time == approx(1e-6 * TIMES[times])


@pytest.mark.parametrize("group", [".", *SPACES, "'"])
def test_thousands_that_only_can_be_thousands_are_read(group):
    """One number has both signs, or several groups; so the others are plain."""
    pairs = zip(TIMES["fractions"], FORCES["mixed"], strict=True)
    rows = [[spelled(v, ",", group, None) for v in row] for row in pairs]
    record = read_record(table([["time_us", "force_N"], *rows], ";", "none", "\n"))
    assert record.values == approx(FORCES["mixed"])


def drop(*last, head="time_us;force_N"):
    return "\n".join([head, *(f"{t};{t}" for t in range(1, 9)), *last])


@pytest.mark.parametrize(
    "text, said",
    [
        (drop("9.25;2,770"), "Row 10 of the record, column “force_N”: the sign in “2,770” may be decimal"),
        (drop("9;962", "10;2,770"), "Row 11 of the record, column “force_N”: the sign in “2,770” may be decimal"),
        (drop("9,25;2.770"), "Row 10 of the record, column “force_N”: the sign in “2.770” may be decimal"),
        (drop("9,25;2.77"), "Row 10 of the record: “2.77” has another decimal sign than “9,25” in row 10."),
        (drop("9;1,234,56"), "Row 10 of the record, column “force_N”: “1,234,56” is not a finite number."),
        (drop("9;1.234.567", "10;2.5"), "“2.5” has another decimal sign than “1.234.567” in row 10."),
    ],
)
def test_what_may_be_two_numbers_is_refused_by_row(text, said):
    with pytest.raises(SceneError) as refused:
        read_record(text)
    assert said in str(refused.value)


def test_the_decimal_sign_can_be_given():
    text = drop("9;962", "10;2,770")
    assert read_record(text, decimal=",").values[-1] == approx(2.77)
    assert read_record(drop("9;962", "10;2.770"), decimal=".").values[-1] == approx(2.77)
    with pytest.raises(SceneError, match=r"“2,7” has another decimal sign than the one that is given"):
        read_record(drop("9;2,7"), decimal=".")
    with pytest.raises(SceneError, match="decimal: got ';'"):
        read_record(text, decimal=";")


def test_lines_that_are_quoted_as_a_whole():
    rows = "\n".join(f'"{t},5e-03;-26,{t}75e-03"' for t in range(9))
    assert read_record('"time_s;force_kN"\n' + rows).values[2] == approx(-26.275)
    with pytest.raises(SceneError, match="has 4 cells"):
        read_record('"time_s,force_kN"\n' + "\n".join(f'"{t},5,26,{t}75"' for t in range(9)))


def test_a_row_without_names_that_may_be_separated_twice():
    rows = "\n".join(f"{t} 234,5" for t in range(1, 10))
    with pytest.raises(SceneError, match="commas may separate or be decimal"):
        read_record(rows, columns=("time_us", "force_N"))
    assert read_record("time_us force_N\n" + rows).values[0] == 234.5


@pytest.mark.parametrize("start", ["1675248455.000005", "20000", "58.3", "-86400", "0"])
def test_times_of_a_clock_begin_at_zero(start):
    """Differences are those of the digits: a float of seconds since 1970 has steps of 0.24 us."""
    whole, _, part = start.partition(".")
    digits = int((part or "0").ljust(6, "0"))
    sign = -1 if start.startswith("-") else 1
    rows = [f"{whole}.{digits + sign * k:06d},{k % 3}" for k in (range(10) if sign > 0 else range(9, -1, -1))]
    if sign < 0:
        rows = [f"-86400.{9 - k:06d},{k % 3}" for k in range(10)]
    record = read_record("time_s,force_N\n" + "\n".join(rows))
    assert record.time == approx(1e-6 * np.arange(10), abs=1e-18)
    assert record.start == approx(float(rows[0].split(",")[0]))


def test_times_that_repeat_name_a_way_out():
    rows = "\n".join(f"{0.0104 + 5e-7 * k:.6f},{k % 3}" for k in range(101))
    with pytest.raises(SceneError, match=r"Row \d .* too few digits\. Write more digits, or even steps of 5e-07 s"):
        read_record("time_s,force_N\n" + rows)
