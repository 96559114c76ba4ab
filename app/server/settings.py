"""What an operator sets, by environment variables or on the command line of `python -m app`."""

import argparse
import os
import re
import sys
from dataclasses import dataclass, field, fields
from importlib.util import find_spec
from pathlib import Path

from bokeh.server.util import check_allowlist

from app.model.votes.ballots import store
from app.server.memory import FILLED, memory_limit

OF_WORKER, OF_PAGE = 300e6, 8e6  # bytes; a page that has seen all rooms has twice as many
FORKS = hasattr(os, "fork")
FORKLESS = "" if FORKS else ": this system cannot fork"  # for another worker, or one that takes the place of one
PORT = re.compile(r":(\d+|\*)$")


# Parsers of the texts; each raises a ValueError that says what is allowed.


def whole(low, high, why=""):
    """Parser of a whole number from low to high; why: not more."""

    def taken(text):
        if not re.fullmatch(r"\d{1,9}", text) or not low <= int(text) <= high:
            raise ValueError(f"a whole number from {low} to {high}{why}")
        return int(text)

    return taken


def matching(pattern, allowed):
    """Parser of a text that matches the pattern."""

    def taken(text):
        if not re.fullmatch(pattern, text):
            raise ValueError(allowed)
        return text

    return taken


def path(text):
    """The path with a slash before each part."""
    parts = text.strip("/").split("/") if text.strip("/") else []
    if not all(re.fullmatch(r"(?!\.+$)[\w.~-]+", part, re.ASCII) for part in parts):
        raise ValueError("a path of ASCII letters, digits and . _ ~ -, such as /tops")
    return "".join(f"/{part}" for part in parts)


def names(text):
    """The hosts, each as host or host:port."""
    hosts = [re.sub(r"^\w+://", "", host.strip()).rstrip("/").lower() for host in text.split(",") if host]
    for host in hosts:
        if not re.fullmatch(r"[\w.*-]+(:(\d{1,5}|\*))?|\[[\da-fA-F:]+\](:\d{1,5})?", host):
            raise ValueError(f"host or host:port, such as top.example.org, by commas; {host!r} is neither")
    return tuple(hosts)


def votes(text):
    """A place where votes can be kept."""
    store(text, 1)
    return text


def writable(text):
    """A folder in which files can be written."""
    if not text or (os.path.isdir(text) and os.access(text, os.W_OK)):
        return text
    raise ValueError("a folder that is there, and in which the server may write")


def measured(text):
    """Whether /metrics is served, which needs a package."""
    if whole(0, 1)(text) and find_spec("prometheus_client") is None:
        raise ValueError("0 as long as prometheus-client is not installed: pip install 'tippe-top-explorer[metrics]'")
    return int(text)


def fitting(workers):
    """How many pages of one room each of so many workers has memory for, at most 250."""
    return int(max(1, min(250, (FILLED * memory_limit() / workers - OF_WORKER) // OF_PAGE)))


def _setting(default, says, take=str):
    return field(default=default, metadata={"says": says, "take": take})


@dataclass(frozen=True, kw_only=True)
class Settings:
    """Each field is an environment variable, TIPPE_ and its name in capitals, and an option of the same name."""

    port: int = _setting(5006, "port to listen on", whole(1, 65535))
    address: str = _setting("", "address to listen on; without it, all of this machine's")
    prefix: str = _setting("", "path before /app, if a proxy passes it on: /tops", path)
    origins: tuple = _setting((), "names of the server, host or host:port, separated by commas; without it, any", names)
    frames: str = _setting("'self'", "pages that may show this one in a frame, as in a content security policy",
                           matching(r"[^;,\r\n]*", "sources of a CSP, by spaces"))  # fmt: skip
    workers: int = _setting(1, "processes on this port", whole(1, 64 if FORKS else 1, FORKLESS))
    sessions: int = _setting(fitting(1), "pages open at once, in each worker; by default what fits into the memory",
                             whole(1, 100_000))  # fmt: skip
    sessions_per_address: int = _setting(
        250, "the same, from one address; a whole class may share one", whole(1, 100_000)
    )
    linger: int = _setting(30, "s for which a session is kept after its page has closed", whole(1, 3600))
    proxy: int = _setting(0, "1: believe a proxy's X-Forwarded-For and -Proto", whole(0, 1))
    show: int = _setting(0, "1: open the page in this machine's browser", whole(0, 1))
    votes: str = _setting("", "file or redis://host:6379/0 where votes are kept; without it, a file of this user's",
                          votes)  # fmt: skip
    maps: str = _setting("", "folder where computed maps are kept, up to 100 MB; without it, in memory alone", writable)
    votes_per_address: int = _setting(
        250, "votes in one class from one address; a whole class may share one", whole(1, 100_000)
    )
    responsible: str = _setting("", "who answers for the page, and how to reach them: for its accessibility statement")
    secret: str = _setting("", "signs sessions; without it, a new one at each start")
    log: str = _setting("info", "how much is logged: debug, info, warning or error",
                        matching("debug|info|warning|error", "debug, info, warning or error"))  # fmt: skip
    log_format: str = _setting("text", "text, or json: one object per line", matching("text|json", "text or json"))
    log_addresses: int = _setting(1, "0: the log has - in place of visitors' addresses", whole(0, 1))
    metrics: int = _setting(0, "1: /metrics is there, for Prometheus", measured)
    memory: int = _setting(0, "MB of memory above which a worker without visitors is replaced; 0: never",
                           whole(0, 1_000_000 if FORKS else 0, FORKLESS))  # fmt: skip
    drain: int = _setting(5, "s at most in which open pages are sent elsewhere, one by one, at SIGTERM", whole(0, 3600))

    @classmethod
    def of(cls, environment, arguments=()):
        """From os.environ and the command line, which takes precedence.

        Raises ValueError naming the variable or option, its value and what is allowed; SystemExit after --help and
        for an option that is none.
        """
        known = {f"TIPPE_{item.name.upper()}": item for item in fields(cls)}
        options = vars(_parser(known.values()).parse_args(list(arguments)))
        for name in environment:
            if name.startswith("TIPPE_") and name not in known:
                raise ValueError(f"{name} is no setting. There are {', '.join(known)}.")
        values = {}
        for name, item in known.items():
            text, called = options[item.name], f"--{item.name.replace('_', '-')}"
            if text is None:
                text, called = environment.get(name, "").strip() or None, name  # it may be there and empty
            if text is None:
                continue
            try:
                values[item.name] = item.metadata["take"](text.strip())
            except ValueError as error:
                raise ValueError(f"{called} is {text.strip()!r}; allowed is {error}.") from None
        return cls(**{"sessions": fitting(values.get("workers", 1))} | values)

    def lets(self, host):
        """Whether the server goes by this name, as in the Host header; a listed one without port is at 80 and 443."""
        named = [each for listed in self.origins for each in _with_port(listed)]
        return not named or any(check_allowlist(way, named) for way in _with_port(host.lower()))


def _with_port(host):
    return [host] if host == "*" or PORT.search(host) else [f"{host}:80", f"{host}:443"]


def _parser(items):
    parser = argparse.ArgumentParser(
        prog="tippe-top" if Path(sys.argv[0]).stem == "tippe-top" else "python -m app",
        description="Serves the tippe top explorer, at http://localhost:5006/app by default.",
        epilog="Each option is an environment variable too: --port 8765 is TIPPE_PORT=8765. "
        "`site --help`: a folder that opens without a server.",
        allow_abbrev=False,
    )
    for item in items:
        says = item.metadata["says"] + (f" (default: {item.default})" if item.default else "")
        alone = {"nargs": "?", "const": "1"} if says.startswith("1: ") else {}  # --show is --show 1
        kind = "N" if item.type is int else "TEXT"
        parser.add_argument(f"--{item.name.replace('_', '-')}", metavar=kind, help=says, **alone)
    return parser
