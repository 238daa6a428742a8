"""Random parameter values of a model, as hypothesis strategies of namespaces of floats."""

from hypothesis import strategies as st


def within_limits(model):
    """Each value anywhere within its limits, often at the default or the limit itself: mostly refused by the model."""
    return _sets(model, lambda p: st.sampled_from([p.start, p.minimum, p.maximum]) | st.floats(p.minimum, p.maximum))


def near_defaults(model):
    """Values that are the default or near it (within 1 of a default 0): often accepted."""

    def choice(parameter):
        low, high = sorted((0.8 * parameter.start, 1.25 * parameter.start)) if parameter.start else (-1.0, 1.0)
        low, high = max(low, parameter.minimum), min(high, parameter.maximum)
        return st.just(parameter.start) | st.floats(low, high)

    return _sets(model, choice, most=40)


def _sets(model, real, most=1000):
    choices = {
        "Real": real,
        "Integer": lambda p: st.integers(int(p.minimum), int(min(p.maximum, most))).map(float),
        "Boolean": lambda p: st.sampled_from([0.0, 1.0]),
    }
    return st.fixed_dictionaries({p.name: choices[p.type](p).map(float) for p in model.parameters}).map(model.checked)
