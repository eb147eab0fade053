"""Updates at given ms, as the steps of a link monitor see them."""

from collections.abc import Iterator, Sequence

from rovercheck.spec_model.lang.system import TICK_MS
from tests.interpretations.scenario import Blocks


def at(stamps: Sequence[int], *, first_step: int, last_step: int, link: str = "rx") -> Blocks:
    """One block for each step, with the updates after the step before and no later than this one."""
    return list(_steps(stamps, first_step, last_step, link))


def _steps(
    stamps: Sequence[int], first_step: int, last_step: int, link: str
) -> Iterator[tuple[int, dict[str, bool | float | str]]]:
    for now in range(first_step, last_step + 1, TICK_MS):
        lags = [now - stamp for stamp in stamps if 0 <= now - stamp < TICK_MS]
        given: dict[str, bool | float | str] = {f"{link}_update": bool(lags)}
        if lags:
            given |= {f"{link}_lag": min(lags), f"{link}_first_lag": max(lags)}
        yield TICK_MS, given
