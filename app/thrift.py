"""What Bokeh and Panel do anew for each message, done less often. What is sent, and shown, is the same.

Found by a profile of one slider that moves, of which it was the third part; benchmarks/load.py has the figures.
"""

import asyncio
from operator import attrgetter

import bokeh.document.document
from bokeh.core.serialization import Deserializer, Serializer
from bokeh.model import Model
from bokeh.protocol import SPEC
from bokeh.protocol.messages.patch_doc import patch_doc
from bokeh.settings import settings
from panel.pane import HTML
from panel.reactive import Reactive, Syncable
from param.parameterized import Parameters, Undefined
from tornado.iostream import StreamClosedError


def save():
    """From now on, in this process."""
    settings.perform_error_diagnostics = False  # an absent property's name was compared with those of all others
    Model.id = property(attrgetter("_id"))
    SPEC["PATCH-DOC"] = Patch
    bokeh.document.document.Deserializer = Incoming
    Reactive._update_properties = update_properties
    HTML._update = update_text
    Parameters._update = update


class References(Serializer):
    """Knows the models that the browser has, without a list of them all for each message."""

    def __init__(self, models):
        super().__init__()
        self._known, self._new = models._models, models._new_models

    def get_ref(self, obj):
        if isinstance(obj, Model) and self._known.get(obj._id) is obj and obj not in self._new:
            return obj.ref
        return super().get_ref(obj)


class Incoming(Deserializer):
    """What a message from the browser may name: all models of a document."""

    def __init__(self, references=(), *, setter=None):
        super().__init__(setter=setter)
        self._references = dict(zip(map(attrgetter("_id"), references), references, strict=True))


class Patch(patch_doc):
    """Changes of a document, for its browser."""

    @classmethod
    def create(cls, events, **metadata):
        [models] = {event.document.models for event in events}
        serializer = References(models)
        content = {"events": serializer.encode(events)}
        models.flush_synced(lambda model: not serializer.has_ref(model))
        message = cls(cls.create_header(), metadata, content)
        message.add_buffers(*serializer.buffers)
        return message


panels_own, params_own = Reactive._update_properties, Parameters._update


def update_properties(component, *events, doc):
    """Panel's works out the theme's styles for each change, though only a change of styles needs them."""
    if any(event.name == "stylesheets" for event in events):
        return panels_own(component, *events, doc=doc)
    return Syncable._update_properties(component, *events, doc=doc)


def update_text(pane, ref, model):
    """Panel's sets all properties of the model anew with its text."""
    model.update(**pane._process_param_change(pane._transform_object(pane.object)))


def update(parameters, arg=Undefined, /, **named):
    """Param's looks up the values of all parameters, to give back the old ones of those that change."""
    values, owner = dict(() if arg is Undefined else arg) | named, parameters.self_or_cls
    if any(name not in parameters or hasattr(parameters[name], "_autotrigger_value") for name in values):
        return params_own(parameters, values)
    old = {name: getattr(owner, name) for name in values}
    waits, parameters._BATCH_WATCH = parameters._BATCH_WATCH, True
    try:
        for name, value in values.items():
            setattr(owner, name, value)
    finally:
        parameters._BATCH_WATCH = waits
    if not waits:
        parameters._batch_call_watchers()
    return old


class Gathered:
    """A stream whose writes of one turn of the loop go out as one: a message is three and more."""

    def __init__(self, stream):
        self._stream, self._data, self._out = stream, bytearray(), None

    def __getattr__(self, name):
        return getattr(self._stream, name)

    def write(self, data):
        """A future that is done when the data is out."""
        if self._stream.closed():
            raise StreamClosedError(real_error=self._stream.error)
        if self._out is None:
            loop = asyncio.get_running_loop()
            self._out = loop.create_future()
            self._out.add_done_callback(lambda out: out.cancelled() or out.exception())  # it may be that nobody asks
            loop.call_soon(self._write)
        self._data += data
        return self._out

    def _write(self):
        if self._out is None:
            return
        data, out, self._data, self._out = bytes(self._data), self._out, bytearray(), None

        def done(written):
            if out.done():
                return
            if written.exception():
                out.set_exception(written.exception())
            else:
                out.set_result(None)

        try:
            self._stream.write(data).add_done_callback(done)
        except OSError as error:  # closed, or full
            out.set_exception(error)

    def close(self, *reason):
        """After what was written."""
        self._write()
        self._stream.close(*reason)
