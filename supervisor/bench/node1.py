"""Board 1 while it is powered: its supervisor, its motor control, sensors and end of the link."""

from dataclasses import dataclass, field

from rovercheck.supervisor.bench.health import Encoders, Health
from rovercheck.supervisor.bench.line import Line, Port
from rovercheck.supervisor.bench.record import Side, Step1
from rovercheck.supervisor.bench.rover import Rover
from rovercheck.supervisor.bench.schedule import Rank
from rovercheck.supervisor.bench.tasks import Tasks
from rovercheck.supervisor.board1 import Board1, Board1Inputs, Board1Outputs
from rovercheck.supervisor.link.frame import Transmitter
from rovercheck.supervisor.link.heartbeat import AliveCounter, Heartbeat
from rovercheck.supervisor.link.payloads import FromBoard1, FromBoard2
from rovercheck.supervisor.link.wire import B1_TO_B2
from rovercheck.supervisor.types import SupervisorCommand

SPEED_RPM, TURN_RPM, MOST_RPM = 160.0, 80.0, 160.0
"""Full scale of both references, and the most that they may ask of a side together."""


def sides(v_ref: float, omega_ref: float) -> tuple[float, float]:
    """The speeds of the left and of the right wheels in rpm that the references of Board 1 stand for."""
    speed, turn = SPEED_RPM * v_ref, TURN_RPM * omega_ref
    scale = MOST_RPM / max(MOST_RPM, abs(speed) + abs(turn))
    return (speed - turn) * scale, (speed + turn) * scale


@dataclass
class Node1:
    """Everything of it that is lost with its power."""

    tasks: Tasks
    rover: Rover
    line: Line
    steps: list[Step1]
    port: Port[FromBoard2]
    """Where it hears Board 2."""
    supervisor: Board1 = field(default_factory=Board1)
    outputs: Board1Outputs | None = None
    """The snapshot of the supervisor, once it has run."""
    run_ms: int = 0
    commanded: tuple[float, float] = (0.0, 0.0)
    health: Health = field(default_factory=Health)
    encoders: Encoders = field(default_factory=Encoders)
    alive: AliveCounter = field(default_factory=AliveCounter)
    heartbeat: Heartbeat = field(default_factory=Heartbeat)
    transmitter: Transmitter[FromBoard1] = field(default_factory=lambda: Transmitter(B1_TO_B2))

    def start(self) -> None:
        """Power-up."""
        self.tasks.every("health", Rank.SENSE, self._read_health)
        self.tasks.every("supervisor_1", Rank.SUPERVISE, self._supervise)
        self.tasks.every("control", Rank.ACTUATE, self._control)
        self.tasks.every("transmit_1", Rank.TRANSMIT, self._transmit)

    def stop(self) -> None:
        """Loss of power: the coil of the relay lets go, and nothing holds the stop pin."""
        self.tasks.powered = False
        self.rover.driver.relay = Side.BOARD_2
        self.rover.driver.stop_pins[Side.BOARD_1] = True

    def receive(self, time_us: int, byte: int) -> None:
        """A byte arrives."""
        self.port.byte(byte, self.tasks.now_ms(time_us))

    def _read_health(self, time_us: int) -> None:
        self.health.read(self.tasks.scenario, time_us, self.tasks.now_ms(time_us))

    def _supervise(self, time_us: int) -> None:
        if self.tasks.scenario.at("supervisor_1", time_us) == "stopped":
            return
        inputs = self._latch(self.tasks.now_ms(time_us))
        self.outputs = outputs = self.supervisor.step(inputs)
        self.run_ms = inputs.now_ms
        self.alive.executed()
        self.rover.driver.relay = Side.BOARD_2 if outputs.give_b2_actuation else Side.BOARD_1
        self.rover.driver.stop_pins[Side.BOARD_1] = outputs.actuate_emergency_stop
        self.steps.append(Step1(time_us, inputs, outputs))

    def _latch(self, now_ms: int) -> Board1Inputs:
        received, health = self.port.receiver.snapshot, self.health
        return Board1Inputs(
            now_ms=now_ms,
            last_valid_b2_ms=self.heartbeat.update(received.payload.alive_counter, now_ms),
            b2_data_last_valid_ms=received.data_last_valid_ms,
            payload=received.payload,
            temperature_degc=health.temperature_degc,
            battery_pct=health.battery_pct,
            temp_last_valid_ms=health.temp_last_valid_ms,
            batt_last_valid_ms=health.batt_last_valid_ms,
            wheel_speed_rpm=self.encoders.wheel_speed_rpm,
            has_no_feedback=self.encoders.has_no_feedback,
        )

    def _control(self, time_us: int) -> None:
        self.encoders.read(self.tasks.scenario, time_us, self.rover.wheels, self.commanded)
        outputs = self.outputs
        self.commanded = (0.0, 0.0)
        if outputs is None or outputs.give_b2_actuation:
            return
        if outputs.current_action is not SupervisorCommand.CMD_ESTOP:
            self.commanded = sides(outputs.v_ref, outputs.omega_ref)
        self.rover.driver.command(Side.BOARD_1, *self.commanded, time_us)

    def _transmit(self, time_us: int) -> None:
        outputs = self.outputs or Board1Outputs()
        payload = FromBoard1(
            wheel_speed_rpm=self.encoders.wheel_speed_rpm,
            critical_mask=outputs.critical_mask,
            degraded_mask=outputs.degraded_mask,
            alive_counter=self.alive.value,
        )
        self.line.send(self.transmitter.frame(payload, self.run_ms), time_us)
