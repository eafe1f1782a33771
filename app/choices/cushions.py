"""Cushions between two bodies: sheets of rubber or wood on the struck face, by one definition of their stiffness.

A sheet of thickness h that covers the face, of area A, and may spread sideways is a linear spring of k = E A / h, as
long as strains are small and the impact lasts longer than a wave takes through it; its own mass is left out.

Source: rubber: P. B. Lindley, Engineering Design with Natural Rubber, NR Technical Bulletin, 4th ed. 1978, Young's
modulus at 50 IRHD. Wood: Wood Handbook, Forest Products Laboratory FPL-GTR-190, 2010, tables 5-1 and 5-3: white oak at
12 % moisture, 13.5 GPa along the grain, 0.163 of that across it, radially.
"""

from typing import Any

from solvers import Scene, Waveguide
from solvers.contact import Linear

THICKNESS = 0.01  # h [m]
MODULI = {"rubber": 2.2e6, "wood": 2.2e9}  # E [Pa]


def cushions(scene: Scene) -> list[dict[str, Any]]:
    """Every sheet that can lie on the struck face, as in `messages.schema`; none where that is no face of a rod."""
    if not isinstance(scene.target, Waveguide):
        return []
    per_modulus = scene.target.area / THICKNESS
    return [_cushion(name, modulus, modulus * per_modulus) for name, modulus in MODULI.items()]


def _cushion(name: str, modulus: float, stiffness: float) -> dict[str, Any]:
    settings = {"law": Linear.NAME, "linear_stiffness": float(f"{stiffness:.6g}")}
    return {"name": name, "modulus": modulus, "thickness": THICKNESS, "stiffness": stiffness, "settings": settings}
