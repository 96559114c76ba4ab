"""The pieces of a message: they are few, and Bokeh's own receiver reads from them what was sent."""

import numpy as np
import pytest
from bokeh.core.serialization import Deserializer
from bokeh.document import Document
from bokeh.document.events import ModelChangedEvent
from bokeh.models import ColumnDataSource
from bokeh.protocol import Protocol
from bokeh.protocol.receiver import Receiver
from wire import run

from app.server.pieces import SMALL, pieces_of


def sent_and_received(data):
    """The number of pieces, and the columns that the receiver gets."""
    document, source = Document(), ColumnDataSource({})
    document.add_root(source)
    message = Protocol().create("PATCH-DOC", [ModelChangedEvent(document, source, "data", data)])

    async def way():
        receiver, got = Receiver(Protocol()), None
        pieces = await pieces_of(message)
        for piece, is_bytes in pieces:
            got = await receiver.consume(piece if is_bytes else str(piece))
        return len(pieces), got

    count, got = run(way())
    [event] = Deserializer([source], setter=None).deserialize(got.payload)["events"]
    return count, event["new"]


@pytest.mark.parametrize(
    "sizes, pieces", [((), 3), ((7, 300), 3), ((SMALL // 8, SMALL // 8 + 1), 5), ((9000, 9000), 7)]
)
def test_small_arrays_go_among_the_words_and_come_out_the_same(sizes, pieces):
    dice = np.random.default_rng(1)
    data = {f"c{i}": dice.normal(size=size) for i, size in enumerate(sizes)} | {"words": ["a", '"data":{"id":"p1"}']}
    count, got = sent_and_received(data)
    assert count == pieces and got.keys() == data.keys() and list(got["words"]) == data["words"]
    for name in data.keys() - {"words"}:
        assert np.array_equal(got[name], data[name])
