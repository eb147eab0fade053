"""What is found, as data only: runs, traces, answers, verdicts, graphs."""
