"""Sine, exponential and their kin, of which every platform gives the same bits.

C libraries, and with them Python on different systems, differ in the last bit of these functions, and a mechanism with
impacts makes much of a bit. Here they are sums and products of IEEE 754 only, each within one unit in the last place.
Python runs them as they stand; the engine compiles them (`mechanism_fmu.engine.elementary`), and so does what runs the
formulas of a native FMU. See docs/decisions/047-one-library-of-functions.md.
"""

from .exponentials import exp as exp, log as log, power as power, tanh as tanh
from .trigonometric import atan2 as atan2, cos as cos, sin as sin, sine_cosine as sine_cosine, tan as tan
