"""A provider of OpenID Connect for tests: one user, who signs in by a click."""

import base64
import hashlib
import hmac
import json
import threading
import time
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import parse_qs, urlencode, urlsplit

CLIENT, SECRET = "tippe", "of-a-test-and-at-least-32-bytes-long"


def coded(data):
    """As in a JSON web token."""
    return base64.urlsafe_b64encode(data).rstrip(b"=").decode()


def token(claims):
    """A JSON web token, signed with the secret of the client (RFC 7515, HS256)."""
    parts = ".".join(coded(json.dumps(each).encode()) for each in ({"alg": "HS256", "typ": "JWT"}, claims))
    return f"{parts}.{coded(hmac.digest(SECRET.encode(), parts.encode(), hashlib.sha256))}"


class Provider(BaseHTTPRequestHandler):
    def do_GET(self):
        root = f"http://localhost:{self.server.server_port}"
        path, query = urlsplit(self.path).path, parse_qs(urlsplit(self.path).query)
        if path == "/.well-known/openid-configuration":
            self.answer(200, "application/json", json.dumps({
                "issuer": root, "authorization_endpoint": f"{root}/authorize", "token_endpoint": f"{root}/token",
                "jwks_uri": f"{root}/keys", "response_types_supported": ["code"], "subject_types_supported": ["public"],
                "id_token_signing_alg_values_supported": ["HS256"],
                "token_endpoint_auth_methods_supported": ["client_secret_basic"],
            }))  # fmt: skip
        elif path == "/keys":
            self.answer(200, "application/json", '{"keys": []}')
        elif path == "/authorize":
            # the code is the nonce, so that nothing has to be stored
            back = urlencode({"code": query["nonce"][0], "state": query["state"][0]})
            href = f"{query['redirect_uri'][0]}?{back}".replace("&", "&amp;")
            self.answer(200, "text/html", f'<a href="{href}">Sign in</a>')
        else:
            self.answer(404, "text/plain", "")

    def do_POST(self):
        asked = parse_qs(self.rfile.read(int(self.headers["Content-Length"])).decode())
        now = int(time.time())
        claims = {"iss": f"http://localhost:{self.server.server_port}", "sub": "student", "aud": CLIENT,
                  "iat": now, "exp": now + 300, "nonce": asked["code"][0]}  # fmt: skip
        said = {"access_token": "unused", "token_type": "Bearer", "id_token": token(claims)}
        self.answer(200, "application/json", json.dumps(said))

    def answer(self, status, kind, text):
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.end_headers()
        self.wfile.write(text.encode())

    def log_message(self, *_):
        pass


@contextmanager
def provider():
    """Runs the provider until the end of the block, and gives its port."""
    server = ThreadingHTTPServer(("127.0.0.1", 0), Provider)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield server.server_port
    finally:
        server.shutdown()
        server.server_close()
