"""A worksheet for a class, one page of A4, as a separate page that a browser prints."""

from html import escape

from app.text import listed, say, spoken

WHY = {"height": ("why",), "arms": ("why",)}  # questions that also ask for a reason
STYLE = (
    "@page { size: A4; margin: 12mm } body { font: 10pt/1.3 sans-serif; color: #000;"
    " background: #fff; max-width: 182mm; margin: 0 auto; padding: 0 } h1 { font-size: 17pt; margin: 0 }"
    " h2 { font-size: 12pt; margin: 4mm 0 1mm }"
    " header { display: flex; justify-content: space-between; align-items: baseline } p { margin: 1mm 0 }"
    " section { break-inside: avoid; margin-top: 3mm } .line { display: flex; gap: 3mm; margin-top: 3mm }"
    " .line span { border-bottom: 0.3mm solid #555; flex: 1 } .box { border: 0.3mm solid #555; height: 34mm }"
)


def worksheet():
    """The whole page, in the page's language."""

    def line(*names):
        return "".join(f'<div class="line">{escape(say(f"worksheet.{name}"))}<span></span></div>' for name in names)

    asked = "".join(
        f"<section><b>{escape(words)}</b>{line('guess', 'saw', *WHY.get(name, ()))}</section>"
        for name, words in listed("worksheet.asked").items()
    )
    toy = "".join(f"<p>{escape(words)}</p>" for words in listed("worksheet.lines"))
    title = escape(say("worksheet.title"))
    return (
        f'<!doctype html><html lang="{spoken()}"><meta charset="utf-8"><title>{title}</title><style>{STYLE}</style>'
        f"<header><h1>{title}</h1><span>{escape(say('worksheet.name'))} ______________________</span></header>"
        f"<p>{escape(say('worksheet.intro'))}</p>{asked}<h2>{escape(say('worksheet.toy'))}</h2>{toy}"
        f'<section><p>{escape(say("worksheet.draw"))}</p><div class="box"></div></section></html>'
    )
