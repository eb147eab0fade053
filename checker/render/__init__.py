"""From traces, charts and graphs to what people read: one file per exit."""
