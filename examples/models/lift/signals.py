"""Signals of the lift: what the cabin and its door sense, and what they are told to do."""

from rovercheck import enumeration, flag, integer, var

call = flag("call", "somebody wants the door open")
ride = flag("ride", "somebody has chosen another floor")
close_button = flag("close_button", "somebody wants the door closed")
at_floor = flag("at_floor", "the cabin is level with a floor")
blocked = flag("blocked", "something is in the light curtain")

MOTOR = enumeration("Motor", ["STOP", "OPEN", "CLOSE"])
motor = var("motor", MOTOR, "STOP", "what the motor of the door does")
WIDE = 4
gap = var("gap", integer(0, WIDE), 0, "how far the door is open; 0: closed")
locked = flag("locked", "the door is closed and stays so")
moving = flag("moving", "the cabin moves")
