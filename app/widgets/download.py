"""A button that saves a file, which is made beside the server when it is clicked."""

import base64

import param
from panel.custom import JSComponent

from app.model.runs import FILES, Run, Stopped

# Of a plain button, here and on others that make their file in the browser.
PLAIN_BUTTON = """<style>button { font: 500 13px system-ui, sans-serif; padding: 4px 10px; height: 31px;
  border: 1px solid; border-radius: 4px; background: transparent; color: var(--link, #0072B2); cursor: pointer }
  button:hover { background: #0072B214 } button[aria-busy=true] { opacity: 0.5; cursor: progress }
  :focus-visible { outline: 2px solid; outline-offset: 2px }</style><button></button>"""


class Download(JSComponent):
    """runs: the page's Runs. state: gives the arguments of make, as of the click; make: gives the file's bytes.

    Clicks while a file is made are answered by one file, of what is set at the last of them.
    """

    label = param.String(constant=True)
    filename = param.String(constant=True)
    frame = param.String(default=PLAIN_BUTTON, constant=True)
    clicks = param.Integer(default=0, doc="the browser's")
    file = param.List(default=[0, ""], doc="[how many so far, the newest in base64]")
    making = param.Boolean(default=False)

    _esm = """
    export function render({model, el}) {
      el.innerHTML = model.frame
      const button = el.querySelector("button")
      button.textContent = model.label
      button.onclick = () => { model.clicks += 1 }
      const show = () => { button.setAttribute("aria-busy", model.making) }
      model.on("making", show)
      show()
      model.on("file", () => {
        const bytes = Uint8Array.from(atob(model.file[1]), (letter) => letter.charCodeAt(0))
        const link = document.createElement("a")
        link.href = URL.createObjectURL(new Blob([bytes]))
        link.download = model.filename
        link.click()
        setTimeout(() => URL.revokeObjectURL(link.href), 60000)
      })
    }
    """

    def __init__(self, runs, state, make, **params):
        super().__init__(**params)
        self._runs, self._state, self._make, self._asked = runs, state, make, None
        self.param.watch(self._clicked, "clicks")

    def _clicked(self, event):
        asked = self._state()
        if self.making and asked == self._asked:
            return
        self._asked, self.making = asked, True
        self._runs.begin(Run(lambda run: self._make(*asked), self._made), self.filename, FILES)

    def _made(self, result):
        self.making = False
        if not isinstance(result, Exception):
            self.file = [self.file[0] + 1, base64.b64encode(result).decode()]
        elif not isinstance(result, Stopped):
            raise result
