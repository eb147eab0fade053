"""One file per area: what must be true of the rover, as sentences with an id."""
