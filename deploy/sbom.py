"""Prints a list of what is installed with the explorer, in the format CycloneDX 1.6: the Python libraries, the
JavaScript in the bundle, Python itself and the packages of Debian. Run it with the Python that runs the explorer:

    docker run --rm --interactive tippe-top-explorer python - < deploy/sbom.py > sbom.json
"""

import json
import platform
import re
from importlib.metadata import distributions
from importlib.util import find_spec
from pathlib import Path
from urllib.parse import quote

OWN = "tippe-top-explorer"


def component(kind, name, version, purl, licence=None):
    """An entry of the list. purl: kind of package and name, as in a package URL; it is unique in the list."""
    place, _, rest = purl.partition("?")
    url = f"pkg:{place}@{quote(version)}" + (rest and f"?{rest}")
    entry = {"type": kind, "bom-ref": url, "name": name, "version": version, "purl": url}
    return entry | ({"licenses": [{"expression": licence}]} if licence else {})


def python():
    """Every Python package that is installed, the explorer first."""
    for each in sorted(distributions(), key=lambda each: (each.name != OWN, each.name.lower())):
        name = re.sub(r"[-_.]+", "-", each.name).lower()
        kind = "application" if name == OWN else "library"
        yield component(kind, each.name, each.version, f"pypi/{name}", each.metadata.get("License-Expression"))


def javascript():
    """The packages whose code is in the bundle: each has its notice beside it."""
    [app] = find_spec("app").submodule_search_locations
    notices = Path(app, "static", "THIRD_PARTY_NOTICES.txt")
    for name, version in re.findall(r"(?m)^(\S+) (\d+\.\d+\.\d+)$", notices.read_text(encoding="utf-8")):
        yield component("library", name, version, f"npm/{quote(name)}")


def debian():
    """The packages of the system; none where there is no dpkg."""
    installed, release = Path("/var/lib/dpkg/status"), platform.freedesktop_os_release()
    for block in installed.read_text(encoding="utf-8").split("\n\n") if installed.exists() else ():
        field = dict(re.findall(r"(?m)^(Package|Status|Version|Architecture): (.*)$", block))
        if field.get("Status", "").endswith(" ok installed"):
            system = f"arch={field['Architecture']}&distro={release['ID']}-{release.get('VERSION_ID', '')}"
            name = field["Package"]
            yield component("library", name, field["Version"], f"deb/{release['ID']}/{quote(name)}?{system}")


def main():
    own, *libraries = python()
    cpython = component("platform", "CPython", platform.python_version(), "generic/cpython")
    print(json.dumps({"bomFormat": "CycloneDX", "specVersion": "1.6", "version": 1, "metadata": {"component": own},
                      "components": [*libraries, *javascript(), cpython, *debian()]}, indent=1))  # fmt: skip


main()
