"""The colours and lines of a timeline as a style sheet, for a picture or for a page."""

from collections.abc import Mapping

from rovercheck.checker.render.lanes import Tone
from rovercheck.checker.render.run_style import FILL, HATCH, INK

PAINTED = ("ok", "degraded", "critical", "idle", "first", "action")
PRINTED: Mapping[str, str] = {
    "ink": INK, "soft": "#4f5768", "line": "#c9cedb", "grid": "#e6e9f0", "paper": "#ffffff",
    "bad": "#a3122b", "input": "#0b5c80", "curve": "#1f4e9c", "loop": "#ece9f6", "hatch": HATCH,
    **{tone.value: FILL[tone][0] for tone in Tone}, **{f"on-{tone.value}": FILL[tone][1] for tone in Tone},
    "on-idle": "#5b6472",
}  # fmt: skip
"""Colours that a print in grey still tells apart."""

THEMED: Mapping[str, str] = {
    **{name: f"var(--{name})" for name in ("ink", "soft", "line", "paper", "bad", "input")},
    **{name: f"var(--tl-{name})" for name in ("grid", "curve", "loop", "hatch", *PAINTED)},
    **dict.fromkeys(("on-ok", "on-first", "on-second"), "var(--tl-dark)"),
    **dict.fromkeys(("on-critical", "on-action"), "var(--tl-light)"),
    "second": "var(--tl-first)",
    "on-degraded": INK,
    "on-idle": "var(--tl-faint)",
}
"""Those of a page, light or dark."""

TEMPLATE = """
.tl-name{fill:{ink};font-size:11px}.tl-group{fill:{soft};font-size:11px;font-weight:bold}
.tl-tick{fill:{ink};font-size:10px;font-weight:bold}.tl-ms,.tl-range{fill:{soft};font-size:10px}
.tl-grid{stroke:{grid};fill:none}.tl-base{stroke:{line};fill:none}
.tl-curve{stroke:{curve};stroke-width:1.8;fill:none;stroke-linejoin:round}
.tl-ramp{fill:{curve};fill-opacity:.16}.tl-value{fill:{ink};font-size:10px;
paint-order:stroke;stroke:{paper};stroke-width:3px;stroke-linejoin:round}
.tl-limit{stroke:{bad};stroke-dasharray:5 3;fill:none}.tl-bound{fill:{bad};font-size:10px}
.tl-hatch{stroke:{hatch};stroke-width:.8;fill:none}.tl-label{font-size:10px}
.tl-needed{fill:none;stroke:{input};stroke-width:2.2}.tl-mark{fill:{input};font-size:11px}
.tl-shot{fill:{ink};stroke:{paper};stroke-width:.8}
.tl-loop{fill:{loop}}.tl-loop-edge{stroke:{soft};stroke-dasharray:2 2;fill:none}
.tl-loop-text{fill:{ink};font-size:11px;font-weight:bold}
.tl-gap{stroke:{paper};stroke-width:6;fill:none}.tl-cut{stroke:{soft};stroke-width:.8;fill:none}
.tl-fail{fill:none;stroke:{bad};stroke-width:2}.tl-fail-text{fill:{bad};font-size:11px;font-weight:bold}
.tl-end{fill:none;stroke:{ink};stroke-width:2}.tl-end-text{fill:{ink};font-size:11px;font-weight:bold}
.tl-hover{fill:none;pointer-events:all}
"""
FOLDS = """
.tl-fold{fill:{loop};stroke:{soft};stroke-dasharray:4 3}.tl-fold-text{fill:{ink};font-size:11px}
.tl-bracket{stroke:{soft};fill:none}
"""
TONES = "".join(
    f".tl-is-{tone.value}{{fill:{{{tone.value}}};stroke:{{paper}}}}.tl-on-{tone.value}{{fill:{{on-{tone.value}}}}}"
    for tone in Tone
)
MEANINGS = {
    Tone.OK: "OK, or true part of the property",
    Tone.DEGRADED: "degraded",
    Tone.CRITICAL: "critical, or false part of the property",
    Tone.ACTION: "true",
    Tone.IDLE: "false, or nothing",
    Tone.FIRST: "any other value",
}
"""What the fillings say, apart from their labels."""


def sheet(colours: Mapping[str, str], folds: bool = True) -> str:
    """The style sheet with these colours, by their names in the template; ``folds`` are drawn, too."""
    shown = TEMPLATE + TONES + (FOLDS if folds else "")
    for name, colour in colours.items():
        shown = shown.replace("{" + name + "}", colour)
    return shown.strip()
