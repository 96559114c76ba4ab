"""Stores for votes that all workers share: a file on one host, a Redis for several. Both store texts by keys.

read(keys) returns a dict of those that exist. change(key, function) replaces a text by function(text) atomically; None
stands for no text, and an exception in function leaves everything unchanged. Both raise Away.
"""

import importlib.util
import os
import re
import sqlite3
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

PATIENCE = 1.0  # s that a store may take to answer
FOLDER = "tippe-top-explorer"
URL = re.compile(r"(redis|rediss|unix)://.+")


class Away(Exception):
    """The store does not answer or cannot be written to; the text is for the log."""


class Sqlite:
    """A file that all workers of a host have open at the same time. To be used from one thread."""

    def __init__(self, path):
        self._path, self._connection, self._opened = Path(path), None, None

    def _file(self):
        """The identity of the file that is there now: the file may have been removed and replaced by another."""
        try:
            there = self._path.stat()
        except FileNotFoundError:
            return None
        return there.st_dev, there.st_ino

    def _open(self):
        self.leave()
        self._path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        os.close(os.open(self._path, os.O_RDWR | os.O_CREAT, 0o600))  # also the mode of SQLite's files beside it
        self._connection = sqlite3.connect(self._path, timeout=PATIENCE, isolation_level=None, check_same_thread=False)
        # In this mode reading never waits for writing. SQLite does not wait when two processes set it at the same time.
        end = time.monotonic() + PATIENCE
        while True:
            try:
                self._connection.execute("pragma journal_mode = wal")
                break
            except sqlite3.OperationalError:
                if time.monotonic() > end:
                    raise
                time.sleep(0.02)
        self._connection.execute("pragma synchronous = normal")
        self._connection.execute("create table if not exists texts (key text primary key, text text not null)")
        self._opened = self._file()

    def leave(self):
        if self._connection is not None:
            self._connection.close()
        self._connection = self._opened = None

    @contextmanager
    def _working(self):
        try:
            if self._connection is None or self._file() != self._opened:
                self._open()
            yield self._connection.execute
        except (sqlite3.Error, OSError) as error:
            self.leave()
            raise Away(f"{self._path}: {error}") from error

    def read(self, keys):
        keys = list(keys)
        with self._working() as run:
            holes = ", ".join("?" * len(keys))
            return dict(run(f"select key, text from texts where key in ({holes})", keys).fetchall())

    def change(self, key, function):
        with self._working() as run:
            run("begin immediate")
            try:
                found = run("select text from texts where key = ?", [key]).fetchone()
                text = function(found[0] if found else None)
                if text is None:
                    run("delete from texts where key = ?", [key])
                else:
                    run("insert or replace into texts values (?, ?)", [key, text])
                run("commit")
            except BaseException:
                if self._connection.in_transaction:
                    run("rollback")
                raise


class Redis:
    """A Redis server, which deletes texts that have not changed for `lasts` seconds."""

    def __init__(self, url, lasts):
        import redis
        from redis.backoff import NoBackoff
        from redis.retry import Retry

        self._lasts, self._error = int(lasts), redis.RedisError
        # two attempts: the first may only discover that the connection was lost
        self._client = redis.Redis.from_url(url, decode_responses=True, socket_timeout=PATIENCE,
                                            socket_connect_timeout=PATIENCE, retry=Retry(NoBackoff(), 1))  # fmt: skip
        self._client.connection_pool.make_connection()  # does not connect yet, but raises for an impossible URL

    @contextmanager
    def _working(self):
        try:
            yield self._client
        except (self._error, OSError) as error:
            raise Away(f"Redis: {error}") from error

    def leave(self):
        self._client.close()

    def read(self, keys):
        keys = list(keys)
        with self._working() as client:
            texts = client.mget([f"tippe:{key}" for key in keys]) if keys else []
            return {key: text for key, text in zip(keys, texts, strict=True) if text is not None}

    def change(self, key, function):
        name = f"tippe:{key}"

        def changed(pipe):  # is repeated if another client was faster
            text = function(pipe.get(name))
            pipe.multi()
            if text is None:
                pipe.delete(name)
            else:
                pipe.set(name, text, ex=self._lasts)

        with self._working() as client:
            client.transaction(changed, name)


def store(where, lasts):
    """The store that TIPPE_VOTES names: the URL of a Redis, a file, or, if it is empty, a file in this user's home.
    lasts: s for which a text must be kept unchanged. Raises ValueError if it is neither."""
    if "://" not in where:
        return Sqlite(where or usual())
    if not URL.fullmatch(where):
        raise ValueError("a file, or the URL of a Redis, such as redis://localhost:6379/0")
    if importlib.util.find_spec("redis") is None:
        raise ValueError("a file, as for a Redis the package redis is missing: pip install 'redis>=6,<9'")
    try:
        return Redis(where, lasts)
    except (ValueError, TypeError) as error:
        raise ValueError(f"the URL of a Redis, such as redis://localhost:6379/0 ({error})") from None


def usual():
    """A file that all servers of this user on this machine share, and find again after a restart."""
    given = os.environ.get("LOCALAPPDATA" if os.name == "nt" else "XDG_STATE_HOME", "")
    home = (Path(given) if Path(given).is_absolute() else Path("~/.local/state").expanduser()) / FOLDER
    nearest = next(folder for folder in (home, *home.parents) if folder.exists())
    return (home if os.access(nearest, os.W_OK | os.X_OK) else _beside()) / "votes.sqlite"


def _beside():
    """A folder of this user's in the temporary directory. It must have been created by this user, because anybody can
    create one of that name."""
    folder = Path(tempfile.gettempdir()) / f"{FOLDER}-{os.getuid() if hasattr(os, 'getuid') else 'user'}"
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        made = folder.lstat()
    except OSError:
        return folder  # nothing can be stored there, which is reported at the first attempt
    ours = not hasattr(os, "getuid") or (made.st_uid == os.getuid() and made.st_mode & 0o170077 == 0o040000)
    return folder if ours else Path(tempfile.mkdtemp(prefix=FOLDER))
