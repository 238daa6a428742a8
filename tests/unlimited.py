"""A model whose parameters, but for two, have no limits: only the check of its mechanism keeps nonsense out."""

from types import SimpleNamespace

from mechanism_fmu.model import (
    GROUND,
    AngleStop,
    Body,
    CircularPattern,
    CompliantShaft,
    Finding,
    Input,
    LogicalFunction,
    Mechanism,
    Model,
    Output,
    Parameter,
    PointLineContact,
    Revolute,
    Settings,
    TorsionSpring,
    Translational,
)

#: Every number but `mass`, `restitution`, `friction`, `guided` and `tolerance` is multiplied by scale * scale, which
#: may overflow.
STARTS = {
    "scale": 1.0,
    "mass": 1.0,
    "inertia": 0.1,
    "start": 0.0,
    "point": 0.5,
    "axis": 1.0,
    "tooth_length": 0.1,
    "stiffness": 3.0,
    "damping": 0.5,
    "normal": -1.0,
    "restitution": 0.0,
    "row_restitution": 0.0,
    "enabled": 1.0,
    "pitch": 0.5,
    "limit": 1.0,
    "gain": 10.0,
    "tolerance": 1e-9,
}


def _mechanism(values: SimpleNamespace) -> Mechanism:
    scaled = SimpleNamespace(**{name: getattr(values, name) * (values.scale * values.scale) for name in STARTS})
    far = (0.0, 9.0)
    normal = (0.0, scaled.normal)
    return Mechanism(
        bodies=(
            Body(
                "arm", values.mass, scaled.inertia, (scaled.point, 0.0, scaled.start), tooth_length=scaled.tooth_length
            ),
            Body("slider {100 %}", scaled.mass, values.mass, (0.0, 0.0, 0.0), (scaled.start, 0.0, 0.0)),
        ),
        joints=(
            Revolute("hinge", "arm", (-scaled.point, 0.0), GROUND, (0.0, 0.0), values.friction),
            Translational("guide", "slider {100 %}", (0.0, 0.0), (scaled.axis, 0.0), GROUND, (0.0, 0.0), (1.0, 0.0)),
        ),
        forces=(
            TorsionSpring("spring", "arm", stiffness=scaled.stiffness),
            CompliantShaft("shaft", "arm", stiffness=values.stiffness, damping=scaled.damping),
        ),
        contacts=(
            PointLineContact(
                "stop {}",
                "arm",
                (0.5, 0.0),
                GROUND,
                far,
                normal,
                restitution=values.restitution,
                friction=values.friction,
                guided=values.guided,
                enabled=scaled.enabled,
            ),
            PointLineContact(
                "row",
                "arm",
                (0.5, 0.0),
                GROUND,
                far,
                normal,
                restitution=scaled.row_restitution,
                closed_while="not low",
            ),
            AngleStop("latch", "arm", GROUND, -0.1, scaled.pitch, scaled.restitution),
        ),
        patterns=(
            CircularPattern(
                "teeth", "arm", (0.5, 0.0), GROUND, scaled.pitch, (0.0, 0.1), (0.0, -scaled.normal), scaled.enabled
            ),
        ),
        functions=(LogicalFunction("low", "arm.angle", scaled.limit),),
        inputs=(Input("angle", "shaft.angle", 0.0, "Angle of the driven end", "rad"),),
        outputs=(Output("arm_angle", "arm.angle", "Angle of the arm", "rad"),),
        settings=Settings(values.tolerance, scaled.gain, values.gain),
    )


def _objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    return (Finding(-1000 - values.mass, "mass = {:g} kg is what the model objects to.", (values.mass,)),)


MODEL = Model(
    "Unlimited",
    "Parameters without limits",
    (
        *(Parameter(name, start, f"Number {name}") for name, start in STARTS.items()),
        Parameter("friction", 0.0, "Friction, with a limit", minimum=0.0),
        Parameter("guided", 0.0, "A switch", type="Boolean"),
    ),
    _mechanism,
    _objections,
)
