"""Answers for monitoring: whether the server is alive, whether it accepts new pages, and its metrics."""

from app import VERSION
from app.server.answers import Handler
from app.server.worker_status import QUEUES, REFUSALS, STATES


class Liveness(Handler):
    """Whether this worker answers, and its number of pages. If it does not answer for long, it may be restarted."""

    def get(self):
        self.write({"live": True, "sessions": len(self.application.admission.sessions), "version": VERSION})


class Readiness(Handler):
    """Whether a new page would be let in, whichever worker gets it: status 200, else 503 and the reason."""

    def get(self):
        workers = self.application.watch.now()
        why = [state for state in STATES if any(row[state] for row in workers.values())]
        self.set_status(503 if why else 200)
        sessions = {str(worker): int(row["sessions"]) for worker, row in workers.items()}
        self.write({"ready": not why, "why": why, "sessions": sessions})


class Metrics(Handler):
    """The board in the format of Prometheus. Only with TIPPE_METRICS=1, which needs prometheus-client."""

    def get(self):
        from prometheus_client import CONTENT_TYPE_LATEST, generate_latest

        self.set_header("Content-Type", CONTENT_TYPE_LATEST)
        self.finish(generate_latest(self))

    GAUGES = (  # name, field, what it says
        ("tippe_sessions", "sessions", "Pages open, and those that are kept for a while after"),
        ("tippe_connections", "connections", "Sockets of pages"),
        ("tippe_event_loop_lag_seconds", "delay", "The longest that the event loop was late, of the last 15 s"),
        ("tippe_full", "full", "1: no more pages are let in"),
        ("tippe_stopping", "stopping", "1: it drains"),
        ("tippe_compiling", "compiling", "1: kernels are compiled beside it"),
        ("tippe_memory_bytes", "memory", "Resident memory"),
        ("tippe_open_files", "files", "File descriptors"),
        ("tippe_start_time_seconds", "started", "When the worker began, since 1970"),
        ("tippe_votes_away", "away", "1: the store of the votes did not answer the last time"),
    )

    COUNTERS = (
        ("tippe_cpu_seconds", "processor", "Time of the processor"),
        ("tippe_sessions_made", "session turns", "Sessions that were made"),
        ("tippe_errors", "errors", "Lines of error in the log"),
        ("tippe_moves", "moves", "Messages of pages that were answered"),
        ("tippe_moves_seconds", "moving", "How long these took to be answered, in all"),
    )

    def collect(self):
        """The interface of a collector of prometheus_client."""
        from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily

        rows = {str(worker): row for worker, row in self.application.watch.now().items()}

        def family(kind, name, says, field, other=(), values=("",)):
            made = kind(name, says, labels=["worker", *other])
            for worker, row in rows.items():
                for value in values:
                    made.add_metric([worker, value][: 1 + len(other)], row[field.format(value)])
            return made

        build = GaugeMetricFamily("tippe_build", "1; its label has the version", labels=["version"])
        build.add_metric([VERSION], 1)
        yield build
        for name, field, says in self.GAUGES:
            yield family(GaugeMetricFamily, name, says, field)
        for name, field, says in self.COUNTERS:
            yield family(CounterMetricFamily, name, says, field)
        yield family(CounterMetricFamily, "tippe_refused", "What was refused, and why", "refused {}", ["why"], REFUSALS)
        queue = (["queue"], QUEUES)
        yield family(GaugeMetricFamily, "tippe_queue_length", "How many wait", "{} waiting", *queue)
        yield family(CounterMetricFamily, "tippe_queue_turns", "How many had their turn", "{} turns", *queue)
        yield family(CounterMetricFamily, "tippe_queue_wait_seconds", "How long these waited", "{} waited", *queue)


def routes(settings):
    """The routes: with and without the prefix; metrics only without, so that a proxy under the prefix cannot reach
    them."""
    places = [(f"{prefix}/{name}", handler) for prefix in {"", settings.prefix}
              for name, handler in (("liveness", Liveness), ("readyz", Readiness))]  # fmt: skip
    return places + ([("/metrics", Metrics)] if settings.metrics else [])
