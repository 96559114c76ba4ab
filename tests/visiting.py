"""A visit to the page in Chromium; the fixtures that start a server and a browser are in conftest.py."""

import shutil
import socket

import numpy as np
import patience

from app.text import listed

PATIENCE = 1000 * patience.PATIENCE  # ms
FLAGS = [
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]

# Three-dimensional pictures have a sixteenth of their pixels: the processor draws them. All else is as it is.
COARSE = "Object.defineProperty(window, 'devicePixelRatio', { get: () => 1 / 4 })"

# A WebGL that takes everything, is done at once, and draws nothing: compiling the shaders of a page takes the processor
# more than a second.
BLANK = """{
  const real = HTMLCanvasElement.prototype.getContext, GL = WebGL2RenderingContext
  const parameters = { [GL.VERSION]: "WebGL 2.0", [GL.SHADING_LANGUAGE_VERSION]: "WebGL GLSL ES 3.00",
                       [GL.VIEWPORT]: [0, 0, 1, 1], [GL.SCISSOR_BOX]: [0, 0, 1, 1] }
  const answers = {
    getContextAttributes: () => ({}), getParameter: (name) => parameters[name] ?? 4096, isContextLost: () => false,
    getSupportedExtensions: () => [], getShaderPrecisionFormat: () => ({ precision: 23 }), fenceSync: () => ({}),
    getProgramInfoLog: () => "", getShaderInfoLog: () => "", getSyncParameter: () => GL.SIGNALED,
    getProgramParameter: (_, name) => Number(name === GL.LINK_STATUS),
    checkFramebufferStatus: () => GL.FRAMEBUFFER_COMPLETE }
  const nothing = (name) => String(name).startsWith("create") ? () => ({}) : () => null
  HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
    if (!kind.startsWith("webgl")) return real.call(this, kind, ...more)
    const get = (own, name) => own[name] ?? GL[name] ?? nothing(name)
    return (this.blank ??= new Proxy({ canvas: this, ...answers }, { get, set: () => true }))
  }
}"""

# A page that moves shows some six pictures a second, each of two frames: they cost a core of the processor otherwise. A
# single frame does not wait.
FEW_FRAMES = """{
  const paint = window.requestAnimationFrame, waiting = new Set()
  let count = 0, last = 0
  window.requestAnimationFrame = (run) => {
    const id = ++count
    waiting.add(id)
    setTimeout(() => paint((now) => {
      if (!waiting.delete(id)) return
      last = performance.now()
      run(now)
    }), last + 80 - performance.now())
    return id
  }
  window.cancelAnimationFrame = (id) => waiting.delete(id)
}"""

# A column of a data source in the browser, given the name of its figure, the index of the renderer and the column; of
# Fig. 6, which is our own, a column of its limits.
COLUMN = """
([figure, renderer, column]) => {
  if (figure == "plane") return Array.from(__tippe.plane.limits[column])
  const models = Bokeh.documents.flatMap((doc) => [...doc.all_models])
  const found = models.find((m) => m.name == figure && m.renderers)
  return Array.from(found.renderers[renderer].data_source.data[column])
}
"""


# The position on the page of a point of a figure.
PIXEL = """
([figure, x, y]) => {
  if (figure == "plane") return __tippe.plane.pixel(x, y)
  const model = Bokeh.documents.flatMap((doc) => [...doc.all_models]).find((m) => m.name == figure && m.renderers)
  const {canvas_view: {el}, frame} = Bokeh.index.find_one(model), box = el.getBoundingClientRect()
  return [box.x + frame.x_scale.compute(x), box.y + frame.y_scale.compute(y)]
}
"""


# Makes parts of the page that are drawn only when they are nearly visible believe that they are.
ALL_IS_NEAR = """
const Seen = window.IntersectionObserver, FAR = "10000px"
window.IntersectionObserver = class extends Seen {
  constructor(tell, options) { super(tell, options?.rootMargin ? { rootMargin: FAR, scrollMargin: FAR } : options) }
}
"""


# Scrolls a part to the middle of the window, and waits until it stays there.
IN_SIGHT = """
part => new Promise((done) => {
  part.scrollIntoView({block: "center"})
  let before = NaN
  const look = () => {
    const {top, height} = part.getBoundingClientRect()
    if (top + height === before) done(true)
    before = top + height
    requestAnimationFrame(look)
  }
  look()
})
"""


# Whether all that the level "Research" opens is there.
WHOLE = "() => window.Bokeh?.documents?.[0]?.is_idle && window.__tippe?.plane?.selected"


# Whether the top is drawn.
DRAWN = "window.__tippe?.top3d?.pictures > 0"


def of_roll(url):
    """The address of the paper's rolling top if the address has no query, otherwise the address itself."""
    return url if "?" in url else f"{url}?tab=roll"


# The buttons in the head that lead to each room.
ROOMS = {
    "Lab": ("Lab", "Explore", None),
    "Roll": ("Lab", "Research", "Rough"),
    "Three planes": ("Lab", "Research", "Ordinary"),
    "Build a top": ("Build", None, None),
    "Families": ("Maps", None, "Which tops can turn over"),
    "Maps": ("Maps", None, "Maps of many runs"),
    "Learn": ("Learn", None, None),
    "Measure": ("Measure", None, None),
}


def go_to(page, room):
    """Clicks the buttons that lead to a room, except those that are already chosen."""
    for role, name in zip(("tab", "radio", "radio"), ROOMS[room], strict=True):
        if name is None:
            continue
        # the row below is that of the room before until the server has answered
        where = page.locator(".rooms, .stage .switch") if name == ROOMS[room][-1] else page
        button = where.get_by_role(role, name=name, exact=True).locator("visible=true").first
        button.wait_for()
        if not is_chosen(button):
            button.click()


def is_seen(page, room):
    """Whether the last of the buttons that lead to a room is chosen."""
    role, name = [(role, name) for role, name in zip(("tab", "radio", "radio"), ROOMS[room], strict=True) if name][-1]
    return is_chosen(page.get_by_role(role, name=name, exact=True).locator("visible=true").first)


def is_chosen(button):
    return "true" in (button.get_attribute("aria-selected"), button.get_attribute("aria-checked"))


def entry(page, name):
    """The field of an input at the level "Research"."""
    return page.get_by_label(listed("controls.inputs", "en")[name]["typed"], exact=True).locator("visible=true")


def open_panel(page, name):
    """Shows a panel beside the stage."""
    page.get_by_role("radio", name=name, exact=True).click()


def texts(page):
    """What stands in all fields, read in one go: a field that is replaced meanwhile has no value to wait for."""
    return page.locator("input[type=text]").evaluate_all("fields => fields.map((field) => field.value)")


def free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


def launch(playwright):
    """Chromium without the parts of a window: with them each page and each context costs five times as much."""
    path = shutil.which("chromium-headless-shell") or shutil.which("chromium")
    return playwright.chromium.launch(executable_path=path, args=FLAGS)


class Contexts:
    """The browser's contexts, emptied when they are closed and used again: a new one takes a second of a processor.

    Three-dimensional pictures are drawn in them only if the test asks for it (`draws=True`), and then coarsely. They
    move seldom, if the test wants motion (`reduced_motion="no-preference"`).
    """

    def __init__(self, browser):
        self._make, self._free = browser.new_context, {}
        browser.new_context, browser.new_page = self.context, self.page

    def context(self, draws=False, **like):
        free = self._free.setdefault(repr((draws, sorted(like.items()))), [])
        if free:
            return free.pop()
        context = self._make(**like)
        context.add_init_script(COARSE if draws else BLANK)
        if like.get("reduced_motion") == "no-preference":
            context.add_init_script(FEW_FRAMES)
        keeper = context.new_page()  # without any page, the process that draws would end
        storage = context.new_cdp_session(keeper)

        def empty():
            for page in context.pages:
                if page is not keeper:
                    page.close()
            context.unroute_all()
            context.clear_cookies()
            storage.send("Storage.clearDataForOrigin", {"origin": "*", "storageTypes": "all"})
            free.append(context)

        context.close = empty
        return context

    def page(self, **like):
        """A page whose context is closed with it."""
        context = self.context(**like)
        page = context.new_page()

        def close():
            del page.close
            context.close()

        page.close = close
        return page


def wait(page, ready):
    """Waits for a condition that cannot be written as one JavaScript expression."""
    return patience.poll(ready, lambda: page.wait_for_timeout(50))


class Visit:
    """An open page, with its requests, its errors, and its websocket frames if it listens."""

    def __init__(self, page, url, whole=True, near=False, listens=False):
        """An address without a query opens the paper's rolling top. whole: wait until the whole tab is there. near:
        draw only what is nearly visible, as usual; otherwise everything is drawn, so that tests can read it."""
        self.page, self.requests, self.errors, self.sent = page, [], [], []
        page.set_default_timeout(PATIENCE)
        if listens:
            page.on("request", lambda request: self.requests.append(request.url))
            page.on("console", lambda message: message.type == "error" and self.errors.append(message.text))
            page.on("pageerror", lambda error: self.errors.append(str(error)))
            page.on("websocket", lambda socket: [socket.on(kind, lambda frame: self.sent.append(frame))
                                                 for kind in ("framesent", "framereceived")])  # fmt: skip
        if not near:
            page.add_init_script(ALL_IS_NEAR)
        page.goto(of_roll(url))
        if not whole:
            return
        page.wait_for_function(DRAWN)
        page.wait_for_function(WHOLE)

    def column(self, *place):
        return np.array(self.page.evaluate(COLUMN, place))

    def until_column(self, figure, renderer, column, first):
        """Waits until a column of a data source starts with this number."""
        self.page.wait_for_function(
            f"([place, first]) => Math.abs(({COLUMN})(place)[0] - first) < 1e-9",
            arg=[[figure, renderer, column], first],
        )

    def pixel(self, figure, x, y):
        return self.page.evaluate(PIXEL, [figure, float(x), float(y)])

    def drag(self, start, end, moves=6, rest=0):
        """Presses the mouse at start, rests for `rest` ms, and moves to end without releasing it."""
        self.page.mouse.move(*start)
        self.page.mouse.down()
        self.page.wait_for_timeout(rest)
        for i in range(1, moves + 1):
            self.page.mouse.move(*(a + (b - a) * i / moves for a, b in zip(start, end, strict=True)))

    def pause(self):
        self.page.evaluate("""() => Bokeh.documents.flatMap((doc) => [...doc.all_models])
            .filter((m) => m.properties?.playing).forEach((m) => { m.playing = false })""")
        self.page.wait_for_function("!__tippe.top3d.playing")
