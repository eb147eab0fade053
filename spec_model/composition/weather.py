"""The rover under weather: sensors, links, boards and wheels that fail at any step, alone and in pairs.

Everything works but for one fault or two, each of which begins at any step.  One alone lasts for good or ends
at any later step; of two the first lasts for good, the second for good or for one step.  The stick is pushed
forward, nothing is near, and the wheels turn while the motors do.  The frames of a link, and the data of a
sensor, come at a phase to the steps that nobody knows.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from spec_model import environment as env1
from spec_model import environment_board2 as env2
from spec_model import environment_fine as fine
from spec_model.board1 import LINKS
from spec_model.board1 import supervisor as supervisor_1
from spec_model.board1.fine_systems import LINKS_MS
from spec_model.board2 import supervisor as supervisor_2
from spec_model.board2.coherence import COHERENCE
from spec_model.board2.heading import measured
from spec_model.board2.supervisor_systems import targetAngle
from spec_model.composition.link import ARRIVAL
from spec_model.composition.motors import motors_zero, power_lost, stop_1, stop_2
from spec_model.composition.systems import SYNCHRONOUS, in_turn, link12, link21
from spec_model.lang.action import Action, assign
from spec_model.lang.chart import Block
from spec_model.lang.domain import enumeration
from spec_model.lang.expr import FALSE, TRUE, Const, Expr, Var, all_of, any_of, flag, ite, member, var
from spec_model.lang.system import System, in_order
from spec_model.signals import board1 as b1
from spec_model.signals import board2_motion as motion
from spec_model.signals import board2_supervisor as b2
from spec_model.signals.board2 import d1, d2, d3
from spec_model.signals.common import PHASE_CLASS

RX_1 = "reception of Board 1"
SPELL = enumeration("Spell", ["ahead", "present", "over"])
"""Of a fault: it has not begun, it is there, it has ended."""


@dataclass(frozen=True)
class Fault:
    """Something that fails; ``ends`` if it may work again.

    ``ages``: the region of Board 2, or ``RX_1`` of Board 1, whose data grow old then.  The phase of all
    others is without effect, as their data come in every step.
    """

    name: str
    text: str
    ends: bool = True
    ages: str = ""


FAULTS = (
    Fault("joystick", "no joystick datum arrives", ages=b2.BLE.region),
    Fault("imu", "no IMU datum arrives", ages=b2.IMU.region),
    Fault("sonars", "no scan is published"),
    Fault("temperature", "no temperature is read"),
    Fault("battery", "no battery level is read"),
    Fault("link12", "no frame of Board 1 arrives at Board 2", ages=b2.RX.region),
    Fault("link21", "no frame of Board 2 arrives at Board 1", ages=RX_1),
    Fault("supervisor1", "the supervisor of Board 1 executes no more", ends=False),
    Fault("supervisor2", "the supervisor of Board 2 executes no more", ends=False),
    Fault("power", "Board 1 has no power", ends=False, ages=b2.RX.region),
    Fault("wheel", "the front left wheel gives no feedback"),
    Fault("hot", "64 °C are measured"),
    Fault("flat", "a battery level of 10 % is measured"),
    Fault("near", "the middle sonar measures 70 cm"),
)
BY_NAME: Mapping[str, Fault] = {fault.name: fault for fault in FAULTS}

late12 = flag("B1-B2.late", "every frame is seen two steps after it was sent, not one")
late21 = flag("B2-B1.late", "every frame is seen two steps after it was sent, not one")


def _spell(name: str) -> Var:
    return var(f"{name}.spell", SPELL, doc=f"whether the fault of {name} has begun, and ended")


SPELLS: Mapping[str, Var] = {fault.name: _spell(fault.name) for fault in FAULTS}
"""By the name of the fault; ``present`` in every step in which it is there."""


def _turn(name: str, ends: Expr) -> Action:
    """The fault begins at will, and ends if so said."""
    spell, begins = _spell(name), flag(f"{name}.begins", f"{name} begins to fail in this step")
    ended = ite((spell == "present") & ends, member(SPELL, "over"), spell)
    return assign(spell, ite((spell == "ahead") & begins, member(SPELL, "present"), ended))


def _world(there: Callable[[str], Expr]) -> list[Action]:
    """What reaches the boards in this step, by what has failed."""

    def arrives(fault: str, late: Var) -> Expr:
        in_time = ite(late, member(ARRIVAL, "older"), member(ARRIVAL, "newest"))
        return ite(there(fault), member(ARRIVAL, "nothing"), in_time)

    middle = env2.arriving(d2)
    constant: dict[Var, int | float] = {
        **dict.fromkeys(map(env2.arriving, (d1, d3)), 301),
        **dict.fromkeys(map(env2.arriving, (motion.yaw, b2.gz_dps, motion.bx_norm)), 0),
        env2.arriving(motion.ay_norm): 1,
    }
    return [
        assign(b2.BLE.update, ~there("joystick")),
        assign(b2.IMU.update, ~there("imu")),
        assign(b2.sonar_update, ~there("sonars")),
        assign(middle, ite(there("near"), _value(middle, 70), _value(middle, 301))),
        assign(b1.temp_update, ~there("temperature")),
        assign(b1.batt_update, ~there("battery")),
        assign(b1.temp_reading, ite(there("hot"), _value(b1.temp_reading, 64), _value(b1.temp_reading, 25))),
        assign(b1.batt_reading, ite(there("flat"), _value(b1.batt_reading, 10), _value(b1.batt_reading, 80))),
        assign(link12.arrives, arrives("link12", late12)),
        assign(link21.arrives, arrives("link21", late21)),
        assign(stop_1, there("supervisor1")),
        assign(stop_2, there("supervisor2")),
        assign(power_lost, there("power")),
        *(
            assign(missing, there("wheel") if wheel == "FL" else FALSE)
            for wheel, missing in b1.has_no_feedback.items()
        ),
        *(
            assign(speed, ite(motors_zero, _value(speed, 0), _value(speed, 60)))
            for speed in b1.wheel_speed_rpm.values()
        ),
        *(assign(datum, _value(datum, value)) for datum, value in constant.items()),
        *(assign(env2.arriving(button), False) for button in (motion.btn1, motion.btn2)),
    ]


def _value(of: Var, number: int | float) -> Const:
    """A number as a value of a variable."""
    return Const(of.domain.raw(number), of.sort)


# --- one fault, or two -----------------------------------------------------------------------------------

SECOND = [f for f in FAULTS if f.name not in ("sonars", "temperature", "battery", "near")]
"""Scans do not age (PB2-22a), temperature and battery only after half a minute; an obstacle is no fault."""

other = var("other", enumeration("Fault", [fault.name for fault in SECOND]), doc="which fault is the second")

for_a_step = flag("other.for_a_step", "the second fault lasts for one step")

SCENE = (
    "Stick forward, no obstacle within 300 cm, 25 °C, battery 80 %, wheels at 60 rpm while the motors turn, "
    "with feedback, constant heading, no buttons; all works in every step but for what is said to fail."
)
FRAMES = "All frames of a link are seen one step after they were sent, or all two steps."
NOTES = (SYNCHRONOUS, fine.CONSTANT_PHASE, SCENE, FRAMES)


COHERENT = Block(
    "Coherent",
    [assign(b2.is_motion_consistent, True)],
    text="What F-COH2 says of a rover that does not turn, on wheels that turn alike.",
)


def _weather(
    name: str,
    text: str,
    ages: Mapping[str, Expr],
    frozen: Sequence[Var],
    actions: Sequence[Action],
    assume: Expr = TRUE,
) -> System:
    """``ages``: whose data may grow old, and in which case; their phase is free then, else without effect."""
    sources = [b2.between_steps(s, PHASE_CLASS) if s.region in ages else s for s in b2.SOURCES]
    rx_phase = replace(b1.rx_phase, domain=PHASE_CLASS)
    phases = {s.region: s.phase for s in sources if s.phase is not None}
    phases |= {RX_1: rx_phase} if RX_1 in ages else {}
    links, reception = LINKS, env1.reception_clock
    if RX_1 in ages:
        links, reception = LINKS_MS, fine.reception_at(rx_phase)
    board2 = supervisor_2(heading=measured(motion.yaw, targetAngle), sources=sources)
    assert board2[-len(COHERENCE) :] == COHERENCE
    return in_order(
        name,
        Block("Weather", actions, text="Which fault is there, and what reaches the boards."),
        *in_turn(
            supervisor_1(links), (*board2[: -len(COHERENCE)], COHERENT), reception, env2.clocks_of(sources)
        ),
        text=text,
        frozen=(*frozen, late12, late21, *phases.values()),
        assume=all_of(assume, *(case | (phases[old] == 0) for old, case in ages.items())),
        notes=NOTES,
        under=True,
    )


def alone(fault: Fault) -> System:
    """The rover with this fault, whenever it begins and ends."""
    ends = flag(f"{fault.name}.ends", f"{fault.name} works again from this step on")

    def there(name: str) -> Expr:
        return SPELLS[fault.name] == "present" if name == fault.name else FALSE

    return _weather(
        f"weather_{fault.name}",
        f"The rover in a scene in which from some step on {fault.text}.",
        {fault.ages: TRUE} if fault.ages else {},
        (),
        [_turn(fault.name, ends if fault.ends else FALSE), *_world(there)],
    )


def with_another(fault: Fault, only: str = "") -> System:
    """The rover with this fault, for good, and any second one, or only that, for good or for one step."""
    which = BY_NAME[only].text if only else "something else fails"
    ends = for_a_step & any_of(*(other == f.name for f in SECOND if f.ends))
    second = _spell("other") == "present"

    def there(name: str) -> Expr:
        if name == fault.name:
            return SPELLS[fault.name] == "present"
        return (other == name) & second if BY_NAME[name] in SECOND else FALSE

    def old(ages: str) -> Expr:
        return TRUE if ages == fault.ages else any_of(*(other == f.name for f in SECOND if f.ages == ages))

    return _weather(
        f"weather_{fault.name}_{only or 2}",
        f"The rover in a scene in which from some step on {fault.text}, and {which}.",
        {f.ages: old(f.ages) for f in FAULTS if f.ages},
        (other, for_a_step),
        [_turn(fault.name, FALSE), _turn("other", ends), *_world(there)],
        other == only if only else TRUE,
    )


FIRST = [BY_NAME[name] for name in ("joystick", "imu", "link12", "supervisor2", "wheel")]
"""Of two faults the one for good; the others last too long, or leave too much open, to be enumerated."""

PAIRS = [(BY_NAME[first], "link21") for first in ("joystick", "imu")]
"""A source that is dead, and one frame of Board 2 that is lost, or all from then on."""

SYSTEMS: tuple[System, ...] = (
    *map(alone, FAULTS),
    *(with_another(first, second) for first, second in PAIRS),
    *map(with_another, FIRST),
)
