"""Files of certificates: one for each search, written whole or not at all, and read with suspicion."""

import gzip
import json
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from rovercheck.checker.certify.certificate import Certificate, certificate, document
from rovercheck.checker.certify.terms import Malformed
from rovercheck.checker.io.files import replaced

SCHEMA = "rovercheck/certificate/1"
LARGE = 1 << 17
"""Bytes from which on a file is compressed."""


@dataclass(frozen=True)
class CertificateOrigin:
    """Where the questions come from: what to check again to ask them again.

    ``proved`` are those of the searched ``properties`` whose verdicts rest on the certificates; the others
    were decided by runs, or not.  The rest says how the system is changed, and how ``timers`` were searched:
    ``changes`` are those of a variant, the board before them.
    """

    system: str
    properties: tuple[str, ...]
    proved: tuple[str, ...]
    interpretations: Mapping[str, str]
    repair: str = ""
    without: tuple[str, ...] = ()
    timers: str = "exact"
    changes: tuple[tuple[str, ...], ...] = ()


class Unwritable(Exception):
    """A certificate cannot be written there; the message says where and why."""


@dataclass(frozen=True)
class CertificateFile:
    """What a file holds."""

    origin: CertificateOrigin
    certificates: tuple[Certificate, ...]


def write(folder: Path, origin: CertificateOrigin, certificates: Sequence[Certificate]) -> Path:
    """Write the file of one search, ``<system>-<first property>.json``, with ``.gz`` where it is large.

    Raises ``Unwritable``; what was there before is then still there.
    """
    data = _text(origin, certificates)
    plain = folder / f"{origin.system}-{origin.properties[0]}.json"
    packed = plain.with_name(f"{plain.name}.gz")
    target, other = (packed, plain) if len(data) >= LARGE else (plain, packed)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        replaced(target, gzip.compress(data, mtime=0) if target is packed else data)
        other.unlink(missing_ok=True)
    except OSError as error:
        raise Unwritable(f"Cannot write {target}: {error.strerror}. The verdicts stand.") from error
    return target


def packed(origin: CertificateOrigin, certificates: Sequence[Certificate]) -> bytes:
    """The contents of a file, compressed."""
    return gzip.compress(_text(origin, certificates), compresslevel=1, mtime=0)


def _text(origin: CertificateOrigin, certificates: Sequence[Certificate]) -> bytes:
    whole = json.dumps(_document(origin, certificates), separators=(",", ":"))
    return whole.replace('],"', '],\n"').encode()


def _document(origin: CertificateOrigin, certificates: Sequence[Certificate]) -> dict[str, object]:
    return {
        "schema": SCHEMA,
        "tool": f"rovercheck {_version()}",
        "origin": {
            "system": origin.system,
            "properties": list(origin.properties),
            "proved": list(origin.proved),
            "readings": dict(sorted(origin.interpretations.items())),
            "repair": origin.repair,
            "without": sorted(origin.without),
            "timers": origin.timers,
            **({"changes": [list(row) for row in origin.changes]} if origin.changes else {}),
        },
        "certificates": [document(one) for one in certificates],
    }


def _version() -> str:
    try:
        return version("rovercheck")
    except PackageNotFoundError:  # run from the sources
        return "not installed"


def read(path: Path) -> CertificateFile:
    """What a file says.  Raises ``Malformed`` for what is no file of certificates, ``OSError``."""
    return unpacked(path.read_bytes())


def unpacked(data: bytes) -> CertificateFile:
    """What the contents of a file say.  Raises ``Malformed`` for what is no file of certificates."""
    try:
        text = gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data
        found = json.loads(text)
    except (ValueError, EOFError, zlib.error, gzip.BadGzipFile, RecursionError) as error:
        raise Malformed(f"it is not whole: {error}") from error
    schema = found.get("schema") if isinstance(found, dict) else None
    if schema != SCHEMA:
        raise Malformed(f"its schema is {schema!r}, not {SCHEMA!r}")
    if not isinstance(found.get("certificates"), list):
        raise Malformed("it holds no list of certificates")
    return CertificateFile(_origin(found.get("origin")), tuple(map(certificate, found["certificates"])))


def _origin(found: Any) -> CertificateOrigin:
    try:
        texts = [str(found[name]) for name in ("system", "repair", "timers")]
        lists = [tuple(map(str, found[name])) for name in ("properties", "proved", "without")]
        interpretations = {str(id): str(choice) for id, choice in found["readings"].items()}
        changes = tuple(tuple(map(str, row)) for row in found.get("changes", ()))
    except (KeyError, TypeError, AttributeError) as error:
        raise Malformed(f"{type(error).__name__} {error} in its origin") from error
    if not lists[0] or not set(lists[1]) <= set(lists[0]):
        raise Malformed("its origin names no property, or proves one that was not searched")
    if any(len(set(named)) < len(named) for named in lists):
        raise Malformed("its origin names something twice")
    return CertificateOrigin(
        texts[0], lists[0], lists[1], interpretations, texts[1], lists[2], texts[2], changes
    )
