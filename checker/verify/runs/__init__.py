"""What becomes of a run that an engine found: moved to the concrete system, minimised, replayed."""
