"""What an operator sets, by environment variables or on the command line of `python -m app`."""

import argparse
import os
import re
from dataclasses import dataclass, field, fields, replace

from bokeh.server.util import check_allowlist

from app.model.ballots import store

PORT = re.compile(r":(\d+|\*)$")


def _setting(default, says, low=None, high=None):
    return field(default=default, metadata={"says": says, "from": low, "to": high})


@dataclass(frozen=True, kw_only=True)
class Settings:
    """Each field is the environment variable TIPPE_ and its name in capitals, and an option of the same name."""

    port: int = _setting(5006, "port to listen on", 1, 65535)
    address: str = _setting("", "address to listen on; without it, all of this machine's")
    prefix: str = _setting("", "path before /app, where a proxy keeps it: /tops")
    origins: str = _setting("", "names the server goes by, host or host:port, by commas; without it, any")
    frames: str = _setting("'self'", "pages that may show this one in a frame, as in a CSP")
    workers: int = _setting(1, "processes on this port", 1, 64)
    sessions: int = _setting(250, "pages open at once, in each worker", 1, 100_000)
    sessions_per_address: int = _setting(250, "the same, from one address: a hall may be one", 1, 100_000)
    linger: int = _setting(30, "s that a session is kept after its page has gone", 1, 3600)
    proxy: int = _setting(0, "1: believe a proxy's X-Forwarded-For and -Proto", 0, 1)
    show: int = _setting(0, "1: open the page in this machine's browser", 0, 1)
    votes: str = _setting("", "file or redis://host:6379/0 where votes are kept; without it, a file of this user's")
    votes_per_address: int = _setting(250, "votes in one room from one address: a hall may be one", 1, 100_000)
    secret: str = _setting("", "what sessions are signed with; without it, new at each start")
    log: str = _setting("info", "how much is logged: debug, info, warning or error")

    @classmethod
    def of(cls, environment, arguments=()):
        """From os.environ and the command line, which goes first.

        Raises ValueError naming the variable or option, its value and what is allowed; SystemExit after --help and
        for an option that is none.
        """
        known = {f"TIPPE_{item.name.upper()}": item for item in fields(cls)}
        options = vars(_parser(known.values()).parse_args(list(arguments)))
        for name in environment:
            if name.startswith("TIPPE_") and name not in known:
                raise ValueError(f"{name} is no setting. There are {', '.join(known)}.")
        values, called = {}, {}
        for name, item in known.items():
            text = options[item.name]
            called[item.name] = name if text is None else f"--{item.name.replace('_', '-')}"
            # a variable may be there and empty
            given = environment.get(name, "").strip() or None if text is None else text.strip()
            if given is not None:
                values[item.name] = _number(called[item.name], given, item) if item.type is int else given
        settings = cls(**values)
        for host in settings.hosts:
            if not re.fullmatch(r"[\w.*-]+(:(\d{1,5}|\*))?|\[[\da-fA-F:]+\](:\d{1,5})?", host):
                raise ValueError(
                    f"{called['origins']} has {host!r}; allowed is host or host:port, such as top.example.org."
                )
        path = settings.prefix.strip("/").split("/") if settings.prefix.strip("/") else []
        for name, wrong, allowed in (
            (
                "prefix",
                not all(re.fullmatch(r"(?!\.+$)[\w.~-]+", part, re.ASCII) for part in path),
                "a path of ASCII letters, digits and . _ ~ -, such as /tops",
            ),
            ("log", settings.log not in ("debug", "info", "warning", "error"), "debug, info, warning or error"),
            ("frames", any(mark in settings.frames for mark in ";,\r\n"), "sources of a CSP, by spaces"),
            ("workers", settings.workers > 1 and not hasattr(os, "fork"), "1 on this system: it cannot fork"),
        ):
            if wrong:
                raise ValueError(f"{called[name]} is {getattr(settings, name)!r}; allowed is {allowed}.")
        try:
            store(settings.votes, 1)
        except ValueError as error:
            raise ValueError(f"{called['votes']} is {settings.votes!r}; allowed is {error}.") from None
        return replace(settings, prefix="".join(f"/{part}" for part in path))

    @property
    def hosts(self):
        """The origins as host or host:port."""
        return [re.sub(r"^\w+://", "", host.strip()).rstrip("/").lower() for host in self.origins.split(",") if host]

    def lets(self, host):
        """Whether the server goes by this name, as in the Host header; a listed one without port is at 80 and 443."""

        named = [each for listed in self.hosts for each in ([listed] if PORT.search(listed) else _both(listed))]
        ways = [host.lower()] if PORT.search(host) else _both(host.lower())
        return not named or any(check_allowlist(way, named) for way in ways)


def _both(host):
    return [host] if host == "*" else [f"{host}:80", f"{host}:443"]


def _parser(items):
    parser = argparse.ArgumentParser(
        prog="python -m app",
        description="Serves the tippe top explorer, at http://localhost:5006/app if nothing else is said.",
        epilog="Each option is an environment variable too: --port 8765 is TIPPE_PORT=8765.",
        allow_abbrev=False,
    )
    for item in items:
        says = item.metadata["says"] + (f" (default: {item.default})" if item.default else "")
        alone = {"nargs": "?", "const": "1"} if item.metadata["to"] == 1 else {}  # --show is --show 1
        kind = "N" if item.type is int else "TEXT"
        parser.add_argument(f"--{item.name.replace('_', '-')}", metavar=kind, help=says, **alone)
    return parser


def _number(name, text, item):
    low, high = item.metadata["from"], item.metadata["to"]
    if not re.fullmatch(r"\d{1,9}", text) or not low <= int(text) <= high:
        raise ValueError(f"{name} is {text!r}; allowed is a whole number from {low} to {high}.")
    return int(text)
