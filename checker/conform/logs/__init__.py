"""Logs recorded on a board, checked against the properties and against the charts."""

from checker.conform.logs.against import Against
from checker.conform.logs.check import Result, as_on_record, examine
from checker.conform.logs.errors import LogError
from checker.conform.logs.mapping import Map, read_map

__all__ = ["Against", "LogError", "Map", "Result", "as_on_record", "examine", "read_map"]
