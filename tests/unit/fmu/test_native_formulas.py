import ctypes
import math
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings, strategies as st

import models
from mechanism_fmu.engine.run import library_path
from mechanism_fmu.fmu.native.formulas import c_number, formulas, printf_text
from mechanism_fmu.fmu.native.objects import compiled_engine
from mechanism_fmu.model import Body, Finding, Mechanism, MechanismError, Model, Parameter
from mechanism_fmu.model.compile import compile_mechanism
from mechanism_fmu.model.functions import atan2, cos, sin, sqrt, tan, where_positive
from mechanism_fmu.model.trace import trace
from mechanism_fmu.tables.layout import FIELDS, field_of, pack
from models.geneva.model import MODEL as GENEVA
from models.ratchet.model import MODEL as RATCHET
from tests.parameter_sets import near_defaults, within_limits

COMPILER = shutil.which("cc") or shutil.which("gcc")
needs_compiler = pytest.mark.skipif(COMPILER is None or sys.platform == "win32", reason="needs a C compiler")

#: As a native FMU says a finding.
SAY = """
#include <stdio.h>
int say(char *line, size_t size, const char *text, const double *x)
{
    return snprintf(line, size, text, x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7]);
}
"""


def _mechanism(values):
    """A body whose numbers use every operation, and constants of every kind."""
    a, b = values.a, values.b
    start = (0.1 + a - 0.1, 1 * a - -0.0 * b, where_positive(a - b, tan(a), -b))
    unused = sqrt(a * 17)
    assert unused is not None
    return Mechanism(
        (Body("body", sqrt(4 + a * a), 2.0, start, (sin(a) / 3, where_positive(b, 7 - cos(b), 1e-320), atan2(0.5, b))),)
    )


def _objections(values):
    return (Finding(values.a - 8, "{:g} % is {{much}}: {:.12g}", (values.a, 2.0)), Finding(-math.inf, "Never."))


SMALL = Model(
    "Small",
    "every operation",
    (Parameter("a", 0.3, "", "1", 0, 9), Parameter("b", 0.1, "", "1", -9, 9), Parameter("c", 0.1, "", "1", -9, 9)),
    _mechanism,
    _objections,
)


class Compiled:
    """A model's formulas, compiled: what they write for parameter values."""

    def __init__(self, model, folder):
        self.model = model
        self.block = pack(compile_mechanism(model.build(model.values())))
        self.formulas = formulas(trace(model), self.block)
        library = _library(self.formulas.source + SAY, folder / model.name)
        pointer = np.ctypeslib.ndpointer(np.float64, flags="C")
        self._run, self._say = library.mechanism_formulas, library.say
        self._run.argtypes, self._run.restype = [pointer] * 3, None
        self._say.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, pointer]

    def __call__(self, values):
        """The default block with the tables of the values, and the findings."""
        block, findings = self.block.copy(), np.zeros(self.formulas.findings)
        block[[word for word, _ in self.formulas.words]] = math.nan
        self._run(np.array([float(getattr(values, p.name)) for p in self.model.parameters]), block, findings)
        return block, findings

    def messages(self, texts, findings):
        """What C says of them."""
        said = []
        for text, place in texts:
            if findings[place] > 0:
                line = ctypes.create_string_buffer(1000)
                self._say(line, len(line), text.encode(), findings[place + 1 :])
                said.append(line.value.decode())
        return said


def _library(source, path):
    # Warnings are errors: a variable that nothing uses is an operation that should have been dropped.
    options = ["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "-O2", "-ffp-contract=off", "-shared", "-fPIC"]
    path.with_suffix(".c").write_text(source)
    engine = compiled_engine()
    files = [path.with_suffix(".c"), engine.objects[library_path(Path()).stem]]
    command = [COMPILER, *options, f"-I{engine.headers}", "-o", path.with_suffix(".so"), *files, "-lm"]
    subprocess.run([str(part) for part in command], check=True)
    return ctypes.CDLL(str(path.with_suffix(".so")))


#: The models but the ratchet are slow: each is another C file to compile.
MODELS = [
    pytest.param(model, id=model.name, marks=() if model in (RATCHET, SMALL) else pytest.mark.slow)
    for model in (*(models.load(name).MODEL for name in models.available()), SMALL)
]


@pytest.fixture(scope="module", params=MODELS)
def compiled(request, tmp_path_factory):
    if COMPILER is None or sys.platform == "win32":
        pytest.skip("needs a C compiler")
    return Compiled(request.param, tmp_path_factory.mktemp("formulas"))


@settings(deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
@given(data=st.data())
def test_c_writes_the_tables_of_the_model_to_the_last_bit(compiled, data):
    values = data.draw(near_defaults(compiled.model))
    assume(not compiled.model.refused(values))
    block, expected = compiled(values)[0], pack(compile_mechanism(compiled.model.build(values)))
    for field in FIELDS:
        if field.section == "tables":
            assert field_of(block, field.name).tobytes() == field_of(expected, field.name).tobytes(), field.name


@settings(deadline=None)
@given(data=st.data())
def test_c_finds_what_the_model_finds_and_says_the_same(compiled, data):
    model = compiled.model
    values = data.draw(within_limits(model) | near_defaults(model))
    findings = (*model.objections(values), *model.warnings(values))
    expected = np.array([float(x) for f in findings for x in (f.applies, *f.numbers)])
    found = compiled(values)[1]
    assert found[: len(expected)].tobytes() == expected.tobytes()
    assert compiled.messages(compiled.formulas.objections, found) == model.refused(values)
    assert compiled.messages(compiled.formulas.warnings, found) == model.warned(values)


def test_c_writes_no_other_word(compiled):
    block = compiled(compiled.model.values())[0]
    assert block.tobytes() == compiled.block.tobytes()


@needs_compiler
def test_constants_are_exact(tmp_path):
    numbers = [0.0, -0.0, 0.1, -1 / 3, 5e-324, -1e-310, 1.7976931348623157e308, 4.0, math.inf, -math.inf, math.nan]
    listed = ", ".join(map(c_number, numbers))
    library = _library(f"#include <math.h>\nconst double numbers[] = {{{listed}}};\n", tmp_path / "numbers")
    found = np.array((ctypes.c_double * len(numbers)).in_dll(library, "numbers"))
    np.testing.assert_array_equal(found, numbers)
    np.testing.assert_array_equal(np.signbit(found), np.signbit(numbers))


def test_texts_become_formats_of_printf():
    assert printf_text(Finding(1.0, "100 % of {:.6g} {{m}} and {:g}.", (1.0, 2.0))) == "100 %% of %.6g {m} and %g."


def test_every_word_that_depends_on_a_parameter_has_a_name():
    block = pack(compile_mechanism(RATCHET.build(RATCHET.values())))
    words = formulas(trace(RATCHET), block).words
    assert len({word for word, _ in words}) == len(words)
    by_value = {label: block[word] for word, label in words}
    assert by_value["inverse_mass of wheel"] == 1 / 32.7948e-3  # the last of three: its inertia
    assert by_value["joint_data of pin"] == 0.055
    assert by_value["joint_friction of wheel_hinge"] == 0
    assert by_value["pattern_pitch of teeth"] == -2 * math.pi / 10
    assert by_value["output_value of tooth_pitch"] == 2 * math.pi / 10
    assert by_value["relative_tolerance"] == 1e-9
    assert "inverse_mass of ground" not in by_value


def test_a_block_of_another_model_is_refused():
    with pytest.raises(MechanismError, match="not one of Ratchet: its table inverse_mass has another size"):
        formulas(trace(RATCHET), pack(compile_mechanism(GENEVA.build(GENEVA.values()))))
