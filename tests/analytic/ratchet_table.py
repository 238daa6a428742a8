"""The first impact of the paper's ratchet by two earlier, independent implementations.

9 redundant coordinates with eqs (3) and (7), and 3 minimal coordinates with Lagrange's equations, agreed to 1e-14; the
numbers stand here with all their printed digits.
"""

import numpy as np

#: beta_0 [deg]: t_I [s]; phi', gamma', omega [rad/s] before the impact; the same after it.
TABLE = {
    85: (0.9573080523, 0.566692226, -0.270715394, -0.000681458, 0.0192038168, -0.0069272732, 0.0228046146),
    90: (0.9399211769, 0.574072849, -0.207085356, -0.000779456, 0.0191482997, -0.0069073680, 0.0227388573),
    95: (0.9277144372, 0.579788752, -0.146091124, -0.000774514, 0.0191307988, -0.0069008794, 0.0227178290),
    100: (0.9194210908, 0.584076449, -0.087110987, -0.000672731, 0.0191521427, -0.0069081155, 0.0227425265),
    105: (0.9143304857, 0.587100938, -0.029561498, -0.000475511, 0.0192147646, -0.0069299405, 0.0228158202),
}

#: Half a unit of the last printed digit.
PRINTED = np.array([0.5e-10, 0.5e-9, 0.5e-9, 0.5e-9, 0.5e-10, 0.5e-10, 0.5e-10])
