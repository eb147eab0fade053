"""Board 1 as its firmware sees it [spec §2.2, §2.3, Fig 13, Fig 14]."""

from collections.abc import Mapping

from rovercheck.spec_model.abstraction.board import Board, BoardSignal, Value, Values, computed, units
from rovercheck.spec_model.abstraction.signals import discrete, measured, outputs, stamp
from rovercheck.spec_model.abstraction.stamps import MeanOfTen, Stamp, age
from rovercheck.spec_model.board1 import SUPERVISOR
from rovercheck.spec_model.environment import check_stop
from rovercheck.spec_model.environment_jitter import step_ms
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TICK_MS, in_order
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board1_fine as fine

AGES: dict[str, Var] = {
    "last_valid_b2_ms": b1.heartbeat_age,
    "b2_data_last_valid_ms": b1.rx_age,
    "temp_last_valid_ms": b1.temp_age,
    "batt_last_valid_ms": b1.batt_age,
}
"""What the charts see of each stamp."""

AGES_MS: dict[str, Var] = {
    "last_valid_b2_ms": fine.heartbeat_age_ms,
    "b2_data_last_valid_ms": fine.rx_age_ms,
}
"""Those of systems in which a stamp may lie at any ms."""

SLOW = {"last_valid_b2_ms": b1.heartbeat_slow, "b2_data_last_valid_ms": b1.rx_slow}
MEAN_MS = 40
MASK = (b1.crit_mask_b2, b1.degr_mask_b2)

now_ms = stamp("now_ms", "start of the step")
SAMPLES: dict[BoardSignal, Var] = {
    measured(b1.temperature_degC, -100, 200): b1.temperature_degC,
    measured(b1.battery_pct, 0, 100): b1.battery_pct,
    **{measured(w, -200, 200): w for w in b1.wheel_speed_rpm.values()},
    **{discrete(f): f for f in b1.has_no_feedback.values()},
    discrete(b1.cmd): b1.cmd,
    measured(b1.x_norm, -1, 1): b1.x_norm,
    measured(b1.y_norm, -1, 1): b1.y_norm,
    measured(b1.current_yaw, 0, 359.99): b1.current_yaw,
    discrete(b1.btn1): b1.btn1,
    discrete(b1.btn2): b1.btn2,
    discrete(b1.is_motion_consistent): b1.is_motion_consistent,
    **{discrete(mask): mask for mask in MASK},
}
STAMPS = (
    stamp("last_valid_b2_ms", "when a new heartbeat of Board 2 was last seen"),
    stamp("b2_data_last_valid_ms", "when a frame of Board 2 was last accepted"),
    stamp("temp_last_valid_ms", "when the temperature was last read"),
    stamp("batt_last_valid_ms", "when the battery was last read"),
)


class Reader1:
    """Ages in place of stamps, means of the intervals between them, and the measurements as they are."""

    def __init__(self) -> None:
        self._means = {name: MeanOfTen(MEAN_MS) for name in SLOW}

    def step(self, inputs: Values) -> dict[str, int]:
        now = int(inputs["now_ms"])
        at = {var.name: signal.raw(inputs[signal.name]) for signal, var in SAMPLES.items()}
        at |= {var.name: age(now, int(inputs[name])) for name, var in AGES.items()}
        at |= {var.name: int(self._means[name].step(int(inputs[name]))) for name, var in SLOW.items()}
        return computed(at)


class Writer1:
    """Stamps in place of ages; a step of the model is one of the board."""

    def __init__(self) -> None:
        self._now = 0
        self._stamps = {name: Stamp() for name in AGES}

    def step(self, at: Mapping[str, int]) -> dict[str, Value]:
        self._now += at.get(step_ms.name, TICK_MS)
        inputs: dict[str, Value] = {"now_ms": self._now}
        for name, var in AGES.items():
            to_the_ms = AGES_MS.get(name)
            if to_the_ms is not None and to_the_ms.name in at:
                old, most = at[to_the_ms.name], to_the_ms.domain.high
                inputs[name] = self._stamps[name].step(self._now, old, most, 1)
                continue
            stopped = var.domain.high if var.domain.high < 1000 else _grows_to(var)
            inputs[name] = self._stamps[name].step(self._now, at.get(var.name, 0), stopped)
        for signal, var in SAMPLES.items():
            known = var.name in at
            inputs[signal.name] = units(var.domain, at[var.name]) if known else signal.initial
        return inputs


def _grows_to(age_of: Var) -> int:
    """The raw age at which the model stops counting: 500 ms before the end of the domain (S09, S24)."""
    return age_of.domain.high - 500 // TICK_MS


references_given_up = b1.actuate_emergency_stop
"""During an emergency stop the user's references are not computed; no block reads them."""

OUTPUTS = (
    *outputs([
        b1.v_ref, b1.omega_ref, b1.critical_mask, b1.degraded_mask, b1.give_b2_actuation,
        b1.actuate_emergency_stop, b1.current_action, b1.temp_status, b1.batt_status,
        *b1.wheel_status.values(), b1.b2_sup_status, b1.rx_status, b1.b2_critical, b1.b2_degraded,
        b1.rover_safety_state, b1.backward_enabled, b1.invert_y, b1.is_rotating180,
        b1.estop_recover_enabled, b1.rover_is_stopped,
    ]),
    *outputs([b1.v_user, b1.omega_user], unless=references_given_up),
    *outputs([b1.targetAngle, b1.angle_err], unless=~b1.is_rotating180),
)  # fmt: skip

BOARD1 = Board(
    name="board1",
    system=in_order(
        "board1_charts",
        check_stop,
        *SUPERVISOR,
        text="The supervisor of Board 1 without environment: its inputs are what the snapshots hold.",
    ),
    inputs=(now_ms, *STAMPS, *SAMPLES),
    outputs=OUTPUTS,
    reader=Reader1,
    writer=Writer1,
    grid_ms=1,
)
