"""What several tests of commands need around them."""

from collections.abc import Iterator

import pytest

from tests.engine_children import commands_here


@pytest.fixture
def no_child() -> Iterator[None]:
    """Searches and judgements in the process of the test: most of the time of a child goes into its start."""
    with commands_here():
        yield
