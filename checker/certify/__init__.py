"""Certificates: proofs that are written down and checked again, without the engine that found them."""
