"""Detection power: mutants of the supervisors, and faults put by hand into the charts."""
