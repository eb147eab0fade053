"""A recorded run beside the charts, part by part: states that explain it, and what nothing explains."""
