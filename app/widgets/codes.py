"""QR codes."""

import segno


def qr(text, title=None, border=4):
    """The code of a text as an SVG, as large as its place; "" if the text is too long for one. A screen has no stains,
    so few errors need to be corrected: fewer modules are larger ones, which are read from the back of a room."""
    try:
        code = segno.make(text, error="l", micro=False)
    except segno.DataOverflowError:
        return ""
    return code.svg_inline(omitsize=True, dark="black", light="white", title=title, border=border)
