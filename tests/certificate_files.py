"""Files of certificates for tests: of real properties, proved by the naive engine, and changed ones."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rovercheck.checker.certify.file import CertificateOrigin, write
from rovercheck.checker.certify.record import Recorder, certified
from rovercheck.checker.engines import Limits
from rovercheck.checker.verify.decide import Task, decide
from rovercheck.checker.verify.portfolio import Callbacks as Listeners
from rovercheck.properties.catalogue import under
from rovercheck.spec_model.rover import systems
from tests.certifying import Naive

COUNTERS = ("PSY-21a",)
WHEEL = ("PB1-06a-FR", "PB1-06b-FR")


def written(folder: Path, *ids: str, interpretations: dict[str, str] | None = None) -> Path:
    """The file that a search of these properties by the naive engine writes."""
    known, by_name = under(interpretations or {}), systems(interpretations or {})
    properties = tuple(known[id] for id in ids)
    task = Task(by_name[properties[0].on], properties)
    recorder = Recorder()
    told = Listeners(on_answer=recorder.answered)
    results = list(decide(task, by_name, Naive(), Limits(), told))
    proved = certified({r.property.id: r.verdict for r in results}, recorder.made)
    return write(
        folder, CertificateOrigin(task.system.name, ids, proved, interpretations or {}), recorder.made
    )


def changed(path: Path, folder: Path, change: Callable[[Any], None]) -> Path:
    """A copy of the file with a change in its document."""
    document = json.loads(path.read_text())
    change(document)
    copy = folder / path.name
    copy.write_text(json.dumps(document))
    return copy


def counters(folder: Path) -> Path:
    return folder / f"counters-{COUNTERS[0]}.json"


def two_searches(folder: Path) -> Path:
    """The folder, with the certificates of two searches."""
    written(folder, *COUNTERS)
    written(folder, *WHEEL)
    return folder
