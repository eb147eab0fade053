"""Firmwares that really differ from the charts, and how many of their differences are found.

``python -m benchmarks.twins`` measures it.  The differences are changes of the source text of four
supervisors that conform: they know nothing of the code that looks for them.
"""
