"""One colour a quantity, the same in every picture: Okabe and Ito's colour-blind safe palette.

The energy's yellow is darkened, since the palette's own is too pale for a line on white.
app/frontend/src/colours.js has the same names and values.
"""

COLOURS = {
    "theta": "#0072B2",
    "normal": "#009E73",
    "friction": "#D55E00",
    "omega": "#CC79A7",
    "momentum": "#E69F00",
    "jellett": "#56B4E9",
    "energy": "#8C6D00",
}
INK, FAINT = "#22303c", "#8a96a3"
GREY = "#7a8794"
"""Of what is no quantity, seen on a light and on a dark page."""
