"""The wheel that the tests of the package look at, built once."""

import sys
from pathlib import Path

import pytest

from tests.packaging.builds import ROOT, core_environment, run_in, wheel_of


@pytest.fixture(scope="session")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel of this repository, built as an index would get it: from its sdist."""
    folder = tmp_path_factory.mktemp("dist")
    run_in(ROOT, sys.executable, "-m", "hatchling", "build", "-t", "sdist", "-d", str(folder))
    [archive] = folder.glob("*.tar.gz")
    run_in(folder, "tar", "-xzf", str(archive))
    [source] = (p for p in folder.iterdir() if p.is_dir())
    return wheel_of(source, folder)


@pytest.fixture(scope="session")
def core(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The Python of an installation without extras."""
    return core_environment(wheel, tmp_path_factory.mktemp("core"))
