"""What an operator can set, and the files and docs that contain settings."""

import os
import re
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import pytest
import yaml

from app.server.settings import Settings

pytestmark = pytest.mark.served

ROOT = Path(__file__).parent.parent


@pytest.mark.parametrize("name, value, says", [
    ("PORT", "x", "whole number from 1 to 65535"), ("PORT", "65536", "65535"), ("WORKERS", "0", "from 1 to 64"),
    ("ORIGINS", "a b", "host:port"), ("PREFIX", "/a?b", "a path"), ("LOG", "loud", "debug, info"),
    ("FRAMES", "*; script-src *", "sources"), ("PROT", "5006", "no setting"),
])  # fmt: skip
def test_a_setting_that_cannot_be_is_named(name, value, says):
    with pytest.raises(ValueError, match=f"TIPPE_{name}") as error:
        Settings.of({f"TIPPE_{name}": value})
    assert says in str(error.value) or name == "PROT"


def started(*arguments, **settings):
    """Runs a `python -m app` that ends by itself."""
    environment = {**os.environ, **{f"TIPPE_{name.upper()}": value for name, value in settings.items()}}
    return subprocess.run([sys.executable, "-m", "app", *arguments], cwd=ROOT, capture_output=True, text=True,
                          timeout=120, env=environment)  # fmt: skip


@pytest.mark.parametrize("arguments, settings, says", [
    ((), {"port": "no"}, "TIPPE_PORT is 'no'; allowed is a whole number from 1 to 65535"),
    (("--port", "no"), {"port": "5006"}, "--port is 'no'; allowed is a whole number from 1 to 65535"),
    (("--sessions-per-address=0",), {}, "--sessions-per-address is '0'; allowed is a whole number from 1"),
    (("--prot", "8765"), {}, "unrecognized arguments: --prot 8765"), (("8765",), {}, "unrecognized arguments: 8765"),
    (("--port",), {}, "argument --port: expected one argument"),
    (("--port", ""), {}, "--port is ''; allowed is a whole number"),
    (("--prefix", "a" * 60 + "?"), {}, "such as /tops"), (("--prefix", "tüps"), {}, "ASCII"),
    (("--prefix", "a/.."), {}, "such as /tops"),
])  # fmt: skip
def test_a_bad_setting_ends_the_start_with_a_sentence(arguments, settings, says):
    done = started(*arguments, **settings)
    assert done.returncode == 2 and says in done.stderr and "Traceback" not in done.stderr


def test_help_names_every_setting():
    done = started("--help", no_setting="")
    assert done.returncode == 0 and "TIPPE_PORT=8765" in done.stdout
    for item in fields(Settings):
        assert f"--{item.name.replace('_', '-')} " in done.stdout


@pytest.mark.parametrize("given, prefix", [("", ""), ("/", ""), ("tops", "/tops"), ("/a/b-c/", "/a/b-c")])
def test_a_prefix_may_have_its_slashes_or_not(given, prefix):
    assert Settings.of({"TIPPE_PREFIX": given}).prefix == Settings.of({}, ["--prefix", given]).prefix == prefix


def test_the_command_line_goes_before_the_environment():
    settings = Settings.of({"TIPPE_PORT": "1", "TIPPE_LOG": "debug"}, ["--port=8765", "--show", "--proxy", "0"])
    assert (settings.port, settings.show, settings.proxy, settings.log) == (8765, 1, 0, "debug")


@pytest.mark.parametrize("origins, host, lets", [
    ("", "anything:99", True), ("*", "anything:99", True), ("top.org", "top.org", True),
    ("top.org", "TOP.org:443", True),
    ("top.org", "top.org:5006", False), ("top.org:5006", "top.org:5006", True), ("top.org:*", "top.org:1", True),
    ("top.org", "nottop.org", False), ("top.org", "top.org.evil.com", False), ("*.top.org", "a.top.org", True),
    ("*.top.org", "top.org.evil.com", False), ("https://top.org/, b.org", "b.org", True),
    ("[::1]:5006", "[::1]:5006", True),
])  # fmt: skip
def test_which_names_the_server_goes_by(origins, host, lets):
    assert Settings.of({"TIPPE_ORIGINS": origins}).lets(host) is lets


def test_the_files_for_many_replicas_set_what_there_is():
    compose = yaml.safe_load((ROOT / "compose.yaml").read_text(encoding="utf-8"))
    app, proxy = compose["services"]["app"], compose["services"]["proxy"]
    values = {name: re.sub(r"\$\{\w+:-(.*)\}", r"\1", str(value)) for name, value in app["environment"].items()}
    assert Settings.of(values).proxy == 1 and app["read_only"] and set(app["networks"]) <= set(compose["networks"])
    assert (ROOT / proxy["volumes"][0].split(":")[0]).is_file()

    proxy = (ROOT / "deploy/haproxy.cfg").read_text(encoding="utf-8")
    for believed in ("X-Real-IP", "X-Scheme"):  # by tornado, which prefers them to the other two
        assert f"http-request del-header {believed}" in proxy

    first, *others = yaml.safe_load_all((ROOT / "deploy/kubernetes.yaml").read_text(encoding="utf-8"))
    [pod] = first["spec"]["template"]["spec"]["containers"]
    assert Settings.of({each["name"]: each.get("value", "") for each in pod["env"]}).proxy == 1
    assert [each["kind"] for each in others[:4]] == ["Service", "Ingress", "PodDisruptionBudget", "NetworkPolicy"]


def test_the_files_for_many_replicas_start_the_redis_that_they_name():
    compose = yaml.safe_load((ROOT / "compose.yaml").read_text(encoding="utf-8"))
    app, redis = compose["services"]["app"], compose["services"]["redis"]
    assert app["environment"]["TIPPE_VOTES"] == "redis://redis:6379/0" and app["depends_on"] == ["redis"]
    assert redis["networks"] == app["networks"] and redis["read_only"]

    every = {(each["kind"], each["metadata"]["name"]): each["spec"]
             for each in yaml.safe_load_all((ROOT / "deploy/kubernetes.yaml").read_text(encoding="utf-8"))}  # fmt: skip
    [pod] = every["Deployment", "tippe"]["template"]["spec"]["containers"]
    assert {"name": "TIPPE_VOTES", "value": "redis://tippe-redis:6379/0"} in pod["env"]
    there = every["Deployment", "tippe-redis"]["template"]
    [container] = there["spec"]["containers"]
    assert container["args"] == redis["command"] and container["image"] == redis["image"]
    service = every["Service", "tippe-redis"]
    assert service["selector"] == there["metadata"]["labels"] and service["ports"][0]["port"] == 6379
    [to_redis, to_names] = every["NetworkPolicy", "tippe"]["egress"]
    assert to_redis["to"][0]["podSelector"]["matchLabels"] == there["metadata"]["labels"]
    assert {each["port"] for each in to_names["ports"]} == {53}
    assert every["NetworkPolicy", "tippe-redis"]["egress"] == []


def test_the_image_keeps_votes_on_a_volume():
    image = (ROOT / "Dockerfile").read_text(encoding="utf-8")
    [path] = re.findall(r"TIPPE_VOTES=(\S+)/votes.sqlite", image)
    assert f"\nVOLUME {path}\n" in image and f"-o 65534 -g 65534 -m 700 {path}\n" in image


def test_the_docs_list_every_setting():
    text = (ROOT / "docs/DEPLOY.md").read_text(encoding="utf-8")
    assert all(f"| TIPPE_{item.name.upper()} |" in text for item in fields(Settings))
