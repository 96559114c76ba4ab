"""What Bokeh calls for this folder when `panel serve app` starts; `python -m app` does the same by itself."""

import asyncio

from app.borrowed import in_one_thread, mend
from app.kernels import compile_beside
from app.server.arrivals import most_files
from app.server.logs import unheard


def on_server_loaded(server_context):
    """Has kernels compiled that are not kept, asks for as many open files as may be, mends what is borrowed, and passes
    over what closed pages no longer hear."""
    compile_beside()
    most_files()
    mend()
    loop = asyncio.get_running_loop()
    loop.set_exception_handler(unheard)
    in_one_thread(loop, server_context.application_context)
