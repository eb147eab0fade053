"""``--scheduler``: what is decided elsewhere is as decided here; a run that is sent is replayed here."""

import gzip
import json
import shutil
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.check_log import at_once as elsewhere_together
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.extras import CLUSTER
from rovercheck.checker.process import cluster as elsewhere
from rovercheck.checker.process.pool import Again, Order, Pool, PoolEvent
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Violated
from rovercheck.checker.verify.search_worker import PropertyDecided, TaskCertificates
from tests.model_files.files import CRITICAL_AT_59_5
from tests.process.cluster import LocalCluster, local_cluster

pytestmark = pytest.mark.skipif(not CLUSTER.installed, reason=CLUSTER.needed("a cluster"))
LAMP = """from rovercheck import *
from words import ON

press, lit = flag("press"), flag("lit")
lamp = Chart("Lamp", [
    State("Off", entry=[assign(lit, False)], transitions=[to(ON, when=press)]),
    State(ON, entry=[assign(lit, True)], transitions=[to("Off", when=press)]),
], default="Off")
LIT = reachable("LIT", "It can be lit.", that=lit, covers=("R1",), on=lamp)
"""
IDS = ["PB1-15", "PB1-11", "PB1-07a", "PB2-32f"]


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LocalCluster]:
    with local_cluster(tmp_path_factory.mktemp("cluster"), 2) as made:
        yield made


def test_the_same_verdicts_as_here(cluster: LocalCluster, capsys: pytest.CaptureFixture[str]) -> None:
    told = []
    for options in ([], ["--scheduler", cluster.address]):
        assert run(["check", *IDS, "--json", *options]) == Exit.AS_EXPECTED
        told.append(json.loads(capsys.readouterr().out)["results"])
    assert {one["id"] for one in told[0]} == {*IDS}
    assert sorted(map(json.dumps, told[0])) == sorted(map(json.dumps, told[1]))


def test_covering_tests_and_mutants_too(
    cluster: LocalCluster, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = Path(__file__).parents[2] / "examples" / "models" / "oven"
    for verb in (
        ["mutate", "--model", str(model), "--sample", "4"],
        ["generate-tests", "--model", str(model)],
    ):
        told = []
        for number, options in enumerate(([], ["--scheduler", cluster.address])):
            more = ["-o", str(tmp_path / f"t{number}")] if verb[0] == "generate-tests" else []
            code = run([*verb, *more, "--json", *options])
            told.append((code, json.loads(capsys.readouterr().out.replace(f"t{number}", "t"))))
        assert told[0] == told[1], verb


VARIANT = 'board = "board1"\n' + CRITICAL_AT_59_5


def test_logs_with_their_map_and_a_variant_too(
    cluster: LocalCluster, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    logs = Path(__file__).parents[2] / "examples" / "logs"
    folder, variant = tmp_path / "logs", tmp_path / "variant.toml"
    folder.mkdir()
    variant.write_text(VARIANT, encoding="utf-8")
    for number in range(elsewhere_together.TOGETHER + 2):
        shutil.copy(logs / "faults.csv", folder / f"faults{number}.csv")
    (folder / "none.csv").write_text("nothing\n", encoding="utf-8")
    told = []
    for options in (["--jobs", "1"], ["--scheduler", cluster.address]):
        asked = [
            "check-log",
            str(folder),
            "--map",
            str(logs / "map.toml"),
            "--variant",
            str(variant),
            "--json",
        ]
        assert run([*asked, *options]) == Exit.FAILED
        told.append(json.loads(capsys.readouterr().out))
    assert len(told[0]["logs"]) == elsewhere_together.TOGETHER + 3
    assert told[0] == told[1]


def test_a_model_of_ones_own_is_sent_with_the_logs(
    cluster: LocalCluster, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model, folder = tmp_path / "lamp.py", tmp_path / "logs"
    folder.mkdir()
    model.write_text(LAMP, encoding="utf-8")
    (tmp_path / "words.py").write_text("ON = 'On'\n", encoding="utf-8")
    (folder / "run.csv").write_text("now_ms,press,lit\n20,0,0\n40,1,1\n60,0,0\n", encoding="utf-8")
    told = []
    for options in ([], ["--scheduler", cluster.address]):
        assert run(["check-log", str(folder), "--model", str(model), "--json", *options]) == Exit.FAILED
        told.append(json.loads(capsys.readouterr().out))
    assert told[0] == told[1]
    assert told[0]["logs"][0]["deviations"]


def test_no_scheduler_and_what_excludes_it(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(elsewhere, "CONNECTED", 0.5)
    assert run(["check", "PB1-15", "--scheduler", "tcp://127.0.0.1:9"]) == Exit.USAGE
    assert "There is no scheduler at tcp://127.0.0.1:9" in capsys.readouterr().err


def test_proofs_that_are_sent_are_certified_and_written_here(
    cluster: LocalCluster, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    proofs = tmp_path / "proofs"
    asked = ["check", "PB1-11", "PB1-07a", "PB1-15", "--certify", "--certificates", str(proofs), "--json"]
    told = []
    for options in ([], ["--scheduler", cluster.address]):
        assert run([*asked, *options]) == Exit.AS_EXPECTED
        told.append(json.loads(capsys.readouterr().out)["results"])
        assert run(["certify", str(proofs)]) == Exit.AS_EXPECTED
        assert "rejected" not in capsys.readouterr().out
        shutil.rmtree(proofs)
    assert [one["certificate"]["outcome"] for one in told[1] if one["verdict"] == "proved"] == [
        "accepted"
    ] * 2
    assert sorted(map(json.dumps, told[0])) == sorted(map(json.dumps, told[1]))


def test_a_proof_that_is_sent_and_shows_nothing_is_rejected_here(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def forging(pool: Pool, orders: Sequence[Order], again: Again) -> Iterator[PoolEvent]:
        for event in replace(pool, size=1).run(orders, again):
            if isinstance(event.message, TaskCertificates):
                document = json.loads(gzip.decompress(event.message.data))
                for one in document["certificates"]:
                    one["invariant"]["nodes"][-1][1:4] = []
                forged = gzip.compress(json.dumps(document).encode())
                event = replace(event, message=TaskCertificates(forged))
            yield event

    monkeypatch.setattr(elsewhere, "carried_out", forging)
    assert run(["check", "PB1-07a", "--certify", "--scheduler", "tcp://anywhere:1"]) == Exit.INTERNAL
    assert "CERTIFICATE REJECTED" in " ".join(capsys.readouterr().out.split())


def test_a_run_that_shows_nothing_here_is_an_internal_error(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def forging(pool: Pool, orders: Sequence[Order], again: Again) -> Iterator[PoolEvent]:
        for event in replace(pool, size=1).run(orders, again):
            match event.message:
                case PropertyDecided(verdict=Violated(Trace() as trace) as found) as said:
                    none = replace(trace, ticks=trace.ticks[:1])
                    event = replace(event, message=replace(said, verdict=replace(found, because=none)))
            yield event

    monkeypatch.setattr(elsewhere, "carried_out", forging)
    assert run(["check", "PB1-15", "--scheduler", "tcp://anywhere:1"]) == Exit.INTERNAL
    said = " ".join(capsys.readouterr().err.split())
    assert "PB1-15: the run that a worker of the cluster found does not show here" in said
