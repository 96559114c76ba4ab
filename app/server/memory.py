"""How much memory this process has, and how much it may have."""

import mmap
from contextlib import suppress
from pathlib import Path

try:
    import resource
except ImportError:  # Windows
    resource = None

FILLED = 0.9  # of it, above which no more pages are let in
# Where Linux says what a container may have, in its two generations.
LIMITS = ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes")


def memory():
    """Memory of this process in bytes; its maximum so far if the system reports only that; 0 if unknown."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[1]) * mmap.PAGESIZE
    except OSError:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss if resource else 0


def memory_limit():
    """The memory that all processes of this container may have together, in bytes; inf if there is no limit."""
    limit = float("inf")
    for path in LIMITS:
        with suppress(OSError, ValueError):  # "max"
            limit = min(limit, int(Path(path).read_text()))
    return limit
