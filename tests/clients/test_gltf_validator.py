"""Khronos' validator has nothing to say about a GLB file, not even a hint."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest
from support.built import built

from jumpcad.bundle.motion import jump_motion
from jumpcad.exporters.glb import animated, write_glb

PROGRAM = """
const validator = require("gltf-validator"), fs = require("fs");
validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1]))).then(
  (report) => console.log(JSON.stringify({issues: report.issues, info: report.info})));
"""


def test_a_robot_and_its_jump_are_valid(tmp_path: Path) -> None:
    node = shutil.which("node")
    if node is None or subprocess.run([node, "-e", 'require("gltf-validator")'], capture_output=True).returncode:
        # Not "installed": `.ci/run` promises it only where there is Node.js, so its lack fails no run.
        pytest.skip("no gltf-validator here (npm install gltf-validator, and NODE_PATH)")
    robot = built("kenan-2.0")
    motion = jump_motion(robot)
    assert motion is not None
    for count, glb in ((0, write_glb(robot)), (2, animated(write_glb(robot), motion))):
        file = tmp_path / "robot.glb"
        file.write_bytes(glb)
        done = subprocess.run([node, "-e", PROGRAM, str(file)], capture_output=True, text=True, check=True)
        report = json.loads(done.stdout)
        assert report["issues"]["messages"] == []
        assert report["info"]["animationCount"] == count
