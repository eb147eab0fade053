"""A bench on which both boards run with a link, simulated sensors and a simulated rover."""

from supervisor.bench.errors import ScenarioError
from supervisor.bench.judge import Outcome, judge
from supervisor.bench.record import Record
from supervisor.bench.scenario import Scenario, loads, parse
from supervisor.bench.simulation import simulate

__all__ = ["Outcome", "Record", "Scenario", "ScenarioError", "judge", "loads", "parse", "simulate"]
