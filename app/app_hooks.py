"""What Bokeh calls for this folder when `panel serve app` starts; `python -m app` does the same by itself."""

import asyncio

from app.borrowed import in_one_thread, mend
from app.kernels import compile_beside
from app.server.arrivals import most_files


def on_server_loaded(server_context):
    """Has kernels compiled that are not kept, asks for as many open files as may be, and mends what is borrowed."""
    compile_beside()
    most_files()
    mend()
    in_one_thread(asyncio.get_running_loop(), server_context.application_context)
