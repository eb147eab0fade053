"""How many random examples a test draws: a share in the quick suite, all in the full one, more every night.

A profile of Hypothesis says which suite it is: ``pytest --hypothesis-profile=full`` is ``make test-full``.
``quick``, which is the default, and ``full`` draw the same examples in every run and keep nothing on disk;
``nightly`` draws new ones and remembers what failed.
"""

from hypothesis import HealthCheck, settings
from hypothesis.database import DirectoryBasedExampleDatabase

SHARE = 4
"""The quick suite draws one example of so many."""
FEW = 5
"""Fewer are not shared: each takes long, or there are few of them to draw."""
NIGHTLY = 20
"""Nightly examples for each one in the full suite."""
USUAL = 100
"""Examples of a test that says nothing of their number, in the full suite."""


def full() -> bool:
    """Whether everything is tested: all examples are drawn, and no verdict on record is taken for granted."""
    return settings.get_current_profile_name() != "quick"


def examples(number: int) -> settings:
    """Settings with so many examples in the full suite."""
    return settings(max_examples=_drawn(number, settings.get_current_profile_name()))


def _drawn(number: int, profile: str) -> int:
    match profile:
        case "nightly":
            return NIGHTLY * number
        case "full":
            return number
        case _:
            return max(number // SHARE, min(number, FEW))


def register() -> None:
    """Make the profiles known and load the default one."""
    for name in ("quick", "full", "nightly"):
        nightly = name == "nightly"
        settings.register_profile(
            name,
            max_examples=_drawn(USUAL, name),
            derandomize=not nightly,
            deadline=None,
            print_blob=True,
            suppress_health_check=[HealthCheck.too_slow],
            database=DirectoryBasedExampleDatabase(".hypothesis/examples") if nightly else None,
        )
    settings.load_profile("quick")
