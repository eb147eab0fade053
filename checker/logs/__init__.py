"""Logs recorded on a board, checked against the properties and against the charts."""

from rovercheck.checker.logs.against import Against
from rovercheck.checker.logs.check import LogResult, as_on_record, examine
from rovercheck.checker.logs.errors import LogError
from rovercheck.checker.logs.mapping import ColumnMap, read_map

__all__ = ["Against", "ColumnMap", "LogError", "LogResult", "as_on_record", "examine", "read_map"]
