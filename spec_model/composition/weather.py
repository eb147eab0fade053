"""The rover under weather: sensors, links, boards and wheels that fail at any step, alone and in pairs.

Everything works but for one fault or two, each of which begins at any step.  One alone lasts for good or
ends at any later step; of two the first lasts for good, the second for good or for one step.  Nothing else
is near, and the wheels turn while the motors do.  The stick is pushed forward; or the rover is steered at
will: the stick moves in any step, and the heading changes the way the motors turn the rover.  The frames of
a link, and the data of a sensor, come at a phase to the steps that nobody knows.
"""

from collections.abc import Mapping, Sequence
from functools import partial

from rovercheck.spec_model.board2.coherence import COHERENCE
from rovercheck.spec_model.composition.link import all_frames_arrive
from rovercheck.spec_model.composition.rover_ms import Stamped
from rovercheck.spec_model.composition.systems import SYNCHRONOUS, link12, link21
from rovercheck.spec_model.composition.world import (
    BY_NAME,
    FAULTS,
    There,
    WorldFault,
    heading_by_motors,
    heading_constant,
    late12,
    late21,
    stick_at_will,
    stick_forward,
    which,
    world,
)
from rovercheck.spec_model.environment import board2 as env2
from rovercheck.spec_model.environment import milliseconds as fine
from rovercheck.spec_model.lang.action import Action, assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import enumeration
from rovercheck.spec_model.lang.expr import FALSE, TRUE, Expr, Var, all_of, any_of, flag, ite, member, var
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.board2 import SONARS
from rovercheck.spec_model.system_table import SystemTable

SPELL = enumeration("Spell", ["ahead", "present", "over"])
"""Of a fault: it has not begun, it is there, it has ended."""


def _spell(name: str) -> Var:
    return var(f"{name}.spell", SPELL, doc=f"whether the fault of {name} has begun, and ended")


SPELLS: Mapping[str, Var] = {fault.name: _spell(fault.name) for fault in FAULTS}
"""By the name of the fault; ``present`` in every step in which it is there."""


def _turn(name: str, ends: Expr) -> Action:
    """The fault begins at will, and ends if so said."""
    spell, begins = _spell(name), flag(f"{name}.begins", f"{name} begins to fail in this step")
    ended = ite((spell == "present") & ends, member(SPELL, "over"), spell)
    return assign(spell, ite((spell == "ahead") & begins, member(SPELL, "present"), ended))


# --- one fault, or two -----------------------------------------------------------------------------------

SECOND = [f for f in FAULTS if f.name not in ("sonars", "temperature", "battery", "near")]
"""Scans do not age (PB2-22a), temperature and battery only after half a minute; an obstacle is no fault."""

other = var("other", enumeration("Fault", [fault.name for fault in SECOND]), doc="which fault is the second")

OTHER = _spell("other")
"""The spell of the second fault."""

for_a_step = flag("other.for_a_step", "the second fault lasts for one step")

SCENE = (
    "{user}, no obstacle within 300 cm, 25 °C, battery 80 %, wheels at 60 rpm while the motors turn, with "
    "feedback, no buttons; all works in every step but for what is said to fail. All frames of a link are "
    "seen one step after they were sent, or all two steps."
)
HELD = SCENE.format(user="Stick forward, constant heading")
CALM = (
    "Stick, buttons, heading and distances are arbitrary in every step, and each frame is seen one or two "
    "steps after it was sent; 25 °C, battery 80 %, wheels at 60 rpm while the motors turn, with feedback."
)
AT_WILL = "Stick forward, left, at rest or back, changing in any step"
STEERED = SCENE.format(user=f"{AT_WILL}, constant heading")
TURNING = SCENE.format(user=f"{AT_WILL}; while the motors turn the rover, the heading changes by 45° at will")


HELD_FORWARD = (*stick_forward(), *heading_constant())

COHERENT = Block(
    "Coherent",
    [assign(b2.is_motion_consistent, True)],
    text="What F-COH2 says of a rover that turns as its wheels do.",
)


def _weather(
    name: str,
    text: str,
    ages: Mapping[str, Expr],
    actions: Sequence[Action],
    *,
    scene: str = HELD,
    frozen: Sequence[Var] = (),
    assume: Expr = TRUE,
) -> System:
    """``ages``: whose data may grow old, and in which case; their phase is free then, else without effect."""
    stamped = Stamped(ages)
    phases, board2 = stamped.phases, stamped.board2
    assert board2[-len(COHERENCE) :] == COHERENCE
    return in_order(
        name,
        Block("Weather", actions, text="Which fault is there, and what reaches the boards."),
        *stamped.in_turn((*board2[: -len(COHERENCE)], COHERENT)),
        text=text,
        frozen=(*frozen, late12, late21, *phases.values()),
        assume=all_of(assume, *(case | (phases[old] == 0) for old, case in ages.items())),
        notes=(SYNCHRONOUS, fine.CONSTANT_PHASE, scene),
        under=True,
    )


def alone(fault: WorldFault) -> System:
    """The rover with this fault, whenever it begins and ends."""
    ends = flag(f"{fault.name}.ends", f"{fault.name} works again from this step on")
    spell = _turn(fault.name, ends if fault.ends else FALSE)
    several = [fault.name] if fault.name in which else []
    return _weather(
        f"weather_{fault.name}",
        f"The rover in a scene in which from some step on {fault.text}.",
        {fault.ages: TRUE} if fault.ages else {},
        [spell, *HELD_FORWARD, *world(_only(fault), any_part=several)],
        frozen=[which[name] for name in several],
    )


def steered(fault: WorldFault, *, turning: bool = False) -> System:
    """The rover with this fault, for good from any step on, and a stick that moves at will.

    ``turning``: it turns as its motors do; else its heading is constant, and a half turn does not end.
    """
    heading = heading_by_motors() if turning else heading_constant()
    return _weather(
        f"weather_{fault.name}_steered",
        f"The rover, steered at will, in a scene in which from some step on {fault.text}.",
        {fault.ages: TRUE} if fault.ages else {},
        [_turn(fault.name, FALSE), *stick_at_will(), *heading, *world(_only(fault))],
        scene=TURNING if turning else STEERED,
    )


def _only(fault: WorldFault) -> There:
    return lambda name: SPELLS[fault.name] == "present" if name == fault.name else FALSE


def calm() -> System:
    """The rover without a fault; the user, the heading, obstacles and the latency of frames are free."""
    user = (motion.ay_norm, motion.bx_norm, motion.btn1, motion.btn2)
    free = [*map(env2.arriving, (*user, motion.yaw, *SONARS)), link12.arrives, link21.arrives]
    return _weather(
        "weather_calm",
        "The rover, of which nothing fails; stick, buttons, heading and obstacles change at will.",
        {},
        world(lambda name: FALSE, free),
        scene=CALM,
        assume=all_frames_arrive(link12, link21),
    )


def with_another(fault: WorldFault, *only: str) -> System:
    """The rover with this fault, for good, and any second one, or one of these, for good or for one step."""
    one = len(only) == 1
    second_text = BY_NAME[only[0]].text if one else "something else fails"
    ends = for_a_step & any_of(*(other == f.name for f in SECOND if f.ends))
    second = OTHER == "present"

    def there(name: str) -> Expr:
        if name == fault.name:
            return SPELLS[fault.name] == "present"
        return (other == name) & second if BY_NAME[name] in SECOND else FALSE

    def old(ages: str) -> Expr:
        return TRUE if ages == fault.ages else any_of(*(other == f.name for f in SECOND if f.ages == ages))

    return _weather(
        f"weather_{fault.name}_{only[0] if one else 2}",
        f"The rover in a scene in which from some step on {fault.text}, and {second_text}.",
        {f.ages: old(f.ages) for f in FAULTS if f.ages},
        [_turn(fault.name, FALSE), _turn("other", ends), *HELD_FORWARD, *world(there)],
        frozen=(other, for_a_step),
        assume=any_of(*(other == name for name in only)) if only else TRUE,
    )


FIRST = [BY_NAME[name] for name in ("joystick", "imu", "link12", "supervisor2", "wheel")]
"""Of two faults the one for good, whatever the second is."""

HEARD = ("joystick", "imu", "link21", "supervisor2", "wheel", "hot", "flat")
"""Second faults with which Board 2 still hears Board 1."""

FIRST_HEARD = [BY_NAME[name] for name in ("near", "hot", "flat", "link21")]
"""Others of which one may be for good.  With a Board 2 that hears nothing they have more states than
8 GiB hold (tried with an obstacle)."""

PAIRS = [(BY_NAME[first], "link21") for first in ("joystick", "imu", "link12", "near")]
"""A source or link that is dead, or an obstacle, and a frame of Board 2 that is lost, or all from then on."""

STEERED_TOO = [BY_NAME[name] for name in ("joystick", "imu", "supervisor2", "wheel", "hot", "flat")]
"""Faults with which the rover is steered at will.  Where Board 2 drives, its ramp has too many states to
be enumerated (a dead link to Board 1: more than 84 million); the others degrade late, or stop nothing."""

SYSTEMS = SystemTable(
    *((f"weather_{fault.name}", partial(alone, fault)) for fault in FAULTS),
    *((f"weather_{fault.name}_steered", partial(steered, fault)) for fault in STEERED_TOO),
    ("weather_near_steered", partial(steered, BY_NAME["near"], turning=True)),
    ("weather_calm", calm),
    *((f"weather_{first.name}_{second}", partial(with_another, first, second)) for first, second in PAIRS),
    *((f"weather_{fault.name}_2", partial(with_another, fault)) for fault in FIRST),
    *(
        (f"weather_{fault.name}_2", partial(with_another, fault, *(n for n in HEARD if n != fault.name)))
        for fault in FIRST_HEARD
    ),
)
"""What the motors do while something has failed, on both boards, at every phase, alone or with another."""
