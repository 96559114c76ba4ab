"""The theme of the widgets, and the style sheet of the page itself."""

from app.widgets.look import widgets

STILL = {"@media (prefers-reduced-motion: reduce)": {"&, & *": {"transition": "none !important",
                                                                "animation": "none !important"}}}  # fmt: skip
# A font of the visitor's own system: the Roboto that comes with the widgets is fetched in sixteen parts, whatever the
# text, because one of its two style sheets does not say which characters a part has.
FAMILY = 'Inter, "Segoe UI", -apple-system, "Liberation Sans", Arial, system-ui, sans-serif'
THEME = {
    "typography": {"fontFamily": FAMILY},
    "components": {
        f"Mui{part}": {"styleOverrides": {"root": STILL}}
        for part in ("ButtonBase", "TouchRipple", "Switch", "Paper", "Backdrop", "Dialog", "OutlinedInput")
    }
    | widgets()
    | {
        # as plain as the background, on the page on which a student votes
        "MuiAppBar": {
            "styleOverrides": {
                "root": {
                    "backgroundColor": "var(--mui-palette-background-default) !important",
                    "color": "var(--mui-palette-text-primary) !important",
                    "boxShadow": "none !important",
                    "borderBottom": "1px solid var(--mui-palette-divider)",
                }
            }
        },
        "MuiMenuItem": {"defaultProps": {"role": "option"}},  # every menu here belongs to a Select
    },
}

STYLE = [
    ".MuiLinearProgress-root { display: none !important }",  # always there, and without a name for screen readers
    ".MuiTooltip-popper { display: none !important }",  # these are in English; guide.js shows ours
    "main { background: var(--mui-palette-background-default) !important }",  # else that of the first theme stays
    "h3.title { color: var(--mui-palette-text-primary); font-size: 20px }",
]
HEADLESS = [
    ".MuiAppBar-root, main .MuiToolbar-root { display: none !important }",  # the page has its own head
    # on a phone the tabs are at the foot; what scrolls ends above them, because a padding is not below what overflows
    "@media (max-width: 700px) { .main-content { margin-bottom: calc(53px + env(safe-area-inset-bottom)) } }",
]
