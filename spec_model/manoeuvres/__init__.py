"""What the reference charts of both boards share: the toggle of backward mode and the 180° rotation."""
