"""What the source document says in numbers, bits and formulas that several areas of properties need.

Written from the document, never taken from a chart: a chart that departs from it must not carry the
properties along.  Each fact names its source; ``[design]`` marks what the document leaves to the design,
and ``choose`` says a sentence once for each interpretation of it.
"""
