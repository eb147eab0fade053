"""Labels and actions as text, in the words in which charts print them and Stateflow writes them.

``syntax`` reads a text, ``meaning`` and ``statements`` make formulas and actions of it with the names of
``names``, and ``chart`` does so for a whole chart.
"""
