"""The widgets' theme, and the style sheet of the page itself."""

from app.widgets.look import widgets

STILL = {"@media (prefers-reduced-motion: reduce)": {"&, & *": {"transition": "none !important",
                                                                "animation": "none !important"}}}  # fmt: skip
THEME = {
    "components": {
        f"Mui{part}": {"styleOverrides": {"root": STILL}}
        for part in ("ButtonBase", "TouchRipple", "Switch", "Paper", "Backdrop", "Dialog", "OutlinedInput")
    }
    | widgets()
    | {
        "MuiToggleButtonGroup": {
            "styleOverrides": {
                "root": {"flexWrap": "wrap", "& .MuiToggleButton-root": {"width": "auto", "flex": "1 1 auto"}}
            }
        },
        # as quiet as the ground: of a page that a student votes on
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
        "MuiMenuItem": {"defaultProps": {"role": "option"}},  # all menus here are of a Select
    }
}

STYLE = [
    ".MuiLinearProgress-root { display: none !important }",  # it stays there, and has no name
    ".MuiTooltip-popper { display: none !important }",  # in English; guide.js has ours
    "main { background: var(--mui-palette-background-default) !important }",  # it would keep the first theme's
    "h3.title { color: var(--mui-palette-text-primary); font-size: 20px }",
]
HEADLESS = [
    ".MuiAppBar-root, main .MuiToolbar-root { display: none !important }",  # the page has a head of its own
    # on a phone the tabs stand at the foot
    "@media (max-width: 700px) { .main-content { padding-bottom: calc(53px + env(safe-area-inset-bottom)) } }",
]
