"""What the page's head and its dialog are made of: the address and keys, a text to copy, a photo, the time."""

import param
from panel.custom import JSComponent

from app.state.keep import Field, Number
from app.widgets.download import PLAIN_BUTTON

# A phone at arm's length reads modules of this size, px.
MODULE = 4


class Address(JSComponent):
    """The page's own address and keys: puts `search` there without a step in the browser's history, and says when a
    hand is down and which gesture it is."""

    search = param.String(default="", doc="what follows the path; written to the address bar")
    page = param.String(default="", doc="the address without it, prefix included; the browser writes it")
    held = param.Boolean(default=False, doc="whether a hand is down; the browser writes it, like all below")
    gesture = param.Integer(default=0, doc="how many times a hand came down")
    undone = param.Integer(default=0, doc="how often Ctrl+Z was pressed")
    redone = param.Integer(default=0, doc="how often Ctrl+Shift+Z or Ctrl+Y was pressed")
    reloads = param.Integer(default=0, doc="one more: the page is loaded anew, from its address")

    _esm = """
    const writing = (target) => target.isContentEditable || target.matches?.(
      "textarea, select, input:not([type=range]):not([type=checkbox]):not([type=radio]):not([type=button])")
    export function render({model}) {
      const listening = new AbortController()
      const on = (type, run) => window.addEventListener(type, run, {capture: true, signal: listening.signal})
      const down = () => { model.gesture += 1; model.held = true }
      const up = () => { if (model.held) model.held = false }
      on("pointerdown", down)
      for (const type of ["pointerup", "pointercancel", "dragend", "blur", "keyup"]) on(type, up)
      on("keydown", (event) => {
        const target = event.composedPath()[0]
        if ((event.ctrlKey || event.metaKey) && !event.altKey && !writing(target)) {
          const key = event.key.toLowerCase()
          const redo = key == "y" && !event.shiftKey || key == "z" && event.shiftKey
          if (redo || key == "z") {
            event.preventDefault()
            model[redo ? "redone" : "undone"] += 1
            return
          }
        }
        const acts = !writing(target) || event.key == "Enter"
        if (acts && !event.repeat && !["Control", "Shift", "Alt", "Meta", "Tab"].includes(event.key)) down()
      })
      model.on("search", () => {
        history.replaceState(history.state, "", location.pathname + model.search + location.hash)
      })
      model.on("reloads", () => location.reload())
      model.page = location.origin + location.pathname
      model.on("remove", () => listening.abort())
    }
    """


class Copy(JSComponent):
    """A text to take along, and a button that copies it, also where a page without https may not."""

    text = param.String(default="")
    label = param.String(default="")
    rows = param.Integer(default=1)
    says = param.List(default=[], doc="what its button says, and what it says once that is done")

    _esm = """
    export function render({model, el}) {
      el.innerHTML = `<style>
        :host > div { width: 100% }
        .copy { display: flex; width: 100%; gap: 8px; align-items: flex-start }
        textarea { flex: 1 1 0; min-width: 0; font: 13px/1.5 ui-monospace, monospace; padding: 7px 9px;
          border: 1px solid #8a96a3; border-radius: 6px; color: inherit; background: transparent; resize: none;
          box-sizing: border-box }
        button { font: 500 13px system-ui, sans-serif; padding: 7px 12px; border: 1px solid; border-radius: 6px;
          background: transparent; color: var(--link, #0072B2); cursor: pointer; white-space: nowrap; min-width: 72px }
        button:hover { background: #0072B214 } :focus-visible { outline: 2px solid; outline-offset: 2px }
        </style><div class="copy"><textarea readonly spellcheck="false"></textarea><button></button></div>`
      const area = el.querySelector("textarea"), button = el.querySelector("button")
      const [copy, copied] = model.says
      button.textContent = copy
      const show = () => {
        area.value = model.text
        area.rows = model.rows
        area.style.whiteSpace = model.rows > 1 ? "pre" : "nowrap"
        area.style.overflow = model.rows > 1 ? "auto" : "hidden"
        area.setAttribute("aria-label", model.label)
      }
      area.onfocus = () => area.select()
      button.onclick = async () => {
        area.select()
        try { await navigator.clipboard.writeText(model.text) } catch { document.execCommand("copy") }
        button.textContent = copied
        setTimeout(() => { button.textContent = copy }, 1500)
      }
      for (const name of ["text", "label", "rows"]) model.on(name, show)
      show()
    }
    """


class Photo(JSComponent):
    """A button that saves the top as it is seen, as a PNG with the caption below."""

    caption = param.List(default=[], doc="lines of plain text")
    frame = param.String(default=PLAIN_BUTTON, constant=True)
    wide = param.Integer(default=2400, doc="of the picture, in px")

    _esm = """
    export function render({model, el}) {
      el.innerHTML = model.frame
      const button = el.querySelector("button")
      button.textContent = "PNG"
      button.onclick = async () => {
        const picture = window.tippe?.photo(model.wide)
        if (!picture) return
        const type = Math.round(picture.width / 75), margin = type
        const canvas = document.createElement("canvas"), ink = canvas.getContext("2d")
        canvas.width = picture.width
        canvas.height = picture.height + 2 * margin + 1.5 * type * model.caption.length
        ink.fillStyle = "white"
        ink.fillRect(0, 0, canvas.width, canvas.height)
        ink.drawImage(picture, 0, 0)
        ink.fillStyle = "#22303c"
        ink.textAlign = "center"
        ink.textBaseline = "top"
        ink.font = `${type}px system-ui, sans-serif`
        model.caption.forEach((line, i) =>
          ink.fillText(line, canvas.width / 2, picture.height + margin + 1.5 * type * i, 0.98 * canvas.width))
        canvas.toBlob((blob) => {
          const link = document.createElement("a")
          link.href = URL.createObjectURL(blob)
          link.download = "tippe-top-3d.png"
          link.click()
          setTimeout(() => URL.revokeObjectURL(link.href), 60000)
        })
      }
    }
    """


class Clock(param.Parameterized):
    """The time at which a Playing stands."""

    at = param.Number(default=None, allow_None=True, doc="in (R/g)^1/2; None while it plays")
    KNOWN = {"at": Field("t", Number, undoable=False)}  # noqa: RUF012

    def __init__(self, playing):
        super().__init__(at=None if playing.playing else playing.time)
        self._playing = playing
        playing.param.watch(self._read, ["playing", "time"])
        self.param.watch(self._put, "at")

    def _read(self, *events):
        self.at = None if self._playing.playing else self._playing.time

    def _put(self, event):
        if event.new is not None:
            self._playing.param.update(time=event.new, playing=False)
