"""``rovercheck doctor``: what is installed, what is missing and would add, and whether it works."""

import os
import platform
import shutil
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from time import monotonic
from typing import Literal

from rich.table import Table
from rich.text import Text

from rovercheck.checker.commands.doctor.sizes import installation, shown, size
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.output import counted, out
from rovercheck.checker.commands.shared.tables import laid
from rovercheck.checker.extras import EXTRAS
from rovercheck.checker.io.printable import json_text
from rovercheck.checker.process.faults import Fault, listening
from rovercheck.properties.forms import Property, always
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import flag, ite, var
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.lang.words import minimum

TRIAL_DEPTH = 20
"""How many ticks of its question an engine without a proof must have seen."""
TRIAL_SECONDS = 60.0
"""What each engine may take for its question; a tenth of a second is usual."""

REQUIRED = {
    "annotated-types": "what the fields of JSON documents hold",
    "click": "the command line",
    "hypothesis": "random runs of compare",
    "jinja2": "HTML pages",
    "junitparser": "JUnit files",
    "lark": "labels of charts as text",
    "llvmlite": "the engine explicit, which compiles charts",
    "markupsafe": "HTML pages, escaped",
    "networkx": "state graphs",
    "numpy": "the engine explicit",
    "oxidd": "the engine bdd",
    "pytest": "the pytest plugin, tests that are written",
    "python-sat": "the engine pdr, reasons of traces",
    "pyvcd": "VCD files",
    "rich": "tables and colours in the terminal",
    "tomlkit": "accept, which writes into a baseline",
    "typing-extensions": "records of JSON documents",
    "watchfiles": "check --watch and serve see that a model is saved",
    "z3-solver": "the engines bmc, kinduction and localisation",
}
"""Packages that rovercheck cannot do without, and what for."""

OPTIONAL = {
    **{one.package: f"{one.adds}: {one.command}" for one in EXTRAS.values()},
    "cvc5": "a third opinion on exported formulas, in our tests: pip install cvc5",
    "playwright": "pages tried in a browser, in our tests: pip install playwright",
}
"""Packages that add something, and what, with the command that installs them."""

PROGRAMS = {
    "cc, gcc, clang": "supervisors in C (compare --impl c:FOLDER): apt install gcc",
    "chromium, chromium-browser, google-chrome": "pages tried in a browser, in tests: apt install chromium",
    "berkeley-abc": "a judge of export --format aiger, in our tests: apt install berkeley-abc",
    "spin": "a judge of export --format promela, in our tests: apt install spin",
    "gtkwave": "a viewer for trace --format vcd or gtkw: apt install gtkwave",
}
"""Programs that add something; the first of each list that is found counts."""


FindingKind = Literal["package", "machine", "program", "trial"]


@dataclass(frozen=True)
class DoctorFinding:
    """One thing looked at: what it is, what was found, and whether it is as needed.

    ``required`` says whether rovercheck works without it, ``adds`` what it is for or how to get it,
    ``bytes`` how much a package takes on the disk.
    """

    kind: FindingKind
    name: str
    found: str
    ok: bool
    required: bool
    adds: str = ""
    bytes: int = 0


def doctor(as_json: bool, quiet: bool = False) -> Exit:
    """Look at everything, and say it, or with ``quiet`` only what is missing or does not work.

    Exit code 1 if something required is among that.
    """
    found = list(findings())
    broken = [f for f in found if f.required and not f.ok]
    if as_json:
        from rovercheck.checker.commands.doctor.document import document

        print(json_text(document(found, not broken), ascii=True))
    else:
        _print_findings([f for f in found if not (quiet and f.ok)], broken)
    return Exit.FAILED if broken else Exit.AS_EXPECTED


def findings() -> Iterator[DoctorFinding]:
    """Everything there is to look at, the quick things first."""
    yield _python()
    yield _installation()
    yield from (_package(name, adds, True) for name, adds in REQUIRED.items())
    yield from _machine()
    yield _cache()
    yield _verdicts()
    yield from (_package(name, adds, False) for name, adds in OPTIONAL.items())
    yield from (_program(names, adds) for names, adds in PROGRAMS.items())
    yield from _trials()


def _python() -> DoctorFinding:
    ok = sys.version_info >= (3, 11)
    return DoctorFinding("package", "Python", platform.python_version(), ok, True, "3.11 or newer")


def _installation() -> DoctorFinding:
    try:
        found = version("rovercheck")
    except PackageNotFoundError:  # run from a folder of sources, beside its packages
        return DoctorFinding("package", "rovercheck", "not installed", True, False, "run from its sources")
    room = installation("rovercheck")
    return DoctorFinding("package", "rovercheck", found, True, True, "with all that it requires", room)


def _package(name: str, adds: str, required: bool) -> DoctorFinding:
    try:
        return DoctorFinding("package", name, version(name), True, required, adds, size(name))
    except PackageNotFoundError:
        there = find_spec(name) is not None
        return DoctorFinding(
            "package", name, "of unknown version" if there else "missing", there, required, adds
        )


def _program(names: str, adds: str) -> DoctorFinding:
    places = filter(None, map(shutil.which, names.split(", ")))
    place = next(places, "")
    return DoctorFinding("program", names.partition(",")[0], place or "missing", bool(place), False, adds)


def _machine() -> Iterator[DoctorFinding]:
    from rovercheck.checker.process.pool import cores

    yield DoctorFinding(
        "machine", "processors", str(cores()), True, True, "searches at a time, unless --jobs says"
    )
    total, free = memory()
    shown = f"{total / 2**30:.1f} GiB, {free / 2**30:.1f} GiB free" if total else "unknown"
    adds = "check --memory says how much each search may take"
    yield DoctorFinding("machine", "memory", shown, not total or free >= 2**30, False, adds)


def memory(table: Path = Path("/proc/meminfo")) -> tuple[int, int]:
    """Bytes there are and bytes that are free, 0 and 0 where the system does not say."""
    try:
        lines = table.read_text(encoding="ascii").splitlines()
        sizes = {line.partition(":")[0]: int(line.split()[1]) * 1024 for line in lines}
        return sizes["MemTotal"], sizes["MemAvailable"]
    except (OSError, ValueError, KeyError, IndexError):
        return 0, 0


def _cache() -> DoctorFinding:
    from rovercheck.checker import cache

    adds = f"compiled searches; ${cache.VARIABLE} says where, and deleting them is always safe"
    try:
        place, secret = cache.chosen(), cache.secret_place()
    except OSError as error:
        off = "" in (os.environ.get(cache.VARIABLE), os.environ.get(cache.SECRET))
        return DoctorFinding("machine", "cache", f"none: {error}", off, False, adds)
    files = list(place.glob(f"*{cache.ENDING}")) if place.is_dir() else []
    size = sum(p.stat().st_size for p in files if p.is_file())
    shown = f"{place}: {counted(len(files), 'file', 'files')}, {size / 2**20:.1f} MiB; sealed with {secret}"
    wrong = _wrong_with_the_cache(place, secret)
    return DoctorFinding("machine", "cache", f"{shown}; {wrong}" if wrong else shown, not wrong, False, adds)


def _verdicts() -> DoctorFinding:
    """Whether verdicts are kept, and how many; what is wrong with the cache is said there."""
    from rovercheck.checker import cache
    from rovercheck.checker.cache.places import STORE

    adds = f"not decided again; ${STORE}= (empty) keeps none, check --recheck believes none"
    if os.environ.get(STORE) == "":
        return DoctorFinding("machine", "verdicts kept", f"none: ${STORE} is empty", True, False, adds)
    try:
        files = [p for p in cache.chosen().glob(f"*-verdict-json{cache.ENDING}") if p.is_file()]
    except OSError:
        return DoctorFinding("machine", "verdicts kept", "none: there is no cache", True, False, adds)
    size = sum(p.stat().st_size for p in files)
    shown = f"{counted(len(files), 'entry', 'entries')}, {size / 2**20:.1f} MiB"
    return DoctorFinding("machine", "verdicts kept", shown, True, False, adds)


def _wrong_with_the_cache(place: Path, secret: Path) -> str:
    """Why the cache is not used, as far as that is seen without making anything; empty if it is."""
    from rovercheck.checker import cache

    try:
        if place.exists():
            cache.usable(place, make=False)
        cache.secret(place, make=False)
    except FileNotFoundError:
        pass  # it is made when the first search is kept
    except OSError as error:
        return f"not used: {error}"
    for needed in (place, secret.parent if not secret.exists() else place):
        if not os.access(next(p for p in (needed, *needed.parents) if p.exists()), os.W_OK):
            return f"{needed} is not writable"
    return ""


def _trials() -> Iterator[DoctorFinding]:
    """The smallest questions there are, put to every engine."""
    from rovercheck.checker.engines import engines

    for name in engines():
        yield _trial(f"engine {name}", partial(tried, name))


def _trial(name: str, work: Callable[[], str]) -> DoctorFinding:
    start = monotonic()
    faults: list[Fault] = []
    try:
        with listening(faults.append):
            said = work()
        said = faults[0].error if faults else said
        ok = not said
    except Exception as error:  # whatever it is, it is what the user wants to know
        said, ok = f"{type(error).__name__}: {error}", False
    shown = f"works, {monotonic() - start:.1f} s" if ok else said
    return DoctorFinding("trial", name, shown, ok, True, "decides a toy that is true and one that is false")


def tried(engine: str) -> str:
    """What is wrong with the answers of an engine to two questions with known answers; empty if nothing."""
    from rovercheck.checker.engines import Limits, engines
    from rovercheck.checker.results.verdict import Proved, Unknown
    from rovercheck.checker.verify.decide import Task, decide

    system = toy()
    task = Task(system, properties())
    found = {
        r.property.id: r.verdict
        for r in decide(task, {system.name: system}, engine, Limits(TRIAL_DEPTH, TRIAL_SECONDS))
    }
    if found["false"].word != "violated":
        return f"says {found['false'].word} of what is violated in the third tick"
    match found["true"]:
        case Proved():
            return ""
        case Unknown(_, depth) if depth == TRIAL_DEPTH or getattr(engines()[engine], "SAMPLES", False):
            return ""  # as deep as it was asked to look, which is all that bmc can do, or at some runs only
        case other:
            return f"says {other.word} of what is true"


def toy() -> System:
    """Counts up to three while asked to."""
    more, count = flag("more"), var("count", integer(0, 3))
    return in_order("toy", Block("Counting", [assign(count, ite(more, minimum(count + 1, 3), 0))]))


def properties() -> tuple[Property, Property]:
    """One that is true of the toy, and one that is false."""
    count = toy().written["count"]
    covers = ("that all works",)
    return (
        always("true", "The count stays below four.", that=count <= 3, covers=covers, on="toy"),
        always("false", "The count stays below three.", that=count < 3, covers=covers, on="toy"),
    )


def _print_findings(found: Sequence[DoctorFinding], broken: Sequence[DoctorFinding]) -> None:
    titles = {
        "package": "Packages",
        "machine": "This machine",
        "program": "Programs",
        "trial": "A question with a known answer, put to every engine",
    }
    there = {one.kind for one in found}
    for kind, title in titles.items():
        if kind not in there:
            continue
        out.print(title, style="bold")
        table = Table.grid(padding=(0, 1))
        table.add_column(width=1)
        table.add_column(no_wrap=True)
        table.add_column(ratio=1)
        for one in (f for f in found if f.kind == kind):
            table.add_row(_mark(one), one.name, _shown(one))
        laid(out, table)
    missing = [f for f in found if not f.ok and not f.required]
    if broken:
        out.print(f"Broken: {', '.join(f.name for f in broken)}.", style="bold red", markup=False)
    else:
        extra = (
            f" {counted(len(missing), 'optional part is', 'optional parts are')} missing." if missing else ""
        )
        out.print(f"All that is required works.{extra}", style="bold", markup=False)


def _mark(one: DoctorFinding) -> Text:
    if one.ok:
        return Text("✓", style="green")
    return Text("✗", style="bold red") if one.required else Text("–", style="yellow")


def _shown(one: DoctorFinding) -> Text:
    adds = one.adds.partition(": ")[0] if one.ok else one.adds
    room = f", {shown(one.bytes)}" if one.bytes else ""
    told = one.found if one.kind == "trial" else f"{one.found}{room}; {adds}"
    return Text(told, style="" if one.ok else "bold red" if one.required else "yellow")
