"""``compare --jobs`` and ``--scheduler``: the random runs are tried elsewhere, and say what they say here."""

import json
import shutil
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker.adapters import adapters, carried, moved
from rovercheck.checker.adapters.implementation import ImplementationError
from rovercheck.checker.cli import run
from rovercheck.checker.commands.compare import elsewhere
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.compare import tried_runs
from rovercheck.checker.compare.tried_runs import shares
from rovercheck.checker.extras import CLUSTER
from rovercheck.checker.io.packed_files import PackedFiles
from tests.model_files.files import FIRMWARE, heater_files
from tests.process.cluster import LocalCluster, local_cluster

EXAMPLES = Path(__file__).parents[2] / "examples"
FRAIL = """
import rests.of_heater


class Frail(rests.of_heater.Short):
    "It does not survive what is hot for long."

    def step(self, given):
        self.hot = getattr(self, "hot", 0) + 1 if given["temperature"] > 30 else 0
        if self.hot > 3:
            raise ValueError("too hot")
        return super().step(given)
"""
SHORT = (
    FIRMWARE
    + """

class Short(Hot):
    rest = 249
"""
)


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LocalCluster | None]:
    if not CLUSTER.installed:
        yield None
        return
    with local_cluster(tmp_path_factory.mktemp("cluster"), 2) as made:
        yield made


@pytest.fixture
def ways(cluster: LocalCluster | None, monkeypatch: pytest.MonkeyPatch) -> list[list[str]]:
    """Here, in two processes, and on two workers; a share is of few runs."""
    monkeypatch.setattr(tried_runs, "SHARE", 8)
    there = [] if cluster is None else [["--scheduler", cluster.address]]
    return [[], ["--jobs", "2"], *there]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    heater_files(tmp_path, FRAIL)
    (tmp_path / "rests").mkdir()
    (tmp_path / "rests" / "__init__.py").touch()
    (tmp_path / "rests" / "of_heater.py").write_text(SHORT, encoding="utf-8")
    return tmp_path


def told(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[Exit, Any]:
    code = run(["compare", *arguments, "--mismatches", "0", "--json"])
    return code, json.loads(capsys.readouterr().out)


def test_a_model_and_firmware_with_a_package_beside_it(
    folder: Path, ways: list[list[str]], capsys: pytest.CaptureFixture[str]
) -> None:
    """Deviations, failures and coverage are those of one process."""
    address = f"python:{folder / 'firmware.py'}:Frail"
    asked = ["--model", str(folder / "heater.py"), "--impl", address, "--examples", "30", "-o", str(folder)]
    here, *there = [told(capsys, *asked, "--failures", "4", *way) for way in ways]
    assert here[0] is Exit.FAILED and len(here[1]["results"][0]["failures"]) == 4
    assert here[1]["results"][0]["mismatches"]
    assert all(one == here for one in there)


def test_c_with_its_map_and_header_elsewhere(
    tmp_path: Path, ways: list[list[str]], capsys: pytest.CaptureFixture[str]
) -> None:
    if shutil.which("cc") is None:
        pytest.skip("no C compiler")
    firmware = f"c:{EXAMPLES / 'board1_c_faulty'},map={EXAMPLES / 'board1_c' / 'map.toml'}"
    asked = ["--system", "board1", "--impl", firmware, "--no-causes", "-o", str(tmp_path)]
    here, *there = [told(capsys, *asked, "--examples", "12", *way) for way in ways]
    assert here[0] is Exit.FAILED
    assert all(one == here for one in there)


def test_charts_of_a_variant_are_sent(
    folder: Path, ways: list[list[str]], capsys: pytest.CaptureFixture[str]
) -> None:
    variant = folder / "fw.toml"
    variant.write_text(
        'board = "Heater"\n[[change]]\nkind = "limit"\nchart = "Heater"\n'
        'at = "arrow/On.1 guard"\nfrom = "temperature > 22"\nto = "temperature > 25"\n',
        encoding="utf-8",
    )
    address = f"python:{folder / 'rests' / 'of_heater.py'}:Hot"
    asked = ["--model", str(folder / "heater.py"), "--impl", address, "--variant", str(variant)]
    every = [told(capsys, *asked, "--examples", "20", *way) for way in ways]
    assert every[0][0] is Exit.AS_EXPECTED
    assert all(one == every[0] for one in every)


def test_the_first_share_is_of_the_seed_that_was_asked_for() -> None:
    assert [(s.examples, s.seed) for s in shares(240, 5)] == [(240, 5)]
    many = shares(1000, 5)
    assert [s.examples for s in many] == [240] * 4 + [40]
    assert many[0].seed == 5 and len({s.seed for s in many}) == 5
    assert not shares(0, 5)


PORT = """
from pathlib import Path

from rests.of_heater import Heater

try:
    Path(__file__).with_name("port").open("x").close()
except FileExistsError:
    raise RuntimeError("the port is taken") from None


class OnPort(Heater):
    pass
"""


def test_what_cannot_be_started_twice_leaves_the_random_runs_out(
    folder: Path, ways: list[list[str]], capsys: pytest.CaptureFixture[str]
) -> None:
    """What the fixed runs say is told all the same."""
    (folder / "firmware.py").write_text(PORT, encoding="utf-8")
    address = f"python:{folder / 'firmware.py'}:OnPort"
    asked = ["--model", str(folder / "heater.py"), "--impl", address, "--examples", "20"]
    code, document = told(capsys, *asked, "--jobs", "2")
    assert code is Exit.INCONCLUSIVE
    [fixed, random] = document["results"][0]["tried"]
    assert fixed["tried"] > 0 == random["tried"]
    assert "could not be tried elsewhere" in random["because"] and "the port is taken" in random["because"]


# --- what cannot be sent ---------------------------------------------------------------------------------


def test_a_program_is_of_this_machine(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    asked = ["--model", str(folder / "heater.py"), "--impl", "command:python3 -c pass"]
    assert run(["compare", *asked, "--scheduler", "tcp://127.0.0.1:1"]) is Exit.USAGE
    said = " ".join(capsys.readouterr().err.split())
    assert "command:python3 -c pass is a program of this machine" in said and "--jobs" in said


def test_a_folder_that_is_too_large(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(elsewhere, "MOST_BYTES", 10)
    address = f"python:{folder / 'firmware.py'}:Frail"
    asked = ["--model", str(folder / "heater.py"), "--impl", address, "--scheduler", "tcp://127.0.0.1:1"]
    assert run(["compare", *asked]) is Exit.USAGE
    assert "give it a folder of its own" in " ".join(capsys.readouterr().err.split())


@pytest.mark.skipif(not CLUSTER.installed, reason=CLUSTER.needed("a cluster"))
def test_a_scheduler_that_is_not_there(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    address = f"python:{folder / 'firmware.py'}:Frail"
    asked = ["--model", str(folder / "heater.py"), "--impl", address, "--scheduler", "tcp://127.0.0.1:1"]
    assert run(["compare", *asked]) is Exit.USAGE
    assert "127.0.0.1:1" in capsys.readouterr().err


def test_every_adapter_says_what_is_sent(tmp_path: Path) -> None:
    source, table = tmp_path / "sup.c", tmp_path / "sup.toml"
    for file in (source, table, tmp_path / "sup.h", tmp_path / "own.py"):
        file.touch()
    addresses = {
        "c": f"c:{source}",
        "python": f"python:{tmp_path / 'own.py'}:Own",
        "command": "command:true",
    }
    assert addresses.keys() == adapters().keys()
    there = tmp_path / "there"
    for kind, address in addresses.items():
        if kind == "command":
            with pytest.raises(ImplementationError, match="program of this machine"):
                carried(address)
            continue
        files = PackedFiles.of([], carried(address))
        files.unpacked(there / kind)
        found = moved(address, partial(files.place, folder=there / kind))
        assert str(there) in found and found.startswith(f"{kind}:")
    assert (there / "c" / "0" / "sup.h").is_file() and (there / "c" / "0" / "sup.toml").is_file()
    assert carried("python:rovercheck.supervisor.board1:Board1") == ()
