"""Models of Simulink as models to check: their systems beside recordings, their names, domains, verdicts."""

import csv
from pathlib import Path

import pytest

from rovercheck import check, load, simulink_model, trace
from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.drawn.lower.diagram import lowered_model
from rovercheck.checker.drawn.lower.domains import domains_path, read_domains
from rovercheck.checker.drawn.lower.run import LoweredRun
from rovercheck.checker.model import drawn
from rovercheck.checker.model.two_readings import ReadingDifference, Readings
from rovercheck.checker.results.verdict import Proved, Violated
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.spec_model.lang.domain import Domain, fixed
from rovercheck.spec_model.lang.errors import ModelError
from tests.simulink.samples import SAMPLES, package_of

QUARTERS = fixed(-100, 100, "0.25")
SUMS = fixed(-100_000, 100_000, "0.25")
DOMAINS: dict[str, dict[str, Domain]] = {
    "5_tank": {"probe.level": QUARTERS},
    "6_press": {f"force({n})": QUARTERS for n in (1, 2, 3)} | {"total": SUMS, "Press.acc.s": SUMS},
}


@pytest.mark.parametrize("sample", SAMPLES)
def test_the_systems_of_the_examples_give_what_their_simulations_by_hand_give(sample: str) -> None:
    path = package_of(sample)
    lowered = LoweredRun(lowered_model(read_model(path), path.name, DOMAINS.get(sample)))
    with (path.parent / "io.csv").open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            given = {name: float(value) for name, value in row.items()}
            found = lowered.step(given)
            assert found == {name: given[name] for name in found}, row["step"]


def test_a_model_is_checked_with_the_properties_beside_it(tmp_path: Path) -> None:
    found = check(str(package_of("2_microwave")))
    assert {one.result.property.id: type(one.result.verdict) for one in found} == {
        "OVEN-1": Proved, "OVEN-2": Proved, "OVEN-3": Violated, "OVEN-4": Proved, "OVEN-5": Proved
    }  # fmt: skip
    run_ = tmp_path / "run.html"
    trace(str(package_of("2_microwave")), "OVEN-3").write(str(run_))
    page = run_.read_text(encoding="utf-8")
    assert 'data-state="Cooking.Heat"' in page and "[minutes &gt; 0]" in page


def test_signals_states_and_charts_have_their_names_in_simulink() -> None:
    tank = simulink_model(package_of("5_tank"))
    assert str(tank["probe.level"]) == "probe.level" == str(tank["level"])
    assert str(tank.active("Valve/Opened")) == str(tank.active("Opened")) == "Valve == Opened"
    assert tank.chart("Monitor").name == "Monitor"
    for wrong, said in (
        (lambda: tank["levle"], "no signal 'levle'. Did you mean 'level'?"),
        (lambda: tank.active("Open"), "No chart has a state 'Open'"),
        (lambda: tank.chart("Valv"), "no chart 'Valv'. Did you mean 'Valve'?"),
    ):
        with pytest.raises(ModelError, match=said.replace("?", r"\?")):
            wrong()


def test_a_model_without_properties_says_where_to_write_them(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "--model", str(package_of("1_lamp"))]) == Exit.USAGE
    assert "lamp_properties.py beside it" in " ".join(capsys.readouterr().err.split())
    assert [*load(str(package_of("1_lamp"))).systems] == ["lamp"]


# --- domains -----------------------------------------------------------------------------------------------


def copied(sample: str, folder: Path) -> Path:
    """The package of an example, with what it is read with, in another folder."""
    for file in package_of(sample).parent.iterdir():
        if file.suffix in (".slx", ".sldd", ".m"):
            (folder / file.name).write_bytes(file.read_bytes())
    return folder / package_of(sample).name


def test_what_no_file_says_is_asked_for_and_proposed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = copied("5_tank", tmp_path)
    with pytest.raises(ModelError, match=r"no domain is given for probe\.level"):
        simulink_model(path)
    assert run(["import", str(path)]) == Exit.AS_EXPECTED
    assert "cannot be checked yet: no domain is given for probe.level" in " ".join(
        capsys.readouterr().out.split()
    )
    assert run(["import", str(path), "--propose-domains"]) == Exit.AS_EXPECTED
    text = domains_path(path).read_text(encoding="utf-8")
    assert '"probe.level" = { values = [9.5, 10, 10.5, 12, 12.5, 13, 19.5, 20, 20.5] }' in text
    assert len(simulink_model(path)["probe.level"].domain) == 9  # type: ignore[attr-defined]
    assert run(["import", str(path), "--propose-domains"]) == Exit.AS_EXPECTED, "nothing is left to propose"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[domains]\nlevel = 3", ":2: level: 3 is no domain; write { low = 0"),
        ("[domains]\nlevel = { low = 0 }", ":2: level: it has no ends"),
        ("[domains]\nlevel = { low = 0, hihg = 3 }", "hihg means nothing. Did you mean 'high'?"),
        ("[domains]\nlevel = { values = [] }", "write a list of numbers"),
        ("[domains]\nlevel = { low = 1, high = 0 }", "is empty; write the lower end first"),
        ("[domain]", "domain means nothing. Did you mean 'domains'?"),
        ("domains = 3", "`domains` is a table"),
        ("beside = 3", "`beside` is a list of files"),
        ("step = true", "`step` is a number of seconds"),
        ("= 3", "this is no TOML"),
    ],
)
def test_a_file_of_domains_that_means_nothing_is_told_with_its_line(
    text: str, said: str, tmp_path: Path
) -> None:
    file = tmp_path / "tank.domains.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(ModelError) as raised:
        read_domains(file)
    assert said in str(raised.value)


def test_a_domain_of_nothing_is_told(tmp_path: Path) -> None:
    path = copied("5_tank", tmp_path)
    domains_path(path).write_text('[domains]\n"probe.levle" = { low = 0, high = 9 }', encoding="utf-8")
    with pytest.raises(ModelError, match=r"no domain is given for probe\.level"):
        simulink_model(path)
    both = '[domains]\n"probe.level" = { low = 0, high = 9, resolution = 0.5 }\nlevl = { low = 0, high = 9 }'
    domains_path(path).write_text(both, encoding="utf-8")
    with pytest.raises(ModelError, match="levl is no input and no datum of the model"):
        simulink_model(path)


# --- two readings ------------------------------------------------------------------------------------------


def test_readings_that_differ_are_told_in_place_of_a_model(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = copied("1_lamp", tmp_path)
    wrong = ReadingDifference(3, {"level": (1.0, 2.0)}, (), ("Off to Dim",))
    monkeypatch.setattr(drawn, "compared_readings", lambda *_: Readings(1, 3, wrong))
    with pytest.raises(ModelError, match="differ in tick 3 level is 1 and 2, after Off to Dim"):
        simulink_model(path)


# --- steps without a meaning -------------------------------------------------------------------------------


def test_a_step_without_a_meaning_is_told_in_place_of_a_verdict(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = WrittenModel("guarded")
    block, drawn = model.root.chart("C")
    state = drawn.state("A")
    drawn.data("go", "input", "boolean")
    drawn.transition(None, state, "[go]")
    model.root.line(model.root.inport("go", 1, OutDataTypeStr="boolean"), f"{block}/1")
    path = model.save(tmp_path / "guarded.slx")
    (tmp_path / "guarded_properties.py").write_text(
        "from rovercheck import always, simulink_model\n"
        "m = simulink_model('guarded.slx')\n"
        "P = always('G-1', 'It is on.', that=m.active('A'), covers=['R'], on=m.system)\n",
        encoding="utf-8",
    )
    assert run(["check", "--model", str(path)]) == Exit.USAGE
    said = " ".join(capsys.readouterr().err.split())
    assert "no default transition of C may lead to a state, first in tick 1." in said
    assert "From there on the model has no meaning: change what is drawn." in said


def test_a_time_that_is_no_whole_number_of_steps_is_told(tmp_path: Path) -> None:
    model = WrittenModel("odd", "0.1")
    _, drawn = model.root.chart("C")
    first, second = drawn.state("A"), drawn.state("B")
    drawn.transition(None, first)
    drawn.transition(first, second, "[after(0.25, sec)]")
    drawn.transition(second, first, "[after(0.3, sec)]")
    found = simulink_model(model.save(tmp_path / "odd.slx"))
    assert found.lowered.notes == (
        "after(0.25, sec) in C/A is no whole number of steps: it counts 3 of them.",
    )
    assert found.system.limited_to == ""
