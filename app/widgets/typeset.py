"""Plain sentences as they appear on the page: letters of formulas, signs and units as they are printed."""

import html
import re

LETTERS = {
    "K_J": "<i>K</i><sub>J</sub>", "K_R": "<i>K</i><sub>R</sub>", "C_J": "<i>C</i><sub>J</sub>",
    "I1": "<i>I</i><sub>1</sub>", "I3": "<i>I</i><sub>3</sub>", "f1": "<i>f</i><sub>1</sub>",
    "f3": "<i>f</i><sub>3</sub>", "F_z": "<i>F</i><sub>z</sub>", "F_h": "<i>F</i><sub>h</sub>",
    "mu_s": "<i>μ</i><sub>s</sub>", "mu_k": "<i>μ</i><sub>k</sub>", "mu": "<i>μ</i>", "μ_s": "<i>μ</i><sub>s</sub>",
    "omega_3": "<i>ω</i><sub>3</sub>", "omega3": "<i>ω</i><sub>3</sub>", "omega2": "<i>ω</i><sub>2′</sub>",
    "theta_dot": "<i>θ̇</i>", "theta": "<i>θ</i>", "MgR": "<i>MgR</i>", "MR^2": "<i>MR</i><sup>2</sup>",
    "(R/g)^1/2": "(<i>R</i>/<i>g</i>)<sup>½</sup>", "(g/R)^1/2": "(<i>g</i>/<i>R</i>)<sup>½</sup>",
    "m/s^2": "m/s<sup>2</sup>", "kg/m^3": "kg/m<sup>3</sup>", "&gt;=": "≥", "&lt;=": "≤",
}  # fmt: skip
"""{as a program writes it, in HTML: as it is printed}."""
LETTER = re.compile("|".join(rf"(?<![\w.]){re.escape(each)}(?!\w)" for each in sorted(LETTERS, key=len, reverse=True)))
MINUS = re.compile(r"(?<![\w.\N{MINUS SIGN}-])-(?=[\d.])|(?<=\de)-(?=\d)")


def typeset(sentence):
    """HTML of plain text."""
    return MINUS.sub("\N{MINUS SIGN}", LETTER.sub(lambda found: LETTERS[found[0]], html.escape(sentence)))


def power(value):
    """A small number as 3·10⁻¹³."""
    mantissa, exponent = f"{max(value, 1e-16):.0e}".split("e")
    return f"{mantissa}·10<sup>{int(exponent)}</sup>".replace("-", "\N{MINUS SIGN}")
