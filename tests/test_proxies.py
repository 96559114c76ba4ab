"""deploy/nginx.conf and deploy/apache.conf unchanged, with https, a prefix and a login that expires."""

import os
import re
import shutil
import subprocess
import threading
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import ClassVar

import pytest
from openid import SECRET, provider
from serving import end, listens, served, until
from test_faults import has_come_back, set_spin
from visiting import Visit, free_port
from watching import LOST

pytestmark = [pytest.mark.served, pytest.mark.long]
DEPLOY = Path(__file__).parent.parent / "deploy"

NGINX = """
daemon off; pid {folder}/pid; error_log {folder}/error; worker_processes 1;
events {{ worker_connections 512; }}
http {{
    include /etc/nginx/mime.types;
    access_log {folder}/access;
    client_body_temp_path {folder}; proxy_temp_path {folder}; fastcgi_temp_path {folder}; uwsgi_temp_path {folder};
    scgi_temp_path {folder};
    {site}
}}
"""
APACHE = """
ServerRoot {folder}
PidFile {folder}/pid
ErrorLog {folder}/error
Listen 127.0.0.1:{port}
ServerName localhost
{modules}
{site}
"""
SIGNED_IN = 20  # s that a login of Apache's is valid
MODULES = ("mpm_event authz_core authz_host ssl proxy proxy_http proxy_wstunnel headers filter deflate alias "
           "socache_shmcb authn_core authz_user auth_openidc").split()  # fmt: skip


def program(name):
    """The path of a program, which may not be in a user's PATH."""
    found = shutil.which(name, path=f"{os.environ['PATH']}:/usr/sbin")
    if found is None:
        pytest.skip(f"{name} is not installed")
    return found


@contextmanager
def proxied(name, folder, behind, login=None):
    """Runs the proxy with the file of deploy/, in front of a server and a login at these ports; gives the page's
    address."""
    at, port = program(name), free_port()
    certificate = ["-newkey", "rsa:2048", "-nodes", "-subj", "/CN=localhost", "-days", "2"]
    files = ["-keyout", folder / "key.pem", "-out", folder / "cert.pem"]
    subprocess.run(["openssl", "req", "-x509", *certificate, *files], check=True, capture_output=True)
    file = "nginx.conf" if name == "nginx" else "apache.conf"
    site = (DEPLOY / file).read_text(encoding="utf-8")
    places = {"/etc/letsencrypt/live/top.example.org/fullchain.pem": f"{folder}/cert.pem", ":5006": f":{behind}",
              "/etc/letsencrypt/live/top.example.org/privkey.pem": f"{folder}/key.pem", "top.example.org": "localhost",
              "listen 443": f"listen 127.0.0.1:{port}", "*:443": f"127.0.0.1:{port}", "4180": str(login),
              "https://localhost/": f"https://localhost:{port}/", "https://login.example.org": f"http://localhost:{login}",
              "/etc/apache2/tippe-secrets.conf": f"{folder}/secrets", "43200": str(SIGNED_IN)}  # fmt: skip
    for there, here in places.items():
        site = site.replace(there, here)
    (folder / "secrets").write_text(f"OIDCClientSecret {SECRET}\nOIDCCryptoPassphrase of-a-test\n")
    if login is not None:
        site = re.sub(r"# LOGIN: ", "", site)
    config = folder / file
    if name == "nginx":
        config.write_text(NGINX.format(folder=folder, site=site))
        command = [at, "-c", config, "-p", folder]
    else:
        there = Path("/usr/lib/apache2/modules")
        modules = "\n".join(f"LoadModule {each}_module {there}/mod_{each}.so" for each in MODULES
                            if (there / f"mod_{each}.so").exists())  # fmt: skip
        config.write_text(APACHE.format(folder=folder, port=port, modules=modules, site=site))
        command = [at, "-f", config, "-D", "FOREGROUND"]
    with (folder / "said").open("w") as said:
        process = subprocess.Popen(command, stdout=said, stderr=said)
    try:
        until(lambda: process.poll() is not None or listens(port))
        assert process.poll() is None, (folder / "said").read_text()
        yield f"https://localhost:{port}"
    finally:
        end(process)


@pytest.fixture
def page(chromium, page_errors):
    page_errors.allow(LOST)
    context = chromium.new_context(viewport={"width": 1400, "height": 900}, ignore_https_errors=True)
    yield context.new_page()
    context.close()


@pytest.mark.parametrize("name", ["nginx", "apache2"])
def test_a_page_comes_by_https_under_a_prefix_and_its_socket_too(name, page, tmp_path):
    with served(tmp_path / "log", prefix="/tops", proxy=1, origins="localhost:*") as server:
        with proxied(name, tmp_path, server.url.rsplit(":", 1)[1].removesuffix("/tops/app")) as root:
            visit = Visit(page, f"{root}/tops/app?tab=lab", whole=False, listens=True)
            set_spin(page, "29.5")
            assert visit.sent and not visit.errors
            assert all(each.startswith((root, "blob:", "data:")) for each in visit.requests)
            asked = page.context.request
            long = f"{root}/tops/app?x=" + "x" * 12_000
            assert asked.get(long).status == asked.get(f"{root}/tops/readyz").status == 200
            assert asked.get(f"{root}/").url == f"{root}/tops/app"
            assert asked.get(f"{root}/metrics").status in (403, 404)
            script = asked.get(f"{root}/tops/static/js/bokeh.min.js", headers={"Accept-Encoding": "gzip"})
            assert script.headers["content-encoding"] == "gzip"
        assert "Traceback" not in server.log and "(127.0.0.1)" not in server.log.partition("GET /tops/app?")[2]


class Login(BaseHTTPRequestHandler):
    """Answers nginx and a browser like oauth2-proxy: a browser with its cookie is let in as long as the cookie is
    valid."""

    good: ClassVar = set()

    def do_GET(self):
        path, _, query = self.path.partition("?")
        if path == "/oauth2/auth":
            self.answer(202 if self.headers.get("Cookie", "") in self.good else 401)
        elif path == "/oauth2/start":
            self.good.add(f"login={len(self.good)}")
            back = bytes.fromhex(query).decode()
            self.answer(302, **{"Set-Cookie": f"login={len(self.good) - 1}; Path=/", "Location": back})
        else:
            back = self.headers["X-Auth-Request-Redirect"].encode().hex()
            self.answer(403, f'<a href="/oauth2/start?{back}">Sign in</a>')

    def answer(self, status, text="", **headers):
        self.send_response(status)
        for name, value in {"Content-Type": "text/html", **headers}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(text.encode())

    def log_message(self, *_):
        pass


def signs_in(page, root):
    """Opens the page through the login, and sets the spin."""
    page.goto(f"{root}/tops/app")
    page.get_by_text("Sign in").click()
    set_spin(page, "29.5")


def loses(page, server):
    """The server goes, and the page is loaded again."""
    page.evaluate("window.mark = 1")
    server.process.kill()
    page.get_by_text("Sign in").wait_for()  # the login answers, so the page loads


def test_a_login_that_ran_out_is_asked_for_again_and_leads_back_to_what_was_set(page, tmp_path):
    """oauth2-proxy itself is not available: Login stands in for it."""
    login = ThreadingHTTPServer(("127.0.0.1", 0), Login)
    threading.Thread(target=login.serve_forever, daemon=True).start()
    port = free_port()
    settings = {"prefix": "/tops", "proxy": 1, "origins": "localhost:*", "port": port}
    try:
        with proxied("nginx", tmp_path, port, login.server_port) as root:
            with served(tmp_path / "log", **settings) as server:
                signs_in(page, root)
                Login.good.clear()
                loses(page, server)
            with served(tmp_path / "again", **settings):
                page.get_by_text("Sign in").click()
                has_come_back(page, "29.5")
    finally:
        login.shutdown()


def test_a_login_of_apache_that_ran_out_is_asked_for_again_and_leads_back_to_what_was_set(page, tmp_path):
    """Apache's own client of OpenID Connect, mod_auth_openidc, with a provider of our own."""
    if not Path("/usr/lib/apache2/modules/mod_auth_openidc.so").exists():
        pytest.skip("mod_auth_openidc is not installed")
    port = free_port()
    settings = {"prefix": "/tops", "proxy": 1, "origins": "localhost:*", "port": port}
    with provider() as login, proxied("apache2", tmp_path, port, login) as root:
        asked = page.context.request
        with served(tmp_path / "log", **settings) as server:
            assert asked.get(f"{root}/tops/readyz", headers={"Sec-Fetch-Mode": "cors"}).status == 401
            signs_in(page, root)
            until(lambda: asked.get(f"{root}/tops/readyz", headers={"Sec-Fetch-Mode": "cors"}).status == 401, 60)
            set_spin(page, "30.5")  # an open page stays open
            loses(page, server)
        with served(tmp_path / "again", **settings):
            page.get_by_text("Sign in").click()
            has_come_back(page, "30.5")
