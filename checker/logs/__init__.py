"""Logs recorded on a board, checked against the properties and against the charts."""

from rovercheck.checker.logs.check import LogResult, as_on_record, examine
from rovercheck.checker.logs.errors import LogError
from rovercheck.checker.logs.mapping import ColumnMap, read_map
from rovercheck.checker.logs.reference import LogReference

__all__ = ["ColumnMap", "LogError", "LogReference", "LogResult", "as_on_record", "examine", "read_map"]
