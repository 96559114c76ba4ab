"""The suite itself: the order of its files, what it says when it has waited, and errors of pages."""

import re
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import durations
import pytest
from patience import poll


def names(tests):
    return [SimpleNamespace(path=Path(file), name=name) for file, name in tests]


@pytest.mark.parametrize("shortest, files", [(False, "new long short"), (True, "short long new")])
def test_files_run_longest_first_and_keep_the_order_of_their_tests(monkeypatch, shortest, files):
    monkeypatch.setattr(durations, "stored", lambda: {"long": {"seconds": 9.0}, "short": {"seconds": 0.1}})
    plugin = durations.Durations(SimpleNamespace(getoption={"--shortest-first": shortest}.get))
    items = names([("short", "b"), ("short", "a"), ("long", "d"), ("long", "c"), ("new", "f"), ("new", "e")])
    plugin.pytest_collection_modifyitems(items)
    assert list(dict.fromkeys(item.path.name for item in items)) == files.split()
    assert [item.name for item in items if item.path.name == "long"] == ["d", "c"]


def test_times_of_other_files_are_kept_while_these_exist():
    old = {"test_gone.py": {"seconds": 7.0, "slow": {}}, "test_axe.py": {"seconds": 5.0, "slow": {"all": 5.0}}}
    timed = Counter({("test_suite.py", "fast"): 0.01, ("test_suite.py", "slow"): 6.0})
    new = durations.updated(old, timed)
    assert list(new.items()) == [
        ("test_suite.py", {"seconds": 6.0, "slow": {"slow": 6.0}}), ("test_axe.py", old["test_axe.py"])]  # fmt: skip


def test_who_waited_says_for_what_and_what_was_there():
    with pytest.raises(AssertionError, match=r"waited 0 s for .*found == 3.*, which is still False"):
        found = 2
        poll(lambda: found == 3, lambda: None, 0)


@pytest.mark.served
def test_an_error_of_a_page_fails_its_test_and_no_other(chromium, page_errors):
    page = chromium.new_page()
    page.set_content("<script>console.error('said'); setTimeout(() => { throw new Error('thrown') })</script>")
    page.evaluate("() => new Promise((done) => setTimeout(done))")
    page.evaluate("() => fetch('http://127.0.0.1:9').catch(() => {})")
    page.evaluate("() => fetch('http://elsewhere.invalid').catch(() => {})")
    found = "\n".join(text for _, text in page_errors.end())
    assert "said" in found and "thrown" in found and "127.0.0.1:9" in found
    assert re.findall("another machine was asked: (.*)", found) == ["http://elsewhere.invalid/"]
    assert page_errors.end() == []
    page_errors.allow("expected")
    page.evaluate("() => console.error('this was expected')")
    assert page_errors.end() == []
    page.close()


@pytest.mark.served
def test_a_context_that_is_used_again_has_nothing_of_before(chromium):
    """And a page in it nothing of another page."""
    keeps = """() => { localStorage.kept ??= "no"; const was = [localStorage.kept, document.cookie, window.name]
        localStorage.kept = document.cookie = window.name = "kept"; return was }"""
    for _ in range(2):
        page = chromium.new_page(locale="fr")
        page.route("http://kept.test/**", lambda route: route.fulfill(body="<p>here", content_type="text/html"))
        page.goto("http://kept.test/")
        assert page.evaluate(keeps) == ["no", "", ""] and page.evaluate(keeps) == ["kept", "kept", "kept"]
        context = page.context
        page.close()
    assert context in chromium.contexts and len(context.pages) == 1


@pytest.mark.served
def test_a_failure_leaves_picture_source_and_console_of_every_page(chromium, page_errors, tmp_path, monkeypatch):
    monkeypatch.setattr("watching.FAILURES", tmp_path)
    page = chromium.new_page()
    page.set_content("<p>what was seen<script>console.log('what was said')</script>")
    folder = page_errors.store("tests/test_x.py::test_y[a b]")
    number = [each for context in chromium.contexts for each in context.pages].index(page)  # others may be open
    assert folder.parent == tmp_path and (folder / f"page{number}.png").stat().st_size > 100
    assert "what was seen" in (folder / f"page{number}.html").read_text(encoding="utf-8")
    assert "what was said" in (folder / "console.txt").read_text(encoding="utf-8")
    page.close()
