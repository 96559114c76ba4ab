"""What Bokeh calls for this folder when `panel serve app` starts; `python -m app` does the same by itself."""

import asyncio

from app.borrowed import mend
from app.kernels import compile_beside
from app.server.files import most_files
from app.server.logs import unheard
from app.server.loop import in_one_thread


def on_server_loaded(server_context):
    """Has missing kernels compiled, raises the limit of open files, repairs what is borrowed, and ignores what closed
    pages can no longer receive."""
    compile_beside()
    most_files()
    mend()
    loop = asyncio.get_running_loop()
    loop.set_exception_handler(unheard)
    in_one_thread(loop)
