"""Odd inputs: every planted fault is found with a run that shows it, and none in firmware without one."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from rovercheck.checker.adapters.implementation import ImplementationError, Value
from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.robustness.odd_inputs import odd_runs, odd_values, started_inputs
from rovercheck.checker.robustness.replay import opened
from rovercheck.checker.robustness.rules import RobustnessRules, breaches, is_nonsense, read_rules
from rovercheck.checker.robustness.sanitizers import said_by
from rovercheck.checker.robustness.search import RobustnessSearch
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.abstraction.stamps import CLOCK, NOW
from rovercheck.spec_model.lang.errors import ModelError
from tests.schemas import published

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
BOARD = boards()["board1"]
FILES = ("firmware.c", "firmware.h", "map.toml")
RULES = RobustnessRules(step_seconds=1.5)
PLANTED = {
    "index by an enumeration": (
        "in.cmd < 8U ? in.cmd : 7U",
        "in.cmd",
        "crash",
        "out of bounds",
        "cmd",
        True,
    ),
    "division by zero": (
        "in.charge >= 1.0 &&",
        "in.charge >= 0.0 &&",
        "crash",
        "division by zero|SIGFPE",
        "battery_pct",
        False,
    ),
    "signed overflow": (
        "in.degrees < 1000.0 ? (int32_t)in.degrees",
        "in.degrees < 1e8 ? (int32_t)in.degrees",
        "crash",
        "signed integer overflow",
        "",
        True,
    ),
    "conversion of no number": (
        "in.degrees > -1000.0 && in.degrees < 1000.0 ? (int32_t)in.degrees * 1000 : 0",
        "(int32_t)in.degrees % 1000",
        "crash",
        "outside the range of repr",
        "",
        True,
    ),
    "no number passed on": (
        "usable(in.y) ? in.y * 0.5 : 0.0",
        "in.y * 0.5",
        "no number",
        "v_ref is",
        "y_norm",
        False,
    ),
    "out of range": (
        "usable(in.y) ? in.y * 0.5 : 0.0",
        "in.y < 1e3 && in.y > -1e3 ? in.y * 2 : 0.0",
        "out of range",
        "v_ref is",
        "y_norm",
        False,
    ),
    "no member": (
        "? 7U : cmd",
        "? in.cmd : cmd",
        "out of range",
        "current_action is",
        "cmd",
        False,
    ),
    "endless loop": (
        "if (!(yaw >= -720.0 && yaw <= 720.0))",
        "if (yaw != yaw)",
        "hang",
        "did not answer",
        "current_yaw",
        False,
    ),
    "stack use": (
        "return mask == 0U ? 0 : (int)(mask & 1U) + ones(mask >> 1)",
        "volatile char room[512]; room[0] = 1; return mask == 0U ? 0 : room[0] + ones(mask - 1)",
        "crash",
        "stack-overflow|SIGSEGV",
        "crit_mask_b2",
        False,
    ),
    "a clock that is taken for signed": (
        "uint32_t age = in.now - in.heartbeat",
        "int32_t due = (int32_t)in.heartbeat + 120;\n  uint32_t age = (int32_t)in.now > due ? 121U : 0U",
        "crash",
        "signed integer overflow",
        "",
        True,
    ),
}
"""What is replaced by what; what is found, in which words, by which input; whether sanitizers must see it."""


def written(folder: Path, old: str = "", new: str = "") -> str:
    """The firmware with a fault in it, and its address."""
    for name in FILES:
        text = (HERE / name).read_text(encoding="utf-8")
        if old and name == "firmware.c":
            assert text.count(old) == 1, old
            text = text.replace(old, new)
        (folder / name).write_text(text, encoding="utf-8")
    return f"c:{folder}"


def found(address: str, count: int = 5, *, sanitize: bool = True):
    with opened(address, BOARD, RULES, sanitize=sanitize) as hostile:
        search = RobustnessSearch(BOARD, hostile.implementation, RULES, hostile.logs)
        return hostile, search.run(odd_runs(BOARD, (), count, 1))


@pytest.mark.usefixtures("cc")
@pytest.mark.parametrize("fault", PLANTED)
def test_every_planted_fault_is_found_in_a_short_run(fault, tmp_path):
    old, new, kind, words, shown, needs = PLANTED[fault]
    hostile, result = found(written(tmp_path, old, new))
    if needs and hostile.sanitized.missing:
        pytest.skip(hostile.sanitized.missing)
    hits = [
        f
        for f in result.findings
        if f.breach.kind == kind and any(word in f.breach.says for word in words.split("|"))
    ]
    assert hits, [(f.breach.kind, f.breach.says) for f in result.findings]
    assert all(len(f.inputs) <= 3 for f in hits), "runs are short"
    assert any(set(m) <= {shown, NOW} for f in hits for m in f.moments if m) or not shown
    others = {f.breach.kind for f in result.findings} - {kind}
    assert others <= ({"out of range"} if kind == "no number" else set()), "nothing else is wrong"


def test_a_full_stack_is_one_finding_wherever_it_is_full(tmp_path):
    """The line differs with the addresses of a process; once two findings, one of them not shortened."""
    again = "".join(f"    #{n} 0x7f in {f} /x/y.c:{n % 3}\n" for n, f in enumerate(["a", "b"] * 3))
    for leaf in ("    #9 0x7f in leaf /x/y.c:7\n", ""):
        for calls, said in (
            (again, "a, b, which call each other"),
            (again.replace(" b ", " a "), "a, which calls itself"),
        ):
            text = f"==1==ERROR: AddressSanitizer: stack-overflow on address\n{leaf}{calls}\n"
            summary = f"SUMMARY: AddressSanitizer: stack-overflow /x/y.c:{len(leaf)} in a\n"
            (tmp_path / "found.1").write_text(text + summary, encoding="utf-8")
            assert said_by(tmp_path, "") == ("y.c", f"stack-overflow in {said}")
    (tmp_path / "found.1").write_text(summary, encoding="utf-8")
    assert said_by(tmp_path, "") == ("y.c:0", "stack-overflow"), "a large array: no function twice"


@pytest.mark.usefixtures("cc")
def test_nothing_is_found_where_nothing_is_planted(tmp_path):
    for address in (written(tmp_path), f"c:{ROOT}/examples/board1_c"):
        _, result = found(address, 40)
        assert result.findings == [] and result.runs > 150 and result.compared


@pytest.mark.usefixtures("cc")
def test_a_finding_is_a_test_that_fails_until_it_is_repaired(tmp_path, capsys):
    old, new, *_ = PLANTED["no number passed on"]
    folder = tmp_path / "firmware"
    folder.mkdir()
    address = written(folder, old, new)
    code = run(
        ["robustness", "--system", "board1", "--impl", address, "--runs", "0", "-o", str(tmp_path / "t")]
    )
    said = capsys.readouterr().out
    assert code is Exit.FAILED and "no number in step 1: v_ref is" in said and "y_norm = nan" in said
    tests = sorted((tmp_path / "t").glob("robustness_board1_*.py"))
    assert tests and all(f"pytest {test}" in said for test in tests)

    def passed() -> int:
        command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *map(str, tests)]
        return subprocess.run(command, capture_output=True, cwd=ROOT, check=False).returncode

    assert passed() == 1
    written(folder)
    assert passed() == 0


@pytest.mark.usefixtures("cc")
def test_what_is_found_as_json(tmp_path, capsys):
    old, new, *_ = PLANTED["no number passed on"]
    address, place = written(tmp_path, old, new), tmp_path / "t"
    command = ["robustness", "--system", "board1", "--impl", address, "--runs", "0", "-o", str(place)]
    assert run([*command, "--json"]) is Exit.FAILED
    told = json.loads(capsys.readouterr().out)
    Draft202012Validator(published("robustness-1")).validate(told)
    [one] = [row for row in told["findings"] if row["kind"] == "no number"]
    assert one["where"] == "v_ref" and one["inputs"][-1]["inputs"]["y_norm"] == "nan"
    assert Path(one["test"]).parent == place and told["exit"] == 1 and "v_ref" in told["judged"]


@pytest.mark.usefixtures("cc")
def test_without_sanitizers_that_is_said(tmp_path, capsys):
    command = [
        "robustness",
        "--system",
        "board1",
        "--impl",
        written(tmp_path),
        "--runs",
        "0",
        "--no-sanitizers",
    ]
    assert run(command) is Exit.AS_EXPECTED
    assert "without sanitizers (not asked for)" in capsys.readouterr().out


@pytest.mark.usefixtures("cc")
def test_what_nonsense_must_lead_to(tmp_path, capsys):
    rules = tmp_path / "rules.toml"
    rules.write_text(
        '[[nonsense]]\ninputs = ["y_norm", "cmd"]\nsteps = 2\n'
        'required = ["actuate_emergency_stop = true", "rover_safety_state = SAFETY_CRITICAL"]\n',
        encoding="utf-8",
    )
    address = written(tmp_path)
    command = ["robustness", "--system", "board1", "--runs", "5", "--rules", str(rules), "--impl"]
    assert run([*command, address]) is Exit.AS_EXPECTED
    address = written(tmp_path, "|| in.cmd > 7U", "")
    capsys.readouterr()
    assert run([*command, address]) is Exit.FAILED
    assert "nonsense in step" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("x = [", "are no TOML"),
        ("finit = true", "'finit' has no meaning here"),
        ("step_seconds = 0", "no number above 0"),
        ("[ranges]\nv_reff = [0, 1]", "no output 'v_reff'"),
        ("[ranges]\nv_ref = [0]", "write [LOWEST, HIGHEST]"),
        ('[[nonsense]]\ninputs = ["y"]\nrequired = ["v_ref = 0"]', "no input 'y'"),
        ('[[nonsense]]\ninputs = ["y_norm"]\nrequired = ["v_ref = x"]', "is no value of v_ref"),
        ('[[nonsense]]\ninputs = ["y_norm"]', "required is missing"),
    ],
)
def test_rules_without_meaning(text, said, tmp_path):
    (tmp_path / "rules.toml").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError, match=r".*") as error:
        read_rules(tmp_path / "rules.toml", BOARD)
    assert said in str(error.value)


def test_mistakes_on_the_command_line(tmp_path, capsys):
    for arguments, said in (
        (["--impl", "c:nowhere"], "Of which board is it?"),
        (["--impl", "c:nowhere", "--system", "board1"], "there is no nowhere"),
        (["--impl", "c:nowhere", "--system", "board9"], "No board 'board9'"),
        (["--impl", "c:x", "--system", "board1", "--rules", str(tmp_path / "no")], "cannot be read"),
    ):
        assert run(["robustness", *arguments]) is Exit.USAGE
        assert said in " ".join(capsys.readouterr().err.split())


class Answers:
    """An implementation that gives what a test wants, or fails."""

    def __init__(self, of):
        self._of = of

    def reset(self):
        pass

    def step(self, inputs):
        return self._of(inputs)

    def close(self):
        pass


def test_a_run_is_as_short_as_it_can_be():
    def of(inputs):
        if inputs["btn1"] == 2 and inputs["cmd"] == 255 and inputs[NOW] > 60:
            raise ImplementationError("x: step 1: the process was ended by SIGSEGV.", 1)
        return {"v_ref": 0.0}

    search = RobustnessSearch(BOARD, Answers(of), RULES)
    moments: tuple[dict[str, Value], ...] = tuple(
        {"btn1": 2 if n == 3 else False, "cmd": 255 if n > 2 else 0, "btn2": 255} for n in range(30)
    )
    result = search.run([("a run", 0, ({}, *moments))])
    [one] = result.findings
    assert one.breach.kind == "crash" and len(one.moments) <= 6
    assert all(set(m) <= {"btn1", "cmd"} for m in one.moments)


def test_rows_and_values():
    names = {s.name: s for s in BOARD.inputs}
    assert all(is_nonsense(names["cmd"], v) for v in odd_values(names["cmd"]))
    assert not is_nonsense(names["temperature_degC"], 20)
    rows = started_inputs(BOARD, [{}, {NOW: 0}, {NOW: -1000}], CLOCK - 10)
    assert [r[NOW] for r in rows] == [10, 10, CLOCK - 990]
    [wrong] = breaches(BOARD, RULES, [rows[0]], [{"current_action": 8, "v_ref": -1.0000000001}])
    assert wrong.says.startswith("current_action is 8, outside")
