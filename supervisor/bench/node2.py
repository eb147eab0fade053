"""Board 2 while it is powered: its supervisor, its sensors, and its end of the link."""

from dataclasses import dataclass, field

from rovercheck.supervisor.bench.line import Line, Port
from rovercheck.supervisor.bench.record import Side, Step2
from rovercheck.supervisor.bench.rover import Rover
from rovercheck.supervisor.bench.schedule import Rank
from rovercheck.supervisor.bench.sensors import Sensors
from rovercheck.supervisor.bench.tasks import Tasks
from rovercheck.supervisor.board2.board import Board2
from rovercheck.supervisor.board2.distances import Distances
from rovercheck.supervisor.board2.signals import Board2Inputs, Board2Outputs
from rovercheck.supervisor.link.frame import Transmitter
from rovercheck.supervisor.link.heartbeat import AliveCounter, Heartbeat
from rovercheck.supervisor.link.payloads import FromBoard1, FromBoard2
from rovercheck.supervisor.link.wire import B2_TO_B1


@dataclass
class Node2:
    """Everything of it that is lost with its power."""

    tasks: Tasks
    rover: Rover
    line: Line
    steps: list[Step2]
    port: Port[FromBoard1]
    """Where it hears Board 1."""
    sensors: Sensors
    supervisor: Board2 = field(default_factory=Board2)
    outputs: Board2Outputs | None = None
    """The snapshot of the supervisor, once it has run."""
    run_ms: int = 0
    alive: AliveCounter = field(default_factory=AliveCounter)
    heartbeat: Heartbeat = field(default_factory=Heartbeat)
    transmitter: Transmitter[FromBoard2] = field(default_factory=lambda: Transmitter(B2_TO_B1))

    def start(self) -> None:
        """Power-up."""
        self.tasks.every("sonars", Rank.SENSE, self._scan)
        self.tasks.every("imu", Rank.SENSE, self._read_imu)
        self.tasks.every("joystick", Rank.SENSE, self._read_joystick)
        self.tasks.every("supervisor_2", Rank.SUPERVISE, self._supervise)
        self.tasks.every("transmit_2", Rank.TRANSMIT, self._transmit)

    def stop(self) -> None:
        """Loss of power: nothing holds the stop pin."""
        self.tasks.powered = False
        self.rover.driver.stop_pins[Side.BOARD_2] = True

    def receive(self, time_us: int, byte: int) -> None:
        """A byte arrives."""
        self.port.byte(byte, self.tasks.now_ms(time_us))

    def _scan(self, time_us: int) -> None:
        self.sensors.start_scan(time_us, self._publish_at)

    def _publish_at(self, time_us: int, dist_cm: Distances) -> None:
        sonars, now_ms = self.sensors.sonars, self.tasks.now_ms
        self.tasks.once(time_us, Rank.SENSE, lambda at: sonars.publish(dist_cm, now_ms(at)))

    def _read_imu(self, time_us: int) -> None:
        self.sensors.read_imu(time_us, self.tasks.now_ms(time_us), self.rover.yaw_rate)

    def _read_joystick(self, time_us: int) -> None:
        self.sensors.read_joystick(time_us, self.tasks.now_ms(time_us))

    def _supervise(self, time_us: int) -> None:
        if self.tasks.scenario.at("supervisor_2", time_us) == "stopped":
            return
        inputs = self._latch(self.tasks.now_ms(time_us))
        self.outputs = outputs = self.supervisor.step(inputs)
        self.run_ms = inputs.now_ms
        self.alive.executed()
        driver = self.rover.driver
        driver.stop_pins[Side.BOARD_2] = outputs.actuated.stop_pin
        if (sent := outputs.actuated.motors) is not None:
            driver.command(Side.BOARD_2, sent.left_rpm, sent.right_rpm, time_us)
        self.steps.append(Step2(time_us, inputs, outputs))

    def _latch(self, now_ms: int) -> Board2Inputs:
        received, sensors = self.port.receiver.snapshot, self.sensors
        return Board2Inputs(
            now_ms=now_ms,
            last_valid_b1_ms=self.heartbeat.update(received.payload.alive_counter, now_ms),
            b1_data_last_valid_ms=received.data_last_valid_ms,
            payload=received.payload,
            dist_cm=sensors.sonars.dist_cm,
            sonar_last_valid_ms=sensors.sonars.last_valid_ms,
            yaw=sensors.imu.yaw,
            gz_dps=sensors.imu.gz_dps,
            imu_last_valid_ms=sensors.imu.last_valid_ms,
            x_norm=sensors.joystick.x_norm,
            y_norm=sensors.joystick.y_norm,
            btn1=sensors.joystick.btn1,
            btn2=sensors.joystick.btn2,
            ble_last_valid_ms=sensors.joystick.last_valid_ms,
        )

    def _transmit(self, time_us: int) -> None:
        outputs, joystick = self.outputs or Board2Outputs(), self.sensors.joystick
        payload = FromBoard2(
            command=outputs.command,
            critical_mask=outputs.critical_mask,
            degraded_mask=outputs.degraded_mask,
            is_motion_consistent=outputs.is_motion_consistent,
            yaw=self.sensors.imu.yaw,
            x_norm=joystick.x_norm,
            y_norm=joystick.y_norm,
            btn1=joystick.btn1,
            btn2=joystick.btn2,
            alive_counter=self.alive.value,
        )
        self.line.send(self.transmitter.frame(payload, self.run_ms), time_us)
