"""The accessibility statement, and the keys of the page beside those that screen readers keep for themselves."""

import re
import textwrap
from pathlib import Path

import pytest

from app.server.settings import Settings
from app.text import LANGUAGES, listed
from app.widgets import guide

PAGE = Path(__file__).parent.parent / "docs" / "accessibility.md"
NVDA = "hlitknfuvebxcrqsmgdo123456789apw,"
"""What NVDA 2026 takes for itself in browse mode, alone or with Shift: its User Guide, "Single Letter Navigation"."""


def markdown():
    """docs/accessibility.md, made of the words in the menu."""
    (title, about), *parts = guide.statement("en")
    heads = [f"# {title}", *about]
    heads += [each for heading, said in parts for each in (f"## {heading}", *said)]
    return "\n\n".join("\n".join(textwrap.wrap(each, 128, break_on_hyphens=False)) for each in heads) + "\n"


def test_the_page_of_docs_says_what_the_menu_says():
    assert PAGE.read_text(encoding="utf-8") == markdown(), "python tests/test_accessibility.py writes it"


def test_who_runs_the_page_is_named(monkeypatch):
    set_to = Settings.of({"TIPPE_RESPONSIBLE": "A <b>School</b>, a@b.org"}).responsible
    monkeypatch.setitem(guide.RESPONSIBLE, "who", set_to)
    said = guide.statement("de")[-1][1][0]
    assert "A &lt;b&gt;School&lt;/b&gt;, a@b.org" in said and "TIPPE_RESPONSIBLE" not in said


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_key_of_the_page_is_one_of_a_screen_reader(language):
    """Letters only with Alt or Ctrl, which NVDA's own keys have not; and never Control with Option, VoiceOver's, or
    with an arrow, also with Shift: macOS's Mission Control."""
    for keys, _ in listed("browser.Guide.list", language):
        for key in keys.lower().split(", "):
            name, *held = reversed(re.split(" [ie]n ", key)[0].split("+"))
            assert len(name) > 1 or held, key
            assert not (name in [*NVDA] and {*held} <= {"shift", "umschalt", "mayús"}), key
            assert not ({"ctrl", "strg"} & {*held} and "alt" in held), key
            assert not (({"ctrl", "strg"} & {*keys.lower().replace(" ", "+").split("+")}) and "→" in keys), key


if __name__ == "__main__":
    PAGE.write_text(markdown(), encoding="utf-8")
