"""What the browser calls: functions of numbers and pointers, as C has them, of which `build` makes one module.

`app/static/wasm/kernels.js` gives the room that they work in, of the sizes that stand here.
"""

from collections.abc import Sequence

from .balance_entries import BALANCE_ENTRIES
from .chain_entries import CHAIN_ENTRIES
from .compact_entries import COMPACT_ENTRIES
from .entry import KINDS
from .figure_entries import FIGURE_ENTRIES
from .modal_entries import MODAL_ENTRIES
from .spring_entries import FEW, PLACES, SPRING_ENTRIES
from .wave_entries import DASHPOTS, WAVE_ENTRIES

ON_A_LINE, WIDTH = 80, 120  # letters of a list, and of a table: longer ones have a line for each of theirs
ENTRIES = (
    WAVE_ENTRIES | MODAL_ENTRIES | SPRING_ENTRIES | COMPACT_ENTRIES | CHAIN_ENTRIES | BALANCE_ENTRIES | FIGURE_ENTRIES
)


def room() -> str:
    """What the browser code knows of all this: the file `app/static/wasm/room.js`."""
    return (
        "// Sizes of the arrays that kernels work in, and places of figures: written by app/wasm/build.py.\n"
        f"export const ROOM = {_listed({name: entry.room for name, entry in ENTRIES.items()})};\n"
        f"export const OUT = {_listed({name: entry.out for name, entry in ENTRIES.items()})};\n"
        f"export const FIELD = [{FEW}, {PLACES}]; // instants and places of a rod that bends as a spring\n"
        f"export const LAWS = {_names([kind.NAME for kind in KINDS])};\n"
        f"export const DASHPOTS = {_names(DASHPOTS)};\n"
    )


def _names(names: Sequence[str]) -> str:
    quoted = [f"'{name}'" for name in names]
    line = f"[{', '.join(quoted)}]"
    return line if len(line) < ON_A_LINE else "[\n" + "".join(f"  {each},\n" for each in quoted) + "]"


def _listed(tables: dict[str, dict[str, int]]) -> str:
    return "{\n" + "".join(_table(name, table) for name, table in tables.items()) + "}"


def _table(name: str, table: dict[str, int]) -> str:
    numbers = [f"{each}: {number}" for each, number in table.items()]
    line = f"  {name}: {{ {', '.join(numbers)} }},\n"
    return line if len(line) <= WIDTH else f"  {name}: {{\n" + "".join(f"    {each},\n" for each in numbers) + "  },\n"
