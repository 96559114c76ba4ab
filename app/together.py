"""Several values of one object as one change."""

import param
from param.parameterized import batch_call_watchers


def set_together(owner: param.Parameterized, **values: object) -> None:
    """Sets these parameters; their watchers are called once for all of them. `param.update` does the same, but reads
    all other parameters of the owner first."""
    with batch_call_watchers(owner):
        for name, value in values.items():
            setattr(owner, name, value)
