"""Where a table comes in: chosen, dropped or pasted. It is read in the browser, and thinned there if it is long."""

import param
from panel.custom import JSComponent

from app.text import listed


class FilmFile(JSComponent):
    """The newest text of a table. Nothing of it is kept anywhere but in this session."""

    texts = param.Dict(default={}, constant=True)
    most = param.Integer(default=180_000, constant=True, doc="characters of a text; of a longer one rows are left out")
    table = param.List(default=["", 1], doc="[the text, each how-manieth row of the file it has]; the browser's")
    refused = param.Integer(default=0, doc="megabytes of a file that was too large to be read; the browser's")

    _esm = """
    export function render({model, el}) {
      const {choose, drop, paste} = model.texts
      el.innerHTML = `<style>
        .drop { font: 14px/1.4 system-ui, sans-serif; color: var(--ink, #22303c); border: 1px dashed;
          border-radius: 8px; padding: 10px 12px; display: flex; flex-wrap: wrap; gap: 8px 12px; align-items: center }
        .drop.over { background: #0072B222 } textarea { flex: 1 1 180px; min-width: 0; height: 34px; font: inherit;
          color: inherit; background: transparent; border: 1px solid #8a96a3; border-radius: 6px; padding: 5px 8px;
          box-sizing: border-box; resize: vertical }
        input { max-width: 100%; font: inherit; color: inherit }
        :focus-visible { outline: 2px solid; outline-offset: 2px }</style>
        <div class="drop"><input type="file" accept=".csv,.tsv,.txt,text/*"><span></span><textarea></textarea></div>`
      const zone = el.querySelector(".drop"), input = el.querySelector("input"), area = el.querySelector("textarea")
      input.setAttribute("aria-label", choose)
      el.querySelector("span").textContent = drop
      area.placeholder = paste
      area.setAttribute("aria-label", paste)
      const send = (text) => {
        let each = 1
        if (text.length > model.most) {
          const lines = text.split(/\\r\\n|\\r|\\n/)
          each = Math.ceil(text.length / model.most * 1.05)
          text = lines.filter((line, i) => i < 12 || i % each == 0).join("\\n")
        }
        model.table = [text, each]
      }
      const read = async (file) => {
        if (!file) return
        if (file.size > 5e7) { model.refused = Math.ceil(file.size / 1e6); return }
        const bytes = new Uint8Array(await file.arrayBuffer())
        const wide = bytes[0] == 0xff && bytes[1] == 0xfe
        let text = new TextDecoder(wide ? "utf-16le" : "utf-8").decode(bytes)
        if (text.includes("\\ufffd")) text = new TextDecoder("windows-1252").decode(bytes)
        send(text)
      }
      input.onchange = () => read(input.files[0])
      area.onchange = () => { if (area.value.trim()) send(area.value) }
      area.onpaste = () => setTimeout(() => { send(area.value); area.value = "" })
      zone.ondragover = (event) => { event.preventDefault(); zone.classList.add("over") }
      zone.ondragleave = () => zone.classList.remove("over")
      zone.ondrop = (event) => {
        event.preventDefault()
        zone.classList.remove("over")
        read(event.dataTransfer.files[0])
      }
    }
    """

    def __init__(self, **params):
        super().__init__(texts=dict(listed("film.file")), **params)
