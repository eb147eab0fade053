"""The engines: each module here with a ``NAME`` and a ``check`` is one."""
