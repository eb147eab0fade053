"""The verbs of the command line, a folder or module each: found by being here, beside what they share."""
