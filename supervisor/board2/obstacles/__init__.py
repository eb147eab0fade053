"""Obstacles while Board 1 is healthy: stop before a near one, turn toward where a moving one came from."""

from rovercheck.supervisor.board2.obstacles.chart import Obstacles

__all__ = ["Obstacles"]
