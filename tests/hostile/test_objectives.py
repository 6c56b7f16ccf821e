"""Own objectives: files that do not run, functions that fail or do something besides, values of every kind."""

import random
import runpy
from pathlib import Path

import numpy as np
import pytest
from support.each import each
from support.sandbox import Sandbox, lay_odd

from jumpcad.errors import JumpcadError
from jumpcad.search.study.objective import Evaluation, find_objective

JUMP = Evaluation("jump", {"fitness": 4.0})
SEARCH = ("optimize", "nsga2", "--model", "capsule", "--evaluations", "4", "--workers", "0", "--study", "s.db")
FAILING = {
    "error": "raise ValueError('a\\nb\\x1b[31m')",
    "exit": "raise SystemExit(0)",
    "key": "return m['no\\n\\x1b']",
    "key without text": "\n class K:\n  def __repr__(self): raise RuntimeError\n raise KeyError(K())",
    "none": "return None",
    "nan": "return float('nan')",
    "infinity": "return float('inf')",
    "huge": "return 10**400",
    "digits": "return 10**6000",
    "text": "return 'x'",
    "complex": "return 1j",
    "true": "return True",
    "list": "return [1.0]",
    "array": "import numpy; return numpy.ones(1)",
    "no repr": "\n class C:\n  def __repr__(self): raise RuntimeError\n return C()",
    "repr of no text": "\n class C:\n  def __repr__(self): return 5\n return C()",
    "long repr": "\n class C:\n  def __repr__(self): return 'x\\n' * 10**6\n return C()",
    "long type": "return type('a\\x1b' * 2000, (), {})()",
    "endless": "return f(m)",
    "generator": "yield 1",
    "two arguments": "return f(m, m)",
}
REFUSED = {
    "syntax": "def f(m:\n",
    "nul": "x = 1\0",
    "not utf-8": "c = 'caf\udce9'\ndef f(m): return 1.0\n",
    "error": "raise ValueError('a\\nb')",
    "exit": "import sys\nsys.exit('a\\nb')",
    "missing import": "import nonexistent_module",
    "nothing": "",
    "builtin": "f = len",
    "class": "class f:\n def __init__(self, m): pass",
    "bound": "class F:\n def f(self, m): return 1.0\nf = F().f",
}
BORNE = {
    "name of a path": "def f(m): return 1.0\nf.__name__ = 'a\\n/../x'",
    "name of a formula": "def f(m): return 1.0\nf.__name__ = '=1+1'",
    "no repr": "class C:\n def __repr__(s): raise RuntimeError\nc = C()\ndef f(m): c; return 1.0",
    "no copy": "class C:\n def __reduce_ex__(s, n): raise RuntimeError\nc = C()\ndef f(m): c; return 1.0",
    "many values": "c = list(map(float, range(300_000)))\ndef f(m): return 1.0",
    "within itself": "c = []\nc.append(c)\ndef f(m): c; return 1.0",
    "deep list": "c = []\nfor i in range(50_000): c = [c]\ndef f(m): c; return 1.0",
    "chain": "def f0(m): return 1.0\n"
    + "".join(f"def f{i}(m): return f{i - 1}(m)\n" for i in range(1, 3000))
    + "def f(m): return f2999 and 1.0",
    "digits": "c = 10**6000\ndef f(m): c; return 1.0",
    "half a character": "c = '\\ud800'\ndef f(m): c; return 1.0",
    "name without value": "def make():\n def f(m): return x if 0 else 1.0\n if 0: x = 1\n return f\nf = make()",
    "lock": "import threading\nc = threading.Lock()\ndef f(m): c; return 1.0",
    "open file": "import os\nc = open(os.devnull)\ndef f(m): c; return 1.0",
    "no builtins": "del __builtins__\ndef f(m): return 1.0",
    "dataclass": "from dataclasses import dataclass\n@dataclass\nclass W:\n a: int = 1\nc = W()\ndef f(m): return c.a",
    "enumeration": "import enum\nclass E(enum.Enum):\n A = 1\ndef f(m): return E.A.value",
    "empties what it gets": "def f(m): m.clear(); return 1.0",
}


def refusal(call: object) -> str:
    with pytest.raises(JumpcadError) as caught:
        call()  # type: ignore[operator]
    said = str(caught.value)
    assert 0 < len(said) < 500
    assert said.isprintable()
    return said


@each("case", FAILING)
def test_a_function_that_fails_is_a_line(sandbox: Sandbox, case: str) -> None:
    sandbox.write("o.py", f"def f(m):\n {FAILING[case]}\n")
    with sandbox.untouched():
        refusal(lambda: find_objective("o.py:f").score(JUMP))


@each("case", REFUSED)
def test_a_file_without_a_usable_function_is_a_line(sandbox: Sandbox, case: str) -> None:
    sandbox.write("o.py", REFUSED[case])
    with sandbox.untouched():
        refusal(lambda: find_objective("o.py:f"))


@each("case", BORNE)
def test_a_function_may_use_anything(sandbox: Sandbox, case: str) -> None:
    """Given as a file's, of which the text is hashed, or as itself, with the values that it uses."""
    sandbox.write("o.py", BORNE[case])
    with sandbox.untouched():
        for given in ("o.py:f", runpy.run_path("o.py")["f"]):
            assert find_objective(given).score(JUMP) == 1.0


def test_an_interrupt_in_an_objective_is_one(sandbox: Sandbox) -> None:
    sandbox.write("o.py", "def f(m):\n raise KeyboardInterrupt\n")
    sandbox.run(*SEARCH, "--objective", "o.py:f", "--json", exits=(130,), writes=["s.db"])


BESIDES = """
import os, random, sys
import numpy as np
print("loaded")
os.chdir("/")
def f(m):
    print("scored")
    random.seed(1)
    np.random.seed(1)
    os.chdir("/")
    return 1.0
"""


def test_what_an_objective_does_besides_disturbs_nothing(sandbox: Sandbox, capfd: pytest.CaptureFixture[str]) -> None:
    """Nor the document on standard output, nor where files go, nor the search's own random numbers."""
    sandbox.write("o.py", BESIDES)
    state, by_numpy = random.getstate(), np.random.get_state()[1].tolist()  # noqa: NPY002
    with sandbox.untouched():
        assert find_objective("o.py:f").score(JUMP) == 1.0
    printed = capfd.readouterr()
    assert printed.out == ""
    assert printed.err.split() == ["loaded", "scored"]
    assert Path.cwd() == sandbox.work
    assert random.getstate() == state
    assert np.random.get_state()[1].tolist() == by_numpy  # noqa: NPY002


PLACES = ["o.py:", ":f", "o.py:f:g", "o.txt:f", "o.py:1", "folder.py:f", "pipe.py:f", "device.py:f", "loop.py:f",
          "no.py:f", "\0.py:f", f"{'x' * 5000}.py:f", "a\n\x1b.py:f", "\ud800.py:f", "o.py:__name__"]  # fmt: skip


@each("place", PLACES)
def test_a_place_without_a_function_is_a_line(sandbox: Sandbox, place: str) -> None:
    sandbox.write("o.py", "def f(m): return 1.0\n")
    for kind in ("folder", "pipe", "device", "loop"):
        lay_odd(sandbox.work / f"{kind}.py", kind)
    sandbox.run(*SEARCH, "--objective", place, "--json", exits=(2,))
