"""A null pointer where the FMU would write is refused in the log, and nothing else happens (FMI 2.0)."""

from ctypes import byref, c_char, c_size_t, c_void_p

from fmpy.fmi2 import fmi2Error, fmi2LastSuccessfulTime, fmi2Terminated

from tests.fmu.conformance.host import Instance


def test_null_pointers_for_results_are_refused(native_ratchet):
    with Instance(native_ratchet) as one:
        one.begin().step(0.1)
        slave, component = one.slave, one.slave.component
        state, size = one.save(), c_size_t()
        assert slave.fmi2SerializedFMUstateSize(component, state, byref(size)) == 0
        room = (c_char * size.value)()
        calls = {
            "fmi2GetFMUstate": (None,),
            "fmi2SetFMUstate": (None,),
            "fmi2SerializedFMUstateSize": (state, None),
            "fmi2SerializeFMUstate": (state, None, size),
            "fmi2DeSerializeFMUstate": (room, size, None),
            "fmi2GetReal": (None, 1, None),
            "fmi2SetReal": (None, 1, None),
            "fmi2GetRealStatus": (fmi2LastSuccessfulTime, None),
            "fmi2GetBooleanStatus": (fmi2Terminated, None),
        }
        for name, arguments in calls.items():
            before = len(one.log)
            # straight into the library: fmpy's own wrapper would raise
            assert getattr(slave.dll, name)(c_void_p(component), *arguments) == fmi2Error, name
            (message,) = one.log[before:]
            assert "null" in message.text or "too small" in message.text, message
        slave.freeFMUstate(state)
        one.step(0.1)
