"""A four-bar linkage and a dyad on its rocker by closed forms, with lengths that may not reach each other."""

from types import SimpleNamespace

from mechanism_fmu.model import GROUND, Finding, Mechanism, Model, Parameter, Revolute, bar, dyad, four_bar_points

_LIMITS = {"minimum": 1e-3, "maximum": 10.0}


def _mechanism(values: SimpleNamespace) -> Mechanism:
    lengths = {"crank": values.crank, "coupler": values.coupler, "rocker": values.rocker}
    fixed, driving, driven, hinge = four_bar_points((0.0, 0.0), (values.ground, 0.0), **lengths, angle=1.0)
    pin = dyad(driven, (0.5, 0.0), from_a=values.rod, from_b=0.3, side="right")
    crank = bar("crank", fixed, driving, mass=1.0)
    coupler = bar("coupler", driving, driven, mass=1.0)
    rocker = bar("rocker", driven, hinge, mass=1.0)
    rod = bar("rod", driven, pin, mass=1.0)
    lever = bar("lever", pin, (0.5, 0.0), mass=1.0)
    return Mechanism(
        bodies=(crank, coupler, rocker, rod, lever),
        joints=(
            Revolute("a", crank.a, GROUND.at(0.0, 0.0)),
            Revolute("b", crank.b, coupler.a),
            Revolute("c", coupler.b, rocker.a),
            Revolute("d", rocker.b, GROUND.at(*hinge)),
            Revolute("e", rocker.a, rod.a),
            Revolute("f", rod.b, lever.a),
            Revolute("g", lever.b, GROUND.at(0.5, 0.0)),
        ),
    )


def _objections(values: SimpleNamespace) -> tuple[Finding, ...]:
    return (Finding(values.crank - 5, "crank = {:g} m is what the model objects to.", (values.crank,)),)


MODEL = Model(
    "Reaching",
    "Links by closed forms",
    tuple(
        Parameter(name, start, f"Length of the {name}", "m", **_LIMITS)
        for name, start in {"crank": 0.05, "coupler": 0.18, "rocker": 0.12, "ground": 0.2, "rod": 0.3}.items()
    ),
    _mechanism,
    _objections,
)

#: Values that are refused: of the first links that do not reach each other, of the second, of both, and what the model
#: objects to before it calculates any point.
REFUSED = {
    "coupler too short": {"coupler": 0.02},
    "coupler too long": {"coupler": 3.0, "rocker": 0.5},
    "rod too long": {"rod": 0.9},
    "both": {"coupler": 0.02, "rod": 0.9},
    "objected to": {"crank": 6.0, "rod": 0.9},
}
