"""Which codes of texts the browser's scripts ask for: as a whole, or by what they begin with."""

import re

WHOLE = re.compile(r"'([a-z][\w-]*(?:\.[\w-]+)*)'")
FAMILY = re.compile(r"(?:family|named)\('([\w.-]+)'")
BEGINNING = re.compile(r"`([a-z][\w-]*(?:\.[\w-]+)*\.)\$\{")  # of codes whose end is a value


def asked_in(scripts: str) -> tuple[set[str], tuple[str, ...]]:
    """Codes, and beginnings of codes, in the source of scripts; among the codes is whatever else is quoted."""
    families = {f"{family}." for family in FAMILY.findall(scripts)}
    return set(WHOLE.findall(scripts)), ("name.", *sorted(families.union(BEGINNING.findall(scripts))))
