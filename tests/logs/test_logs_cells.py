"""A cell without meaning is a finding of its own, and the rest of its log is judged."""

from pathlib import Path

import pytest

from rovercheck.checker.logs import ColumnMap, LogError, LogResult, examine, read_map
from rovercheck.checker.logs.cells import LARGEST
from rovercheck.checker.logs.invalid import MOST_VALUES, InvalidCell
from tests.logs.recorded import copied, long_log, text

SHORT = 40
AT = 6
"""The row that is changed: tick 7, line 8."""


def with_cells(folder: Path, column: str, cells: dict[int, str], board: str = "board1") -> Path:
    lines = [line.split(",") for line in text(copied(long_log(board)[:SHORT])).splitlines()]
    place = lines[0].index(column)
    for row, cell in cells.items():
        lines[row + 1][place] = cell
    file = folder / "log.csv"
    file.write_text("\n".join(map(",".join, lines)), encoding="utf-8")
    return file


def mapped(folder: Path, column: str, options: str) -> ColumnMap:
    file = folder / "map.toml"
    file.write_text(f'[columns]\n{column} = {{ signal = "{column}", {options} }}\n', encoding="utf-8")
    return read_map(file)


def only(found: LogResult) -> InvalidCell:
    (cell,) = found.invalid.cells
    return cell


@pytest.mark.parametrize(
    ("column", "cell", "says"),
    [
        ("temperature_degC", "warm", "'warm' is no number."),
        ("temperature_degC", "nan", "nan is no finite number"),
        ("temperature_degC", "-inf", "-inf is no finite number"),
        ("temperature_degC", "1e309", "1e309 is a larger number than any of a 32-bit float"),
        ("temperature_degC", f"{'9' * 5000}", "is no number"),
        ("battery_pct", "8000", "8000 % is outside 0..100 %; is it in another unit?"),
        ("cmd", "CMD_ESTP", "'CMD_ESTP' is no number and no name of a value. Did you mean 'CMD_ESTOP'"),
        ("cmd", "1e999999999", "'1e999999999' is no number and no name of a value."),
        ("cmd", "1E-9_99999999", "'1E-9_99999999' is no number and no name of a value."),
        ("cmd", "9", "9 is outside SupervisorCommand_t"),
        ("btn1", "2", "2 is outside boolean; write nonzero = true"),
        ("btn1", "255", "255 is outside boolean"),
        ("crit_mask_b2", "0.5", "0.5 is no whole number"),
        ("batt_last_valid_ms", "-5", "-5 ms is no time of a 32-bit clock"),
        ("temp_status", "fine", "'fine' is no number and no name of a value"),
        ("critical_mask", "0.5", "0.5 is no whole number"),
        ("critical_mask", "1e17", "1e+17 is no whole number"),
        ("v_ref", "nan", "nan is no finite number"),
        ("v_ref", "-1e309", "-1e309 is a larger number than any of a 32-bit float"),
    ],
)
def test_a_cell_without_meaning_is_told_and_the_rest_is_judged(
    tmp_path: Path, column: str, cell: str, says: str
) -> None:
    found = examine(with_cells(tmp_path, column, {AT: cell}), ColumnMap())
    told = only(found)
    assert says in told.because and (told.column, told.signal) == (column, column)
    assert (told.line, told.tick, told.count) == (AT + 2, AT + 1, 1)
    assert cell.startswith(told.text.rstrip("…")) and len(told.because) < 300
    assert found.rows == SHORT and not found.deviates and not found.conforms


@pytest.mark.parametrize(
    ("board", "column", "says"),
    [
        ("board1", "temperature_degC", "The model knows temperature_degC as a number in -100..200 °C."),
        ("board2", "d1", "'N/A' is no number. The model knows d1 as a number in 0..344 cm."),
        ("board2", "btn1", "'N/A' is no number. The model knows btn1 as true or false."),
        ("board2", "B2Dec", "'N/A' is no number. The model knows B2Dec as an integer in 0..7."),
        ("board2", "left_rpm", "as a number in steps of 0.05 in -80..80 rpm."),
        ("board2", "imu_last_valid_ms", "as a time in ms, 0..4294967295."),
        ("board2", "esp_status", "no name of a value. Known: CRITICAL, DEGRADED, OK."),
    ],
)
def test_a_cell_that_is_no_number_is_told_with_what_the_model_knows(
    tmp_path: Path, board: str, column: str, says: str
) -> None:
    cell = only(examine(with_cells(tmp_path, column, {AT: "N/A"}, board), ColumnMap()))
    assert says in cell.because and (cell.column, cell.tick, cell.text) == (column, AT + 1, "N/A")


@pytest.mark.parametrize("cell", ["", "later", "-5", "nan", "4294967296"])
def test_a_row_without_a_time_is_passed_over_as_a_missing_step(tmp_path: Path, cell: str) -> None:
    found = examine(with_cells(tmp_path, "now_ms", {AT: cell}), ColumnMap())
    assert (found.rows, found.ticks, found.missing, found.start) == (SHORT - 1, SHORT, 1, "power-up")
    assert (only(found).line, only(found).tick) == (AT + 2, None)
    assert "The row is passed over." in only(found).because and not found.deviates


def test_a_log_whose_first_rows_have_no_time_begins_anywhere(tmp_path: Path) -> None:
    found = examine(with_cells(tmp_path, "now_ms", {0: "", 1: ""}), ColumnMap())
    assert (found.start, found.rows, only(found).count) == ("any", SHORT - 2, 2)
    assert not found.deviates


def test_a_log_without_any_time_is_refused(tmp_path: Path) -> None:
    with pytest.raises(LogError, match=r"line 2: column now_ms: 'x' is no number\..* No row has a time"):
        examine(with_cells(tmp_path, "now_ms", dict.fromkeys(range(SHORT), "x")), ColumnMap())


def test_the_same_text_is_one_finding_and_many_texts_are_counted(tmp_path: Path) -> None:
    found = examine(with_cells(tmp_path, "btn1", {3: "2", 9: "2", 10: "2"}), ColumnMap())
    assert (only(found).count, only(found).line, only(found).last_line) == (3, 5, 12)
    found = examine(with_cells(tmp_path, "btn1", {i: str(i + 2) for i in range(SHORT)}), ColumnMap())
    assert len(found.invalid.cells) == MOST_VALUES and found.invalid.count == SHORT
    assert found.invalid.others == {"btn1": SHORT - MOST_VALUES}


def test_long_cells_are_told_each_time(tmp_path: Path) -> None:
    long = "9" * 1000
    found = examine(with_cells(tmp_path, "btn1", {3: long, 30: long}), ColumnMap())
    assert found.invalid.count == 2


def test_a_value_that_is_not_known_hides_no_fault_elsewhere(tmp_path: Path) -> None:
    file = with_cells(tmp_path, "btn1", {AT: "2"})
    lines = [line.split(",") for line in file.read_text("utf-8").splitlines()]
    place = lines[0].index("temp_status")
    lines[20][place] = str((int(lines[20][place]) + 1) % 3)
    file.write_text("\n".join(map(",".join, lines)), encoding="utf-8")
    found = examine(file, ColumnMap())
    assert [d.outputs for d in found.behaviour.deviations] == [("temp_status",)] and found.invalid.count == 1


# --- what the map may say -------------------------------------------------------------------------


def value(folder: Path, column: str, cell: str, options: str, board: str = "board1") -> object:
    """The value that is read, or why there is none."""
    from rovercheck.checker.logs.log import open_log

    log = open_log(with_cells(folder, column, {AT: cell}, board), mapped(folder, column, options), board)
    (block,) = log.blocks()
    return log.invalid.cells[0].because if log.invalid else block.values[column][AT]


@pytest.mark.parametrize(
    ("column", "cell", "options", "due"),
    [
        ("d1", "1129", "clamp = true", 344),
        ("d1", "-1", "clamp = true", 0),
        ("d1", "300", "clamp = true", 300),
        ("d1", "1129", "absent = [1129]", None),
        ("d1", "1129.0", "absent = [1129]", None),
        ("d1", "11.29", "scale = 0.1, absent = [11.29]", None),
        ("d1", "n/a", 'absent = ["N/A", 255]', None),
        ("d1", "NaN", "absent = [nan]", None),
        ("btn1", "2", "nonzero = true", 1),
        ("btn1", "-0.5", "nonzero = true", 1),
        ("btn1", "0.0", "nonzero = true", 0),
        ("btn1", "255", "nonzero = true, absent = [255]", None),
        ("btn1", "down", 'names = { down = "true", up = "false" }', 1),
        ("btn1", "up", 'names = { down = "true", up = "false" }', 0),
        ("DEG_B1", "255", "nonzero = true", 1),
        ("command", "255", "absent = [255]", None),
    ],
)
def test_the_map_gives_cells_a_meaning(
    tmp_path: Path, column: str, cell: str, options: str, due: int | None
) -> None:
    assert value(tmp_path, column, cell, options, "board2") == due


@pytest.mark.parametrize(
    ("column", "cell", "options", "says"),
    [
        ("d1", "nan", "clamp = true", "nan is no finite number"),
        ("d1", "1130", "absent = [1129]", "is outside 0..344 cm"),
        ("btn1", "nan", "nonzero = true", "nan is no finite number"),
    ],
)
def test_what_the_map_does_not_cover_stays_without_meaning(
    tmp_path: Path, column: str, cell: str, options: str, says: str
) -> None:
    assert says in str(value(tmp_path, column, cell, options, "board2"))


@pytest.mark.parametrize(
    ("column", "options", "says"),
    [
        ("d1", "nonzero = true", "it is not true or false; leave `nonzero` out"),
        ("btn1", "clamp = true", "it is no measurement that the board reads"),
        ("left_rpm", "clamp = true", "it is no measurement that the board reads"),
        ("now_ms", "clamp = true", "it is no measurement that the board reads"),
        ("btn1", "nonzero = 1", "must be true or false"),
        ("btn1", "absent = 255", "must be a list of cells"),
        ("btn1", "absent = [true]", "must be a list of cells"),
        ("d1", "absent = [inf]", "between -1e30 and 1e30"),
        ("d1", "scale = nan", "between -1e30 and 1e30"),
        ("d1", "offset = inf", "between -1e30 and 1e30"),
        ("d1", f"scale = {'9' * 400}", "between -1e30 and 1e30"),
        ("d1", "scale = 0", "would make all its values one"),
        ("left_rpm", "tolerance = -1", "is negative"),
        ("btn1", 'names = { down = "pressed" }', "names of btn1"),
    ],
)
def test_options_without_meaning(tmp_path: Path, column: str, options: str, says: str) -> None:
    with pytest.raises(LogError) as caught:
        value(tmp_path, column, "0", options, "board2")
    assert says in str(caught.value)


@pytest.mark.parametrize(
    ("toml", "says"),
    [
        ('[columns]\nt = "now_ms"\nx = { signal = "d2", scale = "2" }\n', "line 3: [columns.x] scale: "),
        ('[columns.x]\nsignal = "d2"\n\n# scale = 1\nscale = 0\n', "line 5: [columns.x] scale: "),
        ('[columns."t, s"]\nsignal = "d2"\nclamp = 1\n', 'line 3: [columns."t, s"] clamp: '),
        ('[columns]\na = "d1"\nb = "d1"\n', "line 3: [columns] b: "),
        ("[columns]\na = 3\n", "line 2: [columns] a: "),
        ('[columns]\n[columns.x]\nunit = "m"\n', "line 2: [columns] x: column 'x' names no signal"),
        ('note = """\nstart = 1\n"""\n', "line 1: 'note' is no entry."),
        ('\n[log]\nstart = "late"\n', "line 3: [log] start: "),
        ("system = 1\n", "line 1: system = 1 must be a text"),
        ('[log]\nseparator = ";\n', "(at line 2, column 15)"),
    ],
)
def test_a_fault_of_a_map_is_told_with_its_line_and_key(tmp_path: Path, toml: str, says: str) -> None:
    file = tmp_path / "map.toml"
    file.write_text(toml, encoding="utf-8")
    with pytest.raises(LogError) as caught:
        read_map(file)
    assert says in str(caught.value) and str(file) in str(caught.value)


@pytest.mark.parametrize("toml", [f"a = {'[' * 5000}", f"a = {'9' * 5000}"])
def test_a_map_that_no_reader_takes(tmp_path: Path, toml: str) -> None:
    file = tmp_path / "map.toml"
    file.write_text(toml, encoding="utf-8")
    with pytest.raises(LogError, match=r"is no (TOML|map of a log)"):
        read_map(file)


def test_the_largest_number_is_that_of_a_32_bit_float() -> None:
    assert float(LARGEST).hex() == "0x1.fffffe0000000p+127"
