"""What several tests of the checker need around them."""

from collections.abc import Iterator

import pytest

from tests.certifying import solving_here
from tests.engine_children import engines_here


@pytest.fixture(scope="module")
def solver_in_this_process() -> Iterator[None]:
    """The certifier's solver without a child process, for many small questions."""
    with solving_here():
        yield


@pytest.fixture(scope="module")
def engines_in_this_process() -> Iterator[None]:
    """Every engine without a child process, and the certifier's solver too."""
    with engines_here():
        yield
