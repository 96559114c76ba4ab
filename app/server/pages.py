"""The page: generated once."""

import re
import secrets

from bokeh.util.token import generate_jwt_token, generate_session_id
from panel.io.resources import Resources
from panel.io.server import server_html_page_for_session

from app import text
from app.server.answers import Handler, Root
from app.widgets.waiting import waiting

UNUSED = ("bokeh-gl", "bokeh-mathjax")
"""Parts of Bokeh's scripts of which nothing is used; its tables Panel's own script asks for."""


class Sheet:
    """The HTML of the page, generated once in each language; what differs between visitors is inserted."""

    TOKEN, NONCE = secrets.token_hex(), secrets.token_hex()  # placeholders for those of a visitor

    def __init__(self, session, resources):
        document, needed = session.document, Resources.from_bokeh(resources)
        needed.components = [name for name in needed.components if name not in UNUSED]
        html = server_html_page_for_session(
            session, needed, document.title, token=self.TOKEN, template=document.template,
            template_variables=document.template_variables)  # fmt: skip
        before, after = html.split(waiting(text.DEFAULT))  # the language of the template
        self._pages = {}
        for language in text.LANGUAGES:
            html = f"{before}{waiting(language)}{after}"
            self._pages[language] = re.sub(r"<script(?=[\s>])", f'<script nonce="{self.NONCE}"', html)

    def page(self, language, token, nonce):
        """The HTML for one visitor."""
        return self._pages[language].replace(self.NONCE, nonce).replace(self.TOKEN, token)


class Page(Handler):
    """The page, from one template session; a visitor's own session is created when the browser opens the socket."""

    def get(self):
        if self.request.path.endswith("/"):  # the page's own addresses are relative to one without
            Root.get(self)
            return
        app, address = self.application, self.request.remote_ip
        if not app.tippe.lets(self.request.host):
            self.refuse("stranger", "refused a page at %.100r: TIPPE_ORIGINS", self.request.host)
            self.say(403, self.words("stranger"))
        elif refusal := app.admission.refusal(address):
            sentence = text.say(f"main.server.{refusal}", text.DEFAULT)
            self.refuse(refusal, "refused %s a page: %s", address, sentence)
            self.say(503, f"{self.words(refusal)} {self.words('again')}", again=10)
        else:
            nonce = secrets.token_urlsafe(16)
            self.set_header("Content-Type", "text/html; charset=utf-8")
            self.set_policy(nonce)
            self.finish(app.sheet.page(self.language, self._token(), nonce))

    def _token(self):
        """The token that opens a session, with the data from which its page is made."""
        app, request = self.application, self.request
        headers = {name: value for name, value in request.headers.items() if name in app.include_headers}
        return generate_jwt_token(
            generate_session_id(secret_key=app.secret_key, signed=True),
            secret_key=app.secret_key, signed=True, expiration=app.session_token_expiration,
            extra_payload={"headers": headers, "cookies": {}, "arguments": request.arguments})  # fmt: skip

    def compute_etag(self):
        """None, because no two pages are the same."""
