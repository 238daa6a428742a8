"""Limits of a process, its user, and a disk of few bytes."""

from __future__ import annotations

import ctypes
import os
import resource
import signal
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

#: What systems call nobody.
NOBODY = 65534
_NEW_MOUNTS = 0x00020000
#: As of linux/prctl.h and linux/capability.h.
_KEEP_CAPABILITIES, _AMBIENT, _RAISE = 8, 47, 2
_CAPABILITIES_VERSION, _MAY_READ = 0x20080522, 2


def limit_files(size: int) -> None:
    """For a new process: no file of more bytes; who tries is told, and not killed."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


def limit_memory(size: int) -> None:
    """For a new process: no more addresses."""
    resource.setrlimit(resource.RLIMIT_AS, (size, size))


def become_nobody() -> None:
    """For a new process of root's: it may write what nobody may, but read all: Python may be root's own."""
    library = ctypes.CDLL(None, use_errno=True)
    os.setgroups([])
    os.setgid(NOBODY)
    library.prctl(_KEEP_CAPABILITIES, 1, 0, 0, 0)
    os.setuid(NOBODY)
    header = (ctypes.c_uint32 * 2)(_CAPABILITIES_VERSION, 0)
    kept = 1 << _MAY_READ
    data = (ctypes.c_uint32 * 6)(kept, kept, kept, 0, 0, 0)  # effective, permitted, inheritable; and the upper halves
    if library.capset(header, data) != 0 or library.prctl(_AMBIENT, _RAISE, _MAY_READ, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "capabilities cannot be kept")


def set_writable(folder: Path, writable: bool) -> None:
    """Let a folder, and those in it, be written to or not."""
    for path in [folder, *(path for path in folder.rglob("*") if path.is_dir())]:
        with suppress(FileNotFoundError):  # gone since it was found
            path.chmod(0o777 if writable else 0o555)


def own_mounts() -> bool:
    """Let this process and its own mount disks that nobody else sees; whether it may."""
    if not hasattr(os, "geteuid") or os.geteuid() != 0:
        return False
    library = ctypes.CDLL(None, use_errno=True)
    if library.unshare(_NEW_MOUNTS) != 0:
        return False
    return subprocess.run(["mount", "--make-rprivate", "/"], check=False, capture_output=True).returncode == 0


class Disk:
    """A disk in memory, mounted on a folder."""

    def __init__(self, folder: Path, size: int) -> None:
        self._folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "none", str(folder)], check=True)

    def enlarge(self) -> None:
        """Give it room enough."""
        subprocess.run(["mount", "-o", "remount,size=100m", str(self._folder)], check=True)


@contextmanager
def mounted(folder: Path, size: int) -> Iterator[Disk]:
    """A disk of so many bytes on a folder, for a process with `own_mounts`."""
    disk = Disk(folder, size)
    try:
        yield disk
    finally:
        subprocess.run(["umount", str(folder)], check=True)
