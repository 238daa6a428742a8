"""Names of archives that must not be unpacked, each refused for its own reason before a byte is written."""

import io
import stat
import zipfile
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from mechanism_fmu.fmu.disk.folders import unsafe_name


def entry(name: str, kind: int = 0) -> zipfile.ZipInfo:
    info = zipfile.ZipInfo(name)
    info.orig_filename = name
    info.external_attr = kind << 16
    return info


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("../out.txt", "leads out of its folder"),
        ("resources/../../out.txt", "leads out of its folder"),
        ("resources/..", "leads out of its folder"),
        ("/etc/passwd", "absolute path"),
        ("resources\\..\\..\\out.txt", "backslash or a colon"),
        ("C:/out.txt", "backslash or a colon"),
        ("resources/a\0.txt", "control character"),
        ("resources/a\n.txt", "control character"),
        ("", "empty part"),
        ("resources//a", "empty part"),
        ("./a", "empty part"),
        ("resources/" + "a" * 256, "too long: 255 bytes"),
        ("resources/" + "ü" * 128, "too long: 255 bytes"),
        ("a/" * 1000 + "b", "too long"),
    ],
)
def test_unsafe_names_are_refused(name: str, reason: str) -> None:
    objection = unsafe_name([entry("modelDescription.xml"), entry(name)])
    assert objection is not None
    assert reason in objection
    assert "\n" not in objection
    assert "\0" not in objection


@pytest.mark.parametrize(
    ("kind", "reason"),
    [(stat.S_IFLNK, "symbolic link"), (stat.S_IFIFO, "neither a file"), (stat.S_IFCHR, "neither a file")],
)
def test_what_is_no_file_is_refused(kind: int, reason: str) -> None:
    assert reason in (unsafe_name([entry("resources/x", kind | 0o777)]) or "")


@pytest.mark.parametrize("kind", [0, stat.S_IFREG | 0o644, stat.S_IFREG | 0o755])
def test_plain_names_are_taken(kind: int) -> None:
    names = ["modelDescription.xml", "resources/a..b/…ü.txt", "resources/" + "a" * 255, "binaries/x86_64-linux/a.so"]
    folders = [entry("resources/"), entry("binaries/", stat.S_IFDIR | 0o755)]
    assert unsafe_name([*folders, *(entry(name, kind) for name in names)]) is None


def test_longest_path_is_taken() -> None:
    assert unsafe_name([entry("a/" * 999 + "bb")]) is None
    assert unsafe_name([entry("a/" * 999 + "bbb")]) is not None


def test_one_name_for_two_things_is_refused() -> None:
    assert "is there twice" in (unsafe_name([entry("a/b"), entry("a/b")]) or "")
    assert "a file and a folder" in (unsafe_name([entry("a"), entry("a/b")]) or "")
    assert "a file and a folder" in (unsafe_name([entry("a/b"), entry("a/b/")]) or "")
    assert unsafe_name([entry("a/"), entry("a/"), entry("a/b")]) is None


def test_nul_in_a_real_archive_is_seen() -> None:
    """Python ends the name at the NUL; other programs may not."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("aXb", "")
    data = file.getvalue().replace(b"aXb", b"a\0b")
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.namelist() == ["a"]
        assert "control character" in (unsafe_name(archive.infolist()) or "")


@given(st.lists(st.text(st.characters(exclude_categories=["Cs"]), min_size=1, max_size=12), max_size=4))
def test_what_is_taken_stays_in_its_folder(names: list[str]) -> None:
    entries = [entry(name) for name in names]
    if unsafe_name(entries) is None:
        for name in names:
            place = Path("/somewhere/folder") / name
            assert place.resolve().is_relative_to("/somewhere/folder")
