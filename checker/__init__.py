"""How we know: engines, encoders, replay, renderers and the command line."""
