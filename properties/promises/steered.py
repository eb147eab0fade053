"""While something fails the rover is steered at will: from the datum to the motors, both boards."""

from dataclasses import replace

from rovercheck.properties.document.distances import within
from rovercheck.properties.forms import Property, costly, holds_after
from rovercheck.properties.promises import weather
from rovercheck.properties.promises.weather import at_rest, slow
from rovercheck.spec_model.composition.weather import SPELLS
from rovercheck.spec_model.lang.time import ms
from rovercheck.spec_model.lang.words import named
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2


def _steered(held: Property) -> Property:
    """The same, whatever the user does with the stick before and meanwhile."""
    return costly(replace(
        held,
        id=f"{held.id}-STEERED",
        text=f"{held.text[:-1]}, steered at will.",
        on=f"{held.on}_steered",
    ))  # fmt: skip


JOYSTICK, IMU, HOT, FLAT = map(_steered, (weather.JOYSTICK, weather.IMU, weather.HOT, weather.FLAT))
SUPERVISOR2 = _steered(weather.SUPERVISOR2)

near = SPELLS["near"] == "present"
healthy = named(
    "Board 1 is healthy and drives",
    ~b1.give_b2_actuation & (b2.crit_mask_b1 == 0) & (b2.degr_mask_b1 == 0) & ~b2.autorized_to_send_command,
)
half_turn = named("a half turn", b1.is_rotating180)
covers = ["B2-OBS-01", "B1-EST-01"]

WHEEL = holds_after(
    "P-WEATHER-WHEEL-STEERED",
    "With a wheel without feedback for 80 ms, the motors stand, or turn at half speed at most, steered at "
    "will.",
    premise=SPELLS["wheel"] == "present", for_=80 * ms, then=slow,
    covers=["B1-WHL-01", "B1-REF-05"], on="weather_wheel_steered", from_tick=2,
)  # fmt: skip
NEAR = costly(holds_after(
    "P-WEATHER-NEAR-STEERED",
    "With an obstacle at 70 cm for 80 ms, the motors stand, steered at will.",
    premise=near, for_=80 * ms, then=at_rest,
    covers=covers, on="weather_near_steered", from_tick=2, interpretations=["E11", "S63"],
))  # fmt: skip
PUSHED = costly(holds_after(
    "P-WEATHER-NEAR-PUSHED",
    "With an obstacle at 70 cm for 80 ms, the stick forward or at rest meanwhile and no half turn, the "
    "motors stand.",
    premise=near & (motion.ay_norm >= 0) & (motion.bx_norm == 0) & ~half_turn, for_=80 * ms, then=at_rest,
    covers=covers, on="weather_near_steered", from_tick=2, interpretations=["S63"],
))  # fmt: skip
FORWARD = costly(holds_after(
    "P-WEATHER-NEAR-FORWARD",
    "With an obstacle at 70 cm for 80 ms, the stick forward meanwhile and no half turn, the motors stand, "
    "however the rover was steered before.",
    premise=near & (motion.ay_norm > 0) & ~half_turn, for_=80 * ms, then=at_rest,
    covers=covers, on="weather_near_steered", from_tick=2, interpretations=["S63"],
))  # fmt: skip
CALM = holds_after(
    "P-WEATHER-CALM",
    "With obstacles at 70 cm or less for 100 ms, Board 1 healthy and driving, the motors stand, "
    "whatever stick, buttons and heading do.",
    premise=within(70) & healthy, for_=100 * ms, then=at_rest,
    covers=covers, on="weather_calm", from_tick=2, interpretations=["E11", "S63"],
)  # fmt: skip
NEAR_LINK21 = costly(holds_after(
    "P-WEATHER-NEAR-LINK21",
    "With an obstacle at 70 cm for 500 ms, the motors stand, also when a frame for Board 1 is lost, or all.",
    premise=near, for_=500 * ms, then=at_rest,
    covers=[*covers, "B1-RX-03"], on="weather_near_link21", from_tick=2,
))  # fmt: skip
