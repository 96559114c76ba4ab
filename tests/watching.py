"""What the pages of a test do that it does not ask for: errors, and how they look when it fails."""

import re
import shutil
from collections import deque
from pathlib import Path

from playwright.sync_api import expect
from visiting import PATIENCE

expect.set_options(timeout=PATIENCE)

FAILURES = Path(__file__).parent / "failures"  # ignored by git
# no other machine
OWN = r"(data|blob|file|about|chrome-error):|\w+://([\w-]+\.test|(component\.)?localhost|127\.0\.0\.1)(:\d+)?/"
BLANK = "about:blank"  # of a page that only keeps its context
ABORTED = "net::ERR_ABORTED"  # a page that is left stops its requests
LOST = r"(?i)websocket|not connected|net::ERR_|Failed to load resource"  # what a page says whose server does not answer


class Watch:
    """Listens to all pages of a browser. errors: [(address, text)] of the present test; allowed: patterns of those that
    it expects."""

    def __init__(self, browser):
        self.browser, self.errors, self.allowed, self.console = browser, [], [], deque(maxlen=500)
        browser.on("context", self._context)

    def _context(self, context):
        context.set_default_timeout(PATIENCE)
        context.on("console", self._said)
        context.on("weberror", lambda error: self._failed(error.page, str(error.error)))
        context.on("requestfailed", self._missed)
        context.on("request", self._asked)
        context.on("page", lambda page: page.on("load", lambda: self.console.append(f"loaded: {page.url}")))

    def _said(self, message):
        self.console.append(f"{message.type}: {message.text}")
        if message.type == "error":
            self._failed(message.page, message.text)

    def _asked(self, request):
        if not re.match(OWN, request.url):
            self.errors.append(("", f"another machine was asked: {request.url}"))

    def _missed(self, request):
        self.console.append(f"request failed: {request.url}: {request.failure}")
        if request.failure != ABORTED:
            self.errors.append(("", f"{request.url}: {request.failure}"))

    def _failed(self, page, text):
        self.errors.append((page.url if page else "", text))

    def allow(self, pattern):
        """Errors with this pattern do not fail the present test."""
        self.allowed.append(pattern)

    def end(self):
        """Ends a test: returns the errors that it did not expect, and forgets them."""
        for context in self.browser.contexts:
            context.cookies()  # an answer comes after all events before it
        found = [error for error in self.errors if not any(re.search(each, error[1]) for each in self.allowed)]
        self.errors.clear()
        self.allowed.clear()
        return found

    def store(self, test):
        """Stores picture, source and console of every open page in a folder of this test. Returns the folder."""
        folder = FAILURES / re.sub(r"[^\w.-]+", "_", test)[-150:]
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        pages = [page for context in self.browser.contexts for page in context.pages if page.url != BLANK]
        lines = [*self.console, "", *(f"error at {url}: {text}" for url, text in self.errors)]
        for i, page in enumerate(pages):
            lines.append(f"page {i}: {page.url}")
            try:
                page.screenshot(path=folder / f"page{i}.png", timeout=10_000)
                source = page.wait_for_function("document.documentElement.outerHTML", timeout=10_000)
                (folder / f"page{i}.html").write_text(source.json_value(), encoding="utf-8")
            except Exception as error:  # a page that hangs has no picture, but the others have
                lines.append(f"page {i} gave no picture: {error}")
        (folder / "console.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")
        return folder
