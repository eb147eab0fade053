"""Machines of XState in JSON: what stands in them, and what they mean, twice."""
