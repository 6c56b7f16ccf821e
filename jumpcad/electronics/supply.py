"""Supply of the motor: battery, driver and PWM, and the power of the boards (V, A, ohm, N·m, W).

A brushed motor is linear: with the resistance R = V/I_stall and the constants k of torque and voltage, a source of U
in series with a resistance r turns the unloaded shaft with (U - I_0·(R + r))/k and stalls it with U/(R + r).
"""

from dataclasses import dataclass

from jumpcad.catalogue import Motor
from jumpcad.electronics.chosen import Chosen


@dataclass(frozen=True)
class Supply:
    """A battery with a driver.

    Attributes
    ----------
    empty_v, nominal_v, full_v
        Of the battery without load.
    ohm
        Of battery and driver in series with the motor; the battery's is counted as if PWM did not lower its current.
    boards_w
        Power of controller, driver and regulator at the nominal voltage, whether the motor turns or not. The 1 to 2 mA
        of the sensor's pull-up are not counted: they are within the scatter of the boards' currents.
    usable_j
        Energy of a full battery.
    """

    empty_v: float
    nominal_v: float
    full_v: float
    ohm: float
    boards_w: float
    usable_j: float

    def duty(self, motor: Motor, torque_max_nm: float) -> float:
        """Return the largest mean share of a full battery's voltage that overloads neither gearbox nor winding.

        At most 1. The series resistance, which is not known well, is neglected: this is on the safe side.
        """
        rise = (motor.stall_current_a - motor.no_load_current_a) / motor.stall_torque_nm
        stall_v = _ohm(motor) * (motor.no_load_current_a + rise * torque_max_nm)
        return min(1.0, stall_v / self.full_v, motor.range_v[1] / self.full_v)

    def pwm(self, motor: Motor, torque_max_nm: float) -> float:
        """Return the share of PWM that gives the motor `duty` of the battery's voltage.

        The driver's other input is at ground: in the pauses both its outputs are off, and the current flows on against
        the battery through the diodes ("fast decay", TI DRV8833, table of PWM control). The mean is 2·share - 1 while
        current flows all the time, as it does at 20 kHz where the winding's L/R is 0.1 ms or more: judgement.
        """
        return (1.0 + self.duty(motor, torque_max_nm)) / 2.0

    def driven(self, motor: Motor, volts: float, torque_max_nm: float) -> Motor:
        """Return the motor as it behaves with the battery at some volts, under PWM: speed, stall and voltage."""
        mean_v = self.duty(motor, torque_max_nm) * volts
        ohm, unloaded = _ohm(motor), motor.no_load_current_a
        stall_a = mean_v / (ohm + self.ohm)
        speed = (mean_v - unloaded * (ohm + self.ohm)) / (motor.voltage_v - unloaded * ohm)
        torque = (stall_a - unloaded) / (motor.stall_current_a - unloaded)
        return motor.model_copy(
            update={
                "voltage_v": mean_v,
                "no_load_rpm": speed * motor.no_load_rpm,
                "stall_torque_nm": torque * motor.stall_torque_nm,
                "stall_current_a": stall_a,
            }
        )


def _ohm(motor: Motor) -> float:
    return motor.voltage_v / motor.stall_current_a


def boards_beside_a(chosen: Chosen) -> float:
    """Return what driver and regulator draw from the battery while something else feeds the controller."""
    return chosen.driver.quiescent_a + (chosen.regulator.quiescent_a if chosen.regulator else 0.0)


def supply_of(chosen: Chosen) -> Supply:
    """Return what a workshop's parts supply a motor with."""
    battery, regulator = chosen.battery, chosen.regulator
    empty, full = battery.range_v
    behind_v = battery.voltage_v if regulator is None else (regulator.output_v or battery.voltage_v)
    share = 1.0 if regulator is None else regulator.efficiency
    boards_w = chosen.controller.quiescent_a * behind_v / share + boards_beside_a(chosen) * battery.voltage_v
    return Supply(
        empty_v=empty,
        nominal_v=battery.voltage_v,
        full_v=full,
        ohm=battery.ohm + chosen.driver.resistance_ohm,
        boards_w=boards_w,
        usable_j=3.6 * battery.capacity_mah * battery.voltage_v,
    )
