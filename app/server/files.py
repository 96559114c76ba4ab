"""How many connections a server accepts: to the system each is an open file, and a process may have only so many
(ulimit -n). At that limit no connection can be accepted, and a server that keeps trying does nothing else any more."""

from tornado.httpserver import HTTPServer

from app.server.logs import refused

try:
    import resource
except ImportError:  # Windows, where connections are not counted with the files
    resource = None

FILES = (65_536, 10_240, 4_096)  # limits to ask for; macOS allows 10,240 whatever it reports
OTHERS = 64  # of them are reserved for other things, or a quarter if there are few


def most_files():
    """Raises the limit of open files as far as the system allows and returns it; None if there is none."""
    if resource is None:
        return None
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    unlimited = resource.RLIM_INFINITY
    for files in FILES if hard == unlimited else (min(files, hard) for files in FILES):
        if soft == unlimited or soft >= files:
            break
        try:
            resource.setrlimit(resource.RLIMIT_NOFILE, (files, hard))
            return files
        except (OSError, ValueError):
            continue
    return None if soft == unlimited else soft


class Bounded(HTTPServer):
    """An HTTPServer that closes what comes while as many files are open as may be. files: from most_files()."""

    def initialize(self, *arguments, files, **named):
        super().initialize(*arguments, **named)
        self._last = float("inf") if files is None else files - min(OTHERS, files // 4)

    def handle_stream(self, stream, address):
        # The system gives each file the least number that is free: all below are open.
        if stream.socket.fileno() >= self._last:
            refused(address[0], "files", "refused %s: as many files are open as may be (ulimit -n)", address[0])
            stream.close()
            return
        super().handle_stream(stream, address)
