"""The module that came with the package, and whether it is of today's sources."""

from hashlib import sha256
from pathlib import Path

from solvers.fingerprint import fingerprint
from solvers.jit.cache import LIBRARY
from solvers.methods.base import AFTERGLOW, MAX_ROUND_TRIPS
from solvers.methods.waves.method import RIGID_TOLERANCE

MODULE = Path(__file__).parents[1] / "static/wasm/kernels.wasm"
SOURCES = (
    "numerics/waves/rigid_drawn.py",
    "numerics/waves/law_drawn.py",
    "numerics/waves/chain_drawn.py",
    "numerics/modal_drawn.py",
    "numerics/modal_figures.py",
    "numerics/spring_drawn.py",
    "numerics/compact_drawn.py",
    "numerics/balance_drawn.py",
    "numerics/rods.py",
    "contact/__init__.py",
)  # of the library: with all that they import
ENTRIES = (
    "entry.py",
    "wave_entries.py",
    "modal_entries.py",
    "spring_entries.py",
    "compact_entries.py",
    "chain_entries.py",
    "balance_entries.py",
    "figure_entries.py",
    "entries.py",
)  # beside this
SECTION = b"\x0bfingerprint"  # in which the module names the sources that it was made of


def sources() -> str:
    """The fingerprint of what the module is made of: of kernels, and of the entries to them."""
    entries = b"".join(Path(__file__).with_name(each).read_bytes() for each in ENTRIES)
    entries += repr((AFTERGLOW, MAX_ROUND_TRIPS, RIGID_TOLERANCE)).encode()
    return f"{fingerprint([LIBRARY / each for each in SOURCES], deep=True)}-{sha256(entries).hexdigest()[:12]}"


def named_in(module: bytes) -> str:
    """The fingerprint that stands in a module; nothing if there is none."""
    return module.rpartition(SECTION)[2].decode() if SECTION in module else ""


def signed(module: bytes) -> bytes:
    """With the fingerprint of today's sources, in a section that engines pass over."""
    body = SECTION + sources().encode()
    return module + bytes((0, len(body))) + body
