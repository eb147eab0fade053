"""What the pictures share: measuring text, layered layout, routing; it knows no output format."""
