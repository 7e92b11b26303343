"""A flexible, sloshing hypersonic vehicle as FMUs of FMI 2.0 and 3.0."""

from ahv._columns import ManoeuvreError
from ahv._instance import FMUError
from ahv._linear_model import Linearizer, LinearModel, linear_model
from ahv._manoeuvre import manoeuvre
from ahv._package import fmu, template
from ahv._vehicle import VehicleError, vehicle

__all__ = [
    "FMUError",
    "LinearModel",
    "Linearizer",
    "ManoeuvreError",
    "VehicleError",
    "fmu",
    "linear_model",
    "manoeuvre",
    "template",
    "vehicle",
]
