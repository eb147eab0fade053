"""Who drives, and how fast: the words in which promises speak of what the boards command."""

from rovercheck.spec_model.lang.words import absolute, named
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.board1_fine import rx_age_ms

drives_1 = named("Board 1 actuates", ~b1.give_b2_actuation)
drives_2 = named("Board 2 drives", b2.autorized_to_send_command)
zero_1 = named("zero references", (b1.v_ref == 0) & (b1.omega_ref == 0))
zero_2 = named(
    "zero references of Board 2", (motion.v_ref_actuation == 0) & (motion.omega_ref_actuation == 0)
)
half_1 = named("at most half speed", (absolute(b1.v_ref) <= 0.5) & (absolute(b1.omega_ref) <= 0.5))
half_2 = (absolute(motion.v_ref_actuation) <= 0.5) & (absolute(motion.omega_ref_actuation) <= 0.5)
unheard = named(
    "no frame, or no new heartbeat, for more than 120 ms",
    (rx_age_ms > 120) | (b1.heartbeat_age > 120),
)
"""Of Board 2 [spec Table 2, §2.5]."""
