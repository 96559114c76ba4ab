"""Learn in Chromium, as a student and a teacher would use it."""

import re

import numpy as np
import pytest
from visiting import Visit

from app.model import derivation, lesson, lesson_parts
from app.model.explorer import Explorer
from app.state.codecs import Body
from app.text import listed, say
from tippe_core import PRESETS

pytestmark = pytest.mark.served


@pytest.fixture(scope="module")
def browser(chromium):
    """Keeps what pages have in common; nothing moves by itself, as drawing by software takes everybody's time."""
    context = chromium.new_context(reduced_motion="reduce")
    yield context
    context.close()


def opened(browser, address, width=1400, height=900):
    page = browser.new_page()
    page.set_viewport_size({"width": width, "height": height})
    return Visit(page, address, whole=False)


def closed(visit):
    """The end of a visit: the page had no error."""
    visit.page.close()
    assert not visit.errors


def explained(step, guess):
    """What the page must say: the verdict, and the explanation with the numbers of the motion set up."""
    explorer = Explorer()
    explorer.param.update(**step.inputs(explorer.scene.top))
    verdict, answer = lesson.judged(step, explorer.scene, guess)
    return say(f"learn.verdict.{verdict}"), say(f"learn.{step.name}.{answer.told}", **answer.numbers)


def plain_text(words):
    return re.sub(r"\s+", "", re.sub(r"<[^>]+>", "", words))


def go(page, section, language="en"):
    """To one of Learn's sections."""
    page.get_by_role("button", name=say(f"learn.sections.{section}", language), exact=True).click()


@pytest.fixture(scope="module")
def learner(browser, server):
    """One visit for the tests down to the vote, in their order: a person goes through all of Learn."""
    visit = opened(browser, server + "?tab=learn&learn=derivation")
    visit.at = None
    yield visit
    closed(visit)


def test_the_derivation_is_live(learner):
    page = learner.page
    sides = page.locator(".line .sides").first
    sides.locator("b").first.wait_for()
    # the numbers go with the clock; at the turning point itself that of F_x would be the root of a rounding
    before = sides.inner_text()
    page.get_by_role("button", name=say("browser.Top3D.forward"), exact=True).click()
    page.wait_for_function("([node, text]) => node.innerText != text", arg=[sides.element_handle(), before])
    lines = page.locator(".line").evaluate_all("""all => all.map((line) => [
        Number(line.querySelector(".sides").dataset.apart),
        [...line.querySelectorAll("[data-symbol]")].map((node) => node.dataset.symbol)])""")
    assert len(lines) == len(derivation.LINES)
    assert max(apart for apart, _ in lines) < 1e-9
    for (_, known), line in zip(lines, derivation.LINES, strict=True):
        assert set(line.symbols.split()) <= set(known), line.number
    # a symbol is seen beside the top, alone, and its value is said
    page.locator(".line").nth(4).locator("[data-symbol=omega]").first.hover()
    page.locator(".tip").get_by_text(listed("derivation.symbols.omega")).wait_for()
    page.wait_for_function("__tippe.tops('learn').some((top) => top.highlight == 'ω')")


@pytest.mark.parametrize("step", lesson.STEPS, ids=lesson.NAMES)
def test_each_step_as_a_student(learner, step):
    page, place = learner.page, lesson.STEPS.index(step)
    if place == 0:
        go(page, "lesson")
        learner.at = step
    assert learner.at is step, "one before it failed"
    page.get_by_role("heading", name=say(f"learn.{step.name}.title")).wait_for()
    asks = step.asks(Explorer().scene)
    run = page.get_by_role("button", name=say("learn.page.predict"))
    if isinstance(asks, lesson_parts.Choice):
        run.click()
        page.get_by_text(say("learn.page.choose")).wait_for()
        guess = asks.options[-1]
        own = listed("learn.options").get(step.name, {})
        page.get_by_text(own.get(guess) or say(f"learn.options.{guess}"), exact=True).click()
    else:
        slider = page.get_by_role("slider", name=say("learn.page.yours"))
        slider.focus()
        slider.press("Home")
        for _ in range(3):
            slider.press("PageUp")
        guess = float(slider.input_value())
    run.click()
    verdict, words = explained(step, guess)
    page.get_by_role("status").get_by_text(verdict).wait_for()
    told = "".join(page.locator("p").all_inner_texts())
    assert plain_text(words) in plain_text(told)
    assert page.locator("math").count() >= len(step.tex)
    if place < len(lesson.STEPS) - 1:
        page.get_by_role("button", name=say("learn.page.next"), exact=True).click()
        learner.at = lesson.STEPS[place + 1]


def test_nothing_locks(learner):
    """A step left and come back to stands as it was left, with its prediction and verdict."""
    page = learner.page
    page.get_by_role("button", name=say("learn.page.back"), exact=True).click()
    page.get_by_role("heading", name=say("learn.proof.title")).wait_for()
    page.get_by_role("button", name=say("learn.page.again")).wait_for()
    page.get_by_role("status").get_by_text(say("learn.verdict.right")).wait_for()
    assert page.get_by_role("radio", name=say("learn.options.opposite")).is_checked()


@pytest.fixture
def phones(chromium):
    """Two, each with what it keeps itself."""
    contexts = [chromium.new_context(reduced_motion="reduce", has_touch=True) for _ in range(2)]
    yield contexts
    for context in contexts:
        context.close()


def tally(page):
    return list(
        page.evaluate("""() => [...Bokeh.documents[0]._all_models.values()]
        .find((m) => m.name == "votes").renderers[0].data_source.data.votes""")
    )


def test_a_vote(learner, phones):
    """A teacher opens it, two students predict, the histogram shows them, and closing it forgets them. Who loads the
    page anew, or goes to another tab of his browser, is still the same; the teacher's address opens the vote again."""
    page = learner.page
    go(page, "teach")
    page.get_by_role("button", name=say("teach.vote.open")).click()
    link = page.locator("a[href*='?vote=']")
    link.wait_for()
    languages = ("en", "de")  # each is asked in the language of their own page
    students = [opened(phone, f"{link.get_attribute('href')}&lang={each}", 390, 844)
                for phone, each in zip(phones, languages, strict=True)]  # fmt: skip
    for visit, option, language in zip(students, ("over", "upright"), languages, strict=True):
        send = visit.page.get_by_role("button", name=say("teach.student.send", language))
        send.click()
        visit.page.get_by_text(say("teach.student.waiting", language)).wait_for()
        visit.page.get_by_text(say(f"learn.options.{option}", language), exact=True).click()
        send.click()
        visit.page.get_by_text(say("teach.student.sent", language)).wait_for()
    page.get_by_text(say("teach.vote.count", votes=2, most=400)).wait_for()
    assert tally(page) == [1, 0, 1]
    again = students[0].page
    again.reload()
    again.get_by_text(say("teach.student.sent")).wait_for()
    assert again.get_by_role("radio", name=say("learn.options.over")).is_checked()
    again.get_by_text(say("learn.options.between"), exact=True).click()
    again.get_by_role("button", name=say("teach.student.send")).click()
    page.wait_for_function("""() => { const [votes] = [...Bokeh.documents[0]._all_models.values()]
        .filter((m) => m.name == "votes"); return votes.renderers[0].data_source.data.votes[1] == 1 }""")
    assert tally(page) == [0, 1, 1]

    # what he gives away does not hold his key; his own address does
    key = re.search(r"[?&]room=([\w.-]+)", page.evaluate("location.search"))[1]
    page.get_by_role("button", name="Share", exact=True).click()
    page.get_by_role("dialog").locator("textarea").first.wait_for()
    given = page.get_by_role("dialog").locator("textarea").evaluate_all("all => all.map((each) => each.value)")
    assert any("learn=teach" in each for each in given) and not any(key in each for each in given)
    page.keyboard.press("Escape")
    page.reload()
    page.get_by_text(say("teach.vote.count", votes=2, most=400)).wait_for()
    assert tally(page) == [0, 1, 1] and link.get_attribute("href").split("?")[1] in students[0].page.url
    page.get_by_role("button", name=say("teach.vote.answer")).click()
    page.get_by_text(say("teach.vote.said", answer=say("learn.options.over"))).wait_for()
    page.get_by_role("button", name=say("teach.vote.close")).click()
    page.get_by_text(say("teach.vote.shut")).wait_for()
    students[1].page.get_by_text(say("teach.student.closed", "de")).wait_for()
    students[0].page.get_by_role("button", name=say("teach.student.send")).click()
    students[0].page.get_by_text(say("teach.student.gone")).wait_for()
    for visit in students:
        closed(visit)


@pytest.mark.parametrize(("body", "language", "width"), [("Top S", "en", 1400), ("The paper's tippe top", "de", 390)])
def test_step_1_tells_who_is_right_that_he_is_right(browser, server, body, language, width):
    """Both turn over: in flight and landing the one, on its stem the other."""
    shape = next(preset.shape for preset in PRESETS if preset.name == body)
    address = f"{server}?tab=learn&step=free&lang={language}&body={Body.text(shape)}"
    visit = opened(browser, address, width, 900)
    page = visit.page
    for guess, verdict, button in (("over", "right", "predict"), ("between", "off", "again")):
        page.get_by_role("button", name=say(f"learn.page.{button}", language)).wait_for()
        page.get_by_text(say(f"learn.options.{guess}", language), exact=True).click()
        page.get_by_role("button", name=say(f"learn.page.{button}", language)).click()
        page.get_by_role("status").get_by_text(say(f"learn.verdict.{verdict}", language)).wait_for()
        page.get_by_text(f"{say('learn.options.over', language)}.", exact=True).wait_for()
    on = say("learn.on.sphere", language) if shape.edge is None else ""
    assert on in page.locator("p").filter(has_text="0.3").inner_text()
    if width < 600:  # German words are longer
        fits = "document.documentElement.scrollWidth <= innerWidth"
        page.wait_for_function(fits)
        go(page, "history", language)
        page.get_by_role("heading", name=say("history.page.title", language)).wait_for()
        page.wait_for_function(fits)
    closed(visit)


def test_the_links_of_the_teacher_set_up_their_motion():
    from app.state.keep import explorer_of, read
    from app.tabs.learn.teach import link

    for step in lesson.STEPS:
        texts, wrong = read(link(step))
        explorer, sentence = explorer_of(texts)
        assert not wrong and not sentence and texts["step"] == step.name
        expected = Explorer()
        expected.param.update(**step.inputs(expected.scene.top))
        assert np.array_equal(explorer.scene.trajectory.theta, expected.scene.trajectory.theta)
