"""Build hook: in a clone the sources and the licence are two folders above this file, in a source archive beside it."""

from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class CoreHook(BuildHookInterface):
    def initialize(self, version, build_data):
        here = Path(self.root)
        beside = (here / "tippe_core").is_dir()  # then it is selected without our help
        place = here if beside else here.parents[1]
        licence = "tippe_core/LICENSE" if self.target_name == "wheel" else "LICENSE"
        build_data["force_include"][str(place / "LICENSE")] = licence
        if not beside:
            build_data["force_include"][str(place / "tippe_core")] = "tippe_core"
