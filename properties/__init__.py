"""What must be true of the rover: property forms, their reduction to goals, and one file per area."""
