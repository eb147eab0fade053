"""How many random examples a test draws: fixed numbers in CI, many more every night."""

from hypothesis import settings

NIGHTLY = 20
"""Nightly examples for each one in CI."""


def examples(number: int) -> settings:
    """Settings with so many examples, or the nightly multiple of them."""
    times = NIGHTLY if settings.get_current_profile_name() == "nightly" else 1
    return settings(max_examples=times * number)
