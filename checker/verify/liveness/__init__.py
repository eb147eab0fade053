"""Properties about infinite runs: loops that break them, states without a way back, or a proof."""
