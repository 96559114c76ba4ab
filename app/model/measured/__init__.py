"""What a visitor has measured, and the motion that is fitted to it."""

from app.model.measured import table
from app.model.measured.cells import MeasuredError
from app.model.measured.unpack import Wrong, decoded, is_packed, shortened


def read(name: str, data: bytes) -> table.Table:
    """The Table in a file: its columns, each with its name, its quantity ("" if it was not understood), its unit,
    whether that was guessed, its values as they are written, and si, in s, rad, rad/s or m.

    name: the file's; of a phone logger's it tells the sensor, and nothing else is taken from it. Of a long table rows
    are left out, as the page's browser does it. Raises MeasuredError, and nothing else."""
    try:
        text, _ = table.text_inside(data) if is_packed(data) else shortened(decoded(data))
    except Wrong as wrong:
        code, numbers = wrong.args
        raise MeasuredError(code, **numbers) from None
    return table.read(text, name)
