"""Names in archives: those that lead out of the folder are refused in every place that unpacks."""

import stat
import zipfile
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechanism_fmu.batch.origin import NoBatchError, model_of_fmu
from mechanism_fmu.fmu.archive import read_entries
from mechanism_fmu.fmu.unpacked import UnsafeNameError, check_names, checked_archive

UNSAFE = {
    "../out.py": "leads out",
    "resources/../../out.py": "leads out",
    "a/..": "leads out",
    "/etc/cron.d/out": "absolute",
    "//server/share/out": "absolute",
    "C:/out.dll": "colon",
    "c:out.dll": "colon",
    "resources\\..\\out.py": "backslash",
    "\\out.py": "backslash",
    "plain.txt:stream": "colon",
    "x" * 300: "too long",
    "/".join(["long"] * 400): "too long",
    "ä" * 128: "too long",
}


def archive(path: Path, *names: str | zipfile.ZipInfo) -> Path:
    with zipfile.ZipFile(path, "w") as file:
        for name in ("modelDescription.xml", *names):
            info = name if isinstance(name, zipfile.ZipInfo) else zipfile.ZipInfo("x")
            if isinstance(name, str):
                info.filename = info.orig_filename = name  # past what zipfile makes of it
            file.writestr(info, b"content")
    return path


@pytest.mark.parametrize("name", UNSAFE, ids=range(len(UNSAFE)))
def test_a_name_that_leads_out_is_refused(name: str, tmp_path: Path) -> None:
    path = archive(tmp_path / "a.fmu", name)
    with pytest.raises(UnsafeNameError, match=UNSAFE[name]):
        read_entries(path)
    with pytest.raises(NoBatchError, match=f"cannot be read as an FMU: its entry .*{UNSAFE[name]}"):
        model_of_fmu(path)
    assert [one.name for one in tmp_path.iterdir()] == ["a.fmu"]


@pytest.mark.parametrize("kind", [stat.S_IFLNK, stat.S_IFCHR, stat.S_IFIFO, stat.S_IFSOCK])
def test_a_link_or_a_device_is_refused(kind: int, tmp_path: Path) -> None:
    info = zipfile.ZipInfo("resources/link")
    info.create_system, info.external_attr = 3, (kind | 0o777) << 16
    with pytest.raises(UnsafeNameError, match="'resources/link' is a link or a device"):
        read_entries(archive(tmp_path / "a.fmu", info))


def test_plain_names_pass(tmp_path: Path) -> None:
    names = ["binaries/linux64/a.so", "resources/..hidden/b..py", "documentation/", "extra/übung.txt"]
    assert list(read_entries(archive(tmp_path / "a.fmu", *names))) == ["modelDescription.xml", *names]


@given(st.text(st.sampled_from("ab./\\:\0~C"), min_size=1, max_size=12))
def test_what_passes_stays_in_the_folder(name: str) -> None:
    class Archive:
        def infolist(self) -> list[zipfile.ZipInfo]:
            info = zipfile.ZipInfo("x")
            info.filename = info.orig_filename = name
            return [info]

    try:
        check_names(Archive())  # type: ignore[arg-type]
    except UnsafeNameError:
        return
    folder = Path("/some/folder")
    assert (folder / name).is_relative_to(folder)
    assert ".." not in (folder / name).parts


def test_the_archive_is_closed_after_a_refusal(tmp_path: Path) -> None:
    path = archive(tmp_path / "a.fmu", "../b")
    with pytest.raises(UnsafeNameError), checked_archive(path):
        pass
    path.unlink()
