"""The explorer's page: `panel serve app` finds main.py here."""

from importlib.metadata import PackageNotFoundError, version

try:
    VERSION = version("tippe-top-explorer")
except PackageNotFoundError:  # run from a folder that was never installed
    VERSION = "unknown"
