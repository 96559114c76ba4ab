"""Starts that are worth a look, for the Lab at the level "Research"."""

from types import MappingProxyType

import numpy as np

from tippe_core import Scales
from tippe_core.types import Number


def _example(toy: str, spin: float, tilt: float, **law: object) -> MappingProxyType[str, Number]:
    """It sets no table, so that the one that is shown stays."""
    return MappingProxyType({"toy": toy, "spin": spin, "tilt": tilt, "slip": 1.0} | law)


# Top S as in Rutstam's simulations, arXiv:1306.2470: viscous friction F = -1.0 N v (v in m/s), theta = 0.1, G at rest.
_GAMMA_S = float(Scales(R=0.02, M=0.02).velocity)
_S = {
    name: _example("Top S", round(spin / (2 * np.pi), 4), 5.73, law="viscous", gamma=round(_GAMMA_S, 4))
    for name, spin in (("fast", 90), ("hangs", 60), ("never", 25))
}
EXAMPLES = MappingProxyType({
    "The paper’s top by hand": _example("The paper's tippe top", 20.0, 10.0, law="smoothed", mu=0.3, eps=0.1),
    **{f"Top S {name}": example for name, example in _S.items()},
    "An ordinary top rises": _example("Wooden cone", 20.0, 15.0, law="viscous", gamma=0.3),
})  # fmt: skip
"""{name: inputs of a Lab}."""
