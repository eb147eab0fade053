"""What a command loads before it does anything: a user waits for that each time."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from rovercheck.checker.cli import app
from rovercheck.checker.engines import LOADED

LIFT = str(Path(__file__).parents[2] / "examples/models/lift")
RUNS = """
import json, sys
started = set(sys.modules)
from rovercheck.checker.process import isolate
def show(*_):
    print(json.dumps(sorted(sys.modules.keys() - started)), file=sys.stderr)
    raise SystemExit(0)
isolate.Child.order = show  # the first order of a search process
sys.argv[1:] = {arguments}
from rovercheck.__main__ import main
try:
    main()
finally:
    show()
"""
IMPORTS = """
import json, sys
started = set(sys.modules)
import {modules}
print(json.dumps(sorted(sys.modules.keys() - started)), file=sys.stderr)
"""


def loaded(program: str) -> set[str]:
    """The modules that a program has loaded at its end, or when a process is to search."""
    done = subprocess.run(
        [sys.executable, "-c", program], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
        check=True, timeout=60,
    )  # fmt: skip
    [first, *_] = (line for line in done.stderr.splitlines() if line.startswith("["))
    return set(json.loads(first))


def of_others(modules: set[str]) -> set[str]:
    """The packages among them that pip installs, and not Python's own or ours."""
    heads = {m.partition(".")[0] for m in modules if not m.startswith("<")}  # a model is called <...>
    return heads - sys.stdlib_module_names - {"rovercheck"}


LIGHT = [[], ["--version"], ["--help"], ["completion", "bash"], ["nonsense"]]


@pytest.mark.parametrize("arguments", [*LIGHT, *([verb, "--help"] for verb in app.commands)], ids=" ".join)
def test_help_loads_click_alone(arguments: list[str]) -> None:
    """All verbs are there, and nothing of what they do: no model, no engine, no solver."""
    found = loaded(RUNS.format(arguments=arguments))
    told = arguments in ([], ["nonsense"], ["completion", "bash"])  # in words of ours
    wanted = {"click", "rich"} if told else {"click"}
    assert of_others(found) <= wanted
    own = {
        m
        for m in found
        if m.startswith(
            (
                "rovercheck.spec_model.",
                "rovercheck.properties",
                "rovercheck.checker.e",
                "rovercheck.checker.results",
                "rovercheck.checker.verify",
            )
        )
    }
    light = {"checker.engines", "checker.results", "checker.results.exit_code", "spec_model.lang"}
    assert {m.removeprefix("rovercheck.") for m in own} <= light | {"spec_model.lang.errors"}


def test_engines_are_listed_without_loading_one() -> None:
    found = loaded(RUNS.format(arguments=["list", "engines"]))
    assert of_others(found) == {"click", "rich"}
    assert {m for m in found if m.startswith("rovercheck.spec_model.lang.")} == {
        "rovercheck.spec_model.lang.errors"
    }
    assert {m for m in found if m.startswith("rovercheck.checker.engines.explicit.")} == set()


@pytest.mark.parametrize(
    "arguments", [["check", "LIFT-1"], ["trace", "LIFT-3"], ["requirements", "--check"]], ids=" ".join
)
def test_a_search_begins_before_anything_is_loaded_that_searches(arguments: list[str]) -> None:
    """The process that searches loads it, while this one reads the model."""
    found = loaded(RUNS.format(arguments=[*arguments, "--model", LIFT]))
    assert "rovercheck.checker.verify.searches" in found
    assert of_others(found) == {"click", "rich"}
    late = (
        "rovercheck.checker.verify.liveness",
        "rovercheck.checker.certify.c",
        "rovercheck.checker.encode.",
        "rovercheck.spec_model.board",
        "rovercheck.properties.areas",
    )
    assert {m for m in found if m.startswith(late)} == set()


def test_a_mistake_is_told_before_anything_is_loaded_that_searches() -> None:
    found = loaded(RUNS.format(arguments=["check", "LIFT-9", "--model", LIFT]))
    assert of_others(found) == {"click", "rich"}


NEEDS = {
    LOADED: {"numpy", "llvmlite"},
    ("rovercheck.checker.engines.bmc.search",): {"z3"},
    ("rovercheck.checker.engines.kinduction.search",): {"z3", "numpy"},
    ("rovercheck.checker.engines.pdr.search",): {"pysat", "numpy"},
    ("rovercheck.checker.engines.bdd.search",): {"oxidd"},
}
"""What the process of a search loads, and the solvers and libraries that it needs for that."""
HEAVY = {
    "z3",
    "numpy",
    "llvmlite",
    "pysat",
    "oxidd",
    "bitwuzla",
    "networkx",
    "hypothesis",
    "jinja2",
    "rich",
    "click",
}


@pytest.mark.parametrize("modules", NEEDS, ids=" ".join)
def test_a_search_loads_what_its_engine_needs(modules: tuple[str, ...]) -> None:
    assert of_others(loaded(IMPORTS.format(modules=", ".join(modules)))) & HEAVY <= NEEDS[modules]
