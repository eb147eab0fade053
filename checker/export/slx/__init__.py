"""Systems of charts as models of Simulink: one chart with a region for each component."""

from rovercheck.checker.export.slx.package import SlxModel, simulink_of

__all__ = ["SlxModel", "simulink_of"]
