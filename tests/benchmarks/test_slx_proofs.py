"""A proof kept of the rover is one of what is read of its file, in words of the file."""

from pathlib import Path

import pytest

from benchmarks.slx_proofs import CarriedOver, main
from benchmarks.slx_verdicts import ReadAgain, compared
from rovercheck.checker.verify.searches import SearchSettings
from rovercheck.properties.catalogue import catalogue
from rovercheck.spec_model.rover import systems


@pytest.mark.parametrize("id", ["PB1-36b", "PB2-75-IMU"])
def test_a_kept_proof_is_carried_over(id: str, tmp_path: Path) -> None:
    """With states, ages and what monitors remember."""
    prop = catalogue()[id]
    again = ReadAgain(systems()[prop.on], tmp_path)
    found = CarriedOver(systems()[prop.on], again, prop).invariant()
    assert found
    kept = SearchSettings(jobs=1, invariants={id: found})
    assert compared(systems()[prop.on], again, [prop], kept) == {"same": 1}


@pytest.mark.parametrize(
    ("ids", "said"), [(["PB9"], "No proof is kept of PB9"), ([], "No property is named")]
)
def test_without_a_kept_proof_there_is_a_message(
    ids: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(ids) == 2 and said in capsys.readouterr().err
