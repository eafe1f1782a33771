"""Materials: linear elastic, homogeneous, perhaps with a yield strength for the contact laws that need one."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from .. import validation

LENGTH_RANGE = (1e-6, 1e6)  # m, of bodies and of radii
YOUNG_RANGE = (1e-3, 1e13)  # Pa: down to benchmarks without dimensions, of a modulus of 1


@dataclass(frozen=True)
class Material:
    """Linear elastic, homogeneous."""

    young: float  # E [Pa]
    density: float  # rho [kg/m3]
    poisson: float = 0.3
    yield_strength: float | None = None  # sigma_Y [Pa], of uniaxial tension

    @property
    def plane_modulus(self) -> float:
        """E / (1 - nu^2) [Pa]: what a contact feels of one body."""
        return self.young / (1.0 - self.poisson**2)

    def table(self) -> dict[str, float]:
        """As in a scene file."""
        constants = {"young": self.young, "density": self.density, "poisson": self.poisson}
        return constants if self.yield_strength is None else constants | {"yield": self.yield_strength}


MATERIALS = {
    "steel": Material(210e9, 7900.0, 0.30),  # thesis 5.3
    "bronze": Material(98e9, 8600.0, 0.34),  # thesis 9.5; Poisson's ratio is a handbook value
    "aluminium": Material(70e9, 2700.0, 0.33),
    # handbook values at room temperature, rounded
    "brass": Material(100e9, 8500.0, 0.35),
    "copper": Material(120e9, 8940.0, 0.34),
    "titanium": Material(114e9, 4430.0, 0.34),  # Ti-6Al-4V
    "glass": Material(70e9, 2500.0, 0.22),  # soda-lime
    "acrylic": Material(3.2e9, 1180.0, 0.37),
    "concrete": Material(30e9, 2400.0, 0.20),
}


def read_material(key: str, given: object) -> Material:
    """A material by name, or by its constants.

    Raises SceneError naming the key.
    """
    if isinstance(given, str):
        return MATERIALS[validation.choice(key, given, MATERIALS)]
    given = validation.table(key, given, ("young", "density", "poisson", "yield"))
    needed = validation.allowed("material-constant", names=list(MATERIALS))
    yields = given.get("yield")
    return Material(
        validation.number(f"{key}.young", validation.required(key, given, "young", needed), *YOUNG_RANGE, "Pa"),
        validation.number(f"{key}.density", validation.required(key, given, "density", needed), 1e-2, 1e6, "kg/m3"),
        validation.number(f"{key}.poisson", given.get("poisson", 0.3), -0.99, 0.499),
        None if yields is None else validation.number(f"{key}.yield", yields, *YOUNG_RANGE, "Pa"),
    )


def required_material(key: str, given: Mapping[str, Any]) -> Material:
    """The material of a body that must have one. Raises SceneError."""
    material = validation.required(key, given, "material", validation.allowed("material"))
    return read_material(f"{key}.material", material)


def read_radius(key: str, given: object) -> float | None:
    """Radius of curvature at the contact [m], or None for a flat face."""
    return None if given is None else validation.number(key, given, *LENGTH_RANGE, "m")
