"""Bundles for independent programs, and what those must read in them."""

import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from jumpcad.bundle.manifest import Bundle
from jumpcad.mechanism.model import body_poses
from jumpcad.robot.robot import Robot
from jumpcad.scene.visuals import visuals
from support import needs


@dataclass(frozen=True)
class Case:
    """A robot and its bundle; `com_m` (3,) and `extents_m` (2, 3) are those of the robot standing at rest."""

    robot: Robot
    bundle: Bundle

    @property
    def com_m(self) -> np.ndarray:
        poses = body_poses(self.robot)
        moment = sum(body.mass_kg * (poses[name] @ [*body.com_m, 1.0])[:3] for name, body in self.robot.bodies.items())
        return moment / self.robot.mass_kg

    @property
    def extents_m(self) -> np.ndarray:
        poses, points = body_poses(self.robot), []
        for shape in visuals(self.robot):
            pose = poses[shape.body] @ shape.T_body_mesh
            points.append(shape.mesh.vertices / 1000.0 @ pose[:3, :3].T + pose[:3, 3])
        everything = np.concatenate(points)
        return np.stack([everything.min(axis=0), everything.max(axis=0)])

    @property
    def sdf(self) -> Path:
        return self.bundle.folder / "sdf" / f"{self.robot.name}.sdf"

    @property
    def mjcf(self) -> Path:
        return self.bundle.folder / "mjcf" / f"{self.robot.name}.xml"

    @property
    def scene(self) -> Path:
        return self.bundle.folder / "mjcf" / "scene.xml"


def run(*command: str | Path) -> str:
    """Return what a program prints; skip if it is not installed, fail if it fails.

    ADMesh prints the end of a file's header as it finds it in memory, which may be no text.
    """
    needs.program(str(command[0]))
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=120, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout + done.stderr


def same_tensor(read: np.ndarray, written: np.ndarray, rel: float = 1e-9) -> bool:
    """Compare two inertia tensors (3, 3), relative to their largest moment."""
    return bool(np.abs(read - written).max() <= rel * np.abs(written).max())
