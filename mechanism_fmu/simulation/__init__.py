"""Simulation of a mechanism in Python: step by step (`Simulation`), or in one line (`simulate`)."""

from ..moving import (
    Event as Event,
    Impact as Impact,
    SimulationError as SimulationError,
    StepBudgetError as StepBudgetError,
)
from .friction_solutions import FrictionSolution as FrictionSolution, friction_solutions as friction_solutions
from .result import Result as Result, Statistics as Statistics
from .simulate import simulate as simulate
from .simulation import Simulation as Simulation
