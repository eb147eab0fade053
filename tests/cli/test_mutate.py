"""``rovercheck mutate``: what is said of survivors, counts, exit codes, JSON, and mistakes."""

import json
from collections.abc import Generator
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from rovercheck.checker.cli import run
from rovercheck.checker.commands.mutate import judge as mutating_judging
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.mutate import plan
from rovercheck.checker.mutate.workers import MutantJudged, fates
from tests.cli.test_widths import at_terminal, too_long
from tests.mutate import lamp
from tests.schemas import published

SCHEMA: Any = published("mutate-1")
MODEL = Path(lamp.__file__)
LAMP = ["mutate", "--model", str(MODEL), "--quiet", "--jobs", "2"]

WEAK = """
from rovercheck.properties.forms import always
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.expr import flag
from rovercheck.spec_model.lang.system import in_order

go, out = flag("go"), flag("out")
copying = in_order("copying", Block("Copy", [assign(out, go)]))
REQUIREMENTS = {"R": "It copies."}
P = always("P", "TEXT", that=THAT, covers=["R"], on=copying)
"""


def model(folder: Path, that: str) -> list[str]:
    """The command about a block that copies, with one property."""
    file = folder / "copy_model.py"
    file.write_text(WEAK.replace("THAT", that).replace("TEXT", "It is so."), encoding="utf-8")
    return ["mutate", "--model", str(file), "--quiet", "--jobs", "1"]


def test_a_strong_property_leaves_no_survivor(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(model(tmp_path, "(out & go) | (~out & ~go)")) is Exit.AS_EXPECTED
    said = capsys.readouterr().out
    assert "3 mutants of copying:" in said and "Killers: P 3." in said
    assert "Survivors" not in said


def test_a_weak_property_leaves_survivors(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(model(tmp_path, "~out | go")) is Exit.FAILED
    said = capsys.readouterr().out
    assert "Survived: no property kills the mutant, and a run shows in what it differs (2):" in said
    assert "copy_model.py:9: `out := go` is missing" in said
    assert "tick 1  go = true" in said and "then out is true, in the mutant false" in said
    assert "No property requires: when go = true, then out is true." in said


NOTICED_AT_HOME = """
echo = flag("echo")
echoing = in_order("echoing", *copying.components, Block("Echo", [assign(echo, out)]))
Q = always("Q", "It is echoed.", that=(echo & go) | (~echo & ~go), covers=["R"], on=echoing)
"""


@pytest.mark.usefixtures("no_child")
@pytest.mark.parametrize(("extra", "fates"), [((), {"killed"}), (("--alone",), {"noticed", "survivor"})])
def test_what_only_mends_a_finding_at_home_may_be_killed_elsewhere(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], extra: tuple[str, ...], fates: set[str]
) -> None:
    file = tmp_path / "echo_model.py"
    file.write_text(WEAK.replace("THAT", "~out") + NOTICED_AT_HOME, encoding="utf-8")
    run(["mutate", "--model", str(file), "--part", "Copy", "--quiet", "--json", *extra])
    assert {m["fate"] for m in json.loads(capsys.readouterr().out)["mutants"]} == fates


def on_record(file: Path, inputs: list[dict[str, int]]) -> None:
    """A run of `echoing` that a property killed some mutant with."""
    blocks = [[1, tick] for tick in inputs]
    row = {"system": "echoing", "mutant": "Echo/block/dead", "frozen": {}, "blocks": blocks}
    text = json.dumps({"schema": "rovercheck/kills/1", "runs": {"Q": row}})
    file.with_name("kills.json").write_text(text, encoding="utf-8")


@pytest.fixture
def searched(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The mutants, by id, of which something was searched."""
    found = list[str]()

    def noted(planned: Any, limits: Any, jobs: Any, before: Any, search: bool) -> Any:
        found.extend(one.mutant.id for one in planned if search)
        return fates(planned, limits, jobs, before, search)

    monkeypatch.setattr(mutating_judging, "fates", noted)
    return found


def test_a_run_on_record_of_another_system_kills_before_anything_is_searched(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], searched: list[str]
) -> None:
    file = tmp_path / "echo_model.py"
    file.write_text(WEAK.replace("THAT", "~out | go") + NOTICED_AT_HOME, encoding="utf-8")
    on_record(file, [{"go": 1}, {"go": 0}])
    assert run(["mutate", "--model", str(file), "--part", "Copy", "--quiet", "--json"]) is Exit.AS_EXPECTED
    found = json.loads(capsys.readouterr().out)["mutants"]
    assert {(m["fate"], m["killer"]) for m in found} == {("killed", "P"), ("killed", "Q")}
    assert searched == []


RARE = """
from rovercheck.properties.forms import always
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import flag, ite, var
from rovercheck.spec_model.lang.system import in_order

code, out = var("code", integer(0, 99)), flag("out")
right = var("right", integer(0, 5))
next_one = (code == 10 * right + 7) & (right < 5)
do = [assign(right, ite(next_one, right + 1, 0)), assign(out, right == 5)]
locked = in_order("locked", Block("Lock", do))
REQUIREMENTS = {"R": "It opens."}
P = always("P", "The last number opens it.", that=THAT, covers=["R"], on=locked)
"""
OPENS = "~out | (code == 47)"
OPENED = """
echo = flag("echo")
opened = in_order("opened", *locked.components, Block("Echo", [assign(echo, out)]))
Q = always("Q", "It is echoed.", that=~echo | (code == 47), covers=["R"], on=opened)
"""


@pytest.mark.usefixtures("no_child")
@pytest.mark.parametrize(("text", "on"), [(OPENS, "locked"), ("out | ~out", "opened")])
def test_what_a_search_has_killed_once_needs_none_again(
    text: str, on: str, tmp_path: Path, capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch, searched: list[str],
) -> None:  # fmt: skip
    """Also where it was killed in a system too large to try every mutant in."""
    monkeypatch.setattr(plan, "SMALL", 0)
    file = tmp_path / "lock_model.py"
    file.write_text(RARE.replace("THAT", text) + OPENED, encoding="utf-8")
    command = ["mutate", "--model", str(file), "--part", "Lock", "--record-mutants", "--json"]
    assert run(command) is Exit.FAILED
    first, needed = json.loads(capsys.readouterr().out)["mutants"], set(searched)
    kept = json.loads((tmp_path / "mutants.json").read_text(encoding="utf-8"))
    assert kept["runs"] and kept["runs"].keys() <= needed
    assert {row["system"] for row in kept["runs"].values()} == {on}
    searched.clear()
    assert run(command) is Exit.FAILED
    said = capsys.readouterr()
    again = json.loads(said.out)["mutants"]
    assert not kept["runs"].keys() & set(searched)
    assert "0 runs are recorded that searches found now." in " ".join(said.err.split())
    assert [(m["id"], m["killer"]) for m in again] == [(m["id"], m["killer"]) for m in first]
    assert json.loads((tmp_path / "mutants.json").read_text(encoding="utf-8")) == kept


@pytest.mark.usefixtures("no_child")
def test_runs_of_mutants_that_are_gone_are_dropped(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "lock_model.py"
    file.write_text(RARE.replace("THAT", OPENS), encoding="utf-8")
    row = {"system": "locked", "frozen": {}, "blocks": [[1, {"code": 1}]]}
    rows = {"Lock/block/gone": row, "Door/block/dead": row}
    on_file = {"schema": "rovercheck/mutants/1", "runs": rows}
    (tmp_path / "mutants.json").write_text(json.dumps(on_file), encoding="utf-8")
    command = ["mutate", "--model", str(file), "--quiet", "--record-mutants"]
    assert run(command) is Exit.FAILED
    kept = json.loads((tmp_path / "mutants.json").read_text(encoding="utf-8"))["runs"]
    assert "Lock/block/gone" not in kept and "Door/block/dead" in kept


@pytest.mark.usefixtures("no_child")
def test_what_survives_alone_keeps_its_run_of_another_system(tmp_path: Path) -> None:
    """It was dropped, though properties of that system were not asked."""
    file = tmp_path / "lock_model.py"
    file.write_text(RARE.replace("THAT", "out | ~out") + OPENED, encoding="utf-8")
    command = ["mutate", "--model", str(file), "--part", "Lock", "--quiet", "--record-mutants"]
    run(command)
    before = (tmp_path / "mutants.json").read_text(encoding="utf-8")
    assert json.loads(before)["runs"]
    assert run([*command, "--system", "locked", "--alone"]) is Exit.FAILED
    assert (tmp_path / "mutants.json").read_text(encoding="utf-8") == before


def test_a_file_of_mutants_that_holds_something_else_stays_as_it_is(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "lock_model.py"
    file.write_text(RARE.replace("THAT", OPENS), encoding="utf-8")
    (tmp_path / "mutants.json").write_text("[]", encoding="utf-8")
    assert run(["mutate", "--model", str(file), "--record-mutants"]) is Exit.USAGE
    said = " ".join(capsys.readouterr().err.split())
    assert "mutants.json holds no runs" in said and "`rovercheck mutate --record-mutants` writes it" in said
    assert (tmp_path / "mutants.json").read_text(encoding="utf-8") == "[]"


@pytest.mark.usefixtures("no_child")
def test_what_the_original_breaks_as_well_kills_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Q is expected to be proved, which it is not: that is found out before it counts."""
    file = tmp_path / "echo_model.py"
    wrong = NOTICED_AT_HOME.replace("(echo & go) | (~echo & ~go)", "~echo")
    file.write_text(WEAK.replace("THAT", "go | ~go") + wrong, encoding="utf-8")
    on_record(file, [{"go": 0}])
    run(["mutate", "--model", str(file), "--part", "Copy", "--quiet", "--json"])
    found = json.loads(capsys.readouterr().out)["mutants"]
    assert "killed" not in {m["fate"] for m in found}


def test_the_document_holds_every_mutant(capsys: pytest.CaptureFixture[str]) -> None:
    code = run([*LAMP, "--json", "--sample", "12", "--seed", "3"])
    document = json.loads(capsys.readouterr().out)
    Draft202012Validator.check_schema(SCHEMA)
    Draft202012Validator(SCHEMA).validate(document)
    assert (document["schema"], document["exit"]) == ("rovercheck/mutate/1", int(code))
    assert document["complete"] and document["chosen"] == 12 < document["made"]
    assert len(document["mutants"]) == sum(document["counts"].values()) == 12


@pytest.mark.usefixtures("no_child")
def test_a_seed_draws_the_same_mutants_again(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    command = [*model(tmp_path, "~out | go"), "--sample", "2", "--json"]
    drawn = []
    for seed in ("1", "1", "2", "3", "4"):
        run([*command, "--seed", seed])
        drawn.append([m["id"] for m in json.loads(capsys.readouterr().out)["mutants"]])
    assert drawn[0] == drawn[1] and len({tuple(d) for d in drawn}) > 1


def test_an_interruption_keeps_what_was_found(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*args: Any) -> Generator[Any, None, None]:
        yield from [one for one in fates(*args) if isinstance(one, MutantJudged)][:1]
        raise KeyboardInterrupt

    monkeypatch.setattr(mutating_judging, "fates", interrupted)
    assert run([*model(tmp_path, "(out & go) | (~out & ~go)"), "--json"]) is Exit.INTERRUPTED
    said = capsys.readouterr()
    document = json.loads(said.out)
    Draft202012Validator(SCHEMA).validate(document)
    assert not document["complete"] and len(document["mutants"]) == 1
    assert "Interrupted: 1 of 3 mutants judged." in said.err


def test_alone_asks_only_properties_about_the_system(capsys: pytest.CaptureFixture[str]) -> None:
    """What the relay does is demanded of the relay alone: larger systems need not be asked."""
    command = ["mutate", "--system", "relay", "--quiet", "--jobs", "2", "--alone", "--json"]
    assert run(command) is Exit.AS_EXPECTED
    document = json.loads(capsys.readouterr().out)
    assert {m["killer_system"] for m in document["mutants"] if m["fate"] == "killed"} == {"relay"}
    assert [m["id"] for m in document["mutants"] if m["fate"] == "survivor"] == []
    assert document["counts"]["unknown"] == 0


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (["--system", "relais"], Exit.USAGE, "There is no system 'relais'. Did you mean 'relay'"),
        (["--model", "nowhere.py"], Exit.USAGE, "nowhere.py"),
        (["--sample", "0"], Exit.USAGE, "0"),
        (["--timeout", "nan"], Exit.USAGE, "is not a number"),
        (["--record-kills", "--record-mutants"], Exit.USAGE, "keep different runs; write one of them."),
    ],
)
def test_mistakes_are_told_at_once(
    arguments: list[str], code: Exit, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["mutate", *arguments]) is code
    assert said in capsys.readouterr().err


@pytest.mark.parametrize("columns", [60, 80, 120])
def test_survivors_are_readable_at_any_width(columns: int, tmp_path: Path) -> None:
    seen = at_terminal(columns, *model(tmp_path, "~out | go")).seen
    assert too_long(seen, columns) == []
    assert "No property requires" in seen


@pytest.mark.usefixtures("no_child")
def test_one_part_alone_is_made_faulty(capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*LAMP, "--part", "Alarm", "--json"]) in (Exit.FAILED, Exit.AS_EXPECTED, Exit.INCONCLUSIVE)
    ids = [one["id"] for one in json.loads(capsys.readouterr().out)["mutants"]]
    assert ids and all(id.startswith("Alarm/") for id in ids)


def test_a_part_that_is_not_there_is_told_with_its_neighbours(capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*LAMP, "--part", "Alrm"]) is Exit.USAGE
    assert "There is no chart or block 'Alrm'. Did you mean 'Alarm'?" in capsys.readouterr().err


@pytest.mark.usefixtures("no_child")
def test_each_place_is_shown_with_what_constrains_it(capsys: pytest.CaptureFixture[str]) -> None:
    run([*LAMP, "--by-place"])
    rows = [line.split() for line in capsys.readouterr().out.split("\n\n")[0].splitlines()]
    assert rows[0] == ["place", "faults", "constrained", "by"]
    said = {row[0]: " ".join(row[1:]) for row in rows}
    assert said["Lamp/state/On/entry"] == "2 of 4 killed LIT"
    assert said["Lamp/state/Night/entry"] == "4 of 4 killed LIT, NIGHT"
    assert said["Lamp/arrow/Off.1"] == "0 of 10 killed NO PROPERTY"
    assert said["Lamp/data/lit"] == "no fault -"
