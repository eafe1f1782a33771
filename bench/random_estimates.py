"""Do the methods that discretise own to their errors? Random impacts, their estimates against the true errors."""

from tests import random_estimates


def measure() -> dict[str, object]:
    found = random_estimates.measure()
    print(
        f"{'':20} impacts  error within {random_estimates.TWICE:g} x estimate   error / estimate: half, 95 %, largest"
    )
    for kind, row in found.items():
        quotients = ", ".join(f"{row[name]:.2g}" for name in ("half", "95 %", "largest"))
        print(f"{kind:20} {row['impacts']:5}  {row['owned']:25.1%}   {quotients:>32}")
    return found
