"""How fast the page comes and follows the hand, in Chromium, against a bare Bokeh server app in the same run.

    python benchmarks/browser.py [first] [hand]

first: a visit with nothing cached, from the request until something is there to see, and to take hold of:

    top    the third picture of a top that moves; of the bare app its one figure
    hand   the session has taken over the Lab, whose sliders answer from then on; or the bare app's does
    page   all that the first view shows

hand: from input to paint. The bare app redraws one line of 400 points when a Bokeh slider moves. Both get the same
input from Chromium itself, while the top plays:

    steps  STEPS arrow keys on the slider, the next one when the page shows the last
    drag   the mouse pulls the slider to and fro, RATE moves a second

An input counts as painted in the first frame that shows its value or a later one's: of the figure under the hand (the
selected tieline of Fig. 6), and of the whole page (that, and the top on its table). Results of runs are kept below.
"""

import argparse
import datetime
import os
import platform
import subprocess
import sys
import tempfile
import time
import urllib.request
from importlib.metadata import version
from pathlib import Path

import numpy as np
from playwright.sync_api import sync_playwright

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))
from visiting import WHOLE, free_port, launch, of_roll  # noqa: E402

VISITS = 6
STEPS, MOVES, RATE, ROUNDS = 60, 90, 30, 3

BARE = """
import numpy as np
from bokeh.io import curdoc
from bokeh.layouts import column
from bokeh.models import ColumnDataSource, Slider
from bokeh.plotting import figure
x = np.linspace(0, 10, 400)
source = ColumnDataSource({"x": x, "y": np.sin(x), "value": np.zeros(400)})
fig = figure(width=520, height=390, y_range=(-1, 1), name="plane")
fig.line("x", "y", source=source)
slider = Slider(start=0, end=8.4, step=0.01, value=7, width=300)
slider.on_change("value", lambda attr, old, new: source.update(
    data={"x": x, "y": np.sin(x + new), "value": np.full(400, new)}))
curdoc().add_root(column(slider, fig))
"""

# Leaves in window.bench the inputs [time, value], the paints of the figure [time, value it showed], and those of the
# page [time, what valueAt knows the value by].
WATCH = """
(ours) => {
  const bench = window.bench = {inputs: [], figure: [], page: []}
  const models = Bokeh.documents.flatMap((doc) => [...doc.all_models])
  const dial = models.find((m) => m.data?.parts && JSON.parse(m.data.state).values.K_J == 7)?.data
  const slider = models.find((m) => m.type.includes("Slider") && m.value == 7)
  const hand = ours ? dial.properties.request : slider.properties.value
  const value = () => ours ? dial.request[2] : slider.value
  hand.change.connect(() => bench.inputs.push([window.event?.timeStamp ?? performance.now(), value()]))
  const painted = (part, value) => {
    const channel = new MessageChannel()
    channel.port2.onmessage = () => bench[part].push([performance.now(), value])
    channel.port1.postMessage(0)
  }
  if (!ours) {
    window.valueAt = (value) => value
    const plane = Bokeh.index.find_one(models.find((m) => m.name == "plane")), {data_source} = plane.model.renderers[0]
    plane.repainted.connect(() => ["figure", "page"].forEach((part) => painted(part, data_source.data.value[0])))
    return
  }
  const shown = () => Number(__tippe.plane.selected.K_J.toFixed(9)), motions = () => __tippe.top3d.motions
  // A motion begins at the smaller angle of its tieline, by which the value is found that it belongs to.
  const angles = new Map()
  window.valueAt = (angle) => [...angles].find(([known]) => Math.abs(known - angle) < 1e-6)?.[1]
  const see = () => angles.set(__tippe.plane.selected.inner, shown())
  const moved = new MutationObserver(() => (see(), painted("figure", shown())))
  moved.observe(__tippe.plane.bar, {attributes: true})
  see()
  // The page is as old as the top on its table, whose motion comes in another message than Fig. 6.
  const lab = models.find((m) => m.data?.properties?.frames_rough).data
  let waiting = []
  lab.properties.frames_rough.change.connect(() => {
    const sent = {motions: motions().received}
    waiting.push(sent)
    queueMicrotask(() => (sent.angle = new Float32Array(lab.curves_rough, 0, 2)[1] * Math.PI / 180))
  })
  const look = () => {
    requestAnimationFrame(look)
    const whole = waiting.findLastIndex((sent) => motions().shown > sent.motions)
    if (whole < 0) return
    painted("page", waiting[whole].angle)
    waiting = waiting.slice(whole + 1)
  }
  look()
}
"""


# When each part of a first visit was there, ms after the request, in window.came.
ARRIVALS = """
(() => {
  const came = window.came = {}
  const models = () => (window.Bokeh?.documents ?? []).flatMap((doc) => [...doc.all_models])
  const parts = Object.entries(PARTS)
  const look = setInterval(() => {
    for (const [part, is] of parts) if (!came[part] && is(models)) came[part] = performance.now()
    if (came.page) clearInterval(look)
  }, 5)
})()
"""
FIGURE = "() => window.Bokeh?.documents?.[0]?.is_idle"
ARRIVED = {
    "bare": f"{{top: {FIGURE}, hand: {FIGURE}, page: {FIGURE}}}",
    "ours": f"""{{
      top: () => window.__tippe?.tops?.("lab").some((top) => top.pictures > 2 && top.playing),
      hand: () => window.Bokeh?.documents?.[0] && !document.getElementById("first")
          && __tippe.tops("lab").some((top) => top.count),
      page: () => ({FIGURE})() && window.came.top && window.came.hand,
    }}""",
}


def visit(browser, url, kind):
    """Arrivals in ms, and the browser's s of the processor until the whole page was there."""
    context = browser.new_context(viewport={"width": 1400, "height": 900})
    page = context.new_page()
    page.add_init_script(ARRIVALS.replace("PARTS", ARRIVED[kind]))
    session = browser.new_browser_cdp_session()

    def used():
        return sum(process["cpuTime"] for process in session.send("SystemInfo.getProcessInfo")["processInfo"])

    before = used()
    page.goto(url, wait_until="commit")
    page.wait_for_function("window.came?.page", timeout=120_000)
    came = page.evaluate("came") | {"cpu": 1e3 * (used() - before)}
    context.close()
    return came


def serve(*command, path, **environment):
    """A server's process and address. A first visitor came before: what it then imports is not the visit's."""
    port = free_port()
    if not environment:
        command = (*command, "--port", str(port))
    environment = {name: value.format(port=port) for name, value in environment.items()}
    server = subprocess.Popen([sys.executable, "-m", *command], cwd=ROOT, env=os.environ | environment,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
    url = f"http://localhost:{port}/{path}"
    for _ in range(600):
        try:
            urllib.request.urlopen(url, timeout=60).read()
            return server, url
        except OSError:
            time.sleep(0.1)
    server.terminate()
    raise RuntimeError(f"{command} does not answer on {url}")


SHOWN = """
() => [bench.figure.at(-1)?.[1], valueAt(bench.page.at(-1)?.[1])].every(
  (value) => Math.abs(value - bench.inputs.at(-1)?.[1]) < 1e-6)
"""


def step(page, handle):
    page.locator(handle).first.focus()
    for i in range(STEPS):
        page.keyboard.press("ArrowLeft" if i < STEPS / 2 else "ArrowRight")
        page.wait_for_function(SHOWN)


def drag(page, handle):
    box = page.locator(handle).first.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    start = time.perf_counter()
    for i in range(1, MOVES + 1):
        time.sleep(max(0, start + i / RATE - time.perf_counter()))
        page.mouse.move(x - 70 * np.sin(2 * np.pi * i / MOVES) ** 2 - i % 2, y)
    page.mouse.up()
    page.wait_for_function(SHOWN)


def delays(page):
    """Milliseconds from each input to the first paint of its value or a later one's: (figure, page)."""
    bench = page.evaluate("({...bench, page: bench.page.map(([time, angle]) => [time, valueAt(angle) ?? NaN])})")
    times, values = np.array(bench["inputs"]).T
    found = []
    for part in ("figure", "page"):
        paints = np.array(bench[part])
        # The newest input whose value a paint shows, of those made before it.
        newest = [
            max((i for i in range(len(times)) if times[i] <= t and abs(values[i] - v) < 1e-6), default=-1)
            for t, v in paints
        ]
        newest = np.array(newest)
        found.append([paints[newest >= i, 0].min() - times[i] for i in range(len(times)) if (newest >= i).any()])
    return found


def visits(playwright, servers):
    found = {}
    for _ in range(VISITS):  # in turn, so that all see the same machine
        for name, (_, url) in servers.items():
            browser = launch(playwright)  # no shader and no script is kept from the visit before
            for part, ms in visit(browser, url, "bare" if name == "bare" else "ours").items():
                found.setdefault(part, {}).setdefault(name, []).append(ms)
            browser.close()
    for part, ms in found.items():
        least = min(ms["bare"])
        for name, mine in ms.items():
            print(f"first {part:5} {name:14} n = {len(mine):3}  least {min(mine):5.0f} ms  "
                  f"median {np.median(mine):5.0f} ms  {min(mine) / least:5.2f} times bare's least")  # fmt: skip


def hands(playwright, servers):
    browser, results = launch(playwright), {}
    for _ in range(ROUNDS):
        for name in servers:
            handle = ".noUi-handle" if name == "bare" else "input[aria-label='Jellett’s constant']"
            # As high as the whole page of Research: what is out of sight is not sent.
            page = browser.new_page(viewport={"width": 1400, "height": 2000}, locale="en")
            page.set_default_timeout(120_000)
            page.add_init_script("localStorage.setItem('tippe:tour', '1')")
            page.goto(servers[name][1] if name == "bare" else of_roll(servers[name][1]))
            page.wait_for_function(FIGURE)
            page.locator(handle).first.wait_for()
            if name != "bare":
                page.wait_for_function("window.__tippe?.top3d?.pictures > 5")
                page.wait_for_function(WHOLE)
            page.evaluate(WATCH, name != "bare")
            for way, use in {"steps": step, "drag": drag}.items():
                page.evaluate("() => { for (const list of Object.values(bench)) list.length = 0 }")
                use(page, handle)
                for part, found in zip(("figure", "page"), delays(page), strict=True):
                    results.setdefault((way, part), {}).setdefault(name, []).extend(found)
            page.close()
    browser.close()
    for (way, part), found in results.items():
        base = np.percentile(found["bare"], 95)
        for name, delay in found.items():
            p50, p95 = np.percentile(delay, (50, 95))
            print(f"{way:5} {part:6} {name:13} n = {len(delay):4}  p50 {p50:5.0f} ms  p95 {p95:5.0f} ms  "
                  f"{p95 / base:5.2f} times bare")  # fmt: skip


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("what", nargs="*", choices=["first", "hand", []], help="both where none is named")
    what = parser.parse_args().what or ["first", "hand"]
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        bare = Path(folder, "bare.py")
        bare.write_text(BARE)
        servers = {}
        try:
            servers["bare"] = serve("bokeh", "serve", str(bare), path="bare")
            servers["panel serve"] = serve("panel", "serve", "app", path="app")
            servers["python -m app"] = serve("app", TIPPE_PORT="{port}", path="app")
            browser = launch(playwright)
            print(f"{datetime.date.today()}, {platform.machine()}, {os.cpu_count()} cores, "
                  f"load {os.getloadavg()[0]:.1f}, Python {platform.python_version()}, "
                  f"panel {version('panel')}, bokeh {version('bokeh')}, Chromium {browser.version}")  # fmt: skip
            browser.close()
            for part, measure in {"first": visits, "hand": hands}.items():
                if part in what:
                    measure(playwright, servers)
        finally:
            for server, _ in servers.values():
                server.terminate()


if __name__ == "__main__":
    main()

# Results. Aim: figure at most 1.5 times bare at p95, page at most 4 times: reached for single steps, not for a drag
# at 30 moves a second. Without a graphics card the 3-D pictures and the server share two cores with the painting.
#
# 2026-11-21, x86_64, 2 cores, no graphics card, Python 3.11.7, panel 1.9.4, bokeh 3.9.2, Chromium 156.0.8078.79,
# three rounds, nothing else running
# steps figure bare  p50  51 ms  p95  69 ms
# steps figure ours  p50  60 ms  p95  89 ms   1.28 times bare
# steps page   ours  p50 190 ms  p95 272 ms   3.93 times bare
# drag  figure bare  p50  57 ms  p95  67 ms
# drag  figure ours  p50 109 ms  p95 201 ms   3.01 times bare
# drag  page   ours  p50 330 ms  p95 451 ms   6.76 times bare
# Under other work (load average 3 to 8) the drag's ratios were 6 to 10 and 8 to 14.
#
# 2026-11-21, the same machine under other people's work, load average 15 to 20: only ratios in one run count.
# Two visits each in turn, 60 moves; before: figures that ask the style sheets for each stroke; after: first.html.
# drag  figure before  p95 2.84 times bare   after 1.89
# drag  page   before  p95 6.94 times bare   after 4.67
# A figure's painting alone, least of 40: Fig. 6 20.4 -> 3.1 ms, theta over time 8.3 -> 0.8 ms, the track 16.5 -> 1.5 ms
# First visit to `python -m app`, four each in turn, least: a moving top 8.0 s before, 2.6 s after, with 4.6 s and 1.8 s
# of the processor; the whole page 11.5 s and 13.1 s (medians 16.1 and 15.2). At load 2.4 it was 3.4 s before.
# First visits after, load 10 to 15, least: bare 1.03 s; moving top 3.0 times that (panel serve), 3.1 (python -m app).
#
# 2026-11-21, another machine (Xeon, 2 cores, no graphics card), nothing else running, the page as it is
# First visit, six each in turn, least and median: a moving top 1.37 and 1.59 s (python -m app), 1.95 and 2.27 s (panel
# serve), bare 0.53 and 0.61 s; the whole page 3.34 and 3.68 s. Aim: a moving top within 3 s.
# steps figure p95 1.76 times bare, page 5.64; drag figure 2.49, page 7.31; with the hand and the first picture in one
# message it was 1.89, 5.28, 2.95 and 8.36, so they stay two. The aims of 1.5 and 4 are missed here.
#
# 2026-11-21, the same Xeon, nothing else running: after a single step all pictures in one message, which waits for the
# hand's paint; python -m app no longer holds a picture back behind an acknowledgement. p50, p95 and times bare's p95.
# steps figure  bare  52   56        panel serve  68   85  1.52    python -m app  41   56  1.00
# steps page                         panel serve 298  347  6.20    python -m app 227  254  4.55
# drag  figure  bare  45   59        panel serve  93  163  2.77    python -m app  58  100  1.70
# drag  page                         panel serve 337  486  8.22    python -m app 267  372  6.29
# Aims of 1.5 (figure) and 4 (page): a step of the figure meets it with python -m app, the others do not. Without that
# wait the page of panel serve is 4.0 to 4.7 and its figure 1.8 to 1.9 times bare.
#
# 2026-11-25, x86_64, 2 cores, nothing else running, Python 3.11.7, panel 1.9.4, bokeh 3.9.2, Chromium 156.0.8078.79,
# Roll, before (aeb9244) and after the page's house was put in order, in times bare: of first the least, else p95
#                    panel serve       python -m app
#                    before  after     before  after
# first top           3.03    3.96      2.41    5.11   (after: 2565 and 3306 ms, before: 2100 and 1669)
# first hand          3.01    3.38      2.91    2.94
# first page          5.26    5.91      5.11    6.00
# first cpu           4.33    4.59      4.29    4.45
# steps figure        1.25    1.30      0.92    1.01
# steps page          5.41    5.55      4.09    4.52
# drag  figure        2.49    2.41      1.59    1.56
# drag  page          8.17    8.39      7.04    6.60
#
# The first top came later in the second column, since the page had none in it: first.py found no picture to write, and
# the top waited for the session. Now the arrival's own picture is there first; at Roll's address the top still waits.
# Three visits of the arrival each in turn under other work, load 14 to 17, python -m app, least in times bare's:
# first top 2.18, hand 3.02, page 3.13, cpu 3.22
#
# 2026-11-25, later, the same machine, nothing else running (first: the Lab's arrival; steps and drag: Roll in the Lab's
# level of research, whose Fig. 6 is now over all of 0 to pi with K_R below), python -m app, in times bare: first top
# 2.61, hand 2.53, page 2.67, cpu 2.60; p95 steps figure 1.68, page 8.37, drag figure 2.92, page 10.31. So an arrival
# costs half of what it did, and a move of Roll near twice; why is not known yet.
#
# 2026-11-25, why: a figure that is hidden (Fig. 6 from near) had all of the page laid out at each picture of the clock;
# each step waited for the path of the slip (25 ms); a label that grew laid out the page; the second picture in 3-D came
# after the first, and fine, once the hand counted as gone. Hand alone, python -m app, two rounds, p95 in times
# bare's, this run first in turn under other work (load 11 to 18):
#                    07:21 (27b8bf4)   before   hidden figures, path   after
# steps figure        1.05              1.38     1.17
# steps page          5.00              6.60     5.84                   2.9
# drag  figure        1.99              2.14     1.55                   1.5
# drag  page          7.20              9.63     7.86                   6.0
# (after: parts of the page measured apart, one visit, bare's of the run before). Of a step's 180 ms the data are there
# after 66, the plots after 103, the top after 170, Fig. 5 after 181: what is left of a drag is drawing.
#
# 2026-11-25, 16:40, after all of that, with Fig. 5 below the window (its layout has changed since, so it is not drawn
# here), one round, this run first in turn, load 5: p95 in times bare's, steps figure 1.08, page 2.46; drag figure 1.33,
# page 3.69.
#
# 2026-11-25, 21:40, nothing else running, six visits and three rounds, Research in a window of 1400 x 2000 px, so
# that all of it is sent: first page 2.86 times bare (python -m app), cpu 2.67; p95 in times bare's: steps figure
# 0.78, page 2.84; drag figure 1.84, page 6.43 (panel serve: 1.26, 3.95; 1.93, 6.49).
#
# 2026-11-26, 08:53, nothing else running, three rounds, the same window, p95 in times bare's: steps figure 0.73, page
# 2.59; drag figure 1.43, page 5.08 (panel serve: 1.08, 3.62; 1.52, 5.18).
# A phone (390 x 844, the processor slowed 4 times by Chromium; WebGL is drawn by the same slowed processor): a top that
# moves after 3.7 s, the whole page after 4.7 s, 16 frames a second while it plays; at full speed 1.6 s, 1.9 s and 20.
#
# 2026-11-29, nothing else running, Chromium 156 without a window, the window of 1400 x 2000 px, three rounds; first the
# least in times bare's least, then p95 in times bare's, python -m app (panel serve):
# first top 2.32 (2.44), hand 1.96 (1.95), page 2.32 (2.44), cpu 3.17 (3.20).
#                 before        a body built anew for  the strip's width
#                               another profile only   read once a drawing
# steps figure    1.03 (1.32)   1.09 (1.27)            p95  78 ms
# steps page      5.73 (6.43)   4.14 (4.11)            p95 271 ms
# drag  figure    2.70 (2.54)   2.78 (2.84)            p95 209 ms
# drag  page      8.54 (8.25)   8.91 (7.56)            p95 593 ms
# (the last column: three rounds of ours alone, of which bare had 75 and 79 ms in the run before.) Each move had built
# the body of the top and that of the run before anew, with their textures, and drew a picture of the old motion beside
# the new one's ghost; each frame read the strip's width, which laid the page out. Of a step's 206 ms (p50) the motion
# is there after 85, the top has it after 130, and its picture takes 80, by the processor. The aims (figure 1.0 and 1.2,
# page 2.0 and 2.5) are missed; the figure in single steps by little.
