"""``rovercheck graph``: a chart as it is drawn, or a projected state graph."""
