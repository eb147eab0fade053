"""Files that are too large in some way: one message each, in little memory; nothing less is refused."""

import gzip
import tracemalloc
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path
from random import Random

import pytest

from rovercheck.checker.logs import ColumnMap, LogError, files, limits
from rovercheck.checker.logs.files import BLOCK, BUFFER, PIECE, opened
from rovercheck.checker.logs.log import open_log

HEAD = "now_ms,temp_status\n20,0\n"


def count(file: Path) -> int:
    """The rows of a file."""
    rows = opened(file, ColumnMap())
    try:
        return sum(len(texts.lines) for texts in rows.blocks)
    finally:
        rows.close()


def refused(file: Path) -> str:
    with pytest.raises(LogError) as caught:
        count(file)
    return str(caught.value)


def packed(file: Path, text: str) -> Path:
    with gzip.open(file, "wb") as stream:
        stream.write(text.encode())
    return file


@contextmanager
def at_most(mebibytes: int) -> Iterator[None]:
    """What is done inside takes no more memory."""
    tracemalloc.start()
    try:
        yield
        assert tracemalloc.get_traced_memory()[1] < mebibytes << 20
    finally:
        tracemalloc.stop()


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Limits that small files reach."""
    monkeypatch.setattr(limits, "MOST_LINE", 2 * BUFFER)
    monkeypatch.setattr(limits, "RATIO_FROM", 1 << 20)
    monkeypatch.setattr(files, "MOST_COLUMNS", 50)


def test_a_bomb_of_one_line_takes_little_memory(tmp_path: Path) -> None:
    bomb = packed(tmp_path / "log.csv.gz", "," * (64 << 20))
    assert bomb.stat().st_size < 1 << 17
    with at_most(32):
        assert refused(bomb).startswith("line 1: the line is longer than 4 MiB")


@pytest.mark.parametrize("end", ["\n", "\r", "\r\n"])
@pytest.mark.parametrize("zipped", [False, True])
@pytest.mark.usefixtures("small")
def test_a_line_may_be_as_long_as_said(tmp_path: Path, end: str, zipped: bool) -> None:
    file = tmp_path / "log.csv"
    for length, fits in ((2 * BUFFER - 8, True), (4 * BUFFER, False)):
        text = (HEAD + "40," + "0" * length + "\n" + "60,0\n" * 20_000).replace("\n", end)
        packed(file, text) if zipped else file.write_text(text, encoding="utf-8", newline="")
        if fits:  # as a line; no cell of a log is as long
            rows = opened(file, ColumnMap())
            assert max(len(cell) for texts in rows.blocks for cell in texts.columns[1]) == length
            rows.close()
        else:
            assert refused(file).startswith("line 3: the line is longer than")


@pytest.mark.usefixtures("small")
def test_a_line_that_is_too_long_at_the_end_or_before_the_names(tmp_path: Path) -> None:
    file = tmp_path / "log.csv"
    file.write_text(HEAD + "0" * (4 * BUFFER), encoding="utf-8")
    assert refused(file).startswith("line 3: the line is longer than")
    file.write_text("#" * (4 * BUFFER) + "\n" + HEAD, encoding="utf-8")
    assert refused(file).startswith("line 1: the line is longer than")


def test_a_header_of_one_long_name(tmp_path: Path) -> None:
    file = tmp_path / "log.csv"
    file.write_text("now_ms," + "x" * 200_000 + "\n20,0\n", encoding="utf-8")
    assert refused(file).startswith("line 1: field larger than field limit (131072): no cell of a log is")
    file.write_text("x" * (30 << 20) + "\n1\n", encoding="utf-8")
    assert refused(file).startswith("line 1: the line is longer than 4 MiB")


@pytest.mark.usefixtures("small")
def test_a_row_of_many_lines(tmp_path: Path) -> None:
    file = tmp_path / "log.csv"
    file.write_text(HEAD + '"a\n",' * BUFFER + '"\n', encoding="utf-8")
    assert "a row takes more than" in refused(file) and "is a quote not closed?" in refused(file)
    file.write_text(HEAD + '20,"\n"\n' * BUFFER, encoding="utf-8")
    assert count(file) == BUFFER + 1


@pytest.mark.usefixtures("small")
def test_a_gzip_that_grows_too_much_and_one_that_may(tmp_path: Path) -> None:
    file = tmp_path / "log.csv.gz"
    line = 3
    packed(file, HEAD + "40,0\n" * (1 << 20))
    message = refused(file)
    line = int(message.removeprefix("line ").partition(":")[0])
    assert "becomes more than 400 times as large" in message and "unpack it first (gunzip)" in message
    assert line > (1 << 20) // 5
    plain = tmp_path / "log.csv"
    plain.write_bytes(gzip.decompress(file.read_bytes()))
    assert count(plain) == (1 << 20) + 1, "unpacked it is a log like any other"
    packed(file, HEAD + "".join(f"{20 * i},{i * i % 7919}\n" for i in range(300_000)))
    assert count(file) == 300_001


@pytest.mark.usefixtures("small")
def test_as_many_columns_as_said(tmp_path: Path) -> None:
    file = tmp_path / "log.csv"
    for width in (50, 51):
        names = ",".join(f"c{i}" for i in range(width))
        file.write_text(f"{names}\n{','.join('0' * width)}\n", encoding="utf-8")
        if width == 50:
            assert count(file) == 1
        else:
            assert refused(file) == "line 1: there are 51 columns; a log may have 50. Leave some out."


def test_a_log_of_as_many_columns_as_may_be_is_judged(tmp_path: Path) -> None:
    file = tmp_path / "log.csv"
    others = limits.MOST_COLUMNS - 2
    names = ",".join(["now_ms", "temp_status", *(f"c{i}" for i in range(others))])
    rows = (f"{20 * i},0{',7' * others}\n" for i in range(1, 101))
    file.write_text(f"{names}\n{''.join(rows)}", encoding="utf-8")
    with at_most(200):
        log = open_log(file, ColumnMap(), "board1")
        assert sum(len(block) for block in log.blocks()) == 100
    assert len(log.layout.ignored) == others


def test_columns_of_one_name_are_found_among_many(tmp_path: Path) -> None:
    file = tmp_path / "log.csv"
    names = [f"c{i}" for i in range(limits.MOST_COLUMNS - 1)]
    file.write_text(",".join([*names, "c7"]) + "\n", encoding="utf-8")
    assert refused(file).startswith("line 1: the column 'c7' occurs 2 times")


def test_fewer_lines_are_read_together_where_they_are_long(tmp_path: Path) -> None:
    file = tmp_path / "log.csv"
    for cell, most in (("0", BLOCK), ("0" * 100_000, 2 * PIECE)):
        file.write_text(HEAD + f"40,{cell}\n" * 500, encoding="utf-8")
        rows = opened(file, ColumnMap())
        assert max(len(texts.lines) for texts in rows.blocks) <= most
        rows.close()


def test_cells_that_never_repeat_are_not_all_remembered(tmp_path: Path) -> None:
    file = tmp_path / "log.csv"
    rows = (f"{20 * i},{'9' * 5000}{i}\n" for i in range(1, 10_000))
    file.write_text("now_ms,temp_status\n" + "".join(rows), encoding="utf-8")
    with at_most(40):
        log = open_log(file, ColumnMap(), "board1")
        assert sum(len(block) for block in log.blocks()) == 9_999
    assert log.invalid.count == 9_999


def test_damaged_parquet_is_told(tmp_path: Path) -> None:
    """Wherever it is damaged: names, texts and pages that cannot be read are the file's fault, not ours."""
    transition, parquet = import_module("pyarrow"), import_module("pyarrow.parquet")
    file = tmp_path / "log.parquet"
    cells = {"now_ms": list(range(20, 4020, 20)), "temp_status": ["0"] * 200}
    parquet.write_table(transition.table(cells), file)
    assert count(file) == 200
    whole, random = file.read_bytes(), Random(1)
    for _ in range(40):
        data = bytearray(whole)
        for _ in range(3):
            data[random.randrange(4, len(data))] ^= random.randrange(1, 256)
        file.write_bytes(data)
        with suppress(LogError):
            count(file)
