"""The verbs of the command line, a folder or module each.

They are discovered automatically: every module of this folder that holds a command.
"""
