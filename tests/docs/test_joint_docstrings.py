"""What a joint's docstring says of its outputs."""

import re
from typing import get_args

import pytest

from mechanism_fmu.model.joints import Joint


@pytest.mark.parametrize("joint", get_args(Joint), ids=lambda joint: joint.__name__)
def test_a_joint_names_its_forces_itself_with_their_units(joint):
    """So that nobody has to look for their signs elsewhere."""
    said = re.search(r"^    Outputs: (.*?)\n\n", joint.__doc__, re.MULTILINE | re.DOTALL)
    named = set(re.findall(r"`(\w*(?:force|torque)\w*)`", said[1] if said else ""))
    assert named == set(joint.efforts)
    assert not said or re.search(r"\[N(?: m)?\]", said[1])
