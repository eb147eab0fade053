"""Known deviations with their causes: a fault on top that looks like one of them is not known."""

import json
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from tests.model_files.files import FIRMWARE, heater_files

HOTTER = """

class Hotter(Heater):
    "As Hot, and 5 degrees more."
    limit = 30


class HotAndOdd(Heater):
    "As Hot, and on top of it what no other limit explains."

    def step(self, given):
        self.limit = 38 if given["temperature"] % 2 else 25
        return super().step(given)
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("heater")
    return heater_files(made, FIRMWARE + HOTTER)


@pytest.fixture(scope="module")
def of_hot(folder: Path) -> str:
    """What is known of Hot."""
    file = folder / "known.toml"
    assert compared(folder, "Hot", "--write-known", str(file)) is Exit.FAILED
    return file.read_text(encoding="utf-8")


@pytest.fixture
def known(tmp_path: Path, of_hot: str) -> Path:
    """A file of what is known."""
    file = tmp_path / "known.toml"
    file.write_text(of_hot, encoding="utf-8")
    return file


def compared(folder: Path, firmware: str, *more: str) -> Exit:
    address = f"python:{folder / 'firmware.py'}:{firmware}"
    return run(["compare", "--model", str(folder / "heater.py"), "--impl", address, "--examples", "30",
                "--mismatches", "0", *more])  # fmt: skip


def told(folder: Path, capsys: pytest.CaptureFixture[str], firmware: str, *more: str) -> Any:
    compared(folder, firmware, "--json", *more)
    return json.loads(capsys.readouterr().out)["results"][0]


def test_the_cause_is_written_and_what_it_explains_is_known(
    folder: Path, known: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = known.read_text(encoding="utf-8")
    assert (
        '[[cause]]\nboard = "Heater"' in text
        and 'kind = "limit"' in text
        and 'to = "temperature > 25"' in text
    )
    result = told(folder, capsys, "Hot", "--known", str(known))
    assert {one["known"] for one in result["mismatches"]} == {"known"}
    assert [one["verdict"] for one in result["known"]] == ["seen"]


@pytest.mark.parametrize("firmware", ["Hotter", "HotAndOdd"])
def test_what_looks_like_it_and_is_not_explained_is_not_known(
    firmware: str, folder: Path, known: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    [plain] = told(folder, capsys, "Hot", "--known", str(known))["mismatches"]
    result = told(folder, capsys, firmware, "--known", str(known))
    same = [one for one in result["mismatches"] if one["differences"] == plain["differences"]]
    assert {one["known"] for one in same} == {"changed"}
    assert compared(folder, firmware, "--known", str(known)) is Exit.FAILED
    said = " ".join(capsys.readouterr().out.split())
    assert "has changed: what explained it does not explain it any more" in said


def test_without_a_cause_it_is_known_by_its_looks(
    folder: Path, known: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    known.write_text(known.read_text(encoding="utf-8").partition("\n[[cause]]")[0], encoding="utf-8")
    result = told(folder, capsys, "Hotter", "--known", str(known))
    assert {one["known"] for one in result["mismatches"]} == {"known"}


def test_writing_again_keeps_the_cause_and_finds_that_of_what_has_changed(folder: Path, known: Path) -> None:
    text = known.read_text(encoding="utf-8")
    compared(folder, "Hot", "--known", str(known), "--write-known", str(known))
    assert known.read_text(encoding="utf-8") == text
    compared(folder, "Hotter", "--known", str(known), "--write-known", str(known))
    after = known.read_text(encoding="utf-8")
    assert "temperature > 25" not in after
    assert text.partition("\n[[cause]]")[0] in after
    assert compared(folder, "Hotter", "--known", str(known)) is not Exit.FAILED


BAD = [
    ('from = "', 'from = "7', "Take this [[cause]] out"),
    ('kind = "limit"', 'kind = "odd"', "Take this [[cause]] out"),
    ('kind = "limit"', "kind = 3", "changes is no list of tables"),
    ('board = "Heater"', 'board = "oven"', "is no deviation of 'oven'"),
    ('board = "Heater"', 'bord = "Heater"', "a cause has no 'bord'"),
    ('deviations = [\n    "', 'deviations = [\n    "x', "there is no deviation 'x"),
]


@pytest.mark.parametrize(("old", "new", "says"), BAD)
def test_a_cause_without_meaning_is_one_message(
    old: str, new: str, says: str, folder: Path, known: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    head, mark, tail = known.read_text(encoding="utf-8").rpartition("[[cause]]")
    assert old in mark + tail
    known.write_text(head + (mark + tail).replace(old, new, 1), encoding="utf-8")
    assert compared(folder, "Hot", "--known", str(known)) is Exit.USAGE
    said = " ".join(capsys.readouterr().err.split())
    assert says in said and known.name in said and "Traceback" not in said
