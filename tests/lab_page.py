"""The Lab in Chromium: what its browser tests read and do."""

from contextlib import contextmanager

from visiting import Visit

from app.model.setup import TOYS

TOPS = "(window.__tippe?.tops('lab') ?? [])"
TIME = "Number(window.__tippe.time('lab'))"
DRAWN = "window.__tippe?.tops?.('lab').some((top) => top.pictures && top.count)"
UNIT = TOYS["Leine and Glocker's toy"].shape.scales.time  # s


def come(page, url):
    """Opens a page at this address, and waits until its top is drawn."""
    visit = Visit(page, url, whole=False)
    page.wait_for_function(DRAWN)
    return visit


@contextmanager
def arrival(server, chromium, **like):
    """The page on arrival, with its session and its whole run, in a browser context like this one. Nothing moves by
    itself unless the context wants motion."""
    like = {"viewport": {"width": 1400, "height": 900}, "reduced_motion": "reduce"} | like
    with chromium.new_context(**like) as context:
        page = come(context.new_page(), f"{server}?").page
        page.locator("#first").wait_for(state="detached")
        page.locator(".lab[data-whole]").wait_for()
        yield page


def pause(page):
    if page.get_by_role("button", name="Pause").count():
        page.get_by_role("button", name="Pause").click()
    page.get_by_role("button", name="Play", exact=True).wait_for()


def entry(page, name):
    return page.get_by_role("textbox", name=name)


def put(page, name, value):
    entry(page, name).fill(str(value))
    entry(page, name).press("Enter")


def line(page):
    """The points of the curve of the tilt."""
    return page.locator(".strip .rest").first.get_attribute("points")
