"""The page without a server, opened as a file, without a network."""

import re

import pytest
from lab_page import DRAWN, TIME, entry, pause, put
from playwright.sync_api import expect

from app.model import tell
from app.page.site import MOST, mailed, main
from app.text import speaking

SPINS = 20.0, 28.65
START = "v=4&spin={:g}&tilt=5.73&mu=0.3"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """With the tilt and the friction of the arrival, for which the strip of ends ships."""
    path = tmp_path_factory.mktemp("site") / "made"
    assert main([str(path), "--spins", *map(str, SPINS), "--tilts", "5.73", "--frictions", "0.3"]) == 0
    return path


@pytest.fixture
def page(chromium, folder):
    """It asks for nothing but its two files."""
    window = {"width": 1400, "height": 900}
    with chromium.new_context(viewport=window, reduced_motion="reduce", offline=True) as context:
        page, asked = context.new_page(), []
        page.on("request", lambda request: asked.append(request.url))
        page.goto((folder / "index.html").as_uri())
        page.wait_for_function(DRAWN)
        yield page
        assert asked == [(folder / name).as_uri() for name in ("index.html", "site.js")]


def headlines(spin, language, table="ordinary"):
    return [phase["headline"] for phase in tell(START.format(spin), language)["tables"][table]["phases"]]


def reads(page, told):
    """The page, at rest, says the headlines at the start and at the end."""
    pause(page)
    for key, said in (("Home", told[0]), ("End", told[-1])):
        page.locator("input.at").press(key)
        expect(page.locator(".say .big")).to_have_text(said)


@pytest.mark.served
def test_it_plays_and_says_what_the_explorer_says_of_that_start(page):
    page.get_by_role("button", name="Spin it").click()
    page.wait_for_function(f"{TIME} > 0")
    reads(page, headlines(28.65, "en"))
    page.locator("#lab-spin").press("Home")
    expect(entry(page, "Spin, in turns a second")).to_have_value("20.0")
    reads(page, headlines(20, "en"))
    page.get_by_role("radio", name="Rough").click()
    reads(page, headlines(20, "en", "rough"))
    page.get_by_role("button", name=re.compile("^Next")).click()
    expect(page.locator(".say .big")).to_have_text(tell(START.format(20))["wording"][0])
    assert page.locator(".caption").count() and not page.get_by_role("button", name=re.compile("^Next")).is_visible()


@pytest.mark.served
def test_what_is_not_stored_goes_to_the_nearest_and_what_it_has_not_is_not_offered(page):
    put(page, "Spin, in turns a second", 23)
    page.get_by_text("23 rev/s is not stored here; 20 rev/s is the nearest that is, and is shown.").wait_for()
    put(page, "Spin, in turns a second", "fast")
    page.get_by_text("fast is not a number.").wait_for()
    page.locator("#lab-spin").press("End")
    page.get_by_text("not stored").wait_for(state="detached")
    for name in ("Share", "Undo", "Build", "Research"):
        assert page.get_by_text(name, exact=True).locator("visible=true").count() == 0
    assert not page.locator("#lab-tilt").is_visible() and page.locator(".body:visible").count() == 0


@pytest.mark.served
def test_it_speaks_every_language_and_has_the_lesson(page):
    page.get_by_role("button", name="More").click()
    page.get_by_role("radio", name="Deutsch").click()
    page.wait_for_function("document.documentElement.lang == 'de'")
    page.locator("#lab-spin").press("Home")
    expect(entry(page, "Drehung")).to_have_value("20,0")
    page.locator("input.at").press("End")
    expect(page.locator(".say .big")).to_have_text(headlines(20, "de")[-1])
    page.get_by_role("tab", name="Lernen").click()
    page.get_by_role("button", name="Was bleibt").click()
    page.locator(".option").first.click()
    page.get_by_role("button", name="Ansehen, was er tut").click()
    page.locator("#LessonView input[type=range]").first.press("End")
    page.locator(".equation math").first.wait_for()
    with page.context.expect_page() as sheet:
        page.get_by_role("button", name="Arbeitsblatt").click()
    expect(sheet.value.locator("body")).to_contain_text("R = 15,0 mm, M = 6,0 g")  # the page's toy


@pytest.mark.served
def test_the_page_to_mail_is_the_run_that_was_shown(chromium, tmp_path):
    """Of a body of one's own, on another table than that of the arrival, in German."""
    language, table, file = "de", "rough", tmp_path / "mailed.html"
    query = "v=4&spin=20&law=coulomb&table=rough&body=BareSphere_.02_.02_.3_.3742857142857143_.4&lang=de"
    with speaking(language):
        file.write_bytes(mailed(f"http://localhost/app?{query}", {"playing": False, "time": 0.0}))
    with chromium.new_context(reduced_motion="reduce", offline=True) as context:
        page, asked = context.new_page(), []
        page.on("request", lambda request: asked.append(request.url))
        page.goto(file.as_uri())
        page.wait_for_function(DRAWN)
        phases = tell(query, language)["tables"][table]["phases"]
        for key, phase in (("Home", phases[0]), ("End", phases[-1])):
            page.locator("input.at").press(key)
            expect(page.locator(".say .big")).to_have_text(phase["headline"])
        assert page.get_by_role("link", name=query).is_visible() and asked == [file.as_uri()]
        assert page.locator(".say .link").locator("visible=true").count() == 0


def test_it_is_small_and_too_large_a_grid_is_refused(folder, tmp_path, monkeypatch, capsys):
    assert sum(path.stat().st_size for path in folder.iterdir()) < MOST / 3
    monkeypatch.setattr("app.page.site.MOST", 1e6)
    wanted = [str(tmp_path / "no"), "--spins", "20", "--tilts", "5.73", "--frictions", "0.3"]
    assert main(wanted) == 2
    assert re.match(
        r"The folder would have \d\.\d MB \(starts: 1\); allowed are 1 MB", capsys.readouterr().err.splitlines()[-1]
    )
    assert main([*wanted, "--spins", "2000"]) == 2 and "2,000" in capsys.readouterr().err.replace("2000", "2,000")
    assert not (tmp_path / "no").exists()
