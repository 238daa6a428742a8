"""The C files of the native flavour: all decide on the fingerprint of an FMU, and they use each other one way."""

import re

from mechanism_fmu.fmu.native.link import HEADERS, SURFACE, surface

FOLDER = surface("log.c")[0].parent
#: What other libraries are made of, or what is linked on one system only; `linked_with` adds the latter by itself.
ELSEWHERE = {"library.c", "loaded.c", "many.c", "page.c", "windows.c"}


def test_every_file_of_the_surface_is_part_of_the_fingerprint():
    named = {*SURFACE, *HEADERS, *ELSEWHERE}
    assert {path.name for path in FOLDER.iterdir()} == named


def test_a_file_calls_only_what_those_before_it_define():
    """The two versions of FMI come last, and nothing that they define is called from below."""
    texts = {name: (FOLDER / name).read_text(encoding="utf-8") for name in SURFACE}
    defined = {
        name: set(re.findall(r"^[A-Za-z][\w ]*\W\**(\w+)\([^;{]*\) \{", text, re.M)) for name, text in texts.items()
    }
    assert all(defined.values())
    for place, name in enumerate(SURFACE):
        later = set().union(*(defined[other] for other in SURFACE[place + 1 :])) - defined[name]
        assert not later & set(re.findall(r"\b(\w+)\(", texts[name])), name
