"""Concrete measurements (floats, millisecond stamps) as inputs of the charts, and back."""

from rovercheck.spec_model.abstraction.board import Board
from rovercheck.spec_model.abstraction.boards import boards
from rovercheck.spec_model.abstraction.interface import InterfaceReader
from rovercheck.spec_model.abstraction.signals import BoardSignal, Output, Value, Values

__all__ = ["Board", "BoardSignal", "InterfaceReader", "Output", "Value", "Values", "boards"]
