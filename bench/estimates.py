"""Do methods own to their errors, and no more than that? Random impacts, their estimates against the true errors."""

from collections.abc import Mapping

from tests.random_estimates import FIRST, KINDS, rated, shares

from .size import of, some

SCENES = 3000  # of each method, shared out among its families of scenes
FEW = {"multibody": 120}  # of one whose true error takes ten seconds
TARGETS = {"within": 0.95, "within 3": 0.995, "not beyond 5": 0.8}


def measure(scenes: int = SCENES, first: int = FIRST) -> dict[str, dict[str, float]]:
    """Of every method, and of it by family."""
    heads = "impacts  unknown  compared  error <= 1 x   <= 3 x   estimate <= 5 x error   largest error / estimate"
    print(f"{'':22} {heads}")
    found: dict[str, dict[str, float]] = {}
    for name in some(list(dict.fromkeys(kind.split(" of ")[0] for kind in KINDS))):
        kinds, seen = some([kind for kind in KINDS if kind.split(" of ")[0] == name]), []
        for kind in kinds:
            count = of(min(scenes, FEW.get(name, scenes)) // len(kinds), 2)
            each = list(rated(kind, range(first, first + count)))
            found[kind] = _row(kind, shares(each))
            seen += each
        if len(kinds) > 1:
            found[name] = _row(name, shares(seen))
    return found


def _row(called: str, row: Mapping[str, float]) -> dict[str, float]:
    missed = "  !" if any(row[name] < least for name, least in TARGETS.items()) else ""
    told = f"{row['impacts']:7}  {row['unknown']:7.1%}  {row['compared']:8}  {row['within']:12.1%}"
    near = f"{row['within 3']:7.1%}  {row['not beyond 5']:22.1%}  {row['largest']:25.2g}"
    print(f"{called:22} {told}  {near}{missed}", flush=True)
    return dict(row)
