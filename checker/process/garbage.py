"""How often Python looks for garbage in cycles."""

import gc

_SELDOM = 200_000


def collect_seldom() -> None:
    """Look for cyclic garbage less often than Python does: formulas are many and have no cycles."""
    gc.set_threshold(_SELDOM)
