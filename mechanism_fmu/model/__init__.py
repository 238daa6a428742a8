"""What a mechanism is: frozen records with SI units, and no numerics.

Here are all parts, curves, ports and their builders, the `Mechanism` that holds them, the `Model` that makes it from
parameters, and `compile_mechanism`, which checks it and writes the tables that the engine reads. Beside them, for a
model's formulas, objections and state charts: `functions`, `findings`, `transitions`.
"""

from types import ModuleType as _Module

from ..codes import EVENT_BUFFER_LENGTH as EVENT_BUFFER_LENGTH, IMPACT_BUFFER_LENGTH as IMPACT_BUFFER_LENGTH
from .analysis import (
    Arm as Arm,
    ImpactStress as ImpactStress,
    RectangularTooth as RectangularTooth,
    SawtoothWheel as SawtoothWheel,
    SeriesCompliance as SeriesCompliance,
    Strut as Strut,
    TableBeam as TableBeam,
    TrapezoidTooth as TrapezoidTooth,
    WedgeTooth as WedgeTooth,
)
from .areas import CircularHole as CircularHole
from .body import GROUND as GROUND, Body as Body, End as End
from .cases import Case as Case, SineSignal as SineSignal, TableSignal as TableSignal
from .clearance_joints import ClearanceJoint as ClearanceJoint, SlotClearanceJoint as SlotClearanceJoint
from .compile import MechanismTables as MechanismTables, compile_mechanism as compile_mechanism
from .contacts import (
    AngleLock as AngleLock,
    AngleStop as AngleStop,
    Contact as Contact,
    PointLineContact as PointLineContact,
)
from .curves import Curve as Curve, Piece as Piece, Term as Term, constant as constant, cosine as cosine, sine as sine
from .curves.motions import (
    Law as Law,
    Move as Move,
    cycloidal as cycloidal,
    dwell as dwell,
    harmonic_motion as harmonic_motion,
    modified_sine as modified_sine,
    polynomial_345 as polynomial_345,
    polynomial_motion as polynomial_motion,
    table_motion as table_motion,
)
from .curves.profiles import (
    circle as circle,
    harmonic_profile as harmonic_profile,
    motion_profile as motion_profile,
    piecewise_profile as piecewise_profile,
    slot as slot,
    spline_profile as spline_profile,
)
from .default_ports import default_outputs as default_outputs
from .drawing import (
    Bar as Bar,
    Disc as Disc,
    Hinge as Hinge,
    Link as Link,
    Polyline as Polyline,
    Rod as Rod,
    Shape as Shape,
    Spring as Spring,
    Striker as Striker,
    Trace as Trace,
    Wheel as Wheel,
)
from .errors import MechanismError as MechanismError
from .findings import Finding as Finding
from .forces import *  # noqa: F403 a new force element is public by its own file
from .joints import (
    AngleDriver as AngleDriver,
    CamFlatFollower as CamFlatFollower,
    CamFollower as CamFollower,
    Distance as Distance,
    DistanceDriver as DistanceDriver,
    Gears as Gears,
    InternalGears as InternalGears,
    PointFollower as PointFollower,
    RackAndPinion as RackAndPinion,
    Revolute as Revolute,
    RevoluteTranslational as RevoluteTranslational,
    Translational as Translational,
    TranslationalDriver as TranslationalDriver,
    XDriver as XDriver,
    YDriver as YDriver,
)
from .laws import characteristic as characteristic
from .logic import LogicalFunction as LogicalFunction
from .mechanism import Mechanism as Mechanism, Settings as Settings
from .members import (
    LumpedBody as LumpedBody,
    LumpedMass as LumpedMass,
    Member as Member,
    Section as Section,
    lumped_body as lumped_body,
)
from .model import Model as Model
from .outline_contacts import (
    CircularCopies as CircularCopies,
    LinearCopies as LinearCopies,
    OutlineContact as OutlineContact,
)
from .outlines import Outline as Outline, from_svg_path as from_svg_path, svg_path as svg_path
from .outlines.ready import (
    deadbeat_pallet as deadbeat_pallet,
    escape_tooth as escape_tooth,
    geneva_sector as geneva_sector,
    hook as hook,
    involute_tooth as involute_tooth,
    pin_tooth as pin_tooth,
    ratchet_tooth as ratchet_tooth,
    recoil_pallet as recoil_pallet,
    round_hole as round_hole,
    slot_hole as slot_hole,
)
from .patterns import CircularPattern as CircularPattern
from .port_builders import *  # noqa: F403
from .ports import Calculated as Calculated, Input as Input, Output as Output, Parameter as Parameter
from .quantities import cm as cm, deg as deg, mm as mm, quantity as quantity, rpm as rpm
from .sketch import FourBarPoints as FourBarPoints, dyad as dyad, four_bar_points as four_bar_points, toward as toward
from .solids import (
    ALUMINIUM as ALUMINIUM,
    BRASS as BRASS,
    POM as POM,
    STEEL as STEEL,
    Material as Material,
    bar as bar,
    disc as disc,
    plate as plate,
    rigid_body as rigid_body,
)

__all__ = [name for name, value in list(globals().items()) if not (name.startswith("_") or isinstance(value, _Module))]
