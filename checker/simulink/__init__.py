"""Simulink's files: packages of models (.slx) and data dictionaries (.sldd), classes and scripts (.m)."""
