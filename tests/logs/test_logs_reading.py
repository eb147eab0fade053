"""Reading logs: every way to write one, and one clear message with the line for each that has no meaning."""

import gzip
from fractions import Fraction
from pathlib import Path

import pytest

from rovercheck.checker.conformance.recording import LogBlock
from rovercheck.checker.logs import ColumnMap, LogError, examine, read_map
from rovercheck.checker.logs.log import open_log
from rovercheck.spec_model.abstraction import boards
from tests.logs.recorded import Row, copied, long_log, text, written

SHORT = 40


def short() -> list[Row]:
    return copied(long_log("board1")[:SHORT])


def blocks(file: Path, how: ColumnMap | None = None, system: str = "") -> list[LogBlock]:
    return list(open_log(file, how or ColumnMap(), system).blocks())


def conforms(file: Path, how: ColumnMap | None = None) -> bool:
    found = examine(file, how or ColumnMap())
    return found.rows == SHORT and not found.deviates and not found.behaviour.undecided


def refused(file: Path, how: ColumnMap | None = None, system: str = "") -> str:
    with pytest.raises(LogError) as caught:
        blocks(file, how, system)
    return str(caught.value)


def mapped(folder: Path, toml: str) -> ColumnMap:
    file = folder / "map.toml"
    file.write_text(toml, encoding="utf-8")
    return read_map(file)


# --- ways to write a log ---------------------------------------------------------------------------


def test_csv_and_gzip_are_the_same(tmp_path: Path) -> None:
    plain = written(tmp_path, short())
    packed = tmp_path / "log.csv.gz"
    packed.write_bytes(gzip.compress(plain.read_bytes()))
    assert [b.values for b in blocks(plain)] == [b.values for b in blocks(packed)]
    assert conforms(packed)


@pytest.mark.parametrize("separator", [";", "\t", "|"])
def test_separator_and_decimal_comma_are_detected(tmp_path: Path, separator: str) -> None:
    file = tmp_path / "log.csv"
    written_so = text(short(), separator=separator).replace(".", ",")
    file.write_text("# recorded in the yard\n" + written_so, encoding="utf-8-sig")
    assert conforms(file)


def test_a_map_names_columns_units_values_and_time(tmp_path: Path) -> None:
    rows = [
        {
            **{n: v for n, v in row.items() if n not in ("now_ms", "battery_pct", "wheel_speed_rpm_FL")},
            "t": row["now_ms"] / 1000,
            "SOC": row["battery_pct"] / 100,
            "front left": row["wheel_speed_rpm_FL"] / 60,
        }
        for row in short()
    ]
    how = mapped(
        tmp_path,
        """
        system = "board1"
        [columns]
        t = { signal = "now_ms", unit = "s" }
        SOC = { signal = "battery_pct", unit = "1" }
        "front left" = { signal = "wheel_speed_rpm_FL", unit = "rps" }
        current_action = { signal = "current_action", names = { "stop!" = "CMD_ESTOP" } }
        """,
    )
    file = tmp_path / "log.csv"
    file.write_text(text(rows).replace("current_action", "current_action"), encoding="utf-8")
    assert conforms(file, how)


def test_names_of_values_stand_for_their_numbers(tmp_path: Path) -> None:
    rows = short()
    numbers = blocks(written(tmp_path, rows))[0].values["temp_status"]
    sort = next(o for o in boards()["board1"].outputs if o.name == "temp_status").var.domain
    lines = text(rows).splitlines()
    at = lines[0].split(",").index("temp_status")
    cells = [line.split(",") for line in lines[1:]]
    named = [[*c[:at], sort.show(int(c[at])), *c[at + 1 :]] for c in cells]
    file = tmp_path / "named.csv"
    file.write_text("\n".join([lines[0], *(",".join(c) for c in named)]), encoding="utf-8")
    assert blocks(file)[0].values["temp_status"] == numbers


def test_numbers_are_read_exactly(tmp_path: Path) -> None:
    rows = short()
    rows[3]["battery_pct"] = 12.345
    values = blocks(written(tmp_path, rows))[0].values["battery_pct"]
    assert values[3] == Fraction(12345, 100)


@pytest.mark.parametrize("kind", ["update", "age"])
def test_updates_or_ages_stand_for_stamps(tmp_path: Path, kind: str) -> None:
    rows, before = short(), 0.0
    for row in rows:
        stamp = row["temp_last_valid_ms"]
        row["temp"] = stamp != before if kind == "update" else row["now_ms"] - stamp
        before = stamp
    how = mapped(tmp_path, f'[columns]\ntemp = {{ signal = "temp_last_valid_ms", as = "{kind}" }}')
    told = blocks(written(tmp_path, rows, ["temp_last_valid_ms"]), how)[0]
    assert (
        told.values["temp_last_valid_ms"] == blocks(written(tmp_path, rows))[0].values["temp_last_valid_ms"]
    )


def test_steps_are_counted_through_jitter_gaps_and_the_wrap_of_the_clock(tmp_path: Path) -> None:
    rows = short()[:6]
    for row, time in zip(rows, [2**32 - 30, 2**32 - 11, 12, 30, 91, 110], strict=True):
        row["now_ms"] = time
    block = blocks(written(tmp_path, rows))[0]
    assert list(block.ticks) == [1, 2, 3, 4, 7, 8]
    assert list(block.missing) == [0, 0, 0, 0, 2, 0]


def test_where_a_log_begins_is_told_by_its_time_or_the_map(tmp_path: Path) -> None:
    assert examine(written(tmp_path, short()), ColumnMap()).start == "power-up"
    assert examine(written(tmp_path, short()[9:]), ColumnMap()).start == "any"
    assert examine(written(tmp_path, short()[9:]), ColumnMap(start="power-up")).start == "power-up"


# --- what has no meaning ----------------------------------------------------------------------------


def with_cell(folder: Path, column: str, cell: str) -> Path:
    lines = text(short()).splitlines()
    at = lines[0].split(",").index(column)
    cells = lines[7].split(",")
    lines[7] = ",".join([*cells[:at], cell, *cells[at + 1 :]])
    file = folder / "log.csv"
    file.write_text("\n".join(lines), encoding="utf-8")
    return file


@pytest.mark.parametrize(
    ("column", "cell", "says"),
    [
        ("now_ms", "100", "line 8: time runs backwards, from 120 ms to 100 ms"),
        ("now_ms", "121", "line 8: 1 ms after the row before; a step takes 20 ms"),
    ],
)
def test_a_time_that_cannot_be_that_of_its_row(tmp_path: Path, column: str, cell: str, says: str) -> None:
    assert says in refused(with_cell(tmp_path, column, cell))


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"", "is empty"),
        (b"\n\n", "has no line of column names"),
        (b"now_ms,temp_status\n", "has column names but no rows"),
        (b"\x7fELF\0\0\0", "is no text but a binary file"),
        (b"PK\x03\x04rest of a spreadsheet", "is no text but a binary file"),
        (b"time,heat\n20,1\n", "no column has the name of a signal"),
        (b"now_ms,temp_status,temp_status\n20,0,0\n", "line 1: the column 'temp_status' occurs 2 times"),
        (b"now_ms,temp_status\n20,0\n40\n", "line 3: the row has 1 cells, the line of column names 2"),
        (b"now_ms,temperature_degC\n20,0\n", "holds no output of board1"),
        (b"now_ms,critical_mask\n20,0\n", "may be of board1 or of board2; say which with --system"),
        (b"now_ms,temp_status\n20,\xff\n", "is not in UTF-8"),
        (b"PAR1 but no more", "Parquet"),
    ],
)
def test_a_file_without_meaning(tmp_path: Path, content: bytes, says: str) -> None:
    file = tmp_path / "log.csv"
    file.write_bytes(content)
    assert says in refused(file)


@pytest.mark.parametrize(("keep", "says"), [(-20, "it was cut off"), (-9, "it was cut off")])
def test_a_truncated_gzip(tmp_path: Path, keep: int, says: str) -> None:
    file = tmp_path / "log.csv.gz"
    file.write_bytes(gzip.compress(text(copied(long_log("board1"))).encode())[:keep])
    message = refused(file)
    assert says in message and message.startswith("line ")


def test_a_damaged_gzip(tmp_path: Path) -> None:
    packed = bytearray(gzip.compress(text(copied(long_log("board1"))).encode()))
    packed[len(packed) // 2] ^= 0xFF
    file = tmp_path / "log.csv.gz"
    file.write_bytes(packed)
    assert refused(file).startswith("line ")


@pytest.mark.parametrize(
    ("toml", "says"),
    [
        ("columns = 3", "must be a table"),
        ("[colums]", "'colums' is no entry. Did you mean 'columns'"),
        ("[log]\nseparator = ';;'", "is no single character"),
        ("[log]\nstart = 'later'", "write 'power-up' or 'any'"),
        ("[columns]\nx = 3", "write the name of a signal"),
        ("[columns]\nx = { unit = 's' }", "names no signal"),
        ("[columns]\nx = { signal = 'btn1', scale = 'two' }", "must be a number"),
        ("[columns]\nx = { signal = 'btn1', as = 'edge' }", "write 'value' or 'update' or 'age'"),
        ("[columns]\nx = 'btn1'\ny = 'btn1'", "both hold btn1"),
        ("[columns", "is no TOML"),
    ],
)
def test_a_map_without_meaning(tmp_path: Path, toml: str, says: str) -> None:
    with pytest.raises(LogError) as caught:
        mapped(tmp_path, toml)
    assert says in str(caught.value)


@pytest.mark.parametrize(
    ("toml", "says"),
    [
        ("[columns]\nbtn1 = 'button1'", "board1 has no signal 'button1'. Did you mean 'btn1'"),
        ("[columns]\nbuton1 = 'btn1'", "has no column 'buton1', which the map names. Did you mean 'btn1'"),
        ("[columns]\nbattery_pct = { signal = 'battery_pct', unit = 'V' }", "battery_pct is in %, not in V"),
        ("[columns]\nbtn1 = { signal = 'btn1', as = 'age' }", "btn1 is no time stamp"),
        (
            "[columns]\ncmd = { signal = 'cmd', names = { go = 'CMD_GO' } }",
            "is no member of Supervisor",
        ),
    ],
)
def test_a_map_that_does_not_fit_the_log(tmp_path: Path, toml: str, says: str) -> None:
    assert says in refused(written(tmp_path, short()), mapped(tmp_path, toml))


def test_an_unknown_system(tmp_path: Path) -> None:
    assert "Did you mean 'board1'" in refused(written(tmp_path, short()), system="bord1")


@pytest.mark.parametrize("rows", [40, 3000])
@pytest.mark.parametrize("packed", [False, True])
def test_what_comes_before_the_end_of_a_torn_file_is_judged(tmp_path: Path, rows: int, packed: bool) -> None:
    """One line torn when power was lost made all of a log worth nothing."""
    whole = text(copied(long_log("board1"))).splitlines(keepends=True)
    lines = (whole * (rows // len(whole) + 1))[: rows + 1] if rows < len(whole) else whole
    torn = "".join(lines)[: -len(lines[-1]) // 2]
    file = tmp_path / ("log.csv.gz" if packed else "log.csv")
    file.write_bytes(gzip.compress(torn.encode()) if packed else torn.encode())
    found = examine(file, ColumnMap())
    assert found.rows == len(lines) - 2 and not found.conforms
    assert found.ended.startswith(f"line {len(lines)}: the row has")
    assert not found.behaviour.deviations


def test_a_file_of_which_nothing_can_be_read_is_refused(tmp_path: Path) -> None:
    lines = text(copied(long_log("board1"))).splitlines(keepends=True)
    file = tmp_path / "log.csv"
    file.write_text(lines[0] + lines[1][: len(lines[1]) // 2], encoding="utf-8")
    with pytest.raises(LogError, match="line 2: the row has"):
        examine(file, ColumnMap())
