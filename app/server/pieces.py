"""The pieces in which a message goes out: each is a frame of the websocket and a task of the event loop."""

import gzip
import json
import re
from base64 import b64encode

from tornado.locks import Lock

REFERENCE = re.compile(r'"data":\{"id":"([^"\\]*)"\}')  # in a text it would have backslashes
SMALL = 6144  # bytes of an array that costs more as two pieces of its own than among the words: a curve has up to 5,128


class Pieces(list):
    """The pieces of a message as Bokeh would write them to a socket: (piece, whether it is bytes)."""

    write_lock = Lock()

    async def write_message(self, piece, binary=False, locked=True):
        self.append((piece, binary))


async def pieces_of(message):
    """Those of a Bokeh message, with its small arrays among the words, as Bokeh writes arrays into a file: gzip (here
    without any compression) in base64. Half of a move's 50 pieces were for arrays of less than a hundred numbers."""
    written = Pieces()
    await message.send(written)
    (header, _), metadata, (content, _), *arrays = written
    kept, small, named = [], {}, set(REFERENCE.findall(content))
    for (name, _), (data, _) in zip(arrays[::2], arrays[1::2], strict=True):
        key = json.loads(name)["id"]
        if len(data) > SMALL or key not in named:
            kept += (name, False), (data, True)
        else:
            small[key] = b64encode(gzip.compress(data, 0, mtime=0)).decode()
    content = REFERENCE.sub(lambda found: f'"data":"{small[found[1]]}"' if found[1] in small else found[0], content)
    if len(kept) < len(arrays):
        header = json.dumps(json.loads(header) | {"num_buffers": len(kept) // 2})
    return [(header, False), metadata, (content, False), *kept]
