"""Learn in Chromium, as a student and a teacher would use it; axe-core on each of its pages."""

import re

import numpy as np
import pytest
from axe_playwright_python.base import AXE_SCRIPT
from visiting import PATIENCE, Visit

from app import derivation, lesson
from app.explorer import Explorer
from app.text import listed, say


def opened(chromium, server, query, size=(1400, 900)):
    page = chromium.new_page(viewport={"width": size[0], "height": size[1]})
    visit = Visit.__new__(Visit)
    visit.page, visit.requests, visit.errors, visit.sent = page, [], [], []
    page.set_default_timeout(PATIENCE)
    page.on("request", lambda request: visit.requests.append(request.url))
    page.on("console", lambda message: message.type == "error" and visit.errors.append(message.text))
    page.on("pageerror", lambda error: visit.errors.append(str(error)))
    page.goto(server + query)
    return visit


def axe(page):
    """What axe-core finds of WCAG A and AA in what Learn shows, by rule and place; not in the page around it."""
    page.evaluate(AXE_SCRIPT)
    found = page.evaluate("""async () => {
      const all = [], walk = (root) => { for (const node of root.querySelectorAll("*")) {
        if (node.classList.contains("learn")) all.push(node)
        if (node.shadowRoot) walk(node.shadowRoot) } }
      walk(document)
      return (await axe.run(all[0], {runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"]})).violations }""")
    return {rule["id"]: [node["target"] for node in rule["nodes"]] for rule in found}


def explained(step, guess):
    """What the page must say: the verdict, and the explanation with the numbers of the motion set up."""
    explorer = Explorer()
    explorer.param.update(**step.inputs(explorer.scene.top))
    verdict, answer = lesson.judged(step, explorer.scene, guess)
    return say(f"learn.verdict.{verdict}"), say(f"learn.{step.name}.{answer.told}", **answer.numbers)


def plain_text(words):
    return re.sub(r"\s+", "", re.sub(r"<[^>]+>", "", words))


@pytest.fixture(scope="module")
def student(chromium, server):
    visit = opened(chromium, server, "?tab=learn")
    yield visit
    visit.page.close()
    assert not visit.errors
    assert [url for url in visit.requests if not url.startswith((server.rsplit("/", 1)[0], "data:", "blob:"))] == []


@pytest.mark.parametrize("step", lesson.STEPS, ids=lesson.NAMES)
def test_each_step_as_a_student(student, step):
    page = student.page
    page.get_by_role("heading", name=say(f"learn.{step.name}.title")).wait_for()
    asks = step.asks(Explorer().scene)
    if isinstance(asks, lesson.Choice):
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
    page.get_by_role("button", name=say("learn.page.predict")).click()
    verdict, words = explained(step, guess)
    page.get_by_role("status").get_by_text(verdict).wait_for()
    told = "".join(page.locator("p").all_inner_texts())
    assert plain_text(words) in plain_text(told)
    assert page.locator("math").count() >= len(step.tex)
    if step.name != lesson.NAMES[-1]:
        page.get_by_role("button", name=say("learn.page.next"), exact=True).click()


def test_nothing_locks(chromium, server):
    """A step left and come back to stands as it was left, with its prediction and verdict."""
    visit = opened(chromium, server, "?tab=learn&step=proof")
    page = visit.page
    page.get_by_role("button", name=say("learn.page.predict")).click()
    page.get_by_text(say("learn.page.choose")).wait_for()
    page.get_by_text(say("learn.options.opposite"), exact=True).click()
    page.get_by_role("button", name=say("learn.page.predict")).click()
    page.get_by_role("status").get_by_text(say("learn.verdict.right")).wait_for()
    for button, name in (("next", "flip"), ("back", "proof")):
        page.get_by_role("button", name=say(f"learn.page.{button}"), exact=True).click()
        page.get_by_role("heading", name=say(f"learn.{name}.title")).wait_for()
    page.get_by_role("button", name=say("learn.page.again")).wait_for()
    page.get_by_role("status").get_by_text(say("learn.verdict.right")).wait_for()
    assert page.get_by_role("radio").nth(2).is_checked()
    assert axe(page) == {}
    page.close()
    assert not visit.errors


def test_the_derivation_is_live(chromium, server):
    visit = opened(chromium, server, "?tab=learn&learn=derivation")
    page = visit.page
    page.locator(".line .sides b").first.wait_for()
    lines = page.locator(".line")
    assert lines.count() == len(derivation.LINES)
    apart = [float(lines.nth(i).locator(".sides").get_attribute("data-apart")) for i in range(lines.count())]
    assert max(apart) < 1e-9
    for i, line in enumerate(derivation.LINES):
        known = lines.nth(i).locator("[data-symbol]").evaluate_all("all => all.map((node) => node.dataset.symbol)")
        missing = set(line.symbols.split()) - set(known)
        assert not missing, (line.number, missing)
    # the numbers go with the clock
    sides = lines.nth(0).locator(".sides")
    before = sides.inner_text()
    page.wait_for_function("([node, text]) => node.innerText != text", arg=[sides.element_handle(), before])
    # a symbol is seen beside the top, alone, and its value is said
    lines.nth(4).locator("[data-symbol=omega]").first.hover()
    page.locator(".tip").get_by_text(listed("derivation.symbols.omega")).wait_for()
    page.wait_for_function("__tippe.tops('learn').some((top) => top.highlight == 'ω')")
    assert axe(page) == {}
    page.close()
    assert not visit.errors


def test_a_vote(chromium, server):
    """A teacher opens it, two students predict, the histogram shows them, and closing it forgets them."""
    teacher = opened(chromium, server, "?tab=learn&learn=teach")
    page = teacher.page
    page.get_by_role("button", name=say("teach.vote.open")).click()
    link = page.locator("a[href*='?vote=']")
    link.wait_for()
    address = link.get_attribute("href")
    students = [opened(chromium, address, "", (390, 844)) for _ in range(2)]
    for visit, option in zip(students, ("over", "upright"), strict=True):
        visit.page.get_by_role("button", name=say("teach.student.send")).click()
        visit.page.get_by_text(say("teach.student.waiting")).wait_for()
        visit.page.get_by_text(say(f"learn.options.{option}"), exact=True).click()
        visit.page.get_by_role("button", name=say("teach.student.send")).click()
        visit.page.get_by_text(say("teach.student.sent")).wait_for()
    page.get_by_text(say("teach.vote.count", votes=2, most=400)).wait_for()
    votes = page.evaluate("""() => [...Bokeh.documents[0]._all_models.values()]
        .find((m) => m.name == "votes").renderers[0].data_source.data.votes""")
    assert list(votes) == [1, 0, 1]
    assert axe(students[0].page) == {}
    page.get_by_role("button", name=say("teach.vote.answer")).click()
    page.get_by_text(say("teach.vote.said", answer=say("learn.options.over"))).wait_for()
    assert axe(page) == {}
    page.get_by_role("button", name=say("teach.vote.close")).click()
    page.get_by_text(say("teach.vote.shut")).wait_for()
    students[0].page.get_by_role("button", name=say("teach.student.send")).click()
    students[0].page.get_by_text(say("teach.student.gone")).wait_for()
    for visit in (teacher, *students):
        visit.page.close()
        assert not visit.errors


@pytest.mark.parametrize("section", ["lesson", "history"])
def test_on_a_phone(chromium, server, section):
    visit = opened(chromium, server, f"?tab=learn&learn={section}&step=turning", (390, 844))
    title = say("learn.turning.title") if section == "lesson" else say("history.page.title")
    visit.page.get_by_role("heading", name=title).wait_for()
    visit.page.wait_for_function("document.documentElement.scrollWidth <= innerWidth")
    assert axe(visit.page) == {}
    visit.page.close()
    assert not visit.errors


def test_the_links_of_the_teacher_set_up_their_motion():
    from app.keep import explorer_of, read
    from app.teach import link

    for step in lesson.STEPS:
        texts, wrong = read(link(step))
        explorer, sentence = explorer_of(texts)
        assert not wrong and not sentence and texts["step"] == step.name
        expected = Explorer()
        expected.param.update(**step.inputs(expected.scene.top))
        assert np.array_equal(explorer.scene.trajectory.theta, expected.scene.trajectory.theta)
