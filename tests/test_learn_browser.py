"""Learn in Chromium, as a student and a teacher would use it."""

import re

import pytest
from visiting import Visit

from app.model import derivation, lesson, lesson_parts
from app.model.explorer import Explorer
from app.state.keep import read
from app.tabs.learn.teach import link
from app.text import listed, say

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


def told(step, language):
    """What the page must say of a step of the paper's top: its explanation and what was learned, by its own run."""
    scene = Explorer().scene
    answer = step.answer(lesson.planned(step, scene))
    words = [say(f"learn.{step.name}.{key}", language, **answer.numbers) for key in (answer.told, "learned")]
    return [plain_text(spelled(part, language)) for part in words]


def spelled(words, language):
    point = say("lab_view.view.decimal", language)
    return re.sub(r"(?<=\d)\.(?=\d)", point, words)


def plain_text(words):
    return re.sub(r"\s+", "", re.sub(r"<[^>]+>", "", words))


def watched(page, language="en"):
    """Asks to see it, and moves the time to its end, as a hand does: the machine draws by software."""
    page.get_by_role("button", name=say("learn.view.watch", language)).click()
    bar = page.get_by_role("slider", name=say("learn.view.time", language), exact=True)
    bar.focus()
    bar.press("End")
    page.locator(".told .big").wait_for()


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


@pytest.mark.parametrize(("language", "width"), [("en", 1400), ("de", 390)])
def test_a_walk_through_the_lesson(browser, server, language, width):
    """Each step shows its top before it asks, takes no answer by itself, and tells what its own run did once that was
    seen; what was answered stands there when one comes back."""
    visit = opened(browser, f"{server}?tab=learn&lang={language}", width, 900)
    page = visit.page
    crumbs = page.locator(".crumbs button")
    for place, step in enumerate(lesson.LESSON):
        page.get_by_role("heading", name=say(f"learn.{step.name}.question", language)).wait_for()
        watch = page.get_by_role("button", name=say("learn.view.watch", language))
        watch.wait_for()
        assert watch.is_disabled() and page.locator(".option :checked").count() == 0
        page.locator(".bar .covered").wait_for()
        answer = step.answer(Explorer().scene)
        words = listed(f"learn.{step.name}.options", language)
        guess = next(key for key in step.asks.options if key != answer.truth) if place % 2 else answer.truth
        page.get_by_role("radio", name=words[guess]).check(force=True)
        assert page.locator(".told .big").count() == 0
        watched(page, language)
        verdict = say(f"learn.view.{'right' if guess == answer.truth else 'off'}", language)
        assert page.locator(".told .big").inner_text() == verdict
        found = plain_text(page.locator(".told").inner_text())
        for part in told(step, language) if step.name != "yours" else []:
            assert part in found
        if width < 600:
            assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
            box = page.locator(".stage").bounding_box()
            assert box["y"] >= -1 and box["y"] + box["height"] <= 900, "the top is in sight beside the question"
        if step is not lesson.LESSON[-1]:
            page.get_by_role("button", name=say("learn.view.next", language)).click()
    crumbs.nth(1).click()
    page.locator(".told .big").get_by_text(say("learn.view.off", language)).wait_for()
    page.wait_for_function("location.search.includes('step=way')")
    closed(visit)


@pytest.mark.parametrize("name", [step.name for step in lesson.THEORY])
def test_what_is_for_theorists(browser, server, name):
    visit, step = opened(browser, f"{server}?tab=learn&step={name}"), lesson.OF_NAME[name]
    page = visit.page
    page.get_by_role("button", name=say(f"learn.{name}.title")).wait_for()
    if isinstance(step.asks, lesson_parts.Choice):
        page.get_by_role("radio").first.check(force=True)
    else:  # a slider counts once a hand has moved it
        slider = page.get_by_role("slider", name=say("learn.view.number_none"))
        assert page.get_by_role("button", name=say("learn.view.watch")).is_disabled()
        slider.press("PageUp")
    watched(page)
    found = plain_text(page.locator(".told").inner_text())
    for part in told(step, "en"):
        assert part in found
    closed(visit)


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
        visit.page.get_by_text(say(f"learn.flips.options.{option}", language), exact=True).click()
        send.click()
        visit.page.get_by_text(say("teach.student.sent", language)).wait_for()
    page.get_by_text(say("teach.vote.count", votes=2, most=400)).wait_for()
    assert tally(page) == [1, 1, 0, 0]
    again = students[0].page
    again.reload()
    again.get_by_text(say("teach.student.sent")).wait_for()
    assert again.get_by_role("radio", name=say("learn.flips.options.over")).is_checked()
    again.get_by_text(say("learn.flips.options.upright"), exact=True).click()
    again.get_by_role("button", name=say("teach.student.send")).click()
    page.wait_for_function("""() => { const [votes] = [...Bokeh.documents[0]._all_models.values()]
        .filter((m) => m.name == "votes"); return votes.renderers[0].data_source.data.votes[1] == 2 }""")
    assert tally(page) == [0, 2, 0, 0]

    # what he gives away does not hold his key; his own address does
    key = re.search(r"[?&]room=([\w.-]+)", page.evaluate("location.search"))[1]
    page.get_by_role("button", name="Share", exact=True).click()
    page.get_by_role("dialog").locator("textarea").first.wait_for()
    given = page.get_by_role("dialog").locator("textarea").evaluate_all("all => all.map((each) => each.value)")
    assert any("learn=teach" in each for each in given) and not any(key in each for each in given)
    page.keyboard.press("Escape")
    page.reload()
    page.get_by_text(say("teach.vote.count", votes=2, most=400)).wait_for()
    assert tally(page) == [0, 2, 0, 0] and link.get_attribute("href").split("?")[1] in students[0].page.url
    page.get_by_role("button", name=say("teach.vote.answer")).click()
    page.get_by_text(say("teach.vote.said", answer=say("learn.flips.options.over"))).wait_for()
    page.get_by_role("button", name=say("teach.vote.close")).click()
    page.get_by_text(say("teach.vote.shut")).wait_for()
    students[1].page.get_by_text(say("teach.student.closed", "de")).wait_for()
    students[0].page.get_by_role("button", name=say("teach.student.send")).click()
    students[0].page.get_by_text(say("teach.student.gone")).wait_for()
    for visit in students:
        closed(visit)


def test_the_links_of_the_teacher_open_their_step():
    for step in lesson.STEPS:
        texts, wrong = read(link(step))
        assert not wrong and texts == {"tab": "learn", "step": step.name}
