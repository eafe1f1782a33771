"""Every method against the exact solution: the fixed steel rod struck by masses lighter and heavier than itself."""

import solvers

from .size import of
from .timing import row

MASS_RATIOS = (0.1, 0.25, 0.8, 1.0, 2.0, 5.0)  # rod over mass
TWICE = (0.8, 1.0)  # where a method must not miss the second contact, nor invent a third


def measure() -> dict[str, object]:
    found: dict[str, object] = {}
    counted = []
    for ratio in of(MASS_RATIOS, TWICE[:1]):
        rod = solvers.load("fixed-rod")
        scene = rod.replace({"impactor.mass": rod.target.mass / ratio})
        default = solvers.solve(scene)
        rows = solvers.compare(scene)
        print(str(rows).replace("\n", "\n  "), end="\n\n")
        found[f"mass ratio {ratio:g}"] = {line.label: line.table() for line in rows}
        shipped = next(line for line in rows if line.method == default.method)
        if ratio in TWICE:
            counted += [
                row(
                    f"mass ratio {ratio:g}, {line.label}: {what}",
                    number,
                    "",
                    f"{line.true_contacts}" if line is shipped else "",
                )
                for line in (shipped, next(line for line in rows if line.label == "modal"))
                for what, number in (
                    ("true contacts found", line.true_contacts_found),
                    ("contacts listed", line.contacts),
                    ("raw contacts", line.raw_contacts),
                )
            ]
    return dict(counted) | found
