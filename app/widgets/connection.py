"""What the page does when the server is gone: it says so, waits, and comes back to what the person had set."""

import param
from panel.custom import JSComponent


class Connection(JSComponent):
    """Once a server answers, the page is loaded anew: its address holds what was set.

    (BokehJS 3.9 can also go on with a session, but fails where the document has arrays, or where a message was cut.)
    """

    words = param.String(constant=True, doc="What it says.")

    _esm = """
    const FIRST = 500, LONGEST = 8000  // ms between two tries, each half to one and a half times as long

    export function render({model}) {
      const words = document.createElement("div")
      words.setAttribute("role", "alert")
      Object.assign(words.style, {
        position: "fixed", inset: "8px 8px auto", margin: "auto", maxWidth: "560px", zIndex: 9999,
        padding: "10px 16px", borderRadius: "8px", background: "#22303c", color: "white", textAlign: "center",
        font: "15px/1.4 system-ui, sans-serif", boxShadow: "0 2px 8px rgb(0 0 0 / 30%)",
      })
      words.textContent = model.words

      async function recover() {
        if (words.isConnected) return
        document.body.append(words)
        for (let wait = FIRST; ; wait = Math.min(2 * wait, LONGEST)) {
          await new Promise((resolve) => setTimeout(resolve, wait * (0.5 + Math.random())))
          const answer = await fetch("./favicon.ico", {cache: "no-store"}).catch(() => null)
          if (answer?.status < 500) return location.reload()
        }
      }

      Bokeh.documents[0].on_event("connection_lost", recover)
    }
    """
