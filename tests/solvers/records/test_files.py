"""Files of measured records: what is read, and how everything else is refused in one sentence."""

import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pytest import approx

from solvers import SceneError
from solvers.records.files import MAX_BYTES, load_record, read_record
from solvers.records.refused import RecordError

TIME = np.arange(10) * 1e-6
VALUES = np.sin(np.arange(10)) * 1e-4


def lines(time=TIME, values=VALUES, head="time_s,strain", separator=",", decimal=".", end="\n"):
    rows = [f"{t:.9g}{separator}{v:.9g}".replace(".", decimal) for t, v in zip(time, values, strict=True)]
    return end.join(([head] if head else []) + rows) + end


@pytest.mark.parametrize(
    "text",
    [
        lines(),
        lines(end="\r\n"),
        "\ufeff" + lines(),
        "# a comment\n\n" + lines() + "# another\n\n",
        lines(head="time_s;strain", separator=";"),
        lines(head="time_s;strain", separator=";", decimal=","),
        lines(head="time_s\tstrain", separator="\t", decimal=","),
        lines(head="time_s strain", separator="   "),
        lines(head='"time_s","strain"'),
        lines(1e6 * TIME, head="time_us,strain"),
        lines(1e6 * TIME, 1e6 * VALUES, "time_us,microstrain"),
        lines(1e6 * TIME, 1e6 * VALUES, "t [µs],strain [µm/m]"),
        lines(1e6 * TIME, 1e6 * VALUES, "Time (us),Strain (um/m)"),
        lines(1e3 * TIME, 1e2 * VALUES, "time_ms,strain_%"),
        lines(1e9 * TIME, 1e3 * VALUES, "t_ns, millistrain_1"),
    ],
    ids=lambda text: repr(text[:24]),
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "text"])
def test_one_record_written_in_many_ways(text, encoding):
    record = read_record(text if encoding == "text" else text.encode(encoding))
    assert record.kind == "strain"
    assert record.time == approx(TIME, abs=1e-15) and record.values == approx(VALUES, rel=1e-8)


def test_the_old_code_page_of_windows():
    assert read_record(lines(1e6 * TIME, head="time_µs,strain").encode("cp1252")).time == approx(TIME)


@pytest.mark.parametrize(
    "head, kind, factor",
    [("time_s,stress_Pa", "stress", 1.0), ("time_s,stress_MPa", "stress", 1e6), ("time_s,force_kN", "force", 1e3),
     ("time_s,contact_force_N", "force", 1.0)],
)  # fmt: skip
def test_kinds_and_units(head, kind, factor):
    record = read_record(lines(head=head))
    assert record.kind == kind and record.values == approx(factor * VALUES, rel=1e-8)


@pytest.mark.parametrize(
    "name, kind",
    [
        ("force_waves_N", "force"),
        ("force_5_modes_N", "force"),
        ("compression_modal_at_150_mm_Pa", "stress"),
        ("stress_at_1.51_m_Pa", "stress"),
    ],
)
def test_columns_that_the_page_saves_are_read_again(name, kind):
    text = "# scene = fixed-rod\n" + lines(head=f"time_s,{name}")
    assert read_record(text).kind == kind and read_record(text).values == approx(VALUES, rel=1e-8)


def test_the_sign_can_be_turned():
    assert read_record(lines(), sign=-1).values == approx(-VALUES, rel=1e-8)
    with pytest.raises(SceneError, match="sign: got '2'"):
        read_record(lines(), sign=2)


def test_columns_without_names():
    bare = lines(head=None)
    assert read_record(bare, kind="force").kind == "force"
    record = read_record(lines(1e6 * TIME, head=None), columns=("time_us", "strain"))
    assert record.time == approx(TIME)
    with pytest.raises(SceneError, match=r"first row, “0.*”, does not name the columns.*such as time_s"):
        read_record(bare)


def test_several_columns():
    rows = "\n".join(f"{t},{v},{2 * v},x,{1e3 * v}" for t, v in zip(TIME, VALUES, strict=True))
    text = "time_s,strain_1,strain_2,remark,force_N\n" + rows
    assert read_record(text, kind="strain", gauge=2).values == approx(2 * VALUES)
    assert read_record(text, kind="force").values == approx(1e3 * VALUES)
    with pytest.raises(SceneError, match="Say which: strain, stress, force"):
        read_record(text)
    with pytest.raises(SceneError, match="gauge: got 3; allowed: a whole number from 1 to 2"):
        read_record(text, kind="strain", gauge=3)


def replaced(row, text):
    rows = lines().splitlines()
    rows[row - 1] = text
    return "\n".join(rows)


@pytest.mark.parametrize(
    "text, said",
    [
        (replaced(4, "2e-6,nan"), "Row 4 of the record, column “strain”: “nan” is not a finite number."),
        (replaced(4, "2e-6,inf"), "column “strain”: “inf” is not a finite number."),
        (replaced(4, "2e-6,-1e999"), "column “strain”: “-1e999” is not a finite number."),
        (replaced(4, "2e-6,"), "column “strain”: there is no value."),
        (replaced(4, "2e-6"), "Row 4 of the record has one cell, the row of names has 2."),
        (replaced(4, "2e-6,1,5"), "Row 4 of the record has 3 cells, the row of names has 2."),
        (replaced(4, '"2e-6","1'), "Row 4 of the record has a quotation mark that is not closed"),
        (replaced(4, '2e-6,"1,5"'), "Row 4 of the record: “1,5” has another decimal sign than “8.41470985e-05”"),
        (replaced(4, "2e-6,abc"), "column “strain”: “abc” is not a finite number."),
        (replaced(4, "2e-6,1_0"), "column “strain”: “1_0” is not a finite number."),
        (replaced(4, "1,2e-6"), "Row 5 of the record: its time, 3e-06 s, is not later than the 1 s of the row before."),
        (replaced(4, "1e-6,0"), "Row 4 of the record: its time, 1e-06 s, is that of the row before"),
        (replaced(4, "0,0"), "Row 4 of the record: its time, 0 s, is not"),
        (replaced(2, "nan,0"), "Row 2 of the record, column “time_s”: “nan”"),
        ("nan,nan\n" + lines(head=None), "The first row, “nan, nan”,"),
        ("", "The record has no rows of numbers; at least 8 are needed."),
        ("# only a comment\n", "The record has no rows"),
        ("time_s,strain", "The record has no rows of numbers; at least 8"),
        ("time_s,strain\n0,0\n", "The record has one row of numbers; at least 8"),
        (lines(TIME[:7], VALUES[:7]), "The record has 7 rows of numbers"),
        (lines(head="time_s,velocity_m_per_s"), "is strain, stress or force with its unit; it has time_s, velocity_"),
        (lines(head="x_m,strain"), "No column of the record is a time with its unit; it has x_m, strain."),
        (lines(head="time,strain"), "The column “time” of the record has no unit. Name it with its unit: time_s"),
        (lines(head="time_minutes,strain"), "“time_minutes” of the record has the unit “minutes”, which is not known."),
        (lines(head="time_s,stress"), "“stress” of the record has no unit."),
        (lines(head="time_s,force_lbf"), "the unit “lbf”, which is not known"),
        (lines(head="time_s,stress_psi"), "the unit “psi”, which is not known"),
        (lines(1e7 * TIME), "Is the unit of time in the name of its column right?"),
        (lines(1e-6 * TIME), "Is the unit of time in the name of its column right?"),
        (lines(values=1e6 * VALUES), "are these microstrain"),
        (lines(np.append(TIME[:5], TIME[5:] + 6e-6)), "Row 7 of the record comes after a gap of 7e-06 s;"),
        ("\0\1\2" * 50, "record"),
    ],
)  # fmt: skip
def test_what_cannot_be_used_is_named(text, said):
    with pytest.raises(SceneError) as refused:
        read_record(text)
    assert said in str(refused.value)
    assert "\n" not in str(refused.value) and len(str(refused.value)) < 400
    assert not re.search(r"got |allowed:|None|\w\.\w+:", str(refused.value))  # a sentence, no code
    assert isinstance(refused.value, RecordError) and refused.value.key == "record"


def test_bytes_that_are_no_text():
    for content in (b"\xff\xfe\x00", b"PK\x03\x04" + bytes(100), bytes(1000)):
        with pytest.raises(SceneError, match="record"):
            read_record(content)


def test_ten_megabytes_are_refused_before_they_are_read(tmp_path):
    content = b"1,2\n" * 2_500_000
    with pytest.raises(SceneError, match=f"The record has 10000000 bytes; at most {MAX_BYTES} are read"):
        read_record(content)
    path = tmp_path / "large.csv"
    path.write_bytes(content)
    with pytest.raises(SceneError, match="10000000 bytes"):
        load_record(path)


def test_files(tmp_path):
    path = tmp_path / "record.csv"
    path.write_text(lines())
    assert load_record(path).values == approx(VALUES, rel=1e-8)
    for wrong in (tmp_path, tmp_path / "none.csv", "x" * 5_000, "a\0b", ""):
        with pytest.raises(SceneError, match=r"no file of a record|cannot be read|no file can have"):
            load_record(wrong)


def test_too_many_rows():
    with pytest.raises(SceneError, match="The record has 250000 rows; at most 200000"):
        read_record("time_s,strain\n" + "1,2\n" * 250_000)


@settings(max_examples=60, deadline=None)
@given(st.one_of(st.binary(max_size=300), st.text(max_size=300), st.text("0123456789.,;\t\n e-+nax_#", max_size=300)))
def test_anything_is_read_or_refused(content):
    for how in ({}, {"kind": "strain"}, {"columns": ("time_us", "force_N")}):
        try:
            record = read_record(content, **how)
        except SceneError as refused:
            assert "\n" not in str(refused)
        else:
            assert np.isfinite(record.time).all() and np.isfinite(record.values).all()
            assert (np.diff(record.time) > 0.0).all()


def test_volts_are_scaled_by_name_or_number():
    rows = "\n".join(f"{n},{0.5 * n},{n % 3}" for n in range(12))
    text = "Scope 3\nrange 5 V, 2 V\n" + "time_us,CH1,CH2\n" + rows
    one = read_record(text, skip=2, scale={"CH1": (1e-3, 2e-6), "3": (-1e-4, 0.0)})
    two = read_record(text, skip=2, gauge=2, scale={"CH1": (1e-3, 2e-6), "3": (-1e-4, 0.0)}, sign=-1)
    assert (one.kind, one.time[3]) == ("strain", approx(3e-6))
    assert one.values == approx(0.5e-3 * np.arange(12) + 2e-6)
    assert two.values == approx(1e-4 * (np.arange(12) % 3))
    assert read_record(text, skip=2, kind="force", scale={"CH2": (2e3, 0.0)}).values.max() == approx(4e3)
    own = read_record(text.replace("CH1", "microstrain"), skip=2, scale={"2": (2.0, 0.0)})
    assert own.values == approx(1e-6 * np.arange(12))
    for wrong in ("CH3", "4", "0", "1", "time_us"):
        with pytest.raises(SceneError, match=r"^scale: got .*; allowed: the name, or the number, .*: CH1, CH2$"):
            read_record(text, skip=2, scale={wrong: (1.0, 0.0)})
    with pytest.raises(SceneError, match="scale"):
        read_record(text, skip=2, scale={"CH1": (0.0, 0.0)})


def test_rows_keep_their_numbers_where_lines_are_skipped():
    text = "Scope\n" + lines().replace(lines().splitlines()[4], "oops,oops")
    with pytest.raises(SceneError, match="Row 6 of the record"):
        read_record(text, skip=1)
