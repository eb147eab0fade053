"""Systems of charts as machines of SCXML: a region for each chart, and one that gives them their turns."""

from rovercheck.checker.export.scxml.package import ScxmlMachine, scxml_of

__all__ = ["ScxmlMachine", "scxml_of"]
