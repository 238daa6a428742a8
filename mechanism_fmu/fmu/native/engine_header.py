"""Generated engine.h: what the C surface knows of the engine and shares with the slave, as Python declares it."""

from __future__ import annotations

from ... import codes
from ...advice import MOST_NAMED
from ...engine import status
from ...tables.layout import FIELDS, size_slot, slot
from ...tables.sizes import SIZES
from ...tolerances import RATES_WITHIN
from ..instance import protocol
from ..parts.model_description import LOG_CATEGORIES

_PROTOTYPES = """\
int64_t mechanism_begin(double *block, int64_t words, double time);
int64_t mechanism_begin_step(double *block, int64_t words);
int64_t mechanism_go_on(double *block, int64_t words, double target, int64_t rule);
int mechanism_read_outputs(double *block, int64_t words); /* without a result, which only WebAssembly would notice */
int mechanism_read_output_rates(double *block, int64_t words);
int64_t mechanism_exchange(double *block, int64_t words, int64_t what, double time);
int mechanism_respond(double *block, int64_t words);
/* const: a call may be moved to where its result is used, or the formulas' results would fill kilobytes of stack */
__attribute__((const)) double mechanism_sin(double x);
__attribute__((const)) double mechanism_cos(double x);
__attribute__((const)) double mechanism_tan(double x);
__attribute__((const)) double mechanism_atan2(double y, double x);
"""


def engine_header() -> str:
    """The text of engine.h: codes, header words of a block, statuses, limits of the protocol, prototypes."""
    sections = [field.section for field in FIELDS]
    edges = {"FIRST_OF_STATE": sections.index("state"), "END_OF_STATE": sections.index("work")}
    enums = {
        "CODE": {name: value for name, value in vars(codes).items() if name.isupper()},
        "SIZE": {name: size_slot(name) for name in SIZES},
        "SLOT": {
            **{field.name: slot(field.name) for field in FIELDS},
            **{edge: slot(FIELDS[index].name) for edge, index in edges.items()},
        },
        "STATUS": {name: value for name, value in vars(status).items() if isinstance(value, int) and name.isupper()},
    }
    limits = ("LATEST_START", "SAME_TIME", "SAME_TIME_OF_STEP", "ROUNDINGS", "TIGHTEST")
    lines = ["/* The engine for C: written by engine_header.py from the Python sources. */"]
    lines += ["#ifndef ENGINE_H", "#define ENGINE_H", "#include <stdint.h>"]
    for prefix, entries in enums.items():
        lines += ["enum {", *(f"    {prefix}_{name} = {value}," for name, value in entries.items()), "};"]
    lines += [f"#define {name} {getattr(protocol, name)!r} /* as in protocol.py */" for name in limits]
    lines += [f"#define MOST_NAMED {MOST_NAMED} /* as in advice.py */"]
    lines += [f"#define RATES_WITHIN {RATES_WITHIN!r} /* as in tolerances.py */"]
    lines += [f"#define EVENT_FAILURES {{{', '.join(map(str, status.EVENT_FAILURES))}}}"]
    lines += [f"#define LOG_CATEGORIES {{{', '.join(map(c_text, LOG_CATEGORIES))}}}"]
    return "\n".join([*lines, _PROTOTYPES, "extern const char *const ADVICE[];", "#endif", ""])


def advice_table() -> str:
    """The definition of ADVICE: what each status means and what to do."""
    entries = ", ".join(f"[{outcome}] = {c_text(advice)}" for outcome, advice in status.ADVICE.items())
    return f"const char *const ADVICE[] = {{{entries}}};\n"


def c_text(text: str) -> str:
    """A C string literal of ASCII characters only."""
    escaped = "".join(
        f"\\{char}" if char in '"\\' else char if " " <= char <= "~" else "".join(f"\\{b:03o}" for b in char.encode())
        for char in text
    )
    return f'"{escaped}"'
