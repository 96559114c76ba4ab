"""Learn in Chromium: the lesson alone, and a class with a big screen and two phones on the served page."""

import re
from html import unescape
from pathlib import Path

import panel
import pytest
from axe import DARK, DARK_LARGE, LIGHT, LOOK, check, violations
from components import *  # noqa: F403
from playwright.sync_api import expect
from visiting import Visit
from watching import LOST

from app.model.explorer import Explorer
from app.model.lesson import lesson, parts
from app.model.published import curves as curves_of
from app.model.roll import derivation
from app.state.url_state import read
from app.tabs.learn.learn import Learn
from app.tabs.learn.published import Steps, curve_data
from app.tabs.learn.teach import link
from app.tabs.learn.worksheet import worksheet
from app.text import listed, say, speaking

pytestmark = pytest.mark.served


PHONE = {"viewport": {"width": 390, "height": 900}, "has_touch": True}


def told(step, language):
    """The texts that the page must show for a step of the paper's top: its explanation and what was learned, by its own
    run."""
    scene = Explorer().scene
    answer = step.answer(lesson.planned(step, scene))
    words = [say(f"learn.{step.name}.{key}", language, **answer.numbers) for key in (answer.told, "learned")]
    return [plain_text(spelled(part, language)) for part in words]


def spelled(words, language):
    point = say("browser.NumberControls.decimal", language)
    return re.sub(r"(?<=\d)\.(?=\d)", point, words)


def plain_text(words):
    return re.sub(r"\s+", "", re.sub(r"<[^>]+>", "", words))


def watched(page, language="en"):
    """Asks to see the run, and drags the time to its end, because the machine draws by software."""
    page.get_by_role("button", name=say("learn.view.watch", language)).click()
    bar = page.get_by_role("slider", name=say("learn.view.time", language), exact=True)
    bar.focus()
    bar.press("End")
    page.locator(".side .told .big").wait_for()


@pytest.fixture
def learn(alone):
    """learn(language="en", **like) gives the Alone with the lesson, which belongs to the Learn `.learn`."""

    def open_(language="en", **like):
        found = alone(**like)
        with speaking(language):
            found.learn = Learn(Explorer().scene, lab=lambda: found.told.append("lab"))
        found.page.evaluate("language => { document.documentElement.lang = language }", language)
        found.show(found.learn.lesson)
        return found

    return open_


def test_the_derivation_is_live(alone):
    learn, found = Learn(Explorer().scene), alone(draws=True)
    learn.section = "derivation"
    learn.top.height = 400
    [katex] = Path(panel.__file__).parent.glob("dist/bundled/katex/**/katex.min.js")
    found.page.add_script_tag(path=katex)  # which the page has of Panel
    page = found.show(learn.top, *learn.derivation.place.objects)
    sides = page.locator(".lines .line .sides").first
    sides.locator("b").first.wait_for()
    # the numbers go with the clock; at the turning point itself that of F_x would be the root of a rounding
    before = sides.inner_text()
    page.get_by_role("button", name=say("browser.Top3D.forward"), exact=True).click()
    page.wait_for_function("([node, text]) => node.innerText != text", arg=[sides.element_handle(), before])
    lines = page.locator(".lines .line").evaluate_all("""all => all.map((line) => [
        Number(line.querySelector(".sides").dataset.apart),
        [...line.querySelectorAll("[data-symbol]")].map((node) => node.dataset.symbol)])""")
    assert len(lines) == len(derivation.LINES)
    assert max(apart for apart, _ in lines) < 1e-9
    for (_, known), line in zip(lines, derivation.LINES, strict=True):
        assert set(line.symbols.split()) <= set(known), line.number
    # a symbol is seen beside the top, alone, and its value is said
    page.locator(".lines .line").nth(4).locator("[data-symbol=omega]").first.hover()
    page.locator(".tip").get_by_text(listed("derivation.symbols.omega")).wait_for()
    page.wait_for_function("__tippe.tops('learn').some((top) => top.highlight == 'ω')")


def test_a_walk_through_the_lesson_on_a_german_phone(learn):
    """Each step shows its top before it asks, answers nothing by itself, and tells what its own run did once that has
    been seen; an answer is still there when one comes back."""
    language, found = "de", learn("de", **PHONE)
    page, scene = found.page, Explorer().scene
    crumbs = page.locator(".crumbs button")
    for place, step in enumerate(lesson.LESSON):
        page.get_by_role("heading", name=say(f"learn.{step.name}.question", language)).wait_for()
        watch = page.get_by_role("button", name=say("learn.view.watch", language))
        watch.wait_for()
        # the two arms stand where the top does, before the question, and the circles beside the dot
        seen = "section.picture" if step.picture == "arms" else ".stage"
        box, question = page.locator(seen).bounding_box(), page.locator(".question").bounding_box()
        assert -1 <= box["y"] <= question["y"] - box["height"], step.name
        assert page.locator(".ways").is_visible() == (step.name == "way")
        assert watch.is_disabled() and page.locator(".option :checked").count() == 0
        page.locator(".bar .covered").wait_for()
        truth, words = step.answer(scene).truth, listed(f"learn.{step.name}.options", language)
        guess = next(key for key in step.asks.options if key != truth) if place % 2 else truth
        page.get_by_role("radio", name=words[guess]).check(force=True)
        assert page.locator(".side .told .big").count() == 0
        watched(page, language)
        verdict = say(f"learn.view.{'right' if guess == truth else 'off'}", language)
        assert page.locator(".side .told .big").inner_text() == verdict
        said = plain_text(page.locator(".side .told").inner_text())
        assert step.name == "yours" or all(part in said for part in told(step, language)), step.name
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), step.name
        box = page.locator(".stage").bounding_box()
        assert box["y"] >= -1 and box["y"] + box["height"] <= 900, "the top is in sight beside the question"
        if step is not lesson.LESSON[-1]:
            page.get_by_role("button", name=say("learn.view.next", language)).click()
    # the end says what was learned, and leads to where it can be tried
    learned = [say(f"learn.{step.name}.learned", language) for step in lesson.LESSON]
    assert page.locator(".end li").all_inner_texts() == learned
    crumbs.nth(1).click()
    page.locator(".side .told .big").get_by_text(say("learn.view.off", language)).wait_for()
    found.until(lambda: found.learn.step == "way")
    crumbs.last.click()
    page.get_by_role("button", name=say("learn.view.lab", language)).click()
    found.until(lambda: "lab" in found.told)


def test_a_slider_of_the_step_shows_what_steps_do_to_coulombs_law(alone):
    found, curves = alone(), [curve_data(curve) for curve in curves_of()]
    page = found.show(Steps(curves=curves, points=[]))
    says = page.locator(".steps li")
    says.first.wait_for()
    assert says.count() == 4 and page.locator(".steps .plot .line").count() == 4
    assert says.last.inner_text() == "{name}: {says}".format(**curves[3])
    page.get_by_role("slider").press("End")
    assert says.last.inner_text() == "{name}: {says}".format(**curves[-1]) and "90" not in curves[-1]["says"]
    assert violations(page) == []


def test_what_is_for_theorists(learn):
    found = learn()
    page = found.page
    for step in lesson.THEORY:
        found.learn.step = step.name
        found.send()
        page.get_by_role("button", name=say(f"learn.{step.name}.title")).wait_for()
        if isinstance(step.asks, parts.Choice):
            page.get_by_role("radio").first.check(force=True)
        else:  # a slider counts once a hand has moved it
            slider = page.get_by_role("slider", name=say("learn.view.number_none"))
            assert page.get_by_role("button", name=say("learn.view.watch")).is_disabled()
            slider.press("PageUp")
        watched(page)
        said = plain_text(page.locator(".side .told").inner_text())
        assert all(part in said for part in told(step, "en")), step.name


# As in a browser whose websocket is opening again: what is sent then throws.
REFUSES = """window.refuses = () => { throw new DOMException("Still in CONNECTING state.", "InvalidStateError") }
window.lost = !window.dispatchEvent(new CustomEvent("tippe:lost", {cancelable: true}))"""


def test_a_lesson_goes_on_where_nothing_can_be_sent(learn):
    """It says that the votes wait, and the page does not reload."""
    found = learn()
    page = found.page
    page.locator(".crumbs button").nth(1).wait_for()
    page.evaluate(REFUSES)
    page.keyboard.press("Alt+p")
    page.locator(".lesson.present .board").wait_for()
    page.evaluate(REFUSES)
    assert page.evaluate("lost")
    page.locator(".warning").get_by_text(say("teach.room.lost")).wait_for()
    for step in lesson.SIX:
        page.get_by_role("heading", name=say(f"learn.{step.name}.question")).wait_for()
        revealed(page, step)
        page.keyboard.press("ArrowRight")
    assert not found.told


def presented(page):
    """Goes from the lesson to the big screen through what is for teachers; axe-core sees all that there is."""
    page.locator(".crumbs button").nth(1).wait_for()
    check(page, "learn", DARK)
    page.get_by_role("button", name="The derivation", exact=True).click()
    page.locator(".line .sides b").first.wait_for()
    page.locator(".line button:visible").first.click()
    check(page, "the derivation")
    page.get_by_role("radio", name="History", exact=True).click()
    page.locator("ol:visible").first.wait_for()
    check(page, "the history")
    page.get_by_role("radio", name="For teachers", exact=True).click()
    page.get_by_role("button", name=say("teach.vote.close")).wait_for()
    check(page, "for teachers")
    page.get_by_role("button", name="Present to a class (Alt+P)", exact=True).click()
    page.locator(".lesson.present .board").wait_for()


def fits(page):
    """On a small projector, as on a large one, nothing of the big screen is below its edge. It fills the screen, so its
    window has no size that could be set."""
    devtools = page.context.new_cdp_session(page)
    for width, height in ((1280, 720), (1920, 1080)):
        size = {"width": width, "height": height, "deviceScaleFactor": 0, "mobile": False}
        devtools.send("Emulation.setDeviceMetricsOverride", size)
        page.wait_for_function("height => innerHeight === height", arg=height)
        for part in (".counted button:visible", "section.bar", ".foot"):
            box = page.locator(f".lesson.present {part}").bounding_box()
            assert box["y"] + box["height"] <= height


def revealed(page, step):
    """Reveals a step by its key, and drags the time to its end."""
    page.keyboard.press("Alt+r")
    bar = page.get_by_role("slider", name=say("learn.view.time"), exact=True)
    page.wait_for_function("([bar, end]) => Number(bar.max) >= end - 0.01",
                           arg=[bar.element_handle(), step.end])  # fmt: skip
    bar.focus()
    bar.press("End")
    truth = listed(f"learn.{step.name}.options")[step.answer(Explorer().scene).truth]
    page.locator(".letters .true").get_by_text(truth).wait_for()


def sent(page, answer, language=None):
    """Waits until a phone says that the answer was sent, and that it can be changed."""
    said = re.compile(f"{re.escape(answer)}.*{re.escape(say('teach.room.sent', language))}")
    expect(page.get_by_role("radio", name=said)).to_be_checked()
    page.get_by_text(say("teach.room.change", language)).wait_for()


def opened(page, address, width, height):
    page.set_viewport_size({"width": width, "height": height})
    return Visit(page, address, whole=False).page


def connected(socket, sockets):
    """The first socket of a page is connected; once another one has been noted, there is no network."""
    if len(sockets) < 2:
        sockets.append((socket, socket.connect_to_server()))
    else:
        socket.close()


def test_a_class_with_two_phones_that_goes_on_where_the_network_does_not(chromium, server, page_errors):
    """They follow the big screen from question to question; the votes are seen only when they are revealed; another
    class starts without votes. Each phone has its own language. All of the lesson is in the page already."""
    page_errors.allow(LOST)
    languages, sockets = ("en", "de"), []
    screen, *phones = (chromium.new_context(reduced_motion="reduce", has_touch=bool(i)) for i in range(3))
    page = screen.new_page()
    page.route_web_socket(re.compile("/ws"), lambda each: connected(each, sockets))
    opened(page, f"{server}?tab=learn", 1920, 1080)
    presented(page)
    page.locator(".link-address").get_by_text("?vote=").wait_for()
    page.locator(".count").get_by_text(say("teach.room.nobody")).wait_for()
    assert page.locator(".qr svg").bounding_box()["height"] > 300  # it must be readable across a room
    assert page.locator(".warning").inner_text() == say("teach.room.local")
    check(page, "the big screen", DARK_LARGE)
    page.evaluate(LOOK, LIGHT)
    address = f"http://{page.locator('.link-address').inner_text()}"
    students = [opened(phone.new_page(), f"{address}&lang={each}", 390, 844)
                for phone, each in zip(phones, languages, strict=True)]  # fmt: skip
    for phone, option, language in zip(students, ("over", "falls"), languages, strict=True):
        words = listed("learn.flips.options", language)[option]
        phone.get_by_role("radio", name=words).check(force=True)
        sent(phone, words, language)
        assert phone.locator(".told > *").count() == 0
    assert violations(students[0]) == [], "a vote"
    page.locator(".count b", has_text="2").wait_for()
    assert page.locator(".votes").count() == 0 and page.locator(".letters li").count() == 4
    fits(page)
    revealed(page, lesson.OF_NAME["flips"])
    fits(page)
    for place, count in enumerate("1010"):
        page.locator(".letters li").nth(place).locator("em", has_text=re.compile(f"^{count}$")).wait_for()
    for phone, language in zip(students, languages, strict=True):
        phone.get_by_text(say("teach.room.shown", language)).wait_for()

    # the next question, also on the phones; a phone that reloads keeps its identity
    page.keyboard.press("ArrowRight")
    for phone, language in zip(students, languages, strict=True):
        phone.get_by_role("heading", name=say("learn.way.question", language)).wait_for()
        assert phone.locator(".option :checked").count() == 0
    other = listed("learn.way.options")["other"]
    students[0].get_by_role("radio", name=other).check(force=True)
    sent(students[0], other)
    students[0].reload()
    sent(students[0], other)
    page.keyboard.press("Alt+0")
    page.locator(".count b", has_text=re.compile("^0$")).wait_for()
    for phone, language in zip(students, languages, strict=True):
        phone.get_by_role("heading", name=say("learn.flips.question", language)).wait_for()
        phone.get_by_text(say("teach.room.vote", language)).wait_for()
        assert phone.evaluate("document.documentElement.scrollWidth <= innerWidth")
    students[1].emulate_media(color_scheme="dark")
    students[1].wait_for_function("document.documentElement.dataset.look === 'dark'")
    page.route("**/readyz", lambda route: route.abort())
    [(socket, _)] = sockets
    sockets.append(None)
    socket.close()
    page.locator(".warning").get_by_text(say("teach.room.lost")).wait_for()
    revealed(page, lesson.OF_NAME["flips"])
    page.keyboard.press("ArrowRight")
    page.get_by_role("heading", name=say("learn.way.question")).wait_for()
    page.keyboard.press("Escape")
    page.locator(".lesson.present").wait_for(state="detached")
    for context in (screen, *phones):
        context.close()


@pytest.mark.parametrize(("language", "own"), [("en", False), ("de", True)])
def test_the_worksheet_is_one_page(chromium, language, own):
    """Pages of A4, as printed; also with the class's own top."""
    with speaking(language):
        sheet = worksheet(Explorer().scene if own else None)
    context = chromium.new_context()
    page = context.new_page()
    page.set_content(sheet)
    printed = page.pdf(prefer_css_page_size=True)
    context.close()
    assert len(re.findall(rb"/Type\s*/Page\b", printed)) == 1
    for step in lesson.SIX:
        assert say(f"worksheet.asked.{step.name}", language) in unescape(sheet)
    assert ("16.0 mm" in sheet or "16,0 mm" in sheet) is own and sheet.count("<polygon") == own


def test_the_links_of_the_teacher_open_their_step():
    for step in lesson.STEPS:
        texts, wrong = read(link(step))
        assert not wrong and texts == {"tab": "learn", "step": step.name}
