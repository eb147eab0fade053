"""What several tests of the store need around them."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from rovercheck.checker.cache.listeners import unheard
from tests.engine_children import commands_here


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder of its own for the cache of this test, and a secret of its own."""
    place = tmp_path / "cache"
    monkeypatch.setenv("ROVERCHECK_CACHE", str(place))
    monkeypatch.setenv("ROVERCHECK_SECRET", str(tmp_path / "secret" / "cache-secret"))
    monkeypatch.delenv("ROVERCHECK_STORE", raising=False)
    yield place
    unheard()


@pytest.fixture
def no_child() -> Iterator[None]:
    """Searches in the process of the test."""
    with commands_here():
        yield
