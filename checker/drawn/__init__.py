"""Charts and diagrams as somebody drew them, in whatever file: the neutral model."""
