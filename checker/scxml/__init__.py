"""State machines in SCXML: what stands in a file, and what it means, twice."""
