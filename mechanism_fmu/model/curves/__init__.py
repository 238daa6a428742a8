"""Curves: functions of one variable that parts of a mechanism follow.

- `pieces`: a curve in pieces, and splines through given points
- `motions`: motions over time for drivers, and laws of motion for cams; `profiles`: of cams and slots
- `check_curves`: what cannot be right of their numbers
"""

from .pieces import (
    Curve as Curve,
    Piece as Piece,
    Term as Term,
    constant as constant,
    cosine as cosine,
    plain_places as plain_places,
    sine as sine,
    spline_pieces as spline_pieces,
)
