"""Models that compute with real numbers: what is asked for, and what is said where a computer rounds."""

from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from tests.simulink.known.supervisors import SINGLE


def imported(path: Path, capsys: pytest.CaptureFixture[str], *more: str) -> tuple[Exit, str]:
    code = run(["import", str(path), *more])
    return code, " ".join(capsys.readouterr().out.split())


def test_what_follows_from_other_domains_is_not_asked_for(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A range was proposed for an output, too, which is only assigned what has one."""
    path = SINGLE.save(tmp_path, "R2024a")
    assert "3 domains" in imported(path, capsys, "--propose-domains")[1]
    text = (tmp_path / "single.domains.toml").read_text(encoding="utf-8")
    assert [line.split()[0] for line in text.splitlines() if " = {" in line] == ["u", "rate", "acc"]


def test_a_difference_by_rounding_is_told_and_no_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It was called an error of rovercheck, which `check` did not."""
    path = SINGLE.save(tmp_path, "R2024a")
    imported(path, capsys, "--propose-domains")
    code, said = imported(path, capsys)
    assert code is Exit.AS_EXPECTED
    assert "Real numbers are exact: the interpreter, which rounds them, differs in tick" in said
    assert "error of rovercheck" not in said and "the direct interpreter gives the same" not in said


def test_the_last_digits_of_single_precision_are_no_difference(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """0.1 in single precision is another number, and was told as `y is 0.025 and 0.025`."""
    path = SINGLE.save(tmp_path, "R2024a")
    domain = "{ low = -1, high = 1, resolution = 0.00025 }"
    path.with_suffix(".domains.toml").write_text(
        f"[domains]\nu = {{ values = [0, 0.103] }}\nrate = {{ low = 0, high = 1 }}\nacc = {domain}\n",
        encoding="utf-8",
    )
    assert "Real numbers are exact" not in imported(path, capsys)[1]
