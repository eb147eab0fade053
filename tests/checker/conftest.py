"""What several tests of the checker need around them."""

from collections.abc import Iterator

import pytest

from tests.certifying import solving_here


@pytest.fixture(scope="module")
def solver_in_this_process() -> Iterator[None]:
    """The certifier's solver without a child process, for many small questions."""
    with solving_here():
        yield
