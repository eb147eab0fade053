"""Signals of the Board 2 supervisor beside its obstacle and motion charts [spec §3.1].

Both boards run in one composed system, so a name that Board 1 uses too begins with ``B2.`` here.
Where the document indexes a signal by wheel, the wheel's letters follow the name: FL, FR, RL, RR.
"""

from dataclasses import dataclass, replace

from rovercheck.spec_model.lang.domain import Domain, boolean, chosen, enumeration, fixed, integer
from rovercheck.spec_model.lang.expr import Var, flag, var
from rovercheck.spec_model.signals.board1 import WHEELS
from rovercheck.spec_model.signals.board2 import decision
from rovercheck.spec_model.signals.common import (
    B2_FAULT_MASK,
    COMMAND,
    FAULT_MASK,
    PHASE,
    RX_STATUS,
    SAFETY_STATUS,
    SUP_STATUS,
    WHEEL_RPM,
)

SENSOR_STATUS = enumeration("SensorStatus", ["OK", "DEGRADED", "CRITICAL"])
"""State of the joystick link and of the IMU."""

# --- the four monitored sources -------------------------------------------------------------------


@dataclass(frozen=True)
class SourceSignals:
    """What a region of the monitors reads and writes: a time stamp, and the status that follows.

    ``name`` begins the names of the counters that belong to it.  ``update`` says that the stamp was
    set since the last step, ``age`` is ``now_ms`` minus the stamp.  ``mean`` and ``limit`` are the largest
    mean gap and the largest age, in ms, without a fault.  ``phase`` is how long before the step that sees it
    a stamp is set, always; without one it is set to the time of the step.
    """

    region: str
    name: str
    update: Var
    age: Var
    status: Var
    deg: Var
    mean: int
    limit: int
    phase: Var | None = None

    @property
    def levels(self) -> tuple[str, str, str]:
        """The names of the levels OK, degraded and critical of the status."""
        show = self.status.domain.show
        return show(0), show(1), show(2)


def age_until(limit: int, grid: int = 20) -> Domain:
    """Ages on a grid of ``grid`` ms that stop at the first one above ``limit``."""
    return fixed(0, (limit // grid + 1) * grid, grid, "ms")


def source(
    region: str, name: str, deg: str, status: Var, stamp: str, *, mean: int, limit: int
) -> SourceSignals:
    """The signals of one monitored source; ``stamp`` is the document's name of its time stamp."""
    return SourceSignals(
        region,
        name,
        flag(f"{name}_update", f"{stamp} was set to now_ms since the last step"),
        var(f"{name}_age", age_until(limit), 0, f"now_ms - {stamp}"),
        status,
        flag(deg, f"slow2 of {stamp}: the mean of its latest gaps exceeds {mean} ms"),
        mean,
        limit,
    )


b1_sup_status = var("b1_sup_status", SUP_STATUS, doc="supervisor of Board 1, by its alive counter")
esp_status = var("esp_status", SENSOR_STATUS, doc="joystick link")
imu_status = var("imu_status", SENSOR_STATUS, doc="inertial unit")
rx_status = var("B2.rx_status", RX_STATUS, doc="reception from Board 1")

SUP = source("Board1Supervisor", "b1_sup", "deg_sup", b1_sup_status, "last_valid_b1_ms", mean=60, limit=150)
BLE = source("BLE", "esp", "deg_ble", esp_status, "BLE.data_last_valid_ms", mean=40, limit=120)
IMU = source("IMU", "imu", "deg_imu", imu_status, "IMU.data_last_valid_ms", mean=100, limit=200)
RX = source("Rx", "B2.rx", "deg_rx", rx_status, "Board1_Data.data_last_valid_ms", mean=40, limit=120)
SOURCES = (SUP, BLE, IMU, RX)
"""In the order of the regions."""


def between_steps(source: SourceSignals, phases: Domain = PHASE) -> SourceSignals:
    """The source with stamps that are set some ms before a step, always as many, and its age to the ms."""
    name, limit = source.name, source.limit
    age = var(f"{name}_age_ms", integer(0, limit + 1, "ms"), doc=f"{source.age.doc}; {limit + 1} ms: or more")
    return replace(
        source, age=age, phase=var(f"{name}_phase", phases, doc=f"how long before a step {name} is stamped")
    )


SOURCES_MS = (SUP, *map(between_steps, (BLE, IMU, RX)))
"""The same to the ms; an alive counter is stamped with the step that sees it change."""

sup_update, ble_update, imu_update, rx_update = (source.update for source in SOURCES)
sup_age, ble_age, imu_age, rx_age = (source.age for source in SOURCES)
_, ble_age_ms, imu_age_ms, rx_age_ms = (source.age for source in SOURCES_MS)
deg_sup, deg_ble, deg_imu, deg_rx = (source.deg for source in SOURCES)

# --- Board1_Data: the last accepted payload [spec Fig 4] -------------------------------------------

crit_mask_b1 = var("B2.crit_mask_b1", FAULT_MASK, 0, "critical mask of Board 1, as last received")
degr_mask_b1 = var("B2.degr_mask_b1", FAULT_MASK, 0, "degraded mask of Board 1, as last received")
wheel_speed_rpm = {
    w: var(f"B2.wheel_speed_rpm_{w}", WHEEL_RPM, 0, "wheel speed, as last received") for w in WHEELS
}

# --- masks, classes, authorisation, safety state ---------------------------------------------------

critical_mask = var("B2.critical_mask", B2_FAULT_MASK, doc="critical faults: joystick, IMU, reception, B1")
degraded_mask = var("B2.degraded_mask", B2_FAULT_MASK, doc="degraded sources, bits as in critical_mask")
b2_emergency = flag("b2_emergency", "joystick link or IMU is critical")
b1_requests_switch = flag("b1_requests_switch", "Board 1 misses the frames or the supervisor of Board 2")
b1_emergency = flag("b1_emergency", "Board 1 has another critical fault")
autorized_to_send_command = flag("autorized_to_send_command", "Board 2 may send motor commands")
rover_safety_state = var(
    "B2.rover_safety_state", SAFETY_STATUS, doc="safety state while Board 2 is authorised"
)
B2DecDriving = var("B2DecDriving", decision, doc="output of the degraded obstacle chart while authorised")
cmd = var("B2.cmd", COMMAND, "CMD_NORMAL", "B2DecDriving as a command for the motion charts")

# --- coherence of IMU and odometry -----------------------------------------------------------------

gz_dps = var("IMU.gz_dps", chosen([-60, -10, -9, 0, 2, 9, 10, 60], "°/s"), 0, "yaw rate, clockwise positive")
is_motion_consistent = var("B2.isMotionConsistent", boolean, False, "IMU and odometry rotate alike")

# --- motor commands --------------------------------------------------------------------------------

SIDE_RPM = fixed(-80, 80, "0.05", "rpm")
"""Half of full scale (160 rpm), in the steps of a product with a reference."""

left_rpm = var("B2.left_rpm", SIDE_RPM, 0, "last commanded speed of the left wheels")
right_rpm = var("B2.right_rpm", SIDE_RPM, 0, "last commanded speed of the right wheels")
driver_initialised = flag("B2.driver_initialised", "the initialisation was sent to the motor driver")
sends_speeds = flag("B2.sends_speeds", "wheel speeds are sent in this step")
stop_pin = var("B2.stop_pin", boolean, True, "the stop pin of Board 2 is at stop level, as at power-up")
was_autorized = flag("was_autorized", "autorized_to_send_command in the step before")

# --- sonar data ------------------------------------------------------------------------------------

sonar_update = flag("sonar_update", "Sonars.data_last_valid_ms changed: a scan was published")
sonar_age = var("sonar_age", age_until(280), 0, "now_ms - Sonars.data_last_valid_ms")

COUNT = integer(0, 10)
"""A number of gaps of a time stamp; a record holds ten."""
