"""``rovercheck export``: files with names and headers that people can read, and clear messages."""

import os
import threading
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.export.run import file_name
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.export import Problem, exporters, problem
from rovercheck.checker.export.names import identifiers, symbols
from rovercheck.properties.catalogue import catalogue
from rovercheck.properties.forms import Always, Property
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Var, flag
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.rover import systems
from tests.export import read_aiger, read_btor2, read_smv
from tests.export.reading import Machine

FORMATS = ["aag", "aiger", "btor2", "promela", "smv"]


def shown(arguments: Sequence[str], capfd: pytest.CaptureFixture[str]) -> tuple[int, str]:
    code = run(["export", *arguments])
    found = capfd.readouterr()
    assert "Traceback" not in found.out + found.err
    return code, " ".join(found.err.split())


def test_every_promised_format_is_there() -> None:
    assert sorted(exporters()) == FORMATS


@pytest.mark.parametrize("format", FORMATS)
def test_a_file_says_where_it_comes_from_and_names_our_variables(format: str, tmp_path: Path) -> None:
    assert run(["export", "PB1-15", "--format", format, "--output", str(tmp_path)]) == Exit.AS_EXPECTED
    [file] = tmp_path.iterdir()
    assert file.name == f"PB1-15{exporters()[format].FORMAT.suffix}"
    text = file.read_bytes().decode(errors="replace")
    for wanted in ("rovercheck", "system: relay", "property PB1-15: With reception", "give_b2_actuation"):
        assert wanted in text
    assert "bad state PB1-15: PB1-15 is violated" in text


@pytest.mark.parametrize("format", FORMATS)
def test_a_file_is_the_same_every_time(format: str) -> None:
    prop = catalogue()["PB1-15"]
    first, second = (exporters()[format].export(problem(lower(systems()["relay"]), prop)) for _ in range(2))
    assert first == second


def test_several_go_to_a_folder_and_what_no_bad_state_says_is_left_out(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    recoverable = next(p for p in catalogue().values() if type(p.form).__name__ == "Recoverable")
    place = tmp_path / "new" / "folder"
    arguments = ["PB1-15", recoverable.id, "--format", "smv", "--output", str(place)]
    code, said = shown(arguments, capfd)
    assert code == Exit.AS_EXPECTED
    assert f"{recoverable.id} is left out" in said and "always a way back" in said
    assert [file.name for file in place.iterdir()] == ["PB1-15.smv"]
    code, said = shown([recoverable.id], capfd)
    assert code == Exit.USAGE and "always a way back" in said


def test_all_properties_of_a_system(tmp_path: Path) -> None:
    arguments = ["export", "--system", "relay", "--format", "btor2", "--output", str(tmp_path)]
    assert run(arguments) == Exit.AS_EXPECTED
    assert {f.stem for f in tmp_path.iterdir()} == {p.id for p in catalogue().values() if p.on == "relay"}


def test_a_variant_is_named_in_the_file(capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["export", "PB1-15", "--interpret", "S43=AND", "--format", "smv"]) == Exit.AS_EXPECTED
    assert "-- variant: under S43=AND" in capfd.readouterr().out


WRONG = [
    (["PB1-111"], "There is no property 'PB1-111'. Did you mean"),
    (["PB1-15", "--format", "aigr"], "There is no export format 'aigr'. Did you mean 'aiger'?"),
    (["PB1-15", "--format", "scxm"], "There is no export format 'scxm'. Did you mean 'scxml'?"),
    (["PB1-15", "--system", "relais"], "There is no system 'relais'. Did you mean 'relay'"),
    (["PB1-15", "--system", "battery"], "Nothing to export"),
    ([], "write the ids of properties, or --system NAME"),
    (["PB1-15", "PB1-11"], "2 properties need a folder"),
    (["PB1-15", "--output", "{here}/missing/file.aig"], "Cannot write {here}/missing/file.aig"),
    (["PB1-15", "PB1-11", "--output", "{here}/file"], "Cannot write {here}/file"),
]


@pytest.mark.parametrize(("arguments", "message"), WRONG, ids=[" ".join(a) or "nothing" for a, _ in WRONG])
def test_a_slip_gets_one_message(
    arguments: list[str], message: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").write_text("in the way")
    code, said = shown([a.replace("{here}", str(tmp_path)) for a in arguments], capfd)
    assert code == Exit.USAGE
    assert message.replace("{here}", str(tmp_path)) in said
    assert [file.name for file in tmp_path.iterdir()] == ["file"]


def test_a_pipe_is_written_to_and_stays_one(tmp_path: Path) -> None:
    pipe, read = tmp_path / "pipe", list[bytes]()
    os.mkfifo(pipe)
    reader = threading.Thread(target=lambda: read.append(pipe.read_bytes()), daemon=True)
    reader.start()
    assert run(["export", "PB1-15", "--format", "btor2", "--output", str(pipe)]) == Exit.AS_EXPECTED
    reader.join()
    assert pipe.is_fifo() and b"system: relay" in read[0]


def test_files_of_different_properties_have_different_names() -> None:
    for exporter in exporters().values():
        names = {file_name(id, exporter).lower() for id in catalogue()}
        assert len(names) == len(catalogue())


def test_what_only_a_loop_breaks_becomes_the_question_for_a_loop() -> None:
    prop = catalogue()["PB1-25"]
    asked = problem(lower(systems()[prop.on]), prop)
    assert asked.bad[0].var.name == f"{prop.id} loop"
    assert asked.bad[0].meaning == f"a loop closes that violates {prop.id}"
    readers: dict[str, Callable[[bytes], Machine]]
    readers = {"aag": read_aiger.read, "btor2": read_btor2.read, "smv": read_smv.read}
    for format in readers:
        text = exporters()[format].export(asked)
        assert isinstance(text, str)
        assert "PB1-25" in readers[format](text.encode()).bad[0].replace("_", "-")


def test_names_are_told_apart() -> None:
    assert identifiers(["a.b", "a b", "a_b", "next", "3x"], {"next"}) == {
        "a.b": "a_b",
        "a b": "a_b_2",
        "a_b": "a_b_3",
        "next": "next_2",
        "3x": "x_3x",
    }
    assert symbols(["a ; b", "a b"]) == {"a ; b": "a_b", "a b": "a_b_2"}


def test_promela_says_that_numbers_are_too_large() -> None:
    x = Var("x", integer(0, 100_000))
    broken = Always(x * x * x < 5)
    prop = Property("BIG", "a cube is small", broken, ("S1",), "big")
    system = lower(systems()["relay"])
    made: Problem = problem(_with(system, x), prop)
    with pytest.raises(ModelError, match="more than 32 bits"):
        exporters()["promela"].export(made)


def _with(system: TransitionSystem, x: Var) -> TransitionSystem:
    return replace(system, inputs=(*system.inputs, x, flag("unused")))
