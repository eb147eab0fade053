"""What surrounds the boards: sensors, links and clocks, as blocks that execute before the charts."""
