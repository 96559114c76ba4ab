"""HTTP answers besides the page itself: redirects and files; and the headers of all answers."""

import gzip
import logging
import os
import re
import sys
from functools import cache
from http.client import responses
from pathlib import Path

from bokeh.embed.bundle import extension_dirs
from bokeh.server.views.ico_handler import IcoHandler
from bokeh.settings import settings as bokeh_settings
from panel.io.server import ComponentResourceHandler, get_static_routes
from tornado.web import ErrorHandler, HTTPError, RequestHandler, StaticFileHandler

from app import text
from app.server.logs import refused
from app.state.names import LANGUAGE

PIECE = 64 * 1024  # bytes of a file
TEXT = {".css", ".js", ".json", ".svg"}  # files that are sent compressed
HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "same-origin",  # the address contains the state of the page
    "Cross-Origin-Opener-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=(), payment=(), usb=()",
}
# BokehJS makes functions of the page's CustomJS, and Panel imports a component's code from a blob.
POLICY = (
    "default-src 'none'; script-src 'self' 'nonce-{nonce}' 'unsafe-eval' blob:; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; font-src 'self' data:; connect-src 'self' ws://{host} wss://{host} blob: data:; "
    "worker-src 'self' blob:; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors {frames}"
)
# The sentences for pages that are not let in.
SENTENCE = Path(__file__).with_name("sentence.html").read_text(encoding="utf-8")


class Answer:
    """Mixin of all handlers, also those of the libraries: these headers, and one line for an error."""

    refused = False  # and the log says so

    def set_default_headers(self):
        for name, value in HEADERS.items():
            self.set_header(name, value)
        self.set_policy()
        self.clear_header("Server")

    def set_policy(self, nonce=""):
        host, frames = self.request.host, self.application.tippe.frames
        policy = POLICY.format(nonce=nonce, host=host, frames=frames)
        if not re.fullmatch(r"[\w.:\[\]-]{1,260}", host):
            policy = POLICY.replace(" ws://{host} wss://{host}", "").format(nonce=nonce, frames=frames)
        self.set_header("Content-Security-Policy", policy)

    def refuse(self, why, line, *values):
        """Counts a refusal and logs it; values: of the line's places."""
        self.refused = True
        self.application.admission.refused[why] += 1
        refused(self.request.remote_ip, why, line, *values)

    def write_error(self, status, **more):
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        if status == 405:
            self.set_header("Allow", "GET" if type(self).head is RequestHandler.head else "GET, HEAD")
        self.finish(f"{status} {responses.get(status, 'Unknown')}\n")


@cache  # of all, so that nobody can have the same file compressed again and again: some 20 MB at most
def compressed(path, modified):
    """A file compressed by gzip, in bytes; modified: when it was last modified, so that a newer file is read again."""
    return gzip.compress(Path(path).read_bytes(), mtime=0)


class Files(Answer, StaticFileHandler):
    """Sends text compressed, which matters where no proxy does it: a classroom's Wi-Fi, where all come at once. Opens
    other files again for each piece; otherwise a slow connection would need two open files."""

    _compressed = None

    def validate_absolute_path(self, root, absolute_path):
        path, headers = super().validate_absolute_path(root, absolute_path), self.request.headers
        if path is not None and Path(path).suffix in TEXT:
            self.set_header("Vary", "Accept-Encoding")
            if "gzip" in headers.get("Accept-Encoding", "") and "Range" not in headers:
                self._compressed = compressed(path, os.path.getmtime(path))
                self.get_content = lambda *part: self._compressed
        return path

    def set_extra_headers(self, path):
        super().set_extra_headers(path)
        if self._compressed is not None:
            self.set_header("Content-Encoding", "gzip")

    def compute_etag(self):
        tag = super().compute_etag()
        return tag if self._compressed is None else f'{tag[:-1]}-gzip"'

    def get_content_size(self):
        return super().get_content_size() if self._compressed is None else len(self._compressed)

    @classmethod
    def get_content(cls, path, start=None, end=None):
        start, end = start or 0, os.path.getsize(path) if end is None else end
        for at in range(start, end, PIECE):
            yield b"".join(super().get_content(path, at, min(at + PIECE, end)))


class Extensions(Files):
    """The files of Bokeh's extensions, each of which has a folder of its own."""

    @classmethod
    def get_absolute_path(cls, root, path):
        name, _, file = path.partition(os.sep)
        if name not in extension_dirs:
            raise HTTPError(404)
        return super().get_absolute_path(extension_dirs[name], file)

    def validate_absolute_path(self, root, absolute_path):
        return super().validate_absolute_path(extension_dirs[self.path.partition(os.sep)[0]], absolute_path)


class Component(Files, ComponentResourceHandler):
    """Replaces Panel's handler, which would import any module that a visitor names."""

    def parse_url_path(self, path):
        if path.split("/")[0] not in sys.modules:
            raise HTTPError(404)
        return super().parse_url_path(path)


class Handler(Answer, RequestHandler):
    """Base class of the few plain answers of this project, none of which may be cached."""

    def set_default_headers(self):
        super().set_default_headers()
        self.set_header("Cache-Control", "no-store")

    def head(self):
        return self.get()

    @property
    def language(self):
        """The language in the address, else the one that the browser prefers."""
        request = self.request.query_arguments.get(LANGUAGE, [b""])[-1].decode(errors="replace")
        return request if request in text.LANGUAGES else text.preferred(self.request.headers.get("Accept-Language", ""))

    def words(self, name):
        return text.say(f"main.server.{name}", self.language)

    def say(self, status, sentence, again=0):
        """A page with one sentence."""
        self.set_status(status)
        self.set_header("Content-Type", "text/html; charset=utf-8")
        if again:
            self.set_header("Retry-After", str(again))
        refresh = f'<meta http-equiv="refresh" content="{again}">' if again else ""
        title = text.say("main.title", self.language)
        self.finish(SENTENCE.format(lang=self.language, title=title, sentence=sentence, again=refresh))


class Root(Handler):
    """Redirects / to the page."""

    def get(self):
        prefix = self.application.tippe.prefix
        self.redirect(f"{prefix}/app" + (f"?{self.request.query}" if self.request.query else ""))


def routes(application):
    """All routes except the page. Bokeh's own handlers of its files differ between its versions."""
    prefix = application.tippe.prefix
    files = [(r"/static/extensions/(.*)", Extensions, {"path": ""}),
             (r"/static/(.*)", Files, {"path": bokeh_settings.bokehjs_path()})]  # fmt: skip
    [(components, _, _)] = get_static_routes({})
    return [
        *((f"{prefix}{pattern}", *more) for pattern, *more in [("/?", Root), *files, (components, Component)]),
        ("/", Root),  # there, whatever the prefix
        ("/favicon.ico", type("Icon", (Answer, IcoHandler), {}), {"app": application}),
        (".*", type("Nothing", (Answer, ErrorHandler), {}), {"status_code": 404}),
    ]


def log_request(handler):
    """Logs like tornado, but without the query, which may contain the key of a teacher's vote. 503, which is how a full
    or stopping server answers, is no error; what was refused is in the log already."""
    status, request = handler.get_status(), handler.request
    level = logging.INFO if status < 400 or getattr(handler, "refused", False) else (
        logging.WARNING if status < 500 or status == 503 else logging.ERROR)  # fmt: skip
    seldom = {"seldom": (request.remote_ip, status)} if level == logging.WARNING else {}
    logging.getLogger("tornado.access").log(level, "%d %s %s (%s)", status, request.method, request.path,
                                            request.remote_ip, extra=seldom)  # fmt: skip
