# Numba has no types of its own. What it makes of a kernel is its own matter: without this, pyright would work out each
# kernel anew at every call, for minutes.
from typing import Any

def __getattr__(name: str) -> Any: ...
