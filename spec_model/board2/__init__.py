"""Board 2: a file per chart, the blocks between them, and the systems in which they are checked."""
