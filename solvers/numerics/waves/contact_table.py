"""The contacts of a rigid mass with a rod, as the kernels of exact and of stepped waves write them: by columns."""

from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np

Column = TypeVar("Column", np.ndarray, float)


class ContactTable(NamedTuple, Generic[Column]):
    """Columns are arrays (contacts,), of many impacts (impacts, contacts); of one contact they are numbers.

    Time is in round trips T, velocity in the impact speed v, stress in v sqrt(E rho), place in v T.
    """

    start: Column
    end: Column
    velocity_before: Column  # of the mass
    velocity_after: Column
    peak_stress: Column
    position: Column  # of the mass at the end; NaN if they still touch
    face_velocity: Column  # of the struck face just after the end

    @staticmethod
    def of(rows: np.ndarray) -> "ContactTable[np.ndarray]":
        """Of the rows of a kernel, (..., contacts, columns)."""
        return ContactTable(*np.moveaxis(rows, -1, 0))

    @property
    def count(self: "ContactTable[np.ndarray]") -> int:
        return self.start.shape[-1]

    @property
    def impulse_share(self: "ContactTable[np.ndarray]") -> np.ndarray:
        """Of each contact, of the whole impulse."""
        return (self.velocity_before - self.velocity_after) / (self.velocity_before[0] - self.velocity_after[-1])

    def rows(self: "ContactTable[np.ndarray]") -> "list[ContactTable[float]]":
        """One for each contact, of plain numbers."""
        return [ContactTable(*row) for row in zip(*(column.tolist() for column in self), strict=True)]

    def at(self: "ContactTable[np.ndarray]", which: Any) -> "ContactTable[np.ndarray]":
        """Those of this mask or these places."""
        return ContactTable(*(column[which] for column in self))
