"""Private parts of the scripts of Bokeh, each tried in Chromium on a page of Bokeh's alone: it still works, and is
still needed. Those of the Python code are in tests/test_borrowed.py."""

import re
from pathlib import Path

import pytest
from bokeh.document import Document
from bokeh.embed import file_html
from bokeh.layouts import column
from bokeh.models import HoverTool
from bokeh.plotting import figure
from bokeh.resources import INLINE

APP = Path(__file__).parent.parent / "app"
BUNDLED, BEFORE = APP / "frontend/src/borrowed.js", APP / "borrowed.js"
HERE = "http://borrowed.test"
COUNTING = """
  const theirs = CSSStyleDeclaration.prototype.getPropertyValue;
  window.asked = 0;
  CSSStyleDeclaration.prototype.getPropertyValue = function (name) {
    if (name.startsWith("--bk-")) window.asked += 1;
    return theirs.call(this, name);
  };"""


def numbers(path):
    """The numbers of the borrowed parts in a file's comments."""
    return [int(number) for number in re.findall(r"(?:// |/\*\* )(\d+)\. ", path.read_text(encoding="utf-8"))]


def test_what_is_borrowed_is_numbered_and_each_has_its_test():
    every = [*numbers(BEFORE), *numbers(BUNDLED)]
    assert every == [*range(1, len(every) + 1)]
    tests = [int(number) for number in re.findall(r'^    """(\d+)\.', Path(__file__).read_text("utf-8"), re.M)]
    assert tests == every
    for path in (BEFORE, BUNDLED):  # with an issue of the library, or a remark that there is none
        parts = re.split(r"(?:// |/\*\* )\d+\. ", path.read_text(encoding="utf-8"))[1:]
        assert all(re.search(r"github\.com/[\w/.]+/\d+|No issue that we found", part) for part in parts)


def test_docs_list_all_that_is_borrowed():
    """Those of Python too, in the order of the files."""
    python = [int(number) for number in re.findall(r"(?m)^    \"\"\"(\d+)\.", (APP / "borrowed.py").read_text("utf-8"))]
    python = sorted({*python, 3})  # which is in mend(), with two others
    part = (APP.parent / "docs/architecture.md").read_text(encoding="utf-8").partition("## Borrowed keys")[2]
    listed = [int(number) for number in re.findall(r"^\| (?:`[\w./]+` )?(\d+) \|", part, re.M)]
    assert listed == [*python, *numbers(BEFORE), *numbers(BUNDLED)]


# ---- of Bokeh, on a page with one figure ----


def drawn():
    """A document with a figure of 400 x 300 px, x from 0 to 10, y from -1 to 1. It is a new one: otherwise Bokeh uses
    the current one, which an earlier test may have closed."""
    fig = figure(width=400, height=300, x_range=(0, 10), y_range=(-1, 1), tools=[HoverTool()], toolbar_location=None)
    fig.line([0, 10], [0, 0], line_width=20)
    document = Document()
    document.add_root(fig)
    return document


def beside():
    """A document with a column of two figures, each in its own column, the second one hidden."""
    figures = [figure(width=400, height=150, y_range=(-1, 1), name=name) for name in ("seen", "hidden")]
    for fig in figures:
        fig.line([0, 10], [0, 0])
    document = Document()
    document.add_root(column([column(fig, visible=fig.name == "seen") for fig in figures]))
    return document


def of_bokeh(chromium, document):
    page = chromium.new_page(viewport={"width": 500, "height": 400})
    page.add_init_script(COUNTING)
    page.route(f"{HERE}/**", lambda route: route.fulfill(body="", content_type="text/javascript"))  # Panel's scripts
    page.route(f"{HERE}/", lambda route: route.fulfill(body=file_html(document, INLINE), content_type="text/html"))
    return page


@pytest.fixture
def bare(chromium):
    """A page with Bokeh's own scripts, a figure `fig`, and ours in `borrowed`."""
    page = of_bokeh(chromium, drawn())
    page.route(f"{HERE}/borrowed.js", lambda route: route.fulfill(path=BUNDLED, content_type="text/javascript"))
    page.goto(f"{HERE}/")
    page.wait_for_function("() => Bokeh.documents[0]?.is_idle")
    page.evaluate(
        "async () => { window.borrowed = await import('/borrowed.js'); window.fig = Bokeh.documents[0].roots()[0] }"
    )
    yield page
    page.close()


def painted(page):
    """How often Bokeh reads CSS variables while it paints a figure once."""
    return page.evaluate(
        """async () => {
          const { asked } = window;
          fig.renderers[0].glyph.line_width = { value: 10 + Math.random() };
          await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
          return window.asked - asked;
        }"""
    )


def laid_out(page, figure, high):
    """How often the whole page is laid out when a figure gets a range whose labels have the same length as before."""
    return page.evaluate(
        """async ([figure, high]) => {
          const [root] = Bokeh.documents[0].roots(), view = Bokeh.index.find_one(root), { compute_layout } = view;
          let count = 0;
          view.compute_layout = function () { count += 1; return compute_layout.call(this); };
          root.children[figure].children[0].y_range.setv({ start: -high, end: high });
          for (let i = 0; i < 4; i += 1) await new Promise((done) => requestAnimationFrame(done));
          delete view.compute_layout;
          return count;
        }""",
        [figure, high],
    )


OURS = BEFORE.read_text(encoding="utf-8").partition("// 2.")[0]


def a_figure_is_painted_without_asking_the_style_sheets(bare):
    """1. The part of app/borrowed.js that runs before Panel's scripts."""
    assert painted(bare) > 20  # otherwise this patch is no longer needed
    bare.evaluate(f"() => {{ {OURS} }}")
    assert painted(bare) == 0


def test_a_figure_makes_room_for_its_labels_in_itself(chromium):
    """So the page is not laid out again, neither by this figure nor by a hidden one."""
    page = of_bokeh(chromium, beside())
    page.goto(f"{HERE}/")
    page.wait_for_function("() => Bokeh.documents[0]?.is_idle")
    assert laid_out(page, 0, 1000) and laid_out(page, 1, 1000)  # otherwise this patch is no longer needed
    page.evaluate(f"() => {{ {OURS} }}")
    inside = "() => Bokeh.documents[0].roots()[0].children.map(({ children: [fig] }) => fig.inner_width)"
    before = page.evaluate(inside)[0]
    assert laid_out(page, 0, 10_000_000) == 0 == laid_out(page, 1, 10_000_000)
    page.wait_for_function(f"(before) => ({inside})()[0] < before - 5", arg=before)
    page.evaluate("() => { Bokeh.documents[0].roots()[0].children[1].visible = true }")
    page.wait_for_function(f"() => {{ const [one, other] = ({inside})(); return other > 100 && other === one }}")
    page.close()


def test_the_bundle_runs_once(chromium, server):
    """For all Panel components and for our own: Panel's loader is given the module that the browser has."""
    page = chromium.new_page()
    page.goto(f"{server}?")
    page.locator("#first").wait_for(state="detached")
    page.wait_for_function("() => window.importShim")
    assert page.evaluate(
        """async () => {
          const links = [...document.querySelectorAll("link[rel=modulepreload]")].map((link) => link.href);
          const href = links.find((address) => address.includes("tippe.js"));
          return (await window.importShim(href)).default === (await import(href)).default;
        }"""
    )
    page.close()


def a_place_of_a_figure_is_where_its_scales_say(bare):
    """2. Each corner of the frame, compared with Bokeh's own events, which are public."""
    bare.evaluate("() => { window.scales = borrowed.scalesOf(fig); window.over = borrowed.eventsOf(fig) }")
    left, top = bare.evaluate("() => { const { left, top } = over.getBoundingClientRect(); return [left, top] }")
    bare.evaluate("() => fig.on_event('mousemove', ({ x, y }) => { window.told = [x, y] })")
    for x, y in ((1, -0.9), (9, 0.9)):
        across, down = bare.evaluate("([x, y]) => [scales.x.compute(x), scales.y.compute(y)]", [x, y])
        bare.mouse.move(left + across, top + down)
        bare.wait_for_function("() => window.told")
        assert bare.evaluate("() => window.told") == pytest.approx([x, y], abs=0.02)
        assert bare.evaluate("(px) => scales.x.invert(px)", across) == pytest.approx(x)
        bare.evaluate("() => { window.told = null }")


def what_hears_the_mouse_has_its_cursor(bare):
    """3. The element covers the figure and gets its events; a cursor that is set stays until the mouse moves."""
    bare.evaluate("() => borrowed.eventsOf(fig).addEventListener('pointerdown', () => { window.pressed = true })")
    bare.mouse.click(200, 150)
    assert bare.evaluate("() => window.pressed")
    bare.evaluate("() => fig.on_event('mousemove', () => borrowed.setCursor(fig, 'ns-resize'))")
    bare.mouse.move(210, 160)
    bare.wait_for_function("() => getComputedStyle(borrowed.eventsOf(fig)).cursor === 'ns-resize'")
    assert bare.evaluate("() => borrowed.elementOf(fig).getBoundingClientRect().width") == 400


def a_hand_that_rests_before_it_pulls_still_pulls(bare):
    """4."""
    bare.evaluate(
        "() => { window.heard = []; for (const name of ['press', 'panstart'])"
        " fig.on_event(name, () => window.heard.push(name)) }"
    )

    def rest_and_pull():
        bare.evaluate("() => { window.heard.length = 0 }")
        bare.mouse.move(200, 150)
        bare.mouse.down()
        now = bare.evaluate("() => performance.now()")
        bare.wait_for_function("(now) => window.heard.length || performance.now() > now + 600", arg=now)  # Bokeh's: 300
        bare.mouse.move(220, 180, steps=5)
        bare.mouse.up()
        return bare.evaluate("() => window.heard")

    assert rest_and_pull() == ["press"]  # otherwise this patch is no longer needed
    bare.evaluate("() => borrowed.pressNever(fig)")
    assert rest_and_pull() == ["panstart"]


def test_what_is_borrowed_for_a_figure_works_and_is_needed(bare):
    a_place_of_a_figure_is_where_its_scales_say(bare)
    what_hears_the_mouse_has_its_cursor(bare)
    a_hand_that_rests_before_it_pulls_still_pulls(bare)
    a_figure_is_painted_without_asking_the_style_sheets(bare)
