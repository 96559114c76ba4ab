"""What the page does when the server is gone: it says so, waits, and comes back to what the person had set."""

from panel.custom import JSComponent


class Connection(JSComponent):
    """Goes on with its session where a server still has it, else loads the page anew: its address holds the state.

    app.server answers at ./app/session whether it has it; `panel serve` does not, and then the page is loaded anew.
    """

    _esm = """
    const FIRST = 500, LONGEST = 8000  // ms between two tries, each half to one and a half times as long

    export function render() {
      // A session that goes on sends its whole document again, and this comes anew.
      const words = document.getElementById("tippe-connection") ?? document.createElement("div")
      words.id = "tippe-connection"
      words.setAttribute("role", "alert")
      Object.assign(words.style, {
        position: "fixed", inset: "8px 8px auto", margin: "auto", maxWidth: "560px", zIndex: 9999, display: "none",
        padding: "10px 16px", borderRadius: "8px", background: "#22303c", color: "white", textAlign: "center",
        font: "15px/1.4 system-ui, sans-serif", boxShadow: "0 2px 8px rgb(0 0 0 / 30%)",
      })
      words.textContent = "No connection to the server at the moment. What is shown can still be played, and nothing "
        + "that was set is lost; the page goes on by itself as soon as the server answers."
      document.body.append(words)
      words.trying = false

      async function recover(event) {
        if (words.trying) return
        words.trying = true
        words.style.display = "block"
        const id = event.connection.deref()?.id ?? ""
        const address = location.pathname.replace(/[/]$/, "") + "/session?id=" + encodeURIComponent(id)
        for (let wait = FIRST; words.trying; wait = Math.min(2 * wait, LONGEST)) {
          await new Promise((resolve) => setTimeout(resolve, wait * (0.5 + Math.random())))
          const answer = await fetch(address, {cache: "no-store"}).catch(() => null)
          if (answer?.ok && (await answer.text()) === "here") {
            words.trying = false
            event.reconnect()  // where this fails the connection is lost anew
          } else if (answer && answer.status < 500) {
            location.reload()
            return
          }
        }
      }

      Bokeh.documents[0].on_event("connection_lost", (_, event) => recover(event))
    }
    """
