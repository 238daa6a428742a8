"""Temporary folders: removed by their process, or, when that was killed, by whoever makes the next one."""

import os
import signal
import subprocess
import sys
from multiprocessing import get_context
from pathlib import Path

import pytest

from mechanism_fmu.fmu.disk import folders
from mechanism_fmu.fmu.disk.folders import remove_abandoned, temporary_folder

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="folders cannot be locked there")

#: Makes a folder with something in it, says which, and waits.
_WAITING = """
import sys, time
from pathlib import Path
from mechanism_fmu.fmu.disk.folders import temporary_folder
with temporary_folder(Path(sys.argv[1])) as folder:
    (folder / "inside").mkdir()
    (folder / "inside" / "file").touch()
    print(folder, flush=True)
    time.sleep(60)
"""


def waiting(place: Path) -> tuple["subprocess.Popen[str]", Path]:
    process = subprocess.Popen([sys.executable, "-c", _WAITING, str(place)], stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None
    return process, Path(process.stdout.readline().strip())


def test_a_folder_is_there_and_goes(tmp_path: Path) -> None:
    with temporary_folder(tmp_path) as folder:
        assert folder.parent == tmp_path
        assert list(folder.iterdir()) == []
        (folder / "file").touch()
    assert list(tmp_path.iterdir()) == []


def test_the_folder_of_a_killed_process_goes_with_the_next_one(tmp_path: Path) -> None:
    process, left = waiting(tmp_path)
    with process:
        process.kill()
    assert process.returncode == -signal.SIGKILL
    assert (left / "inside" / "file").is_file()
    with temporary_folder(tmp_path) as folder:
        assert list(tmp_path.iterdir()) == [folder]


def test_the_folder_of_a_process_at_work_stays_whatever_its_name_says(tmp_path: Path) -> None:
    """Its process has a lock, not an id: ids come again, and other containers have the same."""
    process, _ = waiting(tmp_path)
    with process:
        with temporary_folder(tmp_path) as mine:
            remove_abandoned(tmp_path)
            assert mine.is_dir()
            assert len(list(tmp_path.iterdir())) == 2
        process.kill()
    gone = subprocess.Popen([sys.executable, "-c", ""])
    gone.wait()
    with temporary_folder(tmp_path) as folder:
        renamed = folder.rename(tmp_path / f"mechanism-fmu-{gone.pid}-abc")
        remove_abandoned(tmp_path)
        assert list(tmp_path.iterdir()) == [renamed]


def test_the_id_of_a_killed_process_may_be_that_of_another_by_now(tmp_path: Path) -> None:
    (tmp_path / f"mechanism-fmu-{os.getpid()}-abc").mkdir()
    remove_abandoned(tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_what_others_made_stays(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "file").touch()
    (tmp_path / "mechanism-fmu-1-link").symlink_to(tmp_path / "elsewhere")
    (tmp_path / "mechanism-fmu-1-file").touch()
    for name in ("mechanism-fmu-abcdefgh", "mechanism_fmu_1-abc", "mechanism-fmu-1-abc.txt", "other"):
        (tmp_path / name).mkdir()
    before = sorted(tmp_path.rglob("*"))
    remove_abandoned(tmp_path)
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.skipif(os.name == "nt" or os.geteuid() != 0, reason="only root can make folders of others")
def test_the_folder_of_another_user_stays(tmp_path: Path) -> None:
    folder = tmp_path / "mechanism-fmu-1-abc"
    folder.mkdir()
    os.chown(folder, 65534, 65534)
    remove_abandoned(tmp_path)
    assert folder.is_dir()
    os.chown(folder, 0, 0)
    remove_abandoned(tmp_path)
    assert not folder.exists()


def test_without_locks_nothing_is_removed_that_may_be_in_use(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_handle: int, _how: int) -> None:
        raise OSError("no locks available")

    monkeypatch.setattr(folders.fcntl, "flock", refuse)
    with temporary_folder(tmp_path) as one, temporary_folder(tmp_path) as two:
        assert sorted(tmp_path.iterdir()) == sorted([one, two])
    assert list(tmp_path.iterdir()) == []


def test_one_that_was_taken_for_abandoned_is_made_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Between its making and its locking, another process may come by, lock it and remove it: in either order."""
    usual, made = folders.tempfile.mkdtemp, []

    def raced(**how: object) -> str:
        folder = usual(**how)
        made.append(folder)
        if len(made) == 1:
            os.rmdir(folder)
        if len(made) == 2:
            held.append(folders._lock(folder))
        return folder

    held: list[int | None] = []
    monkeypatch.setattr(folders.tempfile, "mkdtemp", raced)
    with temporary_folder(tmp_path) as folder:
        assert [str(folder)] == made[2:]
        assert folder.is_dir()
    assert held[0] is not None
    os.close(held[0])


def _many(place: Path) -> None:
    for _ in range(100):
        with temporary_folder(place) as folder:
            (folder / "file").touch()
            assert (folder / "file").exists()


def test_many_at_once_do_not_remove_each_other_s(tmp_path: Path) -> None:
    context = get_context("spawn")
    processes = [context.Process(target=_many, args=(tmp_path,)) for _ in range(3)]
    for process in processes:
        process.start()
    for process in processes:
        process.join()
    assert [process.exitcode for process in processes] == [0, 0, 0]
    assert list(tmp_path.iterdir()) == []
