"""One entry of a message to the browser."""

from typing import NamedTuple


class Field(NamedTuple):
    """One entry of a message or of a record in it."""

    form: str  # dimensions of an array, as in "(instants, places)"; else the type, in TypeScript
    about: str = ""
    optional: bool = False

    @property
    def is_array(self) -> bool:
        """Whether it stands after the header, among the arrays."""
        return self.form.startswith("(") and self.form.endswith(")")


Fields = dict[str, Field]


def optional(fields: Fields) -> Fields:
    return {name: field._replace(optional=True) for name, field in fields.items()}
