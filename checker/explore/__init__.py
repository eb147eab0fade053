"""What there is to reach: graphs of reachable states, and runs made by hand."""
