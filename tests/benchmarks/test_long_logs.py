"""The long logs of the benchmark: what a board answers is not the same in every step."""

from pathlib import Path

import pytest

from benchmarks.long_logs import write_log
from rovercheck.spec_model.abstraction import boards


@pytest.mark.parametrize("board", ["board1", "board2"])
def test_a_long_log_has_a_column_for_each_output(board: str, tmp_path: Path) -> None:
    """Speeds that Board 2 sends for the first time after some rows ended the benchmark."""
    file = tmp_path / "long.csv"
    write_log(file, board, 3_000, differ=False)
    header, *rows = file.read_text(encoding="utf-8").splitlines()
    assert len(rows) == 3_000
    assert {one.name for one in boards()[board].outputs} <= set(header.split(","))
