"""A bench on which both boards run with a link, simulated sensors and a simulated rover."""

from rovercheck.supervisor.bench.errors import ScenarioError
from rovercheck.supervisor.bench.judge import Outcome, judge
from rovercheck.supervisor.bench.record import Record
from rovercheck.supervisor.bench.scenario import Scenario, loads, parse
from rovercheck.supervisor.bench.simulation import simulate

__all__ = ["Outcome", "Record", "Scenario", "ScenarioError", "judge", "loads", "parse", "simulate"]
