"""What several verbs share: options, exit codes, names, and how things are shown."""
