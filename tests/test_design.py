"""The style sheets that the page's design gives to its components equal those of Panel Material UI, computed once."""

import panel as pn
import panel_material_ui as pmui
import pytest
from bokeh.document import Document
from panel_material_ui import MaterialDesign

from app.page.design import Design

KINDS = pmui.Button, pmui.Select, pmui.TextInput, pn.Column, pn.pane.HTML


def plain(given):
    """The given values, with the addresses of style sheets, which are created anew outside a document."""
    return [{name: [getattr(each, "url", each) for each in value] if name == "stylesheets" else value
             for name, value in part.items()} for part in given]  # fmt: skip


@pytest.mark.parametrize("theme", ["default", "dark"])
@pytest.mark.parametrize("kind", KINDS)
def test_it_gives_what_material_gives_before_and_after_it_is_known(kind, theme):
    document, ours, theirs = Document(), Design(theme=theme), MaterialDesign(theme=theme)
    for _ in range(2):
        assert plain(ours.params(kind(), document)) == plain(theirs.params(kind(), document))
    assert plain(ours.params(kind())) == plain(theirs.params(kind()))  # in no document


def test_it_is_worked_out_once_for_a_document_and_kind_and_nobody_changes_what_others_are_given(monkeypatch):
    asked, theirs = [], MaterialDesign.params
    monkeypatch.setattr(MaterialDesign, "params", lambda *given: asked.append(given[1:]) or theirs(*given))
    design, documents = Design(), [Document(), Document()]
    for document in documents:
        for kind in (pmui.Button, pmui.Select):
            first, *_ = design.params(kind(), document)
            first["changed"] = True
            assert all("changed" not in each for each in design.params(kind(), document))
    assert [(type(view), of) for view, of in asked] == [
        (kind, of) for of in documents for kind in (pmui.Button, pmui.Select)
    ]
