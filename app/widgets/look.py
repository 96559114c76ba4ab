"""The look of the page: light or dark, and large with high contrast, for a projector.

The widgets have one theme, whose colours are CSS variables; the look changes these, so that all widgets follow at once.
(With another theme each widget would compute its own, which takes seconds.)
"""

import param

from app.bundle import Bundled

# name in the widgets' theme: (on light, on dark); names with rgb are also needed as three numbers
COLOURS = {
    "text-primary": ("#1f1f1f", "#ffffff"),
    "text-secondary": ("#5b5b5b", "#b8bec5"),
    "text-disabled": ("#9e9e9e", "#808890"),
    "action-active": ("#616161", "#ffffff"),
    "action-selected": ("#000000", "#ffffff"),
    "background-default": ("#ffffff", "#0e1318"),
    "background-paper": ("#ffffff", "#0e1318"),
    "common-background": ("#ffffff", "#000000"),
    "common-onBackground": ("#000000", "#ffffff"),
    "divider": ("#e0e0e0", "#39424c"),
    "primary-main": ("#1565c0", "#90caf9"),
    "primary-dark": ("#0d47a1", "#42a5f5"),
    "primary-light": ("#42a5f5", "#e3f2fd"),
    "primary-contrastText": ("#ffffff", "#1f1f1f"),
    "default-main": ("#000000", "#9e9e9e"),
    "default-dark": ("#757575", "#bdbdbd"),
    "error-main": ("#d32f2f", "#ff8a80"),
    "error-dark": ("#c62828", "#ff8a80"),
    "Switch-defaultColor": ("#ffffff", "#e0e0e0"),
    "Switch-primaryDisabledColor": ("#a7caed", "#405a70"),
    "Slider-primaryTrack": ("#a7caed", "#48657c"),
}
OTHERS = {
    "action-disabled": ("rgb(0 0 0 / 26%)", "rgb(255 255 255 / 30%)"),
    "action-disabledBackground": ("rgb(0 0 0 / 12%)", "rgb(255 255 255 / 12%)"),
    "action-hover": ("rgb(0 0 0 / 4%)", "rgb(255 255 255 / 8%)"),
    "action-focus": ("rgb(0 0 0 / 12%)", "rgb(255 255 255 / 12%)"),
    "action-hoverOpacity": ("0.04", "0.08"),
    "action-selectedOpacity": ("0.08", "0.16"),
}


def _variables():
    yield from OTHERS.items()
    for name, colours in COLOURS.items():
        yield name, colours
        yield f"{name}Channel", tuple(" ".join(map(str, bytes.fromhex(colour[1:]))) for colour in colours)


def widgets():
    """The colours of the widgets' theme: the CSS variables of the look, with the light ones as default."""
    ours = {f"--mui-palette-{name}": f"var(--look-{name}, {light})" for name, (light, _) in _variables()}
    ours["colorScheme"] = "var(--look-scheme, light)"
    return {"MuiCssBaseline": {"styleOverrides": {":host(:not(#_))": ours}}}  # more specific than the theme's own


class Look(Bundled):
    dark = param.Boolean(default=None, allow_None=True, doc="Light on dark; None: as set in the visitor's system.")
    large = param.Boolean(default=False, doc="Large type and stronger contrast, legible across a room.")
    on_dark = param.Dict(
        default={name: dark for name, (_, dark) in _variables()},
        constant=True,
        doc="The variables of the widgets' colours on dark.",
    )
