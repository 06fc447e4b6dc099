from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

import numpy as np

__version__: str
WHITE_EFFICACY: float
TAKES_NUMPY_2: bool

class Scene:
    source: str
    warnings: List[str]
    precision: float
    n_polygons: int
    bands: str
    n_bands: int
    wavelengths: np.ndarray
    surface_names: List[str]
    material_names: List[str]
    vertices: np.ndarray
    corners: np.ndarray
    first_corner: np.ndarray
    polygon_surface: np.ndarray
    two_sided: List[bool]
    def changed(self, lights: Mapping[str, float], reflectances: Mapping[str, np.ndarray]) -> Scene: ...
    def with_heat_values(self, is_temperature: bool, values: np.ndarray) -> Scene: ...
    def with_heat_file(self, is_temperature: bool, path: str) -> Scene: ...
    def write(self, path: str) -> None: ...

class Photometry:
    format: str
    name: str
    maker: str
    lamp_flux: float
    power: float
    along_c0: float
    along_c90: float
    type: str
    flux: float
    peak: float
    def intensity(self, directions: np.ndarray) -> np.ndarray: ...
    def spread(self, plane: float, share: float) -> float: ...
    def ugr_table(
        self,
        rooms: np.ndarray,
        reflectances: np.ndarray,
        height: float,
        spacing: float,
        report: Any,
        n_threads: int,
    ) -> tuple: ...

class Patches:
    vertices: np.ndarray
    corners: np.ndarray
    surface: np.ndarray
    polygon: np.ndarray
    twin: np.ndarray
    area: np.ndarray
    normal: np.ndarray
    centroid: np.ndarray
    surface_names: List[str]
    def __len__(self) -> int: ...
    def lit_shares(self, direction: np.ndarray) -> np.ndarray: ...

class Operator:
    size: int
    patches: Patches
    tolerance: float
    bytes: int
    error: float
    is_dense: bool
    report: Dict[str, Any]
    raw_row_sums: np.ndarray
    def apply(self, radiosity: np.ndarray) -> np.ndarray: ...
    def apply_error(self, radiosity: np.ndarray) -> np.ndarray: ...
    def row(self, i: int) -> np.ndarray: ...
    def row_error(self, i: int) -> np.ndarray: ...
    def by_surface(self) -> np.ndarray: ...
    def by_surface_error(self) -> np.ndarray: ...
    def csr(self, report: Any) -> Tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]: ...
    def save(self, path: str, report: Any) -> None: ...

class StudyOptions:
    patches: Optional[int]
    max_edge: Optional[float]
    as_is: bool
    adaptive: bool
    tolerance: float
    factor_tolerance: Optional[float]
    closed: Optional[bool]
    transport: str
    memory: int
    seed: int
    method: str

class Camera:
    def __init__(
        self, position: np.ndarray, direction: np.ndarray, up: np.ndarray, vertical_fov: float
    ) -> None: ...

class PictureOptions:
    def __init__(
        self,
        width: int,
        height: int,
        samples: int,
        gathers: bool,
        exposure: Optional[float],
        camera: Optional[Camera],
        lightmap: Optional[int],
    ) -> None: ...

class LightPlan: ...

def points_plan(
    points: np.ndarray,
    normals: np.ndarray,
    up: Optional[np.ndarray],
    is_cylindrical: bool,
    vertical: np.ndarray,
    semi_cylindrical: np.ndarray,
) -> LightPlan: ...
def observer_plan(position: np.ndarray, direction: np.ndarray, up: np.ndarray) -> LightPlan: ...

class Study:
    operator: Operator
    scene: Scene
    def solve(self, report: Any, n_threads: int) -> None: ...
    def light(self) -> Dict[str, Any]: ...
    def measure(
        self, plan: Optional[LightPlan], efficacy: float, report: Any, n_threads: int
    ) -> Dict[str, Any]: ...
    def quantity(self, name: str, efficacy: float) -> Tuple[np.ndarray, str]: ...
    def comfort(
        self,
        points: np.ndarray,
        posture: str,
        body: str,
        up: np.ndarray,
        facing: Optional[np.ndarray],
        report: Any,
        n_threads: int,
    ) -> Dict[str, np.ndarray]: ...
    def daylight_factors(
        self,
        points: np.ndarray,
        normals: np.ndarray,
        outdoors: Sequence[str],
        efficacy: float,
        report: Any,
        n_threads: int,
    ) -> np.ndarray: ...
    def image(self, options: PictureOptions, report: Any, n_threads: int) -> np.ndarray: ...
    def write(
        self,
        path: str,
        quantities: Sequence[str],
        efficacy: float,
        picture: PictureOptions,
        report: Any,
        n_threads: int,
    ) -> None: ...

def read_photometry(path: str, report: Any) -> Photometry: ...
def read_scene(
    path: str, unit: Optional[str], precision: Optional[float], strict: bool, report: Any
) -> Scene: ...
def scene_of_mesh(
    vertices: np.ndarray,
    corners: np.ndarray,
    first_corner: np.ndarray,
    surface: np.ndarray,
    names: Sequence[str],
    two_sided: Sequence[bool],
    precision: Optional[float],
    is_single: bool,
) -> Scene: ...
def polygons_of(scene: Scene) -> Patches: ...
def assemble(
    scene: Scene,
    options: StudyOptions,
    operator_file: Optional[str],
    report: Any,
    n_threads: int,
) -> Study: ...
def load(path: str, memory: int, report: Any) -> Operator: ...
def solve(
    factors: Operator,
    exitance: np.ndarray,
    reflectance: np.ndarray,
    incident: np.ndarray,
    options: StudyOptions,
    report: Any,
    n_threads: int,
) -> Dict[str, Any]: ...
def importance(
    factors: Operator, reflectance: np.ndarray, patch: int, tolerance: float, report: Any
) -> np.ndarray: ...
def exchange(
    factors: Operator,
    emissivity: np.ndarray,
    node: Sequence[int],
    n_nodes: int,
    report: Any,
    n_threads: int,
) -> Dict[str, Any]: ...
def factors_from_points(
    polygons: Patches, points: np.ndarray, normals: np.ndarray, report: Any, n_threads: int
) -> np.ndarray: ...
