"""Formulas in the words of scene files, `a^2 = alpha R`, as the page writes them: `a² = α R`."""

import re
from functools import lru_cache

GREEK = {
    **{"alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "eta": "η", "kappa": "κ", "lambda": "λ", "mu": "μ"},
    **{"nu": "ν", "omega": "ω", "phi": "φ", "pi": "π", "psi": "ψ", "rho": "ρ", "sigma": "σ", "sqrt": "√"},
}
RAISED = str.maketrans("0123456789-.", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻·")
_WORD = re.compile(rf"(?<![A-Za-z])({'|'.join(GREEK)})(?![A-Za-z])")
_POWER = re.compile(r"\^(-?\d+(?:\.\d+)?)(?![\d/])")


@lru_cache(maxsize=1024)
def typeset(words: str) -> str:
    """With Greek letters and raised numbers; other raised and lowered letters the browser sets, see typeset.js."""
    return _POWER.sub(lambda power: power[1].translate(RAISED), _WORD.sub(lambda name: GREEK[name[1]], words))
