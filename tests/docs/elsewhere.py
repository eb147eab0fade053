"""What the pages show and the tests do not run as it stands: each with the reason, and what is done instead.

A command that is in no table is run as it is written; a table may not name one that no page shows.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Instead:
    """Why a command is not run as written, and the one that is; None: its words are only understood."""

    because: str
    command: str | None = None


INSTALLS = Instead("fetches packages; `make test` itself runs in an environment that was so installed")
MAKES = Instead("runs everything; the test looks whether the Makefile has the target")
CROSSCHECKS = Instead(
    "20 s and more for a board; tests/compare runs cross-checks, and tests/cli their command line"
)
COVERS = Instead("searches for minutes; tests/cli/test_generate_tests.py runs the command on small charts")
MUTATES = Instead("minutes of searches; tests/cli/test_mutate.py runs the command on small models")
OUTSIDE = Instead("a program that pip does not install; tests/export asks it where there is one")
REVISIONS = Instead("decides all of two revisions; tests/cli/test_diff.py compares those of small models")
CLUSTERS = Instead("needs machines; tests/cli/test_scheduler.py starts a scheduler and workers on this one")
SERVES = Instead("goes on until it is ended; tests/cli/test_serve.py and tests/browser look at it")
PICKS = Instead("the tutorial runs tests of this kind; tests/plugin picks some of them in these ways")

FAULTY = "c:examples/board1_c_faulty,map=examples/board1_c/map.toml"

CHECKED = "rovercheck check --model heater.py"
ACCEPTS = 'rovercheck accept HEAT-3 --model heater.py --because "The valve comes." --owner "A. Rossi"'

IMPORTS = Instead(
    "names files of a user; the page shows two of those in examples/simulink",
    "rovercheck import examples/simulink/1_lamp/lamp.slx",
)

COMMANDS = {
    "rovercheck import MODEL.slx": IMPORTS,
    "rovercheck import supervisor.slx --beside types.sldd --beside parameters.m": IMPORTS,
    "rovercheck import supervisor.slx": IMPORTS,
    "rovercheck robustness --system board1 --impl c:FOLDER": CROSSCHECKS,
    "mkdir tank": INSTALLS,
    "cd tank": INSTALLS,
    "python3 -m venv .venv": INSTALLS,
    ". .venv/bin/activate": INSTALLS,
    "pip install ../rovercheck": INSTALLS,
    ".venv/bin/pip install ../rovercheck": INSTALLS,
    "pip install 'rovercheck[certificates]'": INSTALLS,
    "pip install '../rovercheck[all]'": INSTALLS,
    "pip install 'rovercheck[cluster]'": INSTALLS,
    "dask scheduler": CLUSTERS,
    "dask worker tcp://192.168.0.7:8786 --nthreads 1": CLUSTERS,
    "rovercheck check --scheduler tcp://192.168.0.7:8786": CLUSTERS,
    "rovercheck mutate --system board1 --scheduler tcp://192.168.0.7:8786": CLUSTERS,
    "rovercheck generate-tests --system board1 --scheduler tcp://192.168.0.7:8786": CLUSTERS,
    "rovercheck check-log examples/logs --scheduler tcp://192.168.0.7:8786": CLUSTERS,
    "rovercheck compare --system board1 --profile nightly --scheduler tcp://192.168.0.7:8786": CLUSTERS,
    "make check": Instead(MAKES.because, "rovercheck check PB1-15 PB2-01"),
    "make test": MAKES,
    "make test-full": MAKES,
    "make check-full": MAKES,
    f"{ACCEPTS} --until 2027-03-31": Instead(
        "the day will be over; tests/cli/test_accept.py names one that is not", ACCEPTS
    ),
    "rovercheck compare": CROSSCHECKS,
    "rovercheck compare --system board1 --impl python:mine.py:Board1": CROSSCHECKS,
    "rovercheck compare --system board1 --impl c:supervisor.toml --profile nightly": CROSSCHECKS,
    "rovercheck compare --system board1 --interpret S43=AND": CROSSCHECKS,
    "rovercheck compare --system board1 --impl c:FOLDER": CROSSCHECKS,
    "rovercheck compare --system board1 --impl python:mine.py:Board1 --known known.toml": CROSSCHECKS,
    "rovercheck compare --system board1 --impl c:FOLDER --write-known known.toml": CROSSCHECKS,
    "rovercheck compare --system board1 --impl c:FOLDER --known known.toml": CROSSCHECKS,
    "rovercheck compare --system board1 --impl c:FOLDER --write-variant variant.toml": CROSSCHECKS,
    "rovercheck compare --system board1 --impl c:FOLDER --variant variant.toml": CROSSCHECKS,
    "rovercheck check --variant variant.toml": Instead(
        "a minute of searches; docs/variants.md shows two properties, tests/cli/test_variant_files.py more"
    ),
    "rovercheck compare --system board1 --impl c:examples/board1_c": CROSSCHECKS,
    f"rovercheck compare --system board1 --impl {FAULTY}": CROSSCHECKS,
    "rovercheck accept --from decisions.json": Instead(
        "writes into the record of the rover; tests/cli/test_accept.py takes over decisions of a page"
    ),
    "rovercheck serve": SERVES,
    "rovercheck serve --model heater.py": SERVES,
    "rovercheck doctor": Instead("tests/cli/test_doctor.py puts its questions to every engine"),
    "rovercheck generate-tests": COVERS,
    "rovercheck generate-tests --system board1 --cover transitions --cover pairs": COVERS,
    "rovercheck generate-tests --system Relay --cover boundaries": COVERS,
    "rovercheck generate-tests --format pytest -o tests_b1": COVERS,
    "rovercheck generate-tests --format c -o tests_c": COVERS,
    "rovercheck generate-tests --kept": Instead(
        "tests/cli/test_generate_tests.py writes the kept set of a board"
    ),
    "rovercheck generate-tests --keep FOLDER": COVERS,
    "rovercheck generate-tests --keep checker/testgen/kept": COVERS,
    "rovercheck mutate": MUTATES,
    "rovercheck mutate --system rover": MUTATES,
    "rovercheck mutate --part Relay": MUTATES,
    "rovercheck mutate --system relay --alone": MUTATES,
    "rovercheck mutate --model heater.py": MUTATES,
    "rovercheck mutate --sample 50 --seed 1": MUTATES,
    "rovercheck mutate --system masks --timeout 10": MUTATES,
    "rovercheck mutate --system masks --json": MUTATES,
    "rovercheck mutate --record-mutants": MUTATES,
    "rovercheck simulate SCENARIO.toml -o run.png": Instead(
        "any scenario; tests/cli/test_simulate.py draws the pictures",
        "rovercheck simulate examples/scenarios/link_loss.toml --log logs -o run.csv",
    ),
    "rovercheck simulate INPUTS.csv --model PATH": Instead(
        "a model and a table of one's own; tests/cli/test_simulate_charts.py has some"
    ),
    "rovercheck simulate SCENARIO.toml --log logs": Instead("the line with -o writes the log, too"),
    "rovercheck simulate SCENARIO.toml --no-plot": Instead("any scenario; the first line is run so"),
    "rovercheck simulate examples/scenarios/link_loss.toml": Instead("the line below it runs this scenario"),
    "rovercheck check --model heater.py --watch": Instead(
        "goes on for ever; tests/cli/test_watch.py ends it"
    ),
    "rovercheck check --changed": REVISIONS,
    "rovercheck diff HEAD": REVISIONS,
    "rovercheck report --output review.html": Instead(
        "decides everything; the line with --full below it is run for one property"
    ),
    (
        'rovercheck report --output review.html --pdf review.pdf --reviewer "A. Rossi" '
        '--document "Supervisors, rev. 3"'
    ): Instead("decides everything; tests/cli/test_report_pdf.py prints a page"),
    "rovercheck report --model examples/models/lift --output lift.html": Instead(
        "the tutorial writes the page of a model; the README of this one checks it"
    ),
    "rovercheck report --model heater.py --output review.html": Instead(
        "the tutorial writes the page of a model"
    ),
    "rovercheck report PB1-15 PB1-16 --output relay.html": Instead(
        "8 s: decides the repairs of both, too; the line before it writes the page of one property"
    ),
    "rovercheck report --full --certify --explain --premises --output review.html": Instead(
        "decides everything",
        "rovercheck report PB1-11 --no-repairs --full --certify --explain --premises --output review.html",
    ),
    "rovercheck check --model heater.py --junit rovercheck.xml": Instead(
        "one run with the line below it",
        f"{CHECKED} --junit rovercheck.xml --sarif rovercheck.sarif --annotations github",
    ),
    "rovercheck check --model heater.py --sarif rovercheck.sarif --annotations github": Instead(
        "one run with the line above it"
    ),
    "rovercheck check --junit verdicts.xml --sarif verdicts.sarif --annotations github": Instead(
        "decides everything",
        "rovercheck check PB1-11 --junit verdicts.xml --sarif verdicts.sarif --annotations github",
    ),
    "rovercheck trace PB1-15 --witnesses 3": Instead(
        "35 s; tests/cli/test_trace_kinds.py asks for several runs"
    ),
    "rovercheck trace PB1-15 --witnesses 3 --by reason": Instead(
        "40 s; tests/cli/test_trace_explained.py tells runs of a small chart apart by their reasons"
    ),
    "rovercheck trace --state Relay.B2_actuating": Instead(
        "on the board it takes longer",
        "rovercheck trace --state Relay.B2_actuating --system relay --no-explain",
    ),
    "rovercheck trace PB1-15 --format c -o pb1_15.c": Instead(
        "explained in the run of the format before it",
        "rovercheck trace PB1-15 --format c --no-explain -o pb1_15.c",
    ),
    "rovercheck trace --transition 'Relay: B2_actuating -> B1_actuating'": Instead(
        "12 s; tests/cli/test_trace_kinds.py runs through a transition"
    ),
    r"printf 'step 3\nwhy\n' | rovercheck explore Relay": Instead(
        "a pipe of the shell", "rovercheck explore Relay --script session.txt"
    ),
    r"printf 'step\nnext\nnext 1 2\nreach Relay.B2_actuating\n' | rovercheck explore relay_links": Instead(
        "a pipe of the shell; tests/cli/test_explore.py gives these commands"
    ),
    "cc -std=c99 pb1_15.c your_supervisor.c -lm": Instead(
        "needs a supervisor; tests/render compiles such a file with one"
    ),
    "ROVERCHECK_IMPL=c:FOLDER pytest test_pb1_15.py": Instead(
        "needs a supervisor in C; the line before it runs ours"
    ),
    'berkeley-abc -q "read_aiger PB1-15.aig; fold; pdr"': OUTSIDE,
    'berkeley-abc -q "read_aiger PB1-15.aig; fold; bmc3"': OUTSIDE,
    "spin -a PB1-15.pml && gcc -O2 -DSAFETY -o pan pan.c && ./pan -m1000000": OUTSIDE,
    "nuXmv: read_model -i PB1-15.smv; go; check_invar": OUTSIDE,
    "pytest": Instead("the tutorial runs it, with -q"),
    "pytest -k HEAT-3": PICKS,
    "pytest -k Heater": PICKS,
    "pytest -m \"rovercheck(system='Heater')\"": PICKS,
    "pytest heater.py::HEAT-3": PICKS,
    "pytest -rA": PICKS,
}

BEFORE = {
    "docs/ci.md": ["rovercheck init heater", "cd heater"],
    "docs/compare.md": ["rovercheck init heater", "cd heater"],
    "docs/findings.md": ["rovercheck init heater", "cd heater"],
    "docs/generate-tests.md": ["rovercheck init heater", "cd heater"],
}
"""What a page takes for granted, done before its first command."""

GIVEN = {
    "docs/explore.md": {"session.txt": "step 3\nwhy\n"},
    "docs/ci.md": {"heater/pyproject.toml": '[tool.pytest.ini_options]\nrovercheck_models = ["heater.py"]\n'},
}
"""Files that a page takes for granted."""

MADE = "made by the search that the page speaks of, which takes minutes"
SHOWN = {
    (
        "docs/firmware.md",
        "1. ✗ crash in step 1: firmware.c:43: index 8 out of bounds for type 'uint8_t [8]'",
    ): "tests/robustness plants this fault, and looks at what is told",
    (
        "docs/labels.md",
        "wrong.py:10:61: Oven, transition 1 of Off: `dor_open` is unknown here. Did you mean 'door_open'?",
    ): "tests/model_files/test_statements.py compares what is told",
    (
        "docs/certificates.md",
        "✓ PSY-21a               accepted  proved of counters: 4 obligations by Bitwuzla 0.9.1",
    ): ("tests/cli/test_certify.py has the line"),
    (
        "docs/daily.md",
        "From 3f2a1c09d4 to the working tree: 1 verdict is worse; 2 verdicts are the same.",
    ): "tests/cli/test_diff.py compares what is told of two revisions",
    ("docs/findings.md", '{"schema": "rovercheck/decisions/1",'): (
        "tests/cli/test_accept.py reads decisions that are valid under the schema"
    ),
    ("docs/generate-tests.md", "board1"): MADE,
    ("docs/installation.md", "docker build -t rovercheck ."): (
        "needs Docker; tests/packaging/test_containers.py builds what the Dockerfile does, without it"
    ),
    ("docs/inside.md", "spec_model/         properties/        a user's file"): (
        "a drawing; tests/test_architecture.py has the order of the folders"
    ),
    ("docs/mutate.md", "Relay/default.1/target"): "tests/cli/test_mutate.py has the survivor",
    ("docs/timers.md", "all 425 reachable states of references                                exact"): (
        "three ways to count, of three systems; tests/engines has the texts"
    ),
}
"""Listings that are no command, no file and no program, by page and first line, and why."""

PROGRAMS = {
    ("docs/simulink.md", 'State("Paused", transitions=[to("Cooking", "[~door]")])'): "python",
    ("docs/simulink.md", "from rovercheck import always, implies, simulink_model"): "imports",
    ("docs/adapters.md", "class Supervisor:"): "python",
    ("docs/adapters.md", "import json, sys"): "python",
    ("docs/library.md", "import rovercheck"): "python",
    ("docs/library.md", 'run = rovercheck.trace("heater.py", "HEAT-3")'): "python",
    (
        "docs/library.md",
        "from rovercheck import Chart, State, after, always, assign, flag, implies, model, picture, sec, to",
    ): "python",
    ("docs/compare.md", "from rovercheck.checker.compare import cross_check, effort, quick_check"): "imports",
    (
        "docs/diagnose.md",
        "from rovercheck.checker.conformance.recording import Recording",
    ): "imports",
    ("docs/models.md", "from rovercheck import ("): "model",
}
"""Python of a page: compiled; its imports executed; or read as a model."""
