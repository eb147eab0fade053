"""From properties to verdicts: tasks, searches in child processes, replay."""
