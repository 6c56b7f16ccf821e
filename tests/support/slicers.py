"""Programs that pretend to be PrusaSlicer."""

OBEDIENT = """
import sys
arguments = sys.argv[1:]
if "--help" in arguments:
    sys.exit(print("PrusaSlicer-2.9.1+fake based on Slic3r"))
value = lambda option: arguments[arguments.index(option) + 1]
settings = dict(line.rstrip("\\n").split(" = ", 1) for line in open(value("--load")) if " = " in line)
settings |= {"estimated printing time (normal mode)": "1h 2m 30s"}
TAMPER
with open(value("--output"), "w") as gcode:
    gcode.write("M83\\n;HEIGHT:0.2\\n;TYPE:Perimeter\\nG1 X0 Y0\\nG1 X10 Y0 E100\\n")
    gcode.writelines(f"; {key} = {value}\\n" for key, value in settings.items())
"""
"""Takes every setting over; what replaces `TAMPER` may change them."""
