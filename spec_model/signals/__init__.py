"""Signals of both boards: name, finite domain, unit and meaning of everything a chart reads or writes."""
