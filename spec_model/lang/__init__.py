"""Every word a chart file may use, its meaning and its lowering; knows no rover."""
