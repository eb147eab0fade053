"""How long something takes, written in one way wherever a person reads it.

A point in time is another thing: like the column of a table it is in ms, to be found again by its number.
"""


def duration(ms: int) -> str:
    """``160 ms`` below a second, ``3.02 s`` from there on."""
    return f"{ms / 1000:.10g} s" if ms >= 1000 else f"{ms} ms"
