"""Properties about infinite runs: loops that break them, valuations without a way back, or a proof."""
