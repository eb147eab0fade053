"""Concrete measurements (floats, millisecond stamps) as inputs of the charts, and back."""

from rovercheck.spec_model.abstraction.board import Board, BoardReader, BoardSignal, Output, Value, Values
from rovercheck.spec_model.abstraction.boards import boards

__all__ = ["Board", "BoardReader", "BoardSignal", "Output", "Value", "Values", "boards"]
