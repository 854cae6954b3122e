#!/usr/bin/env python3
"""A hand under a tap, from Python: steps the fluid, ticks the servo, prints the force. Standard library only.

    python3 examples/hapflow_ctypes.py target/release/libhapflow.so
    python3 examples/hapflow_ctypes.py LIBRARY 0.5 "fluid.spacing = 0.01"      seconds, and settings, one a line
"""
import sys
from ctypes import CDLL, POINTER, Structure, byref, c_char_p, c_double, c_size_t, c_uint32, c_uint64, c_void_p
from ctypes import create_string_buffer, sizeof


class Config(Structure):  # the structs are those of the headers; of this one the first fields, as its size says
    _fields_ = [("kind", c_uint32), ("size", c_uint32), ("next", c_void_p), ("scene", c_char_p), ("toml", c_char_p),
                ("toml_length", c_size_t), ("settings", c_char_p), ("threads", c_uint32), ("fluid_drive", c_uint32)]


class Session(Structure):
    _fields_ = [("id", c_uint64)]


class ToolState(Structure):
    _fields_ = [("size", c_uint32), ("tool", c_uint32), ("buttons", c_uint32), ("reserved", c_uint32),
                ("time_s", c_double), ("dt_s", c_double), ("position", c_double * 3), ("orientation", c_double * 4),
                ("velocity", c_double * 3), ("angular_velocity", c_double * 3)]


class Wrench(Structure):
    _fields_ = [("force", c_double * 3), ("torque", c_double * 3)]


lib = CDLL(sys.argv[1] if len(sys.argv) > 1 else "libhapflow.so")
lib.hapflow_fluid_advance.argtypes = [Session, c_double]
lib.hapflow_servo_tick.argtypes = [Session, POINTER(ToolState), POINTER(Wrench)]
lib.hapflow_session_destroy.argtypes = [Session]
lib.hapflow_last_error.argtypes = [c_char_p, c_size_t, POINTER(c_size_t)]
lib.hapflow_result_text.restype = c_char_p


def check(result):
    """Ends the program if something failed. A positive result is but a remark."""
    if result < 0:
        detail = create_string_buffer(512)
        lib.hapflow_last_error(detail, sizeof(detail), byref(c_size_t()))
        sys.exit(f"{lib.hapflow_result_text(result).decode()}\n{detail.value.decode()}")


check(lib.hapflow_negotiate(1, 1, byref(c_uint32())))
config, session, state, wrench = Config(), Session(), ToolState(), Wrench()
check(lib.hapflow_session_config_init(byref(config), sizeof(config)))
config.scene = b"tap"
config.settings = sys.argv[3].encode() if len(sys.argv) > 3 else None
check(lib.hapflow_session_create(byref(config), byref(session)))
check(lib.hapflow_tool_state_init(byref(state), sizeof(state)))  # at rest in the origin; dt_s is 1 ms
for n in range(round(float(sys.argv[2] if len(sys.argv) > 2 else 0.5) * 1000)):
    state.time_s = n * 1e-3
    check(lib.hapflow_fluid_advance(session, state.time_s))
    check(lib.hapflow_servo_tick(session, byref(state), byref(wrench)))
    if n % 50 == 0:
        print(f"{state.time_s:.3f} s", *(f"{f:8.4f}" for f in wrench.force), "N")
check(lib.hapflow_session_destroy(session))
