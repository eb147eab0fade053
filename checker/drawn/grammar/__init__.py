"""The texts of Stateflow charts: labels of states and transitions, signatures, scripts, in both languages."""
