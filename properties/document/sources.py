"""The four sources that Board 2 monitors, and how old and how slow each may be [design] (E26, E29)."""

from dataclasses import dataclass

from rovercheck.spec_model.lang.expr import Expr, Var
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals import board2_supervisor as b2


@dataclass(frozen=True)
class Source:
    """A source, by the name of its region: levels OK, degraded and critical of its status.

    ``mean`` is the largest mean gap of its stamps and ``limit`` the largest age, in ms, without a fault.
    ``age_ms`` is the age where a stamp is set some ms before the step that sees it.
    """

    region: str
    update: Var
    age: Var
    deg: Var
    status: Var
    levels: tuple[str, str, str]
    mean: int
    limit: int
    age_ms: Var | None = None


SUP = Source(
    "Board1Supervisor", b2.sup_update, b2.sup_age, b2.deg_sup,
    b2.b1_sup_status, ("SUP_OK", "SUP_DEGRADED", "SUP_CRITICAL"), mean=60, limit=150,
)  # fmt: skip
BLE = Source(
    "BLE", b2.ble_update, b2.ble_age, b2.deg_ble,
    b2.esp_status, ("OK", "DEGRADED", "CRITICAL"), mean=40, limit=120, age_ms=b2.ble_age_ms,
)  # fmt: skip
IMU = Source(
    "IMU", b2.imu_update, b2.imu_age, b2.deg_imu,
    b2.imu_status, ("OK", "DEGRADED", "CRITICAL"), mean=100, limit=200, age_ms=b2.imu_age_ms,
)  # fmt: skip
RX = Source(
    "Rx", b2.rx_update, b2.rx_age, b2.deg_rx,
    b2.rx_status, ("RX_OK", "RX_DEGRADED", "RX_CRITICAL"), mean=40, limit=120, age_ms=b2.rx_age_ms,
)  # fmt: skip


def silent(source: Source) -> Expr:
    """The stamp is older than the limit (strict)."""
    return named(f"now_ms - ts > {source.limit} ms", source.age > source.limit)


def silent_ms(source: Source) -> Expr:
    """The same where stamps are set some ms before the step that sees them, always as many."""
    age = source.age if source.age_ms is None else source.age_ms
    return named(f"now_ms - ts > {source.limit} ms", age > source.limit)
