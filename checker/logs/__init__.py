"""Logs recorded on a board, checked against the properties and against the charts."""

from checker.logs.against import Against
from checker.logs.check import Result, as_on_record, examine
from checker.logs.errors import LogError
from checker.logs.mapping import Map, read_map

__all__ = ["Against", "LogError", "Map", "Result", "as_on_record", "examine", "read_map"]
