"""Work in child processes that can be killed at any moment, and what becomes of their errors."""
