"""Logs recorded on a board, checked against the properties and against the charts."""

from checker.logs.against import Against
from checker.logs.check import LogResult, as_on_record, examine
from checker.logs.errors import LogError
from checker.logs.mapping import ColumnMap, read_map

__all__ = ["Against", "ColumnMap", "LogError", "LogResult", "as_on_record", "examine", "read_map"]
