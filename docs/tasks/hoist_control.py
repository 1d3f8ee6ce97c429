"""A speed controller that drives kurbel's hoist through FMI 3.0: python3 hoist_control.py FOLDER, the unpacked component."""
import ctypes
import pathlib
import sys
import xml.etree.ElementTree as xml

folder = pathlib.Path(sys.argv[1]).resolve()
root = xml.parse(folder / "modelDescription.xml").getroot()
name = root.find("CoSimulation").get("modelIdentifier")
reference = {v.get("name"): int(v.get("valueReference")) for v in root.find("ModelVariables")}
fmi = ctypes.CDLL(str(folder / f"binaries/x86_64-linux/{name}.so"))

number, boolean, size, text, nothing = ctypes.c_double, ctypes.c_bool, ctypes.c_size_t, ctypes.c_char_p, None
logger = ctypes.CFUNCTYPE(nothing, ctypes.c_void_p, ctypes.c_int, text, text)(lambda _, status, kind, said: print(said.decode()))
fmi.fmi3InstantiateCoSimulation.restype = ctypes.c_void_p
hoist = ctypes.c_void_p(fmi.fmi3InstantiateCoSimulation(
    b"hoist", root.get("instantiationToken").encode(), f"{folder}/resources/".encode(), boolean(False), boolean(False),
    boolean(False), boolean(False), nothing, size(0), nothing, logger, nothing))


def call(function, *arguments):
    if getattr(fmi, function)(hoist, *arguments) != 0:
        raise RuntimeError(function)


def put(variable, value):
    call("fmi3SetFloat64", ctypes.byref(ctypes.c_uint32(reference[variable])), size(1), ctypes.byref(number(value)), size(1))


def get(variable):
    value = number()
    call("fmi3GetFloat64", ctypes.byref(ctypes.c_uint32(reference[variable])), size(1), ctypes.byref(value), size(1))
    return value.value


put("motor.command", 0), put("brake.command", 0)
call("fmi3EnterInitializationMode", boolean(False), number(0), number(0), boolean(False), number(0))
call("fmi3ExitInitializationMode")
sum_of_errors, dt = 0.0, 0.005
for k in range(800):
    wanted = min(60.0, 40.0 * k * dt)  # rad/s: a ramp, then constant
    error = wanted - get("speed.motor")
    sum_of_errors += error * dt
    put("motor.command", max(-1.0, min(1.0, 0.02 * error + 0.05 * sum_of_errors)))
    events, terminate, early, reached = boolean(), boolean(), boolean(), number()
    call("fmi3DoStep", number(k * dt), number(dt), boolean(True), *map(ctypes.byref, (events, terminate, early, reached)))
    if (k + 1) % 200 == 0:
        print(f"{reached.value:.0f} s: {get('speed.motor'):.2f} rad/s, {get('torque.motor'):.1f} N*m, "
              f"command {get('motor.command'):.4f}")
call("fmi3Terminate")
fmi.fmi3FreeInstance(hoist)
