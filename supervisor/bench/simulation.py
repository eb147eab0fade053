"""One run of a scenario: both boards, the link between them and the rover, from power-up to the end."""

from collections.abc import Callable

from rovercheck.supervisor.bench.line import Line, Port
from rovercheck.supervisor.bench.node1 import Node1
from rovercheck.supervisor.bench.node2 import Node2
from rovercheck.supervisor.bench.record import SAMPLE_US, Record
from rovercheck.supervisor.bench.rover import STEP_US, Rover
from rovercheck.supervisor.bench.scenario import Scenario
from rovercheck.supervisor.bench.schedule import Agenda, Clock, Rank
from rovercheck.supervisor.bench.sensors import Sensors
from rovercheck.supervisor.bench.tasks import Tasks
from rovercheck.supervisor.link.receiver import Receiver
from rovercheck.supervisor.link.wire import B1_TO_B2, B2_TO_B1

SECOND_US = 10**6


class Simulation:
    """The parts that outlive a loss of power, and the boards that are powered."""

    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario
        self.record = Record()
        self.agenda = Agenda()
        self.rover = Rover(scenario)
        self.node1: Node1 | None = None
        self.node2: Node2 | None = None
        self._to_b1 = Line("b2_b1", scenario, self.agenda, self._deliver1, self.record.b2_to_b1)
        self._to_b2 = Line("b1_b2", scenario, self.agenda, self._deliver2, self.record.b1_to_b2)

    def run(self, progress: Callable[[int], None]) -> Record:
        """All of it; call it once."""
        for name, switch, start_us in (
            ("board_1", self._switch1, 0),
            ("board_2", self._switch2, self.scenario.phase_us),
        ):
            later = (at for at in self.scenario.courses[name].changes if at > start_us)
            for at in (start_us, *later):
                self.agenda.enter(at, Rank.WORLD, switch)
        self.agenda.enter(STEP_US, Rank.WORLD, self._move)
        self.agenda.enter(0, Rank.WATCH, self._watch)
        for until_us in range(0, self.scenario.duration_us, SECOND_US):
            self.agenda.run(until_us)
            progress(until_us)
        self.agenda.run(self.scenario.duration_us)
        return self.record

    def _move(self, time_us: int) -> None:
        self.rover.step(time_us)
        self.agenda.enter(time_us + STEP_US, Rank.WORLD, self._move)

    def _watch(self, time_us: int) -> None:
        samples, driver = self.record.samples, self.rover.driver
        now = (driver.relay, driver.source(time_us), driver.stopped)
        if time_us % SAMPLE_US == 0 or now != samples[-1].switches:
            samples.append(self.rover.sample(time_us))
        self.agenda.enter(time_us + STEP_US, Rank.WATCH, self._watch)

    def _switch1(self, time_us: int) -> None:
        powered = self.scenario.at("board_1", time_us) == "on"
        if powered and self.node1 is None:
            tasks = Tasks(self.scenario, self.agenda, Clock(time_us))
            port = Port(Receiver(B2_TO_B1), self.record.b2_to_b1)
            self.node1 = Node1(tasks, self.rover, self._to_b2, self.record.board1, port)
            self.node1.start()
        elif not powered and self.node1 is not None:
            self.node1.stop()
            self.node1 = None

    def _switch2(self, time_us: int) -> None:
        powered = self.scenario.at("board_2", time_us) == "on"
        if powered and self.node2 is None:
            tasks = Tasks(self.scenario, self.agenda, Clock(time_us, self.scenario.drift_ppm))
            port, sensors = Port(Receiver(B1_TO_B2), self.record.b1_to_b2), Sensors(self.scenario)
            self.node2 = Node2(tasks, self.rover, self._to_b1, self.record.board2, port, sensors)
            self.node2.start()
        elif not powered and self.node2 is not None:
            self.node2.stop()
            self.node2 = None

    def _deliver1(self, time_us: int, byte: int) -> None:
        if self.node1 is not None:
            self.node1.receive(time_us, byte)

    def _deliver2(self, time_us: int, byte: int) -> None:
        if self.node2 is not None:
            self.node2.receive(time_us, byte)


def simulate(scenario: Scenario, progress: Callable[[int], None] = lambda time_us: None) -> Record:
    """The run of a scenario, the same every time; ``progress`` hears of every second of it, in us."""
    return Simulation(scenario).run(progress)
