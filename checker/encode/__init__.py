"""From expressions and programs to what an engine runs: machine code, bit-vectors."""
