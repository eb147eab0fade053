"""Proposes the mapping file of a firmware in C: what its sources declare, beside the signals of a board.

Nothing is compiled or executed for it, and no header of a platform is needed.
"""
