"""FMU files as archives: whatever the bytes and names, they are opened or refused, and nothing is written elsewhere."""

import io
import zipfile
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from harness.errors import UsageError
from harness.fmu import open_fmu
from harness.fmu.description_file import read_description
from mechanism_fmu.fmu.disk.archive import read_entries
from tests.fuzz.input_bytes import CORPUS, damaged, fuzzed, read_or_refused
from tests.harness.damaged import DAMAGES, DESCRIPTION, sound

SEEDS = sorted(CORPUS.glob("zip/*.zip"))


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two folders deep, so that a step out of it stays among what is looked at."""
    folder = tmp_path_factory.mktemp("zip") / "one" / "two"
    folder.mkdir(parents=True)
    return folder


@pytest.fixture(autouse=True)
def _temporary(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (place / "temporary").mkdir(exist_ok=True)
    monkeypatch.setattr("tempfile.tempdir", str(place / "temporary"))


def opened(path: Path) -> bool:
    """Whether it can be opened; nothing may lie anywhere but in the temporary folder, and nothing there afterwards."""
    before = everything(path.parent)

    def read() -> bool:
        with open_fmu(path) as fmu:
            assert all(one.resolve().is_relative_to(fmu.folder) for one in fmu.folder.rglob("*"))
            assert not any(one.is_symlink() for one in fmu.folder.rglob("*"))
        return True

    done = read_or_refused(read, path) or False
    assert everything(path.parent) == before
    return done


def everything(place: Path) -> set[Path]:
    return set(place.parents[1].rglob("*"))


def zipped(entries: dict[str, bytes], how: int = zipfile.ZIP_DEFLATED) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", how) as archive:
        for name, data in entries.items():
            archive.writestr(zipfile.ZipInfo(name), data, how)
    return file.getvalue()


LIBRARIES = {f"binaries/{folder}/Sound.{end}": b"no library" for folder, end in (("linux64", "so"), ("win64", "dll"))}
PLAIN = {"modelDescription.xml": DESCRIPTION.encode(), **LIBRARIES, "resources/a/b.txt": b"text " * 40}


def test_what_is_damaged_was_sound(place: Path) -> None:
    path = place / "Sound.fmu"
    path.write_bytes(zipped(PLAIN))
    assert opened(path)


def test_the_corpus_is_there() -> None:
    assert len(SEEDS) >= len(DAMAGES) * 0.8


@pytest.mark.parametrize("seed", SEEDS, ids=lambda seed: seed.name)
def test_the_corpus_is_refused(seed: Path, place: Path) -> None:
    path = place / "Seed.fmu"
    path.write_bytes(seed.read_bytes())
    assert not opened(path)


@pytest.mark.parametrize("how", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
@fuzzed
@given(data=st.data())
def test_any_bytes_are_opened_or_refused(place: Path, how: int, data: st.DataObject) -> None:
    path = place / "Any.fmu"
    path.write_bytes(data.draw(damaged(zipped(PLAIN, how))))
    opened(path)
    with suppress(OSError, zipfile.BadZipFile):
        read_entries(path)


PART = st.sampled_from(
    ["..", ".", "", "a", "resources", "binaries", "C:", "\\", "~", "a\\b", "a\0b", "é", "x" * 260, "con"]
)


@fuzzed
@given(names=st.lists(st.lists(PART, min_size=1, max_size=4).map("/".join), min_size=1, max_size=3))
def test_any_names_are_unpacked_within_or_refused(place: Path, names: list[str]) -> None:
    path = place / "Named.fmu"
    data = zipped(PLAIN | {name.replace("\0", "X") or "X": b"outside" for name in names})
    path.write_bytes(data)
    opened(path)


@pytest.mark.parametrize("flag", [0x1, 0x20, 0x40])
def test_encrypted_and_unknown_forms_are_refused(place: Path, flag: int) -> None:
    data = bytearray(zipped(PLAIN))
    for begin, offset in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        start = data.find(begin)
        while start >= 0:
            data[start + offset : start + offset + 2] = flag.to_bytes(2, "little")
            start = data.find(begin, start + 1)
    path = place / "Encrypted.fmu"
    path.write_bytes(bytes(data))
    assert not opened(path)


def test_a_folder_and_a_pipe_are_no_files(place: Path) -> None:
    with pytest.raises(UsageError, match="There is no FMU file"):
        read_description(place)
    assert opened(sound(place / "Sound.xml"))  # whatever its name ends with
