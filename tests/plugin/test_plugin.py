"""Properties as tests of pytest: found, chosen, decided once per system, and told without a traceback."""

import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NoReturn, cast
from xml.etree import ElementTree

import pytest

from rovercheck.checker.commands.shared import verdicts
from rovercheck.checker.commands.trace.explain import ExplanationOptions
from rovercheck.checker.process.faults import Fault, report
from rovercheck.checker.pytest_plugin import decisions
from rovercheck.checker.pytest_plugin.decisions import Decider
from rovercheck.checker.pytest_plugin.item import PropertyItem
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.runs.replay import ReplayError
from rovercheck.spec_model.lang.errors import ModelError
from tests.cli.terminal import Terminal
from tests.model_files.files import BASELINE, HEATER

pytest_plugins = ["pytester"]
PLUGIN = ("-p", "no:rovercheck", "-p", "rovercheck.pytest_plugin", "-p", "no:cacheprovider",
          "-W", "ignore:Module already imported")  # fmt: skip
"""The module itself, whether or not the installed rovercheck has registered it, and imported it."""
NAMES = ("checker", "properties", "spec_model", "supervisor")
"""Our folders: packages of a user's own may have these names."""


@pytest.fixture
def project(pytester: pytest.Pytester) -> pytest.Pytester:
    """A project with a model and a test of its own."""
    pytester.makeini("[pytest]\nrovercheck_models = heater.py\n")
    pytester.makepyfile(heater=HEATER, test_own="def test_own():\n    pass\n")
    (pytester.path / "baseline.toml").write_text(BASELINE)
    return pytester


def collected(project: pytest.Pytester, *arguments: str) -> list[str]:
    """The items that pytest would run."""
    result = project.runpytest_inprocess(*PLUGIN, "--collect-only", "-q", *arguments)
    return [line for line in result.outlines if "::" in line]


OWN, H1, H2, H3 = "test_own.py::test_own", *(f"heater.py::HEAT-{n}" for n in (1, 2, 3))
CHOICES = [
    ("", [OWN, H1, H2, H3]),
    ("test_own.py", [OWN]),
    ("heater.py::HEAT-2", [H2]),
    (".", [H1, H2, H3, OWN]),
    ("-k HEAT-2", [H2]),
    ("-k Heater", [H1, H2, H3]),
    ("-m rovercheck", [H1, H2, H3]),
    ("-m xdist_group", [H1, H2, H3]),
    ("-o rovercheck_models=", [OWN]),
    ("-o rovercheck_models= --rovercheck", [OWN]),
]


@pytest.mark.parametrize(("arguments", "items"), CHOICES)
def test_properties_are_collected(project: pytest.Pytester, arguments: str, items: list[str]) -> None:
    assert collected(project, "--strict-markers", "--strict-config", *arguments.split()) == items


def test_models_are_met_by_their_names_if_wanted(project: pytest.Pytester) -> None:
    (project.path / "heater.py").rename(project.path / "heater_model.py")
    only = ("-o", "rovercheck_models=")
    assert collected(project, *only) == [OWN]
    assert collected(project, *only, "--rovercheck")[:1] == ["heater_model.py::HEAT-1"]


def test_a_folder_is_one_model_and_its_items_are_where_they_are_written(project: pytest.Pytester) -> None:
    lift = Path(__file__).parents[2] / "examples" / "models" / "lift"
    names = collected(project, "-o", f"rovercheck_models={lift}", "--rootdir", str(lift.parent))
    assert [n for n in names if "LIFT" in n] == [f"lift/demands.py::LIFT-{n}" for n in (1, 2, 3, 4)]


def test_the_rover_is_a_model(project: pytest.Pytester) -> None:
    names = collected(project, "-o", "rovercheck_models=rover", "-k", "relay")
    assert "rover::PB1-15" in names and "rover::PSY-09" not in names


def test_a_session_decides_each_system_once_and_leaves_evidence(
    project: pytest.Pytester, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[list[str]] = []
    decide = Decider._decide

    def counted(self: Decider, items: Sequence[PropertyItem]) -> None:
        asked.append([item.name for item in items])
        decide(self, items)

    monkeypatch.setattr(Decider, "_decide", counted)
    (project.path / "heater.py").write_text(HEATER.replace("when=door_open | (", "when=(", 1))
    result = project.runpytest_inprocess(*PLUGIN, "-rA", "--junitxml=j.xml")
    assert asked == [["HEAT-1", "HEAT-2", "HEAT-3"]]
    result.assert_outcomes(passed=3, failed=1)
    told = result.stdout.str()
    assert "HEAT-3 is violated, as expected: Only Pause waits" in told
    failure = told[told.index("HEAT-1 of Heater") : told.index("= PASSES =")]
    assert "HEAT-1 is violated; expected: proved\nWith the door open the heater is off.\n" in failure
    assert "▸ Heater: default → Off" in failure
    assert "in* tick 3 60 ms door_open = true" in " ".join(failure.split())
    assert "rovercheck trace HEAT-1 --model heater.py" in failure
    assert "Error" not in failure and ".py:" not in failure
    cases = {c.get("name"): c for c in ElementTree.parse(project.path / "j.xml").iter("testcase")}
    said = {p.get("name"): p.get("value") for p in cases["HEAT-2"].iter("property")}
    assert (said["verdict"], said["system"], said["requirements"]) == ("proved", "Heater", "R2")
    assert "all 752 reachable states of Heater" in str(said["evidence"])


def test_a_violation_that_is_gone_fails(project: pytest.Pytester) -> None:
    (project.path / "baseline.toml").write_text(BASELINE.replace("HEAT-3", "HEAT-1"))
    result = project.runpytest_inprocess(*PLUGIN, "-k", "HEAT-1")
    result.assert_outcomes(failed=1, deselected=3)
    first, why = "HEAT-1 is proved; expected: violated after 4 ticks", "Expected because: Only Pause*"
    result.stdout.fnmatch_lines([first, "explicit: *", why, "If that is over, delete its entry*"])


def test_what_is_not_decided_fails_with_the_reason(project: pytest.Pytester) -> None:
    limits = ("--rovercheck-engine=bmc", "--rovercheck-depth=3")
    result = project.runpytest_inprocess(*PLUGIN, "heater.py::HEAT-2", *limits)
    result.assert_outcomes(failed=1)
    evidence = "bmc on Heater, no counterexample within 3 ticks: *"
    result.stdout.fnmatch_lines(["HEAT-2 is unknown; expected: proved", evidence])


def test_what_takes_long_is_skipped_unless_wanted(project: pytest.Pytester) -> None:
    text = HEATER.replace("    always,\n", "    always,\n    costly,\n") + "HEAT_2 = costly(HEAT_2)\n"
    (project.path / "heater.py").write_text(text)
    result = project.runpytest_inprocess(*PLUGIN, "heater.py::HEAT-2", "-rs")
    result.assert_outcomes(skipped=1)
    result.stdout.fnmatch_lines(["SKIPPED * it takes long; --rovercheck-full decides it"])
    assert collected(project, "-m", "skip") == [H2]
    assert collected(project, "-m", "skip", "--rovercheck-full") == []


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x = 1 / 0\n", "heater.py:1: ZeroDivisionError: division by zero, in `x = 1 / 0`."),
        (HEATER[: HEATER.index("REQUIREMENTS")], "heater.py holds no property: there is nothing to check. *"),
    ],
)
def test_a_model_without_meaning_is_one_error(project: pytest.Pytester, text: str, message: str) -> None:
    (project.path / "heater.py").write_text(text)
    (project.path / "baseline.toml").unlink()
    result = project.runpytest_inprocess(*PLUGIN)
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["*ERROR collecting heater.py*", message])
    assert "Traceback" not in result.stdout.str()


@pytest.mark.parametrize(
    ("error", "message"),
    [
        (ReplayError("HEAT-1: the run of 3 ticks does not reach the goal."),
         "Internal error: HEAT-1: the run of 3 ticks does not reach the goal."),
        (ZeroDivisionError("of ours"),
         "Internal error: ZeroDivisionError: of ours. This is a bug of rovercheck*; please report it *"),
        (OSError(28, "No space left on device"), "The operating system refuses: *No space left on device. *"),
        (ModelError("heater.py:3: no meaning."), "heater.py:3: no meaning."),
    ],
)  # fmt: skip
def test_an_error_is_one_message(
    project: pytest.Pytester, monkeypatch: pytest.MonkeyPatch, error: Exception, message: str
) -> None:
    def results(*_: object, **__: object) -> NoReturn:
        raise error

    monkeypatch.setattr(decisions, "results", results)
    result = project.runpytest_inprocess(*PLUGIN, "-k", "HEAT-1 or HEAT-2")
    result.assert_outcomes(failed=2, deselected=2)
    result.stdout.fnmatch_lines(["*HEAT-1 of Heater*", message, "*HEAT-2 of Heater*", message])
    assert "Traceback" not in result.stdout.str() and "raise error" not in result.stdout.str()


def test_an_engine_that_fails_is_told_with_the_verdict_of_another(
    project: pytest.Pytester, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = verdicts.results

    def results(*args: Any, **options: Any) -> Iterator[Result]:
        report(Fault("pdr", "Heater", "AssertionError: of ours"))
        yield from real(*args, **options)

    monkeypatch.setattr(decisions, "results", results)
    result = project.runpytest_inprocess(*PLUGIN, "-k", "HEAT-2")
    result.assert_outcomes(failed=1, deselected=3)
    verdict = "HEAT-2 is proved; expected: proved: explicit: all 752 reachable states of Heater*"
    fault = "Internal error: pdr failed on Heater with AssertionError: of ours. *please report it *"
    result.stdout.fnmatch_lines([verdict, fault])


def test_a_verdict_is_told_although_its_explanation_fails(
    project: pytest.Pytester, monkeypatch: pytest.MonkeyPatch
) -> None:
    def explained(*_: object) -> NoReturn:
        raise ReplayError("another run with the same needed inputs ends otherwise.")

    monkeypatch.setattr(ExplanationOptions, "__call__", explained)
    (project.path / "baseline.toml").unlink()
    result = project.runpytest_inprocess(*PLUGIN, "-k", "HEAT-3")
    result.assert_outcomes(failed=1, deselected=3)
    message = "Internal error: another run with the same needed inputs ends otherwise."
    result.stdout.fnmatch_lines(["HEAT-3 is violated; expected: proved", message])
    assert "Traceback" not in result.stdout.str()


@pytest.mark.parametrize(
    "option", ["--rovercheck-engine=expl", "--rovercheck-timeout=0", "--rovercheck-depth=0"]
)
def test_an_option_without_meaning_is_refused(project: pytest.Pytester, option: str) -> None:
    result = project.runpytest_inprocess(*PLUGIN, option)
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines([f"ERROR: {option.partition('=')[0]}*"])


def test_workers_find_the_same_items_whatever_folders_are_called(project: pytest.Pytester) -> None:
    """Python is started where packages of the user's bear our names, and comes across them first."""
    for name in (*NAMES, "reports", "tests"):
        project.mkpydir(name).joinpath("__init__.py").write_text(f"name = 'my {name}'\n")
    imported = "import checker, properties, spec_model, supervisor, tests"
    same = "assert [checker.name, properties.name, spec_model.name, supervisor.name] == "
    mine = str([f"my {name}" for name in NAMES])
    project.makepyfile(test_own=f"{imported}\ndef test_own():\n    {same}{mine}\n")
    result = project.runpytest_subprocess(*PLUGIN, "-n1", "--dist", "loadgroup", "-k", "HEAT-1 or own")
    result.assert_outcomes(passed=2)
    named = project.runpytest_subprocess(*PLUGIN, "--collect-only", "-q", "heater.py::HEAT-2", "test_own.py")
    assert [line for line in named.outlines if "::" in line] == [H2, OWN]


@pytest.mark.parametrize(("grouped", "apart"), [(True, False), (False, True)])
def test_a_worker_decides_a_system_only_if_it_has_all_of_it(grouped: bool, apart: bool) -> None:
    options = {"rovercheck_timeout": 2.0, "rovercheck_depth": None, "rovercheck_engine": "auto"}
    config = SimpleNamespace(
        workerinput={}, option=SimpleNamespace(loadgroup=grouped), getoption=options.__getitem__
    )
    decider = Decider.of(cast(pytest.Config, config))
    assert (decider.apart, decider.jobs) == (apart, 1)


def test_the_plugin_alone_loads_no_solver() -> None:
    heavy = "rovercheck.checker rovercheck.language z3 llvmlite numpy bitwuzla oxidd pysat rich click"
    code = f"import sys, rovercheck.pytest_plugin; print(*set('{heavy}'.split()) & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []


def test_a_terminal_shows_the_lines_of_pytest_whole(project: pytest.Pytester) -> None:
    """With ``-s``, too, where a progress line would be written over the name of the test."""
    (project.path / "baseline.toml").write_text("")
    with Terminal([sys.executable, "-m", "pytest", *PLUGIN, "-s", "-v"]) as terminal:
        assert terminal.ended() == pytest.ExitCode.TESTS_FAILED, terminal.seen
    assert "so far" not in terminal.seen and terminal.clean
    assert {OWN, H1, H2, H3} <= {line.split()[0] for line in terminal.shown() if "::" in line}
