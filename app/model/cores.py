"""The number of cores that this process may use: in a container only as many as its share of processor time."""

import math
import os
from pathlib import Path, PurePosixPath

GROUPS, MINE = Path("/sys/fs/cgroup"), Path("/proc/self/cgroup")


def allowed() -> int:
    """The cores on which the system lets it run."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def given(groups: Path = GROUPS, mine: Path = MINE) -> float:
    """The smallest number of cores for which its control group, or a parent group, has time; inf without a limit. (This
    is cpu.max of cgroup v2, as set by Docker, Kubernetes and systemd; os.process_cpu_count() ignores it.)"""
    try:
        own = next(line for line in mine.read_text().splitlines() if line.startswith("0::"))[3:].lstrip("/")
    except (OSError, StopIteration):
        return math.inf
    found = math.inf
    for folder in (PurePosixPath(own), *PurePosixPath(own).parents):
        try:
            time, period = (groups / folder / "cpu.max").read_text().split()
            found = min(found, float(time) / float(period))
        except (OSError, ValueError):  # the root group has no file, and "max" is not a number
            continue
    return found


def cores() -> int:
    """The number of whole cores, at least one."""
    return int(max(1, min(allowed(), given())))
