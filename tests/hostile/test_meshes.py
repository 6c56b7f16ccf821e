"""Meshes of a bundle from a stranger, listed in its manifest as they are."""

import hashlib
import json
from pathlib import Path

import numpy as np
from support.each import each
from support.sandbox import Sandbox

VALUES = {"far": 1e30, "infinity": np.inf, "nothing": np.nan, "beyond": 3000.0}


@each("case", VALUES)
def test_a_mesh_that_is_no_part_is_refused(sandbox: Sandbox, bundle: Path, case: str) -> None:
    path = bundle / "stl" / "main_leg.stl"
    content = bytearray(path.read_bytes())
    content[96:100] = np.float32(VALUES[case]).tobytes()  # x of the first corner of a binary STL
    path.write_bytes(content)
    manifest = json.loads((bundle / "manifest.json").read_text())
    manifest["files"]["stl/main_leg.stl"] = hashlib.sha256(content).hexdigest()
    (bundle / "manifest.json").write_text(json.dumps(manifest))
    sandbox.run("slice", "robot", "--json", exits=(1, 2))
