"""How many visitors one server bears, beside a bare Bokeh app under the same load; on this machine alone, and bounded.

    python benchmarks/load.py [--quick] [--only NAME ...]

Visitors speak Bokeh's protocol without a browser (tests/wire.py), and answer what a browser answers. A reply is the
first picture that comes after a slider moved. The generator runs beside, on the same cores.

    class     100 sessions, each moves a slider every 2 s, for 120 s
    lecture   200 sessions, of which 20 move one
    memory    of the server, MB: a session that came and looks, one that moves a slider, and after all have left
    leak      visitors who come, move a slider 5 times and go, many times over
    breaks    more and more who move a slider every 2 s, until p95 is over 1 s or something fails

Results of runs are kept below.
"""

import argparse
import asyncio
import datetime
import os
import platform
import subprocess
import sys
import tempfile
import time
from contextlib import ExitStack, contextmanager
from importlib.metadata import version
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))
from visiting import free_port
from wire import Closed, Visitor, answers, served, until

BARE = """
import numpy as np
from bokeh.io import curdoc
from bokeh.layouts import column
from bokeh.models import ColumnDataSource, Slider
from bokeh.plotting import figure
x = np.linspace(0, 10, 400)
source = ColumnDataSource({"x": x, "y": np.sin(x)})
fig = figure(width=520, height=390, y_range=(-1, 1))
fig.line("x", "y", source=source)
slider = Slider(start=0, end=8.4, step=0.01, value=7, width=300)
slider.on_change("value", lambda attr, old, new: source.update(data={"x": x, "y": np.sin(x + new)}))
curdoc().add_root(column(slider, fig))
"""
EVERY = 2.0  # s between two moves of a slider
COMING = 8  # who come at the same time


class Active:
    """A visitor who reads all the time, answers as a page does, and times the replies."""

    def __init__(self, visitor):
        self.visitor, self.moved, self.times, self.lost = visitor, None, [], None
        self.dial, self.slider = (visitor.find(kind) for kind in ("Dial", "Slider"))
        self.painted = (visitor.find("Painted") or [None])[0]
        self.reading = asyncio.create_task(self._read())

    async def _read(self):
        try:
            while True:
                kind, content, _ = await self.visitor.receive()
                if kind == "ERROR":
                    raise RuntimeError(content["text"])
                if kind != "PATCH-DOC":
                    continue
                if self.moved is not None:
                    self.times.append(time.monotonic() - self.moved)
                    self.moved = None
                for event in content["events"]:
                    if event.get("attr") == "sent":
                        await self.visitor.set(self.painted, "painted", event["new"])
        except (Closed, RuntimeError) as error:
            self.lost = error

    async def move(self, value):
        """One step of the slider; one that came before the last was answered counts as answered now."""
        if self.moved is not None:
            self.times.append(time.monotonic() - self.moved)
        self.moved = time.monotonic()
        if self.dial:
            await self.visitor.set(self.dial[0], "asked", [len(self.times), value, False])
        else:
            await self.visitor.set(self.slider[0], "value", value)

    async def act(self, seconds, delay):
        """Moves to and fro."""
        await asyncio.sleep(delay)
        end, i = time.monotonic() + seconds, 0
        while time.monotonic() < end and not self.lost:
            due = time.monotonic() + EVERY
            await self.move(round(6 + 0.01 * (i % 90), 2))
            i += 1
            await asyncio.sleep(max(0, due - time.monotonic()))

    async def leave(self):
        """Closes the page."""
        self.reading.cancel()
        self.visitor.leave()


async def come(urls, count):
    """So many visitors, a few at a time, over all the servers; and how long each waited for his page, s."""
    waited, gate = [], asyncio.Semaphore(COMING)

    async def one(i):
        async with gate:
            start = time.monotonic()
            visitor = await Visitor.enter(urls[i % len(urls)])
            waited.append(time.monotonic() - start)
            return Active(visitor)

    return await asyncio.gather(*(one(i) for i in range(count))), waited


def summary(times):
    """p50, p95 and the longest, ms."""
    middle, late, most = np.percentile(np.array(times or [np.nan]) * 1e3, (50, 95, 100))
    return f"p50 {middle:.0f}, p95 {late:.0f}, most {most:.0f} ms"


async def load(servers, sessions, active, seconds):
    """Some sit, some move; returns (sentence, times, all went well)."""
    before = [server.seconds() for server in servers]
    visitors, waited = await come([server.url for server in servers], sessions)
    made = [server.seconds() for server in servers]
    moving = visitors[:active]
    await asyncio.gather(*(each.act(seconds, EVERY * i / active) for i, each in enumerate(moving)))
    await asyncio.sleep(1)
    times = [t for each in moving for t in each.times]
    lost = [each.lost for each in visitors if each.lost]
    used = sum(server.seconds() for server in servers) - sum(made)
    for each in visitors:
        await each.leave()
    each_move, each_page = 1e3 * used / max(len(times), 1), (sum(made) - sum(before)) / sessions
    words = (f"{sessions} sessions, {active} active for {seconds} s: {summary(times)} of {len(times)} moves; "
             f"{each_move:.1f} ms of processor a move; lost {len(lost)} {lost[:1] or ''}; "
             f"page after {summary(waited)}, {each_page:.2f} s of processor each")  # fmt: skip
    return words, times, not lost


async def memory(servers, sessions, seconds):
    """MB of idle and active sessions, and what is left of them."""
    def total():
        return sum(server.megabytes() for server in servers)

    urls = [server.url for server in servers]
    first, _ = await come(urls, 5)
    for each in first:
        await each.leave()
    await asyncio.sleep(8)
    start = total()
    visitors, _ = await come(urls, sessions)
    idle = total()
    await asyncio.gather(*(each.act(seconds, EVERY * i / sessions) for i, each in enumerate(visitors)))
    active = total()
    for each in visitors:
        await each.leave()
    await asyncio.sleep(25)
    left = total()
    return (f"{start:.0f} MB with none; {(idle - start) / sessions:.2f} MB an idle session of {sessions}, "
            f"{(active - start) / sessions:.2f} an active one; {left:.0f} MB after they left "
            f"({100 * (left - start) / (active - start):.0f} % of what they took)")  # fmt: skip


async def leak(servers, rounds, each_round):
    """MB after each round of visitors who come, move and go."""
    sizes = []
    for _ in range(rounds):
        visitors, _ = await come([server.url for server in servers], each_round)
        for i in range(5):
            await asyncio.gather(*(visitor.move(6 + 0.1 * i) for visitor in visitors))
            await asyncio.sleep(0.3)
        for visitor in visitors:
            await visitor.leave()
        await asyncio.sleep(8)
        sizes.append(sum(server.megabytes() for server in servers))
    slope = np.polyfit(np.arange(rounds), sizes, 1)[0] / each_round if rounds > 1 else np.nan
    listed = " ".join(f"{size:.0f}" for size in sizes)
    return f"{rounds * each_round} visitors: {listed} MB; {1e3 * slope:+.0f} kB a visitor"


async def breaks(servers, seconds, most):
    """Where p95 goes over 1 s."""
    told = []
    for sessions in range(50, most + 1, 50):
        _, times, well = await load(servers, sessions, sessions, seconds)
        p95 = np.percentile(np.array(times or [np.inf]), 95)
        told.append(f"{sessions}: {1e3 * p95:.0f} ms{'' if well else ', and sessions were lost'}")
        if p95 > 1 or not well:
            break
    return "p95 of so many: " + "; ".join(told)


class Process:
    """A server that runs: where its page is, and what the system says of its process."""

    def __init__(self, pid, url):
        self.pid, self.url = pid, url

    def seconds(self):
        """Of the processor, so far."""
        fields = Path(f"/proc/{self.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def megabytes(self):
        """Resident."""
        return int(Path(f"/proc/{self.pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


@contextmanager
def ours(folder, replicas):
    """So many servers of one worker each."""
    with ExitStack() as stack:
        limits = {"sessions": 1000, "sessions_per_address": 1000, "linger": 3}
        servers = [stack.enter_context(served(Path(folder, f"log{i}"), **limits)) for i in range(replicas)]
        yield [Process(server.process.pid, server.url) for server in servers]
        for server in servers:
            bad = [line for line in server.log.splitlines() if "ERROR" in line]
            print(f"    lines of error in the log: {len(bad)}", *bad[:2])


@contextmanager
def bare(folder):
    """The bare app, with Bokeh's own server."""
    Path(folder, "bare.py").write_text(BARE)
    port = free_port()
    command = [sys.executable, "-m", "bokeh", "serve", "bare.py", "--port", str(port),
               "--unused-session-lifetime", "3000", "--check-unused-sessions", "2000",
               "--allow-websocket-origin", f"127.0.0.1:{port}"]  # fmt: skip
    process = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        until(lambda: answers(f"http://127.0.0.1:{port}/bare"), 60)
        yield [Process(process.pid, f"http://127.0.0.1:{port}/bare")]
    finally:
        process.terminate()
        process.wait()


def main():
    """All scenarios, ours with one and two replicas and the bare app."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="a tenth of it, to see that it runs")
    parser.add_argument("--only", nargs="*", choices=("class", "lecture", "memory", "leak", "breaks"))
    options = parser.parse_args()
    few = 10 if options.quick else 1
    scenarios = {
        "class": lambda servers: load(servers, 100 // few, 100 // few, 120 // few),
        "lecture": lambda servers: load(servers, 200 // few, 20 // few, 60 // few),
        "memory": lambda servers: memory(servers, 50 // few, 20 // few),
        "leak": lambda servers: leak(servers, 10 // (few // 4 or 1), 30 // few),
        "breaks": lambda servers: breaks(servers, 20 // few, 50 if options.quick else 400),
    }
    print(datetime.date.today(), f"{platform.machine()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f} before,",
          f"Python {platform.python_version()}, panel {version('panel')}, bokeh {version('bokeh')}")  # fmt: skip
    for name in options.only or scenarios:
        print(name)
        with tempfile.TemporaryDirectory() as folder:
            kinds = {"1 replica": lambda f: ours(f, 1), "2 replicas": lambda f: ours(f, 2), "bare Bokeh": bare}
            for words, start in kinds.items():
                with start(folder) as servers:
                    found = asyncio.run(asyncio.wait_for(scenarios[name](servers), 1800))
                print(f"  {words}: {found[0] if isinstance(found, tuple) else found}", flush=True)


if __name__ == "__main__":
    main()


# Short runs (--quick) while others used the machine (load 8 on 2 cores): only the processor's seconds mean something.
#
# 2026-11-21, x86_64, 2 cores, Python 3.11.7, panel 1.9.4, bokeh 3.9.2
#   1 replica: 10 sessions, 10 active: 26.3 ms of processor a move, a page 0.56 s of processor, lost 0
#   2 replicas: the same 26.5 ms and 0.56 s; p95 324 ms where one replica had 2210 ms
#   bare Bokeh: 3.7 ms a move, 0.04 s a page
#   3.6 MB a session, idle or active; 203 MB with none
