"""The hash of code changes with what is computed, and with nothing else."""

import functools
import random
import subprocess
import sys
from pathlib import Path

import pytest
from fingerprint import Code, core, fingerprint, key_of

import tippe_core

FILES = {
    "top/__init__.py": "from . import laws as laws\nfrom .run import slide as slide\n",
    "top/run.py": '''
"""Runs."""
import numpy as np
from . import laws
from .laws import Law
from .plain import compiled
from .size import scaled as larger

STEPS = 100  # enough
"""Of a run."""

def slide(top: "Law", time=STEPS):
    """A run."""
    each = [step(top, t) for t in range(time)]
    return np.array(each) * larger(2.0)

@compiled
def step(top, t):
    return laws.push(top, t)

def unrelated(x):
    return x + 1
''',
    "top/laws.py": """
from dataclasses import dataclass
from math import sqrt

SLOW: float = 1e-3

@dataclass
class Law:
    mu: float = 0.3

    def k(self, u: float) -> float:
        return self.mu / deep(u)

def push(law, t):
    return law.k(t) + SLOW

def deep(u):
    from .size import least
    return least(sqrt(u), 1.0)
""",
    "top/size.py": "def scaled(x): return 2 * x\n\ndef least(a, b): return a if a < b else b\n",
    "top/plain.py": "def compiled(function): return function\n",
}


def hashed(files, name="slide"):
    code = Code(files)
    return code.hash([key for key in code.meant("top", name) if isinstance(key, tuple)])


def changed(file, old, new):
    assert FILES[file].count(old) == 1
    return FILES | {file: FILES[file].replace(old, new)}


@pytest.mark.parametrize("file, old, new", [
    ("top/size.py", "2 * x", "2 / x"),
    ("top/size.py", "a < b", "a > b"),  # three calls down, imported in a function
    ("top/laws.py", "mu: float = 0.3", "mu: float = 0.4"),
    ("top/laws.py", "self.mu / deep(u)", "self.mu * deep(u)"),  # of a class that only an annotation names
    ("top/laws.py", "1e-3", "1e-4"),
    ("top/laws.py", "from math import sqrt", "from math import cbrt as sqrt"),
    ("top/laws.py", "@dataclass\n", "@dataclass(frozen=True)\n"),
    ("top/run.py", "STEPS = 100", "STEPS = 101"),
    ("top/run.py", "time=STEPS", "time=99"),
    ("top/run.py", "import scaled as larger", "import least as larger"),
])  # fmt: skip
def test_what_changes_a_result_changes_the_hash(file, old, new):
    assert hashed(changed(file, old, new)) != hashed(FILES)


@pytest.mark.parametrize("file, old, new", [
    ("top/run.py", '"""A run."""', '"""A motion."""\n    # of a top'),
    ("top/run.py", '"""Of a run."""', ""),
    ("top/run.py", "  # enough", ""),
    ("top/run.py", "x + 1", "x - 1"),
    ("top/run.py", '"Law"', '"Law | None"'),
    ("top/run.py", "@compiled\n", ""),
    ("top/run.py", "scaled as larger", "scaled as larger, least"),
    ("top/run.py", "laws.push(top, t)", "laws.push(\n        top, t)"),
    ("top/laws.py", "u: float) -> float", "u)"),
    ("top/plain.py", "return function", "return print(function)"),
])  # fmt: skip
def test_what_changes_no_result_does_not(file, old, new):
    assert hashed(changed(file, old, new)) == hashed(FILES)


def test_code_may_move_between_files():
    """The laws to a folder of their own, in another order and with a part of them in the file of the runs."""
    law, push, deep = parts(FILES["top/laws.py"])
    moved = {
        "core/__init__.py": "from .all import slide as slide\n",
        "core/all.py": FILES["top/run.py"].replace("from . import laws", "import core.of.law as l")
        .replace("from .laws import Law", "from .of.friction import Law").replace("laws.push", "l.push")
        .replace(".size", ".of.friction").replace("from .plain import compiled", "from .of.law import compiled"),
        "core/of/law.py": f"from .friction import SLOW, Law\n{FILES['top/plain.py']}\n{push}",
        "core/of/friction.py": "from dataclasses import dataclass\nimport math\nfrom math import sqrt\n"
        f"{FILES['top/size.py']}\n{deep.replace('from .size', 'from ..of.friction')}\n{law}\nSLOW: float = 1e-3\n",
    }  # fmt: skip
    code = Code(moved)
    assert code.hash([*code.meant("core", "slide")]) == hashed(FILES)


def parts(text):
    """(the class, push, deep) of the file of laws."""
    law, rest = text[text.index("@dataclass") :].split("def push")
    push, deep = rest.split("def deep")
    return law, f"def push{push}", f"def deep{deep}"


def test_two_of_a_name_are_told_apart():
    """Who calls which of two functions counts, though the texts of all are the same."""

    def files(first, second):
        return {"a.py": "def g(x): return x + h(x)\ndef h(x): return 1\n",
                "b.py": "def g(x): return x + h(x)\ndef h(x): return 2\n",
                "c.py": f"import {first} as p, {second} as q\ndef f(x): return p.g(x) - q.g(x)\n"}  # fmt: skip

    def both(files):
        code = Code(files)
        return code.hash([*code.meant("c", "f")])

    assert both(files("a", "b")) != both(files("b", "a"))


def test_a_name_of_ones_own_is_not_the_global_one():
    """Neither a parameter, nor a local name, nor what a comprehension runs over; but its first iterable is."""
    text = "def g(x): return 1\ndef h(x): return 2\ndef f(g, n):\n    h = n\n    return [g for g in h]\n"
    code = Code({"a.py": text})
    assert code.closure(code.meant("a", "f")) == {*code.meant("a", "f")}
    code = Code({"a.py": "g = [1]\ndef f():\n    return [g for g in g]\n"})
    assert len(code.closure(code.meant("a", "f"))) == 2


def test_the_core_is_reached_through_kernels_classes_and_laws():
    code = core()

    def reached(function):
        return {key[2] for key in code.closure(key_of(function, code))}

    assert {"rates", "contensou", "hypergeometric", "Trajectory", "SLACK"} <= reached(tippe_core.slide)
    assert not reached(tippe_core.f) & {"slide", "Trajectory", "Rolling", "Kernel"}
    assert reached(tippe_core.Constants.from_state) == reached(tippe_core.Constants)


def test_a_change_of_the_core_changes_what_goes_through_it():
    """The last factor of a kernel deep below slide(): not a hash that has nothing to do with it."""
    root = Path(tippe_core.__file__).parent
    sources = {path.relative_to(root.parent).as_posix(): path for path in root.rglob("*.py")}
    (file,) = [path for path in sources if path.endswith("/friction.py")]
    text = sources[file].read_text(encoding="utf-8")
    assert "LEAST = 1e-300" in text
    other = Code(sources | {file: text.replace("LEAST = 1e-300", "LEAST = 1e-200")})
    assert fingerprint(tippe_core.slide, code=other) != fingerprint(tippe_core.slide)
    assert fingerprint(tippe_core.f, code=other) == fingerprint(tippe_core.f)


def test_it_is_the_same_in_every_process():
    """Whatever the order of sets."""
    program = "import tippe_core; from fingerprint import fingerprint; print(fingerprint(tippe_core.roll))"
    run = functools.partial(subprocess.run, capture_output=True, text=True, check=True, cwd=Path(__file__).parent)
    seed = str(random.randrange(1, 1000))
    found = run([sys.executable, "-c", program], env={"PYTHONHASHSEED": seed, "PATH": ""}).stdout.strip()
    assert found == fingerprint(tippe_core.roll)
