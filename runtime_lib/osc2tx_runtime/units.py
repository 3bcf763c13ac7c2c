"""Physical types and units of the standard library.

Units are SI factors: `35 * kph` is a speed in m/s. Those with an offset are functions, because a
factor cannot say them: `celsius(20)` is 293.15 (kelvin). The factors are exact where the standard
prints rounded ones (`kph` is 1/3.6, `deg` is pi/180, `mph` is 0.44704).
"""

from __future__ import annotations

import math
from typing import TypeAlias

# Physical types: numbers in SI units
Length: TypeAlias = float  # m
Time: TypeAlias = float  # s
Speed: TypeAlias = float  # m/s
Acceleration: TypeAlias = float  # m/s^2
Jerk: TypeAlias = float  # m/s^3
Angle: TypeAlias = float  # rad
AngularRate: TypeAlias = float  # rad/s
AngularAcceleration: TypeAlias = float  # rad/s^2
Mass: TypeAlias = float  # kg
Temperature: TypeAlias = float  # K
Pressure: TypeAlias = float  # Pa
LuminousIntensity: TypeAlias = float  # cd
LuminousFlux: TypeAlias = float  # lm
Illuminance: TypeAlias = float  # lx
ElectricalCurrent: TypeAlias = float  # A
AmountOfSubstance: TypeAlias = float  # mol

# length, in metres
nanometer = nm = 1e-9
micrometer = 1e-6
millimeter = mm = 1e-3
centimeter = cm = 0.01
meter = m = 1.0
kilometer = km = 1000.0
inch = 0.0254
feet = 0.3048
mile = mi = 1609.344

# time, in seconds
millisecond = ms = 1e-3
second = sec = s = 1.0
minute = min = 60.0
hour = h = 3600.0

# speed, in metres per second
meter_per_second = mps = 1.0
kilometer_per_hour = kmph = kph = 1 / 3.6
mile_per_hour = mph = miph = 0.44704
millimeter_per_hour = mmph = 1 / 3.6e6

# acceleration, in metres per second squared
meter_per_sec_sqr = mpsps = mpss = 1.0
kilometer_per_hour_per_sec = kmphps = 1 / 3.6
mile_per_hour_per_sec = miphps = 0.44704

# jerk, in metres per second cubed
meter_per_sec_cubed = mpspsps = 1.0
mile_per_sec_cubed = mipspsps = 1609.344

# angle, angular rate and angular acceleration, in radians (per second, per second squared)
degree = deg = math.pi / 180
radian = rad = 1.0
degree_per_sec = degps = math.pi / 180
radian_per_sec = radps = 1.0
degree_per_sec_sqr = degpsps = math.pi / 180
radian_per_sec_sqr = radpsps = 1.0

# mass, in kilograms
gram = 1e-3
kilogram = kg = 1.0
ton = 1000.0
pound = lb = 0.45359237

# pressure, in pascals
newton_per_meter_sqr = pascal = Pa = 1.0
hPa = 100.0
atm = 101325.0

# light, electricity, amount of substance: SI units
candela = cd = 1.0
lumen = lm = 1.0
lux = lx = 1.0
ampere = A = 1.0
mole = mol = 1.0

# temperature, in kelvin
kelvin = K = 1.0


def celsius(value: float) -> float:
    """Return a temperature in kelvin for one in degrees Celsius."""
    return value + 273.15


def fahrenheit(value: float) -> float:
    """Return a temperature in kelvin for one in degrees Fahrenheit."""
    return (value + 459.67) * 5 / 9


C = celsius
F = fahrenheit
