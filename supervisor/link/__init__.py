"""The serial link between the boards: payloads, frames, the receive task and the comparison of heartbeats."""
