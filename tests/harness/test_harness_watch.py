"""`watch`: a page that follows a file, without a build of it."""

import json
import os
import socket
import struct
import time
from collections.abc import Iterator
from http.client import HTTPConnection
from pathlib import Path
from threading import Thread

import pytest
from typer.testing import CliRunner

from harness.app.cli import main
from harness.page.watched import Watched, server_of
from mechanism_fmu.model import MechanismError


class Followed:
    """A file whose page is its text; "wrong" is a mistake."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / "lever.py"
        self.ticks = 0
        self.write("first")
        self.watched = Watched(self.path, self.make)

    def write(self, text: str) -> None:
        self.path.write_text(text, encoding="utf-8")
        self.ticks += 1
        os.utime(self.path, ns=(self.ticks * 10**9,) * 2)

    def make(self) -> str:
        text = self.path.read_text(encoding="utf-8")
        if text == "wrong":
            raise MechanismError("lever.py, line 1: that is wrong.")
        return f"<p>{text}</p>"


@pytest.fixture
def followed(tmp_path: Path) -> Followed:
    return Followed(tmp_path)


def test_it_is_built_anew_when_it_changes(followed: Followed) -> None:
    watched = followed.watched
    assert [watched.look(), watched.look()] == [True, False]
    first = watched.version
    assert (watched.html, watched.objection) == ("<p>first</p>", "")
    followed.write("wrong")
    assert watched.look()
    # the last page stays
    assert (watched.html, watched.version) == ("<p>first</p>", first)
    assert watched.objection == "lever.py, line 1: that is wrong."
    assert not watched.look()
    followed.write("third")
    assert watched.look()
    assert (watched.html, watched.version, watched.objection) == ("<p>third</p>", first + 1, "")


def test_a_later_watch_is_newer(followed: Followed) -> None:
    followed.watched.look()
    later = Watched(followed.path, followed.make)
    assert later.version == 0
    later.look()
    # two may begin in one millisecond here
    assert later.version >= followed.watched.version > 10**12


def test_who_asked_and_has_gone_is_no_fault(
    followed: Followed, asked: HTTPConnection, capfd: pytest.CaptureFixture[str]
) -> None:
    followed.watched.html = "x" * 10**7
    asked.connect()
    # closing with unread bytes resets the connection
    asked.sock.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    asked.sock.sendall(b"GET /page HTTP/1.1\r\nHost: localhost\r\n\r\n")
    asked.sock.recv(1)
    asked.close()
    assert got(asked, "/state")[0] == 200
    time.sleep(0.1)
    assert capfd.readouterr().err == ""


def test_a_file_beside_it_counts_and_one_that_is_gone_is_said(followed: Followed) -> None:
    watched = followed.watched
    watched.look()
    first = watched.version
    (followed.path.parent / "sizes.py").write_text("LENGTH = 1.0\n", encoding="utf-8")
    assert watched.look()
    assert watched.version == first + 1
    followed.path.unlink()
    assert watched.look()
    assert "lever.py" in watched.objection
    assert watched.version == first + 1


@pytest.fixture
def asked(followed: Followed) -> Iterator[HTTPConnection]:
    server = server_of(followed.watched, "lever & co", 0)
    Thread(target=server.serve_forever, daemon=True).start()
    connection = HTTPConnection("127.0.0.1", server.server_address[1], timeout=60)
    yield connection
    connection.close()
    server.shutdown()
    server.server_close()


def got(connection: HTTPConnection, path: str, host: str = "localhost:1") -> tuple[int, str]:
    connection.request("GET", path, headers={"Host": host})
    answer = connection.getresponse()
    return answer.status, answer.read().decode()


def test_its_server_shows_the_page_and_what_is_wrong(followed: Followed, asked: HTTPConnection) -> None:
    followed.watched.look()
    assert got(asked, "/page") == (200, "<p>first</p>")
    followed.write("wrong")
    followed.watched.look()
    status, state = got(asked, "/state")
    assert (status, json.loads(state)) == (
        200,
        {"version": followed.watched.version, "objection": "lever.py, line 1: that is wrong."},
    )
    status, around = got(asked, "/")
    assert (status, "<title>lever &amp; co</title>" in around) == (200, True)


@pytest.mark.parametrize(
    ("path", "host", "status"), [("/etc/passwd", "127.0.0.1", 404), ("/page", "evil.example", 403)]
)
def test_its_server_is_for_nothing_else(path: str, host: str, status: int, asked: HTTPConnection) -> None:
    assert got(asked, path, host)[0] == status


@pytest.mark.parametrize("words", [["nowhere.py"], ["ratchet"]])
def test_what_is_no_file_is_wrong_use(words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert CliRunner().invoke(main, ["watch", *words, "--no-open"]).exit_code == 2
