"""The fits of the examples; each with the default settings is stored, so that a first visitor need not wait for it.

`python -m app.model.measured.made` makes the examples and these fits again.
"""

import json
from functools import lru_cache

from app.model.measured.data import Data, settled
from app.model.measured.examples import EXAMPLES, FILMED, FOLDER, example
from app.model.measured.motion import Model
from app.model.measured.remembered import checked, stored_fit
from app.model.measured.table import Table, read
from app.model.measured.work import Found, found, found_again, models
from tippe_core import Top

LAW = "contensou"
"""The friction law of the stored fits; in them only the start and the law are free."""
STORED = FOLDER / "fits.json"


@lru_cache(maxsize=len(EXAMPLES))
def table_of_example(name: str) -> Table:
    """The Table of an example, one for all pages: a class may open it at once."""
    table = read((FOLDER / f"made-{name}.csv").read_bytes())
    for each in table.columns:
        each.values.setflags(write=False)
    return table


def _wanted(name: str, law: str, loose: tuple[str, ...]) -> tuple[Data, tuple[Model, Model]]:
    data = settled(table_of_example(name))
    return data, models(Top.paper(), FILMED.scales, FILMED, law, loose)


def is_stored(law: str, loose: tuple[str, ...]) -> bool:
    """Whether the fits of the examples are stored with this law and these free parameters."""
    return law == LAW and not loose


@lru_cache(maxsize=32)
def found_of_example(name: str, law: str, loose: tuple[str, ...]) -> Found:
    """The Found of a whole example; cached, because every visitor may ask for it."""
    data, both = _wanted(name, law, loose)
    if not is_stored(law, loose):
        return found(data, both)
    stored = json.loads(STORED.read_text(encoding="utf-8"))[name]
    return found_again(data, both, tuple(checked(each, model) for each, model in zip(stored, both, strict=True)))


def made_anew(name: str) -> Found:
    """What is stored of an example, fitted anew."""
    return found(*_wanted(name, LAW, ()))


def main() -> None:
    """Writes the examples and their fits."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name in EXAMPLES:
        (FOLDER / f"made-{name}.csv").write_text(example(name), encoding="utf-8", newline="\n")
    fits = {name: [stored_fit(fit) for fit in made_anew(name).fits] for name in EXAMPLES}
    STORED.write_text(json.dumps(fits, indent=1) + "\n", encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
