"""The parts of a form in Chromium, alone on a page without a server: hands, keys, looks, and what Python hears."""

from types import SimpleNamespace

import pytest
from axe import violations
from components import *  # noqa: F403

from app.state.validate import InvalidMessage
from app.text import speaking
from app.widgets.cards import flow, stack, words
from app.widgets.form import Form
from app.widgets.forms import Button, Checks, Field, Menu, Stretch, TextFile

pytestmark = pytest.mark.served


def parts():
    """One of each."""
    return {
        "primary": Button("Fit", kind="primary"),
        "outline": Button("Stop", disabled=True),
        "link": Button("Show one such run", kind="link"),
        "field": Field("friction", value="0.3", shows="friction <i>μ</i>", unit="mm"),
        "menu": Menu("Across", options={"spin": "spin", "tilt": "tilt"}, value="spin"),
        "checks": Checks("Also free", options={"spin": "n", "friction": "mu"}, value=["mu"]),
        "stretch": Stretch("Part that is fitted", value=[0.25, 0.75], unit="s"),
        "file": TextFile("Open a file", lambda text: None, lambda: None, most=8, accept=".json"),
    }


@pytest.fixture
def form(alone):
    def open_(language="en", **like):
        found = alone(**like)
        with speaking(language):
            found.parts = parts()
        found.show(*found.parts.values())
        return found

    return open_


def test_each_click_is_heard_once_and_none_while_disabled(form):
    found, heard = form(), []
    for name in ("primary", "outline"):
        found.parts[name].on_click(lambda name=name: heard.append(name))
    found.page.get_by_role("button", name="Fit").dblclick()
    found.page.get_by_role("button", name="Stop").click(force=True)
    found.until(lambda: len(heard) >= 2)
    assert heard == ["primary"] * 2
    found.parts["primary"].clicks = 10**15  # from a client other than the page
    assert 2 < len(heard) < 20


def test_an_entry_is_sent_once_and_a_refused_one_has_ways_out(form):
    found = form()
    field, entry = found.parts["field"], found.page.get_by_role("textbox", name="friction")
    entry.fill("7")
    entry.press("Escape")
    assert entry.input_value() == "0.3"
    entry.fill("7")
    entry.press("Enter")
    found.until(lambda: field.value == "7")
    field.refuse("friction is 7. Allowed is 0 to 5.", "5", "0.3")
    found.send()
    assert "friction is 7. Allowed is 0 to 5." in found.page.get_by_role("alert").inner_text()
    assert entry.get_attribute("aria-invalid") == "true" and entry.input_value() == "7"
    found.page.get_by_role("button", name="Take 5").click()
    found.until(lambda: field.value == "5")
    assert [value for _, name, value in found.told if name == "value"] == ["7", "5"]


def test_one_chooses_checks_and_pulls_by_keys(form):
    found = form()
    page, menu, checks, stretch = found.page, *(found.parts[name] for name in ("menu", "checks", "stretch"))
    page.get_by_label("Across").focus()
    page.keyboard.press("ArrowDown")
    found.until(lambda: menu.value == "tilt")
    page.get_by_label("spin", exact=True).press("Space")
    found.until(lambda: checks.value == ["n", "mu"])
    page.get_by_role("slider", name="to").press("ArrowRight")
    found.until(lambda: stretch.value == [0.25, 0.76])
    page.get_by_role("slider", name="to").press("PageUp")
    found.until(lambda: stretch.value[1] == pytest.approx(0.86))


def test_a_stretch_names_its_range_and_the_nearest(form):
    found = form()
    stretch = found.parts["stretch"]
    entry = found.page.get_by_role("textbox", name="Part that is fitted, from")
    entry.fill("7")
    entry.press("Enter")
    assert "0.000 s to 0.750 s" in found.page.get_by_role("alert").inner_text()
    assert stretch.value == [0.25, 0.75]
    found.page.get_by_role("button", name="Take 0.750 s").click()
    found.until(lambda: stretch.value == [0.75, 0.75])


def test_in_one_form_each_part_is_heard_and_shows_what_python_says(form):
    found, heard = form(), []
    parts, says = parts_of_one(), words("before")
    whole = Form(flow(parts["primary"], parts["field"]), stack(says, parts["menu"]), parts["outline"])
    parts["primary"].on_click(lambda: heard.append(parts["field"].value))
    parts["menu"].on("value", lambda event: says.param.update(object="<b>after</b>", visible=True))
    page = found.show(whole)
    page.get_by_role("button", name="Go").dblclick()
    found.until(lambda: len(heard) == 2)
    page.get_by_role("textbox", name="mass").fill("7")
    page.get_by_role("textbox", name="mass").press("Enter")
    found.until(lambda: parts["field"].value == "7")
    page.get_by_role("button", name="Go").click()  # none of the clicks is taken back by an answer
    found.until(lambda: heard == ["0.3", "0.3", "7"])
    page.get_by_label("Up").select_option("tilt")
    page.get_by_text("after").wait_for()
    found.put(says, visible=False)
    parts["field"].refuse("mass is 7 g. Allowed is 0 to 5 g.", "5", "0.3")
    found.send()
    page.get_by_text("after").wait_for(state="hidden")
    page.get_by_role("button", name="Take 5").click()
    found.until(lambda: parts["field"].value == "5")
    page.get_by_role("button", name="Wait").click(force=True)
    assert parts["outline"].clicks == 0 and [name for _, name, _ in found.told] == ["sent"] * 6


def parts_of_one():
    return {
        "primary": Button("Go", kind="primary"),
        "outline": Button("Wait", disabled=True),
        "field": Field("mass", value="0.3", shows="mass", unit="g"),
        "menu": Menu("Up", options={"spin": "spin", "tilt": "tilt"}, value="spin"),
    }


def test_a_file_is_read_and_one_too_large_is_refused(form):
    found, heard = form(), []
    file = found.parts["file"]
    file._take, file._refuse = heard.append, lambda: heard.append(None)
    for text in ("abc", "abc", "far too long"):
        found.page.locator("input[type=file]").set_input_files(
            {"name": "top.json", "mimeType": "application/json", "buffer": text.encode()}
        )
    found.until(lambda: len(heard) >= 3)
    assert heard == ["abc", "abc", None]


@pytest.mark.parametrize("like", [{}, {"viewport": {"width": 390, "height": 844}}])
def test_they_are_legible_in_every_look_and_large_enough_for_a_finger(form, like):
    found = form("de", **like)
    found.parts["field"].refuse("Das geht nicht. Erlaubt ist 0 bis 5.", "5", "0,3")
    found.send()
    for look in ("light", "dark large"):
        found.page.evaluate("""look => {
          __tippe.wear(look)
          document.body.style.background = "var(--card)"
          window.dispatchEvent(new CustomEvent("tippe:look"))
        }""", look)  # fmt: skip
        assert not violations(found.page)
        if like:
            low = found.page.locator("button, select, input:not([type=file], [type=checkbox]), label:has(input)")
            heights = low.evaluate_all("all => all.map(e => Math.round(e.getBoundingClientRect().height))")
            assert min(heights) >= 44, heights


@pytest.mark.parametrize("name", ["object", "visible", "css_classes"])
def test_no_browser_sets_the_words_of_a_form(name):
    says = words("ours")
    form = Form(flow(says))
    for at, part in enumerate(form._parts):
        with pytest.raises(InvalidMessage):
            form._take(SimpleNamespace(new=[1, at, name, "theirs"]))
        assert getattr(part, name, None) != "theirs"
