"""Files as columns of texts: many lines at once say the same as a plain reader does row by row."""

import csv
import io
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.conformance.recording import Raw
from rovercheck.checker.logs import ColumnMap, LogError
from rovercheck.checker.logs import files as log_files
from rovercheck.checker.logs.cells import converter
from rovercheck.checker.logs.files import BLOCK, opened
from rovercheck.checker.logs.mapping import Column
from rovercheck.spec_model.abstraction import BoardSignal, boards

Rows = list[tuple[int, list[str]]]
SIGNALS = {s.name: s for b in boards().values() for s in b.inputs}


def plain(content: str, separator: str = ",") -> Rows | str:
    """The rows after the first one, each with its line; or how the message begins on the first wrong one."""
    reader = csv.reader(io.StringIO(content, newline=""), delimiter=separator, skipinitialspace=True)
    width, rows = len(next(reader)), Rows()
    try:
        for cells in reader:
            if cells and len(cells) != width:
                return f"line {reader.line_num}: the row has {len(cells)} cells"
            rows += [(reader.line_num, cells)] if cells else []
    except csv.Error as error:
        return f"line {reader.line_num}: {error}"
    return rows


def read(file: Path, how: ColumnMap | None = None) -> Rows | str:
    rows = opened(file, how or ColumnMap())
    try:
        return [
            (line, [cell.lstrip(" ") for cell in cells])
            for texts in rows.blocks
            for line, *cells in zip(texts.lines, *texts.columns, strict=True)
        ]
    except LogError as error:
        return str(error)
    finally:
        rows.close()


def the_same(file: Path, content: str, separator: str = ",") -> None:
    file.write_bytes(content.encode())
    due, found = plain(content.removeprefix("\ufeff"), separator), read(file, ColumnMap(separator=separator))
    if isinstance(due, str):
        assert isinstance(found, str) and found.startswith(due)
    else:
        assert found == [(line, [cell.lstrip(" ") for cell in cells]) for line, cells in due]


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("logs") / "log.csv"


AWKWARD = {
    "plain": "a,b\n1,2\n3,4\n",
    "no line end at the end": "a,b\n1,2\n3,4",
    "line ends of other systems": "a,b\r\n1,2\r\n3,4\r\n",
    "line ends of old ones": "a,b\r1,2\r3,4\r",
    "line ends of all kinds": "a,b\n1,2\r\n3,4\r5,6",
    "a mark of the byte order": "\ufeffa,b\n1,2\n",
    "empty cells": "a,b\n,\n1,\n,2\n",
    "blank lines": "a,b\n\n1,2\n\n\n3,4\n\n",
    "spaces": "a, b\n 1, 2\n3 ,4\n",
    "quotes": 'a,b\n"1","2"\n3,4\n',
    "quoted separators and line ends": 'a,b\n"1,5","2\n3"\n4,5\n',
    "a quoted name with a line end": '"a\nb",c\n1,2\n3,4\n',
    "quotes within quotes": 'a,b\n"say ""1""",2\n',
    "quotes inside a cell": 'a,b\n5" wheel,2\n',
    "a quote that is not closed": 'a,b\n1,2\n"3,4\n5,6\n',
    "no numbers": "a,b\nnan,inf\n-Infinity,ü\n",
    "one column": "a\n1\n\n2\n",
    "one cell too few": "a,b\n1,2\n3\n4,5\n",
    "one cell too many": "a,b\n1,2\n3,4,5\n",
    "as many cells as due, wrongly spread": "a,b\n1\n2,3,4\n",
    "a line of spaces": "a,b\n1,2\n   \n",
    "other spaces": "a,b\n1\x0b,2\x0c\n\u2028,\x85\n",
    "a cell longer than any": f"a,b\n1,2\n{'9' * csv.field_size_limit()}9,4\n",
}


@pytest.mark.parametrize("what", AWKWARD)
def test_awkward_files(what: str, file: Path) -> None:
    the_same(file, AWKWARD[what])


@pytest.mark.parametrize("separator", [";", "\t", "|"])
def test_other_separators(separator: str, file: Path) -> None:
    the_same(file, "a,b\n1,2\n3,4\n".replace(",", separator), separator)


@pytest.mark.parametrize("line", ["1", '"1', '"1","2"', "", "1,2,3"])
def test_what_is_awkward_far_behind_is_told_with_its_line(line: str, file: Path) -> None:
    lines = ["a,b", *(["7,8"] * (BLOCK + 10)), line, *(["9,0"] * 10), ""]
    the_same(file, "\n".join(lines))


@given(st.text(alphabet='1, "\r\n', max_size=40))
def test_any_text(file: Path, rest: str) -> None:
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(log_files, "BLOCK", 3)
        the_same(file, "a,b\n" + rest)


def test_zero_bytes_are_told_with_their_line_after_what_is_wrong_before(file: Path) -> None:
    head = b"now_ms,temp_status\n" + b"20,0\n" * (BLOCK + 3)
    file.write_bytes(head + b"40,\0\n")
    assert str(read(file)).startswith(f"line {BLOCK + 5}: there are zero bytes")
    file.write_bytes(head + b"40\n40,\0\n")
    assert str(read(file)).startswith(f"line {BLOCK + 5}: the row has 1 cells")


def test_lines_before_broken_bytes_are_counted(file: Path) -> None:
    head = b"now_ms,temp_status\n" + b"20,0\n" * 9000
    file.write_bytes(head + b"40,\xff\n")
    line = int(str(read(file)).removeprefix("line ").partition(":")[0])
    assert 9001 - io.DEFAULT_BUFFER_SIZE // 5 <= line <= 9002


# --- values ----------------------------------------------------------------------------------------


def value(cell: str, signal: str = "gz_dps", column: Column | None = None) -> Raw | None:
    convert = converter(column or Column(signal), SIGNALS[signal], True, comma=False)
    (one,) = convert([cell])
    wrong = convert.without_meaning([cell])
    assert convert([cell, cell]) == [one, one]
    assert [why for _, why in convert.without_meaning([cell, cell])] == [why for _, why in 2 * wrong]
    if wrong:
        raise LogError(wrong[0][1])
    return one


@given(st.decimals(-100, 100, places=6))
def test_numbers_are_read_exactly_however_they_are_written(number: object) -> None:
    signal = SIGNALS["gz_dps"]
    exact = Fraction(str(number)) / Fraction(str(resolution(signal)))
    for cell in (f"{number}", f" {number} ", f"{number}e0", f"{number}0"):
        assert value(cell) == exact


def resolution(signal: BoardSignal) -> object:
    return getattr(signal.domain.sort, "resolution", 1)


@pytest.mark.parametrize("cell", [".5", "5.", "+5", "-.5", "1e1", "007", "3/4"])
def test_other_ways_to_write_a_number(cell: str) -> None:
    assert value(cell) == Fraction(cell) / Fraction(str(resolution(SIGNALS["gz_dps"])))


@pytest.mark.parametrize(
    "cell", ["-", ".", "-.", "1.2.3", "--1", "1e99999999", "9" * 5000, "0x10", "1e-99999999"]
)
def test_what_is_no_number_is_told_at_once(cell: str) -> None:
    with pytest.raises(LogError, match=r"is no number|is outside"):
        value(cell)


@pytest.mark.parametrize(
    ("cell", "time"),
    [("40", 40), (" 40 ", 40), ("40.4", 40), ("4e1", 40), ("", None), ("4294967295", 2**32 - 1)],
)
def test_times(cell: str, time: int | None) -> None:
    assert value(cell, "now_ms") == time


@pytest.mark.parametrize("cell", ["4294967296", "-1", "9" * 5000])
def test_what_is_no_time(cell: str) -> None:
    with pytest.raises(LogError, match=r"no time of a 32-bit clock|is no number"):
        value(cell, "now_ms")


def test_times_in_other_units() -> None:
    assert value("0.04", "now_ms", Column("now_ms", unit="s")) == 40
    assert value("40", "now_ms", Column("now_ms", offset=20)) == 60


def test_names_that_were_quoted_for_spreadsheets_are_found_again(tmp_path: Path) -> None:
    file = tmp_path / "log.csv"
    file.write_text("'=a,''b,c\n1,2,3\n")
    rows = opened(file, ColumnMap())
    rows.close()
    assert rows.header == ("=a", "'b", "c")
