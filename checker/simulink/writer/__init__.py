"""Packages of Simulink being written: blocks, charts with a layout, and data dictionaries."""
