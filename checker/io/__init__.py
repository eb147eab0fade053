"""Texts and files from outside and to the outside: printable, whole, never half written."""
