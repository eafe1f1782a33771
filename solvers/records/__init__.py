"""Measured histories: as data, as files, and the contact force from gauges."""

from .files import example, load_record, read_record
from .gauges import RecoveredWaves, from_one_gauge, from_two_gauges
from .record import Alignment, Record, Residual, align, expected

__all__ = [
    "Alignment",
    "Record",
    "RecoveredWaves",
    "Residual",
    "align",
    "example",
    "expected",
    "from_one_gauge",
    "from_two_gauges",
    "load_record",
    "read_record",
]
