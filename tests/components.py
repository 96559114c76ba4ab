"""Components of the bundle in Chromium, each alone on a static page: there is no server and no session. The Python
object beside it is the real one; it hears at once what the browser sets, and its answer goes back."""

import base64
from functools import partial

import pytest
from lab_page import TOPS
from panel.custom import JSComponent
from visiting import ALL_IS_NEAR, PATIENCE, wait

from app.bundle import BUNDLE, ENCODERS
from app.model.lab.lab import Lab
from app.tabs.lab.lab import LabTab
from app.widgets.look import FAMILY

HERE = "http://component.test"
TRUSTED = "http://component.localhost"
"""Where a browser allows what it otherwise allows only with TLS."""
# As in the page: it fills the window, and what does not fit scrolls. A model holds values, runs the listeners of one
# that is set, and tells Python what the component sets.
STATIC = """<!doctype html><html lang="en"><head><title>component</title>
<meta name="viewport" content="width=device-width">
<link rel="icon" href="data:,"><style>:root { --family: %s }
body { margin: 0 } main { height: 100vh; overflow: auto }</style></head><body><main></main>
<script type="module">
import bundle from "./tippe.js"
const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer
const base64 = (buffer) => btoa(String.fromCharCode(...new Uint8Array(buffer)))
const read = (said) => Object.fromEntries(Object.entries(said).map(([name, value]) =>
  [name, typeof value?.base64 == "string" ? bytes(value.base64) : value]))
const put = (values, heard, news) => {
  const changed = Object.keys(news).filter((name) => values[name] !== news[name])
  Object.assign(values, news)
  changed.forEach((name) => heard[name]?.forEach((run) => run()))
}
window.shown = []
window.show = (kind, said) => {
  const values = read(said), heard = {}, number = shown.length
  const model = new Proxy(values, {
    get: (_, name) => name == "on" ? (event, run) => (heard[event] ??= []).push(run) : values[name],
    set: (_, name, value) => {
      window.refuses?.(name)
      put(values, heard, { [name]: value })
      tell(number, name, value).then((news) => put(values, heard, read(news)))
      return true
    } })
  const place = document.createElement("div"), el = document.createElement("div"), view = {}
  place.attachShadow({ mode: "open" }).append(el)
  place.style.height = el.style.height = values.height ? `${values.height}px` : ""
  document.querySelector("main").append(place)
  shown.push({ take: (news) => put(values, heard, read(news)), leave: () => {
    heard.remove?.forEach((run) => run())
    place.remove()
  } })
  bundle[kind].render({ model, el, view })
}
window.ready = true
</script></body></html>"""


class Alone:
    """A static page. show() puts components on it; told: [(component, name, value)] of all that they have set."""

    def __init__(self, page, near, here):
        self.page, self.told, self._shown, self._news = page, [], [], {}
        page.set_default_timeout(PATIENCE)
        page.route(f"{here}/**", lambda route: route.fulfill(body=STATIC % FAMILY, content_type="text/html"))
        for path in (BUNDLE, ENCODERS):
            page.route(f"{here}/**{path.name}", script(path))
        page.expose_function("tell", self._tell)
        if not near:
            page.add_init_script(ALL_IS_NEAR)
        page.goto(f"{here}/")
        page.wait_for_function("window.ready")

    def show(self, *components):
        """Puts them on the page, one below the other."""
        for component in components:
            names = [name for name in component.param if name not in JSComponent.param]
            number = len(self._shown)
            self._shown.append(component)
            component.param.watch(partial(self._note, number), names)
            said = {name: sent(getattr(component, name)) for name in (*names, "height")}
            self.page.evaluate("([kind, said]) => show(kind, said)", [type(component).__name__, said])
        return self.page

    def _note(self, number, *events):
        self._news.setdefault(number, {}).update({event.name: sent(event.new) for event in events})

    def _tell(self, number, name, value):
        component = self._shown[number]
        self.told.append((component, name, value))
        setattr(component, name, value)
        return {key: new for key, new in self._news.pop(number, {}).items() if (key, new) != (name, value)}

    def send(self):
        """Sends what Python has changed."""
        changes, self._news = self._news, {}
        for number, news in changes.items():
            self.page.evaluate("([number, news]) => shown[number].take(news)", [number, news])

    def put(self, component, **values):
        component.param.update(**values)
        self.send()

    def until(self, condition):
        """Waits until Python has heard something."""
        wait(self.page, condition)

    def leave(self, component):
        self.page.evaluate("number => shown[number].leave()", self._shown.index(component))


def script(path):
    """A route that answers with this script."""
    return lambda route: route.fulfill(path=path, content_type="text/javascript")


def sent(value):
    return {"base64": base64.b64encode(value).decode()} if isinstance(value, bytes) else value


@pytest.fixture
def alone(chromium):
    """alone(near=False, here=HERE, **like) gives an Alone in a browser context like this one; nothing moves by itself
    unless that wants motion."""
    contexts = []

    def open_(near=False, here=HERE, **like):
        contexts.append(chromium.new_context(**{"viewport": {"width": 1400, "height": 900}, "reduced_motion": "reduce",
                                                "locale": "en"} | like))  # fmt: skip
        return Alone(contexts[-1].new_page(), near, here)

    yield open_
    for context in contexts:
        context.close()


@pytest.fixture
def lab(alone, monkeypatch):
    """lab(start={}, **like) gives the Alone with the view of a Lab, `.lab`, which is that of the arrival but for this
    start. It is at rest; after that no hand is."""
    for module in ("tabs.lab.lab", "widgets.rest"):
        monkeypatch.setattr(f"app.{module}.after", lambda seconds, act: None)

    def open_(start=(), **like):
        found = alone(**like)
        found.lab = Lab()
        found.lab.explorer.set(**dict(start))
        found.lab.show()
        found.lab.rest()
        found.show(LabTab(found.lab, None).view)
        found.page.wait_for_function(f"{TOPS}.some((top) => top.pictures && top.count)")
        return found

    return open_
