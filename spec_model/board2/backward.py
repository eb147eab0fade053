"""Toggle of backward mode of Board 2, the first region of its reference chart: as on Board 1 (S59)."""

from rovercheck.spec_model.manoeuvres.backward import backward_mode_toggle
from rovercheck.spec_model.signals.board2_motion import ay_norm, backward_enabled, btn1, btn2, bx_norm

toggle_2 = backward_mode_toggle(
    "Backward_mode_toggle_2",
    btn1=btn1,
    btn2=btn2,
    x_norm=bx_norm,
    y_norm=ay_norm,
    backward_enabled=backward_enabled,
)
