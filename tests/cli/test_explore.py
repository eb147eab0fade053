"""``rovercheck explore``: a session by script, through a pipe and at a terminal."""

import json
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.explore.run import COMMANDS, named
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.explore.by_hand.value_syntax import RefusedInput
from tests.cli.terminal import Terminal

COMMAND = [sys.executable, "-m", "rovercheck", "explore"]


@pytest.fixture
def told(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    """The exit code and what a script of commands prints."""

    def told(*lines: str, on: str = "Relay") -> tuple[Exit, str, str]:
        script = tmp_path / "script"
        script.write_text("\n".join(lines) + "\n", encoding="utf-8")
        code = run(["explore", on, "--script", str(script)])
        seen = capsys.readouterr()
        return code, seen.out, seen.err

    return told


def test_a_session_shows_what_was_typed_and_what_happened(told) -> None:
    code, seen, said = told(
        "step", "set rx_status=RX_CRITICAL", "until Relay.B2_actuating", "show", "quit", "junk"
    )
    assert (code, said) == (Exit.AS_EXPECTED, "")
    assert "tick 0, 0 ms> step\n" in seen
    assert "▸ Relay: B1_actuating → B2_actuating (transition 1)" in seen
    assert "tick 2, 40 ms> show\ncharts  Relay: B2_actuating\n" in seen
    assert "junk" not in seen, "after quit nothing is read"
    assert max(map(len, seen.splitlines())) <= 80
    assert [line for line in seen.splitlines() if line != line.rstrip()] == []


def test_why_names_the_guard_that_is_false_with_its_values_and_the_timer(told) -> None:
    _, seen, _ = told("set rx_status=RX_CRITICAL", "step 2", "set rx_status=RX_OK", "step 20", "why")
    seen = seen.partition("> why\n")[2]
    assert "✗ B2_actuating → B1_actuating" in seen
    assert "false duration(rx_status != RX_CRITICAL && b2_sup_status !=" in seen
    assert "(rx_status = RX_OK, b2_sup_status =" in seen
    assert "Relay.B2_actuating.duration1 400 ms of > 3 s" in seen


def test_the_session_in_the_document_is_what_one_sees(told) -> None:
    text = (Path(__file__).parents[2] / "docs" / "explore.md").read_text(encoding="utf-8")
    block = text.partition("    $ rovercheck explore Relay\n")[2].partition("\n\n")[0]
    written = [line.removeprefix("    ") for line in block.splitlines()]
    typed = [line.partition("> ")[2] for line in written if line.startswith("tick ")]
    _, seen, _ = told(*typed)
    assert seen.splitlines() == written


def test_all_about_moving(told) -> None:
    code, seen, _ = told(
        "step 3", "back 2", "forward", "goto 0", "ste", "watch rx_status", "break give_b2_actuation",
        "random 3", "run 200", "hold", "show rx_status", "free rx_status", "clear", "forward # a comment", "",
    )  # fmt: skip
    assert code is Exit.USAGE, "there is nothing to go forward to"
    assert "A new branch: 3 ticks after tick 0 forgotten." in seen
    assert "break: give_b2_actuation" in seen
    assert "rx_status = " in seen


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("stepp", "There is no command 'stepp'. Did you mean 'step'"),
        ("f", "may be forward or free or fixed"),
        ("step -1", "no number of ticks"),
        ("step 2 3", "no number of ticks"),
        ("set rx_status", "is no NAME=VALUE"),
        ("set rx_status = RX_OK", "no blanks"),
        ("set rx_statsu=RX_OK", "Did you mean 'rx_status'"),
        ("set rx_status=RX_OKK", "Did you mean 'RX_OK'"),
        ("set give_b2_actuation=true", "There is no input 'give_b2_actuation'"),
        ("set 'rx_status=RX_OK", "quotation mark is not closed"),
        ("until", "Write a condition. Write a state (Relay.B1_actuating), a comparison (rx_status == RX_OK)"),
        ("break rx_status", "neither true nor false"),
        ("until rx_status > 1e999", "has no meaning"),
        ("until Relay.B3", "no state 'B3'"),
        ("goto 4", "There is no tick 4"),
        ("goto x", "number of a tick"),
        ("random x", "is no seed"),
        ("why Monitor", "There is no chart 'Monitor'"),
        ("trace PB9-99", "There is no property 'PB9-99'"),
        ("trace", "Write the ID of a property: trace P"),
        ("fixed a=1", "no frozen variable 'a'"),
        ("save", "Write save FILE"),
        ("help stepp", "There is no command 'stepp'"),
        ("save .", "No format has files like .;"),
        ("save run.xyz", "No format has files like run.xyz"),
        ("save run.xyz junk", "There is no trace format 'junk'"),
    ],
)
def test_the_first_bad_command_of_a_script_ends_it(told, line: str, said: str) -> None:
    code, seen, error = told("step", line, "step")
    assert code is Exit.USAGE
    assert "Line 2, " in error and said in error
    assert seen.count("> step\n") == 1
    assert "Traceback" not in error


def test_saved_runs_are_written_and_the_script_makes_the_run_again(told, tmp_path: Path) -> None:
    first, again, script = (tmp_path / name for name in ("first.json", "again.json", "run.txt"))
    told("random 1", "run 60", f"save {first}", f"save {script}", f"save {tmp_path / 'run.vcd'}")
    told(*script.read_text(encoding="utf-8").splitlines(), f"save {again}")
    assert json.loads(first.read_text("utf-8"))["states"] == json.loads(again.read_text("utf-8"))["states"]
    assert "$enddefinitions" in (tmp_path / "run.vcd").read_text("utf-8")


@pytest.mark.parametrize("file", ["run.html", "run.json", "run.txt"])
def test_before_the_first_tick_there_is_nothing_to_save(told, tmp_path: Path, file: str) -> None:
    code, _, error = told(f"save {tmp_path / file}")
    assert (code, (tmp_path / file).exists()) == (Exit.USAGE, False)
    assert "There is no run before the first tick; write step first." in error


def test_a_run_of_a_board_becomes_a_test(told, tmp_path: Path) -> None:
    target = tmp_path / "test_run.py"
    code, _, error = told("step 3", f"save {target}", on="board1")
    assert (code, error) == (Exit.AS_EXPECTED, "")
    compile(target.read_text(encoding="utf-8"), str(target), "exec")


def test_a_counterexample_is_loaded_and_gone_on_from(told) -> None:
    code, seen, _ = told("trace PB1-15", "goto 7", "set heartbeat_update=false", "step", on="relay")
    assert code is Exit.AS_EXPECTED
    assert "board1: The whole supervisor of Board 1" in seen
    assert "Its run of 8 ticks is loaded" in seen
    assert "tick 7, 140 ms> set heartbeat_update=false" in seen
    assert "A new branch: 1 tick after tick 7 forgotten." in seen


def test_inputs_against_an_assumption_are_refused(told) -> None:
    code, _, error = told("set heartbeat_update=true", on="relay_links")
    assert code is Exit.USAGE
    assert "requires !heartbeat_update || rx_update. Set what belongs together in one line" in error


def test_without_a_name_it_lists_what_there_is(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["explore"]) is Exit.AS_EXPECTED
    seen = capsys.readouterr().out
    assert "Relay, Safety_state" in seen and "rover_no_loss" in seen


def test_a_name_that_is_none(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["explore", "Rela"]) is Exit.USAGE
    assert "There is no chart or system 'Rela'. Did you mean 'Relay'" in capsys.readouterr().err


def test_every_command_has_a_beginning_of_its_own_and_help(told) -> None:
    assert all(meaning for _, _, meaning in COMMANDS.values())
    for name in COMMANDS:
        assert named(name) == name
    assert (named("?"), named("exit"), named("q")) == ("help", "quit", "quit")
    with pytest.raises(RefusedInput, match="may be"):
        named("s")
    _, seen, _ = told("help", "help why")
    assert all(usage in seen for usage, _, _ in COMMANDS.values())


def test_commands_through_a_pipe() -> None:
    done = subprocess.run(
        [*COMMAND, "Relay"],
        input="step\nwho\nstep\n",
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert done.returncode == Exit.USAGE
    assert "\x1b" not in done.stdout + done.stderr
    assert "tick 1, 20 ms> who" in done.stdout and done.stderr.startswith("Line 2, 'who'")


def test_at_a_terminal_a_mistake_is_told_and_ctrl_c_and_ctrl_d_do_what_they_do_elsewhere() -> None:
    with Terminal([*COMMAND, "Relay"]) as terminal:
        terminal.until("tick 0, 0 ms> ")
        terminal.type("who\n")
        terminal.until("There is no command 'who'. Did you mean")
        terminal.until("tick 0, 0 ms> ")
        terminal.type("step 1000")
        terminal.until("step 1000")
        terminal.interrupt("Interrupted; quit or Ctrl-D ends.")
        terminal.until("tick 0, 0 ms> ")
        terminal.type("step\n")
        terminal.until("tick 1, 20 ms> ")
        terminal.type("\x04")
        assert terminal.ended() == Exit.AS_EXPECTED


def test_at_a_terminal_it_ends_when_told_to() -> None:
    with Terminal([*COMMAND, "Relay"]) as terminal:
        terminal.until("tick 0, 0 ms> ")
        terminal.tell(signal.SIGTERM)
        assert terminal.ended() == Exit.INTERRUPTED
        assert terminal.seen.endswith("tick 0, 0 ms> \r\n"), "what follows begins a line"


def test_next_lists_what_can_come_and_takes_it(told) -> None:
    code, seen, err = told("step", "next", "next 1 2", "next all", "next 9", on="relay_links")
    assert code is Exit.USAGE, err
    first = seen.partition("> next\n")[2].partition("tick 1,")[0]
    assert "   1 Monitor_heartbeat: Sup_OK → Sup_DEG\n       [heartbeat_slow]\n" in first
    assert "       by heartbeat_slow = true\n" in first
    assert "2 steps more that keep every state: next all" in first
    taken = seen.partition("> next 1 2\n")[2].partition("tick 2,")[0]
    assert "▸ Monitor_heartbeat: Sup_OK → Sup_DEG" in taken and "▸ Monitor_reception: Rx_OK → Rx_DEG" in taken
    assert "Sup_DEG → Sup_DEG" in seen.partition("> next all\n")[2]
    assert max(map(len, seen.splitlines())) <= 80


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        (("next 99",), "There is no next step 99; write next 1 to next"),
        (("step", "next one"), "There is no next step one"),
        (("step", "next 1 3"), "No inputs lead to Monitor_heartbeat: Sup_OK → Sup_DEG and"),
        (("reach",), "Write a condition."),
        (("reach nowhere",), "There is no variable or state 'nowhere'"),
    ],
)
def test_what_cannot_come_is_refused(told, lines: tuple[str, ...], said: str) -> None:
    code, _, err = told(*lines, on="relay_links")
    assert said in " ".join(err.split()) and code is Exit.USAGE


def test_reach_runs_to_a_condition_or_says_that_there_is_no_run(told) -> None:
    never = "reach Relay.B1_actuating and heartbeat_age > 200"
    code, seen, _ = told("reach Relay.B2_actuating", "step", never, on="relay_links")
    assert code is Exit.AS_EXPECTED
    seen = " ".join(seen.split())
    assert "Reached in 7 ticks by a run that explicit found; none is shorter." in seen
    assert "Never, from here: all" in seen and "reachable states (explicit)." in seen


def test_reach_at_a_terminal_can_be_interrupted_and_the_session_goes_on() -> None:
    with Terminal([*COMMAND, "rover"], lines=60) as terminal:
        terminal.until("tick 0, 0 ms> ")
        terminal.type("next\r")
        terminal.until("next 1 2 takes what two of them do together.")
        terminal.until("tick 0, 0 ms> ")
        terminal.type("reach Relay.B2_actuating && backward_enabled && B2.backward_enabled\r")
        terminal.until("searching")
        terminal.interrupt("Interrupted; quit or Ctrl-D ends.")
        terminal.type("step\r")
        terminal.until("tick 1, 20 ms> ")
        terminal.type("quit\r")
        assert terminal.ended() == 0
