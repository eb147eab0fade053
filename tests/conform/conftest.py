"""What the tests of conformance share: a C compiler, if this machine has one."""

import pytest

from rovercheck.checker.adapters.c_build import compiler


@pytest.fixture(scope="session")
def cc() -> str:
    """The C compiler; tests that need one are skipped, visibly, where there is none."""
    found = compiler()
    if found is None:
        pytest.skip("there is no C compiler on this machine (cc, gcc, clang)")
    return found
