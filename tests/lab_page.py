"""The Lab in Chromium: what its browser tests read of it and do to it."""

from visiting import Visit

from app.model.lab.run import TOYS

TOPS = "__tippe.tops('lab')"
TIME = "Number(window.__tippe.time('lab'))"
DRAWN = "window.__tippe?.tops?.('lab').some((top) => top.pictures && top.count)"
UNIT = TOYS["Leine and Glocker's toy"].shape.scales.time  # s


def come(page, url):
    """A page at this address, once its top is drawn."""
    visit = Visit(page, url, whole=False)
    page.wait_for_function(DRAWN)
    return visit


def one_visit(server, chromium):
    """The page as it comes, the same for all tests here, in this order; they fail on an error in it."""
    visit = come(chromium.new_page(viewport={"width": 1400, "height": 900}), f"{server}?")
    yield visit
    visit.page.close()
    assert not visit.errors


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
    """The points of the tilt over time."""
    return page.locator(".strip .rest").first.get_attribute("points")
