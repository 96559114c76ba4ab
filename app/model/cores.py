"""How many cores this process has: in a container no more than it is given the time of, whatever the machine has."""

import math
import os
from pathlib import Path, PurePosixPath

GROUPS, MINE = Path("/sys/fs/cgroup"), Path("/proc/self/cgroup")


def allowed() -> int:
    """Those that the system lets it run on."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def given(groups: Path = GROUPS, mine: Path = MINE) -> float:
    """The least that its control group, or one that this is in, has time for; inf where none says so. (cpu.max, of
    Linux's second version, as Docker, Kubernetes and systemd set it; os.process_cpu_count() does not look at it.)"""
    try:
        own = next(line for line in mine.read_text().splitlines() if line.startswith("0::"))[3:].lstrip("/")
    except (OSError, StopIteration):
        return math.inf
    found = math.inf
    for folder in (PurePosixPath(own), *PurePosixPath(own).parents):
        try:
            time, period = (groups / folder / "cpu.max").read_text().split()
            found = min(found, float(time) / float(period))
        except (OSError, ValueError):  # the outermost has none, and "max" is no number
            continue
    return found


def cores() -> int:
    """Whole ones, at least one."""
    return int(max(1, min(allowed(), given())))
