"""The published schemas of JSON documents, derived from the records that the commands write."""

import json
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any, get_args, get_origin

from pydantic import ConfigDict, TypeAdapter
from pydantic.json_schema import GenerateJsonSchema

from rovercheck import checker
from rovercheck.checker.commands.accept.document import DecisionsDocument
from rovercheck.checker.commands.certify.document import CertifyDocument
from rovercheck.checker.commands.check.document import CheckDocument
from rovercheck.checker.commands.check_log.document import CheckLogDocument
from rovercheck.checker.commands.compare.document import CompareDocument
from rovercheck.checker.commands.diagnose.document import DiagnoseDocument
from rovercheck.checker.commands.diff.document import DiffDocument
from rovercheck.checker.commands.doctor.document import DoctorDocument
from rovercheck.checker.commands.generate_tests.document import GenerateTestsDocument
from rovercheck.checker.commands.import_.document import ImportDocument
from rovercheck.checker.commands.import_.machine_document import MachineDocument
from rovercheck.checker.commands.lint.document import LintDocument
from rovercheck.checker.commands.list.document import ListDocument
from rovercheck.checker.commands.mutate.document import MutateDocument
from rovercheck.checker.commands.requirements.document import RequirementsDocument
from rovercheck.checker.commands.robustness.document import RobustnessDocument
from rovercheck.checker.render.graph_json import GraphDocument
from rovercheck.checker.render.trace_json import TraceDocument

DOCUMENTS: Mapping[str, Any] = {
    "certify-1": CertifyDocument,
    "check-1": CheckDocument,
    "conform-1": CheckLogDocument,
    "crosscheck-1": CompareDocument,
    "decisions-1": DecisionsDocument,
    "diagnose-1": DiagnoseDocument,
    "diff-1": DiffDocument,
    "doctor-1": DoctorDocument,
    "graph-2": GraphDocument,
    "import-1": ImportDocument,
    "import-machine-1": MachineDocument,
    "lint-1": LintDocument,
    "list-1": ListDocument,
    "mutate-1": MutateDocument,
    "requirements-1": RequirementsDocument,
    "robustness-1": RobustnessDocument,
    "testgen-1": GenerateTestsDocument,
    "trace-3": TraceDocument,
}
"""Each kind of document with its version, which rises when what is there changes its meaning or goes."""

FOLDER = Path(checker.__file__).resolve().parent / "schemas"


def schema(name: str) -> dict[str, Any]:
    """The JSON Schema (2020-12) of a kind of document; it allows no key that the record does not have."""
    kind = DOCUMENTS[name]
    for one in get_args(kind) or (kind,):
        record: Any = get_origin(one) or one
        record.__pydantic_config__ = ConfigDict(extra="forbid", use_attribute_docstrings=True)
    return {
        "$schema": GenerateJsonSchema.schema_dialect,
        "$id": f"urn:rovercheck:{name.replace('-', ':')}",
        **TypeAdapter(kind).json_schema(schema_generator=_Descriptions),
    }


def page(name: str) -> str:
    """The file of it."""
    return json.dumps(schema(name), indent=2, ensure_ascii=False) + "\n"


FILES = {FOLDER / f"{name}.json": partial(page, name) for name in DOCUMENTS}


class _Descriptions(GenerateJsonSchema):
    """Without titles that say the name of a field once more."""

    def field_title_should_be_set(self, schema: Any) -> bool:
        return False


__all__ = ["DOCUMENTS", "FILES", "page", "schema"]
