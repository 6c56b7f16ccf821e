"""From a design to its drive in plain numbers: torsion springs, snail cam, gear train and motor."""

from jumpcad.drive.cam import Cam, CamGeometry
from jumpcad.drive.cam_law import CamLaw
from jumpcad.drive.cam_limits import CamLimits
from jumpcad.drive.gears import Gear, GearPair
from jumpcad.drive.motor import TrainLimits
from jumpcad.drive.spring import SpringLimits, TorsionSpring
from jumpcad.drive.synthesis import Drive, DriveLimits, synthesise
from jumpcad.drive.train import GearTrain

__all__ = [
    "Cam", "CamGeometry", "CamLaw", "CamLimits", "Drive", "DriveLimits", "Gear", "GearPair", "GearTrain",
    "SpringLimits", "TorsionSpring", "TrainLimits", "synthesise",
]  # fmt: skip
