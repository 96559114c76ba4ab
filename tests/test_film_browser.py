"""A film that Share saves: each picture is of its own time, as read by the browser's own player and by Pillow."""

import base64
import io

import numpy as np
import pytest
from components import TRUSTED
from components import alone as alone
from components import lab as lab
from PIL import Image
from visiting import wait

from app.share.parts import Film

pytestmark = pytest.mark.served

PACE = 8.0  # times real time
FAINT, DARK = 25, 235  # the least blue that counts and the lightest line, of 255
PARTS = 10  # pictures that are looked at

# What the browser's own player shows of a film at these times, as PNGs in base64, and how long the film is.
PLAYED = """
async ([url, times]) => {
  const video = document.createElement("video"), canvas = document.createElement("canvas"), pictures = []
  const heard = (name) => new Promise((done) => video.addEventListener(name, done, { once: true }))
  video.muted = true
  video.src = URL.createObjectURL(await (await fetch(url)).blob()) // in which it can seek
  await heard("loadeddata")
  Object.assign(canvas, { width: video.videoWidth, height: video.videoHeight })
  for (const time of times) {
    // the player may have another picture for a moment, also after "seeked", or not say that it has the right one
    let isThere = false
    const there = new Promise((done) => {
      const is = (mediaTime) => Math.abs(mediaTime - time) < 1 / 30
      const look = (_, { mediaTime }) => is(mediaTime) ? done() : video.requestVideoFrameCallback(look)
      video.requestVideoFrameCallback(look)
    }).then(() => (isThere = true))
    for (let off = 0; !isThere; off = 1e-3 - off) {
      const seeked = heard("seeked")
      video.currentTime = time + off
      await seeked
      await Promise.race([there, new Promise((done) => setTimeout(done, 500))])
    }
    canvas.getContext("2d").drawImage(video, 0, 0)
    pictures.push(canvas.toDataURL().split(",")[1])
  }
  return [video.duration, pictures]
}
"""
# In place of what writes files: notes what is drawn when a picture is added, and takes it when `taken` says so.
NOTES = """
window.noted = []
export const writerOf = async (kind, codec, canvas) => ({
  add: async () => {
    noted.push(window.__tippe.tops("film").map(({ t, quaternion }) => [t, ...quaternion])[0])
    await window.taken
  },
  end: async () => new Blob([String(kind)]), stop: () => (window.isStopped = true),
})
"""


@pytest.fixture
def filmed(lab):
    """filmed(**like) gives the Alone of a Lab at PACE, with the film of Share below it. The top itself is drawn if that
    says so; the line below it, which has the time, always."""

    def open_(**like):
        found = lab(**like)
        found.put(found._shown[0], speed=PACE)
        found.show(Film())
        found.page.get_by_role("button", name="GIF").wait_for()
        return found

    return open_


def saved(page, kind):
    with page.expect_download() as download:
        page.get_by_role("button", name=kind, exact=True).click()
    assert download.value.suggested_filename == f"tippe-top-ordinary.{kind.lower()}"
    return download.value.path().read_bytes()


def times_in(pictures, span):
    """The times that the line below the stage says: where its blue mark is between the ends of the axis of time."""
    rows = [np.asarray(each.convert("RGB").resize((1280, 720)), float)[:, 136:1140] for each in pictures]
    low = rows[PARTS // 2][555:592].mean(axis=2)  # its mark is at neither end
    axis = low[(low < DARK).sum(axis=1).argmax()]  # dark from one end to the other
    ends = np.flatnonzero(axis < DARK)[[0, -1]]
    for each in rows:
        red, green, blue = np.moveaxis(each[490:555], 2, 0)
        blueness = np.clip(blue - (red + green) / 2 - FAINT, 0, None).sum(axis=0)
        at = np.average(np.arange(len(blueness)), weights=np.where(blueness > blueness.max() / 4, blueness, 0))
        yield span * (at - ends[0]) / np.ptp(ends)


def end_of(found):
    return float(found.page.locator(".strip input[type=range]").get_attribute("max"))


@pytest.mark.parametrize("kind", ["WebM", "MP4"])
def test_a_film_has_its_length_and_each_of_its_pictures_is_of_its_time(filmed, kind):
    found = filmed(here=TRUSTED)
    button, end = found.page.get_by_role("button", name=kind, exact=True), end_of(found)
    wait(found.page, lambda: button.is_visible() or kind == "MP4")
    if not button.is_visible():
        pytest.skip("this browser writes no MP4")
    film = saved(found.page, kind)
    count = int(np.ceil(30 * end / PACE)) + 1
    shown = np.linspace(0, count - 1, PARTS).astype(int)
    found.page.route("**/film", lambda route: route.fulfill(body=film, content_type=f"video/{kind.lower()}"))
    length, pictures = found.page.evaluate(PLAYED, ["/film", ((shown + 0.5) / 30).tolist()])
    assert length == pytest.approx(count / 30, abs=1 / 60)
    opened = [Image.open(io.BytesIO(base64.b64decode(each))) for each in pictures]
    assert {each.size for each in opened} == {(1280, 720)}
    assert np.array([*times_in(opened, end)]) == pytest.approx(np.minimum(PACE * shown / 30, end), abs=PACE / 30 / 3)


def test_without_an_encoder_the_page_says_so_and_writes_a_gif(filmed):
    found = filmed(draws=True)
    page, end = found.page, end_of(found)
    page.get_by_text("This browser cannot write a video here").wait_for()
    assert not page.get_by_role("button", name="WebM").is_visible()
    film = Image.open(io.BytesIO(saved(page, "GIF")))
    count = int(np.ceil(20 * end / PACE)) + 1
    assert (film.n_frames, film.size) == (count, (640, 360))
    red, _, blue = np.moveaxis(np.asarray(film.convert("RGB"), int), 2, 0)
    assert (red - blue > 40).sum() > 5000  # px of wood: without the top there are 160
    shown, opened = np.linspace(0, count - 1, PARTS).astype(int), []
    for each in shown:
        film.seek(each)
        assert film.info["duration"] == 50
        opened.append(film.copy())
    assert np.array([*times_in(opened, end)]) == pytest.approx(np.minimum(PACE * shown / 20, end), abs=PACE / 20 / 3)


def test_the_top_is_drawn_as_it_was_computed_for_each_time_and_a_stopped_film_is_not_saved(filmed):
    found = filmed(here=TRUSTED)
    page, frames = found.page, np.frombuffer(found._shown[0].frames_ordinary, "<f4").reshape(-1, 21)
    page.route("**/encoders.js", lambda route: route.fulfill(body=NOTES, content_type="text/javascript"))
    to = page.get_by_label("Of the run, to", exact=True).locator("visible=true").last
    to.fill("2")
    to.press("Enter")
    saved(page, "WebM")
    noted = np.array(page.evaluate("noted"))
    assert noted[:, 0] * found._shown[0].seconds == pytest.approx([*np.arange(8) * PACE / 30, 2], abs=1e-6)
    for t, *pose in noted:
        low = max(np.searchsorted(frames[:, 0], t) - 1, 0)
        (t0, before), (t1, after) = ((row[0], row[1:5] * np.sign(row[1:5] @ pose)) for row in frames[low : low + 2])
        between = before + (after - before) * (t - t0) / (t1 - t0)
        assert between / np.linalg.norm(between) == pytest.approx(np.array(pose), abs=0.01)
    assert len({tuple(pose) for pose in noted[:, 1:].round(3)}) == len(noted)
    assert page.locator("[inert]").count() == 0

    downloads = []
    page.on("download", lambda download: downloads.append(download))
    page.evaluate("() => { window.taken = new Promise((go) => { window.go = go }) }")
    page.get_by_role("button", name="WebM", exact=True).click()
    page.get_by_role("button", name="Stop", exact=True).click()
    page.evaluate("go()")
    page.get_by_text("Stopped; nothing is saved.").wait_for()
    assert page.evaluate("isStopped") and not downloads and page.locator("[inert]").count() == 0
