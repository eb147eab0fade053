"""Commands that do not answer as they should: one message, which says at which step and what was there."""

import json
import shlex
import sys
from contextlib import closing

import pytest

from rovercheck.checker.adapters import AdapterLimits, start
from rovercheck.checker.adapters.implementation import ImplementationError, run
from rovercheck.spec_model.abstraction import boards

BOARD = boards()["board1"]
AT_REST = BOARD.at_power_up()
LIMITS = AdapterLimits(step=60, start=120, memory=1 << 28)
LOOP = """
import json, os, sys, time
say = lambda text: print(text, flush=True)
for number, line in enumerate(sys.stdin):
    order = json.loads(line)
    {}
"""
ANSWER = """say('{}' if 'reset' in order else '{"v_ref": 0.5}')"""


def command(tmp_path, program):
    file = tmp_path / "program.py"
    file.write_text(program, encoding="utf-8")
    return f"command:{shlex.join([sys.executable, str(file)])}"


def loop(tmp_path, body):
    """A command that does this with each order."""
    return command(tmp_path, LOOP.format(body))


def failure(address, steps=3, limits=LIMITS):
    """What is said about a command that fails within some steps."""
    with pytest.raises(ImplementationError) as caught, closing(start(address, BOARD, limits)) as started:
        run(started, [AT_REST] * steps)
    assert str(caught.value).startswith(f"{address}: ")
    return str(caught.value).removeprefix(f"{address}: ")


def test_the_protocol_is_two_kinds_of_lines(tmp_path):
    """What is written is exactly what the documentation says."""
    log = tmp_path / "log"
    address = loop(tmp_path, f"open({str(log)!r}, 'a').write(line); {ANSWER}")
    with closing(start(address, BOARD, LIMITS)) as started:
        assert started.step({"now_ms": 20, "btn1": True, "x_norm": float("nan")}) == {"v_ref": 0.5}
        started.reset()
    lines = log.read_text().splitlines()
    reset, step = {"reset": True}, {"step": {"now_ms": 20, "btn1": True, "x_norm": "NaN"}}
    assert [json.loads(line) for line in lines] == [reset, step, reset]


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("say('ready')", "at power-up: the process answered 'ready', which is no JSON object."),
        ("say('[1]')", "at power-up: the process answered '[1]', which is JSON but no object."),
        ("say('[' * 100000)", "which is no JSON object"),
        ("say('{\"v_ref\": 1}')", "at power-up: the process answered"),
        ("say('{\"error\": \"no licence\"}')", "at power-up: no licence."),
        (
            "sys.stderr.write('cannot open can0\\n'); sys.exit(7)",
            "ended with status 7 without an answer.\nIts standard error ends with\n  cannot open can0",
        ),
        ("os.close(1); time.sleep(1000)", "at power-up: the process closed its standard output"),
        ("say('x' * 3_000_000)", "more than 1,048,576 bytes without an end of line"),
        ("print(bytearray(1 << 30))", "MemoryError"),
    ],
)  # fmt: skip
def test_trouble_at_power_up(tmp_path, body, said):
    assert said in failure(loop(tmp_path, body))


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        ("{}", "no output was answered"),
        ('{"v_reff": 1}', "the board has no output 'v_reff', which was answered. Did you mean 'v_ref'?"),
        ('{"v_ref": "fast"}', "v_ref = 'fast', which is neither true or false nor a number"),
        ('{"v_ref": null}', "v_ref = 'None', which is neither"),
        ('{"v_ref": [1]}', "v_ref = '[1]', which is neither"),
        ('{"v_ref": 0.', "answered '{\"v_ref\": 0.', which is no JSON object"),
        ('{"error": "overflow"}', "overflow"),
    ],
)
def test_trouble_at_a_step(tmp_path, answer, said):
    body = f"say('{answer}' if number == 2 else '{{}}' if number == 0 else '{{\"v_ref\": 1}}')"
    assert failure(loop(tmp_path, body)).startswith("step 2: ")
    assert said in failure(loop(tmp_path, body))


def test_death_in_the_middle_of_a_line(tmp_path):
    body = f"""
    if number == 3:
        sys.stdout.write('{{"v_ref": 0.'); sys.stdout.flush(); os._exit(3)
    {ANSWER}"""
    expected = "step 3: the process ended with status 3 in the middle of the line '{\"v_ref\": 0.'."
    assert failure(loop(tmp_path, body)) == expected


def test_answers_that_nobody_asked_for(tmp_path):
    """They are found at the next reset at the latest, whether or not they have arrived by then."""
    said = r"said '.*' without being asked|answered .* to the reset"
    twice = f"{ANSWER}; 'step' in order and say('{{\"v_ref\": 0.5}}')"
    started = start(loop(tmp_path, twice), BOARD, LIMITS)
    with closing(started), pytest.raises(ImplementationError, match=said):
        run(started, [AT_REST] * 3)
        started.reset()


def test_silence_that_complains_without_end(tmp_path):
    address = loop(tmp_path, "\n    while True: sys.stderr.write('no route to host ' * 999 + '\\n')")
    said = failure(address, limits=AdapterLimits(step=60, start=2, memory=1 << 28))
    assert said.startswith("at power-up: the process did not answer within 2 s.")
    assert len(said) < 4000


def test_a_command_that_answers_without_reading(tmp_path):
    """Whatever it does not read fills its pipe, which must not stop us."""
    address = command(tmp_path, "import time\nprint('{}', flush=True)\ntime.sleep(1000)")
    assert (
        failure(address, 500, AdapterLimits(step=2, start=60))
        == "step 1: the process did not answer within 2 s."
    )


@pytest.mark.parametrize(
    ("address", "said"),
    [
        ("command:no-such-program --fast", "there is no program 'no-such-program' to run"),
        ("command:'open", "No closing quotation"),
        ("command: ", "there is no command"),
    ],
)
def test_no_command(address, said):
    with pytest.raises(ImplementationError) as caught:
        start(address, BOARD)
    assert said in str(caught.value)
