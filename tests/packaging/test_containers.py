"""The action, the image and the devcontainer, as far as they can be followed without GitHub and Docker."""

import json
import os
import re
import shutil
import stat
import subprocess
import sys
import tomllib
import zipfile
from fnmatch import fnmatch
from pathlib import Path
from typing import Any

import pytest
from ruamel.yaml import YAML

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.extras import EXTRAS
from tests.packaging.builds import ROOT, project, run_in, wheel_of

DOCKERFILE = (ROOT / "Dockerfile").read_text(encoding="utf-8")


# --- the action --------------------------------------------------------------------------------------


def action() -> dict[str, Any]:
    found: dict[str, Any] = YAML(typ="safe").load((ROOT / "action.yml").read_text(encoding="utf-8"))
    return found


def step(name: str) -> dict[str, Any]:
    [found] = (one for one in action()["runs"]["steps"] if one["name"] == name)
    assert isinstance(found, dict)
    return found


def done(
    name: str, at: Path, values: dict[str, str], env: dict[str, str]
) -> subprocess.CompletedProcess[str]:
    """A step of the action as a runner does it: inputs in its environment, a shell that fails early."""
    one = step(name)
    assert one["shell"] == "bash"
    inputs = {name: given["default"] for name, given in action()["inputs"].items()} | values
    known = {f"inputs.{name}": value for name, value in inputs.items()} | {"github.action_path": str(ROOT)}
    put = {key: known[re.fullmatch(r"\$\{\{ (\S+) }}", text)[1]] for key, text in one["env"].items()}  # type: ignore[index]
    return subprocess.run(
        ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", one["run"]],
        cwd=at, env={**env, **put}, capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip


def test_no_step_puts_what_was_given_into_its_script() -> None:
    """An input that is a command of the shell stays a word."""
    steps = [one for one in action()["runs"]["steps"] if "run" in one]
    assert steps and not any("${{" in one["run"] for one in steps)


@pytest.mark.parametrize(
    ("given", "code", "said"),
    [
        ({"model": "heater.py"}, Exit.AS_EXPECTED, "::notice file=heater.py"),
        (
            {"model": "heater.py", "arguments": "HEAT-3 --sarif found.sarif"},
            Exit.AS_EXPECTED,
            "1 demand: violated.",
        ),
        ({"model": "heater.py", "arguments": ""}, Exit.AS_EXPECTED, "Every verdict is as expected."),
        ({"arguments": "PB2-02b"}, Exit.AS_EXPECTED, "1 demand: proved."),
        ({"model": "nowhere.py"}, Exit.USAGE, "nowhere.py"),
        ({"model": "heater.py", "arguments": "$(touch made) *"}, Exit.USAGE, "$(touch"),
        ({"model": "; touch made"}, Exit.USAGE, "touch made"),
    ],
)
def test_it_checks_what_was_given(given: dict[str, str], code: Exit, said: str, tmp_path: Path) -> None:
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    env = {**os.environ, "PATH": path}
    run_in(tmp_path, "rovercheck", "init", ".", env=env)
    found = done("Check every property", tmp_path, given, env)
    assert found.returncode == code, found.stdout + found.stderr
    assert said in found.stdout + found.stderr
    assert not (tmp_path / "made").exists()
    assert (tmp_path / "found.sarif").exists() == ("found.sarif" in given.get("arguments", ""))


def test_it_installs_from_its_own_checkout_and_extras_that_there_are(tmp_path: Path) -> None:
    """With a pip that only writes down what it was asked for: a real one fetches 100 MB."""
    fake = tmp_path / "bin" / "python"
    fake.parent.mkdir()
    fake.write_text('#!/bin/sh\necho "$@" >> "$ASKED"\n')
    fake.chmod(fake.stat().st_mode | stat.S_IXUSR)
    asked = tmp_path / "asked"
    env = {"PATH": f"{fake.parent}{os.pathsep}{os.environ['PATH']}", "ASKED": str(asked)}
    found = done("Install rovercheck", tmp_path, {"extras": "certificates,plot"}, env)
    assert found.returncode == 0, found.stderr
    listed, itself, extras = asked.read_text().splitlines()
    assert listed.endswith(f"--require-hashes -r {ROOT / 'requirements-core.lock'}")
    assert "--no-deps" in itself and itself.endswith(f" {ROOT}")
    assert extras.endswith("rovercheck[certificates,plot]") and {"certificates", "plot"} <= EXTRAS.keys()
    asked.unlink()
    done("Install rovercheck", tmp_path, {}, env)
    assert len(asked.read_text().splitlines()) == 2


# --- the image ---------------------------------------------------------------------------------------


def instructions() -> list[tuple[str, str]]:
    """The instructions of the Dockerfile, each with what follows."""
    lines = re.sub(r"\\\n", " ", DOCKERFILE).splitlines()
    words = [line.split(maxsplit=1) for line in lines if line and not line.startswith("#")]
    return [(first, rest) for first, rest in words]


def test_the_image_is_built_of_all_that_the_wheel_holds(wheel: Path, tmp_path: Path) -> None:
    """``COPY . .`` copies what .dockerignore leaves; the wheel that is built of that is the usual one."""
    assert ("COPY", ". .") in instructions()
    left = [
        line for line in (ROOT / ".dockerignore").read_text().splitlines() if line and line[0] not in "#*"
    ]
    source = tmp_path / "source"
    for name in run_in(ROOT, "git", "ls-files").splitlines():
        if not any(fnmatch(name.split("/")[0], pattern) for pattern in left):
            (source / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, source / name, follow_symlinks=False)
    (copied,) = (rest.split()[0] for kind, rest in instructions() if kind == "COPY" and rest.endswith("./"))
    assert (source / copied).is_file(), "what is copied first"
    with zipfile.ZipFile(wheel_of(source, tmp_path)) as built, zipfile.ZipFile(wheel) as usual:
        assert sorted(built.namelist()) == sorted(usual.namelist())


def test_the_image_runs_our_program_as_a_user_without_rights() -> None:
    last = dict(instructions())
    [program] = json.loads(last["ENTRYPOINT"])
    assert program in project()["scripts"]
    created = re.search(r"useradd .*?--uid (\d+) (\w+)", DOCKERFILE)
    assert created and created[2] == last["USER"] and int(created[1]) > 0
    assert [kind for kind, _ in instructions()].index("USER") > DOCKERFILE.count("\nFROM")
    bases = {rest.split()[0] for kind, rest in instructions() if kind == "FROM"}
    [version] = {re.fullmatch(r"python:(3\.\d+)-slim", base)[1] for base in bases}  # type: ignore[index]
    assert f"Programming Language :: Python :: {version}" in project()["classifiers"]


def test_the_devcontainer_makes_what_the_makefile_can() -> None:
    found = json.loads((ROOT / ".devcontainer" / "devcontainer.json").read_text(encoding="utf-8"))
    program, target = found["postCreateCommand"].split()
    assert program == "make"
    assert re.search(rf"(?m)^{target}:", (ROOT / "Makefile").read_text(encoding="utf-8"))
    tools = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["dependency-groups"]["dev"]
    assert any(str(one).startswith("ruff") for one in tools)
    assert "charliermarsh.ruff" in found["customizations"]["vscode"]["extensions"]
