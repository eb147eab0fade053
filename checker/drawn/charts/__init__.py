"""What is drawn as charts of the language: states, transitions and actions that a person can edit."""
