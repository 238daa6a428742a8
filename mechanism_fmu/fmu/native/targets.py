"""The platforms that a native FMU has a binary for."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Target:
    """A platform.

    Attributes:
        name: of the folder in an FMI 3.0 FMU (specification 3.0, section 2.5.1.4.1).
        fmi2: of the folder in an FMI 2.0 FMU; two for one folder become a universal binary. FMI 2.0 has no name for
            Linux on ARM: the folder named as in 3.0 is for importers that look there, and for hands.
        triple: what LLVM calls it.
        zig: what `zig cc -target` calls it: the oldest system library that the binary runs with is part of it.
        suffix: of shared libraries.
    """

    name: str
    fmi2: str
    triple: str
    zig: str
    suffix: str


#: The platforms that pythonfmu's wheel has a wrapper for.
WRAPPED = ("linux64", "win64")

TARGETS = (
    Target("x86_64-linux", "linux64", "x86_64-unknown-linux-gnu", "x86_64-linux-gnu.2.17", ".so"),
    Target("x86_64-windows", "win64", "x86_64-pc-windows-msvc", "x86_64-windows-gnu", ".dll"),
    Target("x86_64-darwin", "darwin64", "x86_64-apple-macosx11.0.0", "x86_64-macos.11.0", ".dylib"),
    Target("aarch64-linux", "aarch64-linux", "aarch64-unknown-linux-gnu", "aarch64-linux-gnu.2.17", ".so"),
    Target("aarch64-darwin", "darwin64", "arm64-apple-macosx11.0.0", "aarch64-macos.11.0", ".dylib"),
)
