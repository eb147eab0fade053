"""Conformance: does an implementation, or a log of one, behave as the charts say?"""
