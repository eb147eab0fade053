"""Causes of deviations: the nearest changes of the charts with which recorded runs are runs of them."""
