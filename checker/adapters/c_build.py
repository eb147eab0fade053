"""Compiles a C supervisor, and the file between it and us, into one shared object."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from rovercheck.checker.adapters.c_map import CMap
from rovercheck.checker.adapters.c_shim import OWN, shim
from rovercheck.checker.adapters.implementation import ImplementationError
from rovercheck.spec_model.lang.errors import did_you_mean

COMPILERS = ("cc", "gcc", "clang")
LIBRARIES = (".so", ".dylib", ".dll")
SECONDS = 300
"""A compiler that takes longer hangs."""
MOST_LINES = 30
COLUMN = re.compile(r"(?<=[a-zA-Z_0-9]):1(:\d+)?: (?=error|warning|note|undefined)")
"""An entry of the mapping file is one line, whose columns are not those of the file."""
OURS = re.compile(
    rf"{re.escape(OWN)}|In function|some warnings being treated|in expansion of macro 'ROVERCHECK"
)
WARNING = re.compile(r"\bwarning: ")
STRICT = ("implicit-function-declaration", "int-conversion", "incompatible-pointer-types")
PLAIN = ("-fdiagnostics-color=never", "-fmessage-length=0", "-fPIC", "-g", "-O1")


def compiler() -> str | None:
    """The C compiler: ``$CC``, or the first that is there."""
    return next(
        (found for name in (os.environ.get("CC", ""), *COMPILERS) if (found := shutil.which(name))), None
    )


def built(path: Path, c: CMap, folder: Path, more: Sequence[str] = ()) -> tuple[Path, str]:
    """The shared object, made in ``folder``, and what the compiler warned of.

    ``path`` is a C file, a folder of them, or a shared object; ``more`` are flags of its sources.

    Raises ``ImplementationError`` with the words of the compiler.
    """
    cc = compiler()
    if cc is None:
        raise ImplementationError(
            f"c:{path}: there is no C compiler; install one ({', '.join(COMPILERS)}) or name it in the "
            "variable CC."
        )
    code, folders = _code(path, c), _folders(path, c)
    _headers(c, folders)
    made, source, middle = (folder / name for name in ("supervisor.so", OWN, "rovercheck.o"))
    source.write_text(shim(c), encoding="utf-8")
    common = [cc, *PLAIN, *(f"-I{place}" for place in folders)]
    strict = ["-std=gnu11", *(f"-Werror={name}" for name in STRICT)]
    _compile([*common, *strict, "-c", str(source), "-o", str(middle), *c.flags], c.file)
    link = ["-Wall", "-shared", "-o", str(made), str(middle), *code, *_linking(path)]
    return made, _compile([*common, *link, *c.flags, *more, "-lm"], path)


def is_library(path: Path) -> bool:
    """Whether this is a shared object, versioned or not."""
    return any(suffix in LIBRARIES for suffix in path.suffixes)


def _code(path: Path, c: CMap) -> list[str]:
    """The files to compile or to link."""
    if is_library(path):
        return [str(path.resolve())]
    here = path if path.is_dir() else path.parent
    listed = [here / name for name in c.sources] or (sorted(path.glob("*.c")) if path.is_dir() else [path])
    for file in listed:
        if not file.is_file():
            raise ImplementationError(f"{c.file}: sources: there is no file {file}.")
    if not listed:
        raise ImplementationError(f"c:{path}: there is no C file (*.c) in this folder.")
    return [str(file.resolve()) for file in listed]


def _linking(path: Path) -> list[str]:
    """Every symbol must be there, and one of the supervisor is its own even if the C library has it too."""
    if sys.platform == "darwin":
        return []
    found = ["-Wl,--no-undefined", "-Wl,-Bsymbolic"]
    return [*found, f"-Wl,-rpath,{path.resolve().parent}"] if is_library(path) else found


def _folders(path: Path, c: CMap) -> list[Path]:
    """Where headers are looked for."""
    beside = path if path.is_dir() else path.parent
    found = [c.file.parent, *(c.file.parent / name for name in c.include), beside]
    return list(dict.fromkeys(folder.resolve() for folder in found))


def _headers(c: CMap, folders: Sequence[Path]) -> None:
    """Name a header that is nowhere before the compiler does: it does not say which there are."""
    for header in c.header:
        if not (header.startswith("<") or any((folder / header).is_file() for folder in folders)):
            there = [file.name for folder in folders for file in folder.glob("*.h")]
            raise ImplementationError(
                f"{c.file}: header: there is no file {header}. {did_you_mean(header, there)}"
            )


def _compile(command: Sequence[str], what: Path) -> str:
    """What the compiler said.  Raises ``ImplementationError`` if it refuses."""
    try:
        done = subprocess.run(
            command,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=SECONDS,
            stdin=subprocess.DEVNULL,
            env={**os.environ, "LC_ALL": "C"},
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise ImplementationError(f"{what}: the compiler cannot be run: {error}.") from None
    if done.returncode:
        said = _short(done.stderr, MOST_LINES)
        raise ImplementationError(f"{what} cannot be compiled. {Path(command[0]).name} says:\n{said}")
    return _short(done.stderr)


def in_one_line(said: str) -> str:
    """How often a compiler warns, and of what first; the lines after it are all that it says."""
    warnings = [line for line in said.splitlines() if WARNING.search(line)]
    name = Path(compiler() or COMPILERS[0]).name
    if not warnings:
        return f"{name} says more with -v\n{said}"
    first = re.sub(r"^(?:[^:\s]*/)*", "", warnings[0])
    many = f"{len(warnings)} warnings, first: {first}" if len(warnings) > 1 else f"1 warning: {first}"
    return f"{name}: {many}; all that it says with -v\n{said}"


def _short(text: str, most: int | None = None) -> str:
    """What a compiler says, or the beginning: each fault once, and nothing of the lines that we wrote."""
    lines = [COLUMN.sub(": ", line) for line in text.splitlines() if line.strip()]
    again = {n for n, line in enumerate(lines) if ": error: " in line and line in lines[:n]}
    theirs = [line for n, line in enumerate(lines) if n not in again and not OURS.search(line)] or lines
    more = len(theirs) - most if most else 0
    return "\n".join([*theirs[:most], *([f"... and {more} more lines"] if more > 0 else [])])
