"""What several tests of commands need around them."""

from collections.abc import Iterator

import pytest

from tests.engine_children import commands_here


@pytest.fixture(scope="module", autouse=True)
def _compiled_once(compiled_once: None) -> None:
    """What is compiled is tested in ``tests/encode`` and ``tests/engines``, without a cache."""


@pytest.fixture
def no_child() -> Iterator[None]:
    """Searches and judgements in the process of the test: most of the time of a child goes into its start."""
    with commands_here():
        yield
