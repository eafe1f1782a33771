"""Bodies that strike and that are struck, and the scene of two of them."""

import solvers

BAR = {"kind": "rod", "length": 0.3, "section": {"area": 9e-4}, "material": "steel"}  # the steel rod again
BALL = {"kind": "sphere", "radius": 0.02, "material": "steel"}


def between(impactor: dict, target: dict, contact: dict) -> solvers.Scene:
    return solvers.Scene.from_table({"impactor": impactor, "target": target, "contact": contact})
