"""First-order impact and penetration mechanics: estimates of penetration depth, residual velocity and ballistic limit.

The package has the runs, comparisons and studies of the program ``percuss``, with the same names and numbers. A case is a file, or the tables of a
case file as keyword arguments. Numbers in code are in SI units; the names of results end with their unit.

Examples
--------
>>> import percuss
>>> case = percuss.Case(
...     projectile={"material": "copper", "length": "12.74 mm", "diameter": "4.8 mm", "impact_velocity": "230 m/s"},
...     target={"material": "aluminium-2024-t351", "thickness": "25 mm"},
... )
>>> result = percuss.run(case)
>>> result.outcome, round(result.depth_of_penetration_mm, 4)
('rebounded', 0.208)
"""

from typing import NoReturn

from ._percuss import VERSION as __version__
from .benchmarks import Benchmark, benchmark
from .calibration import Calibration, calibrate
from .case import Case, load
from .commands import ResistanceLaw, compare, converge, export, limit, run, validate
from .errors import (
    CaseError,
    ClusterError,
    LibraryError,
    MaterialError,
    NotApplicableError,
    NumericalError,
    PercussError,
    ReadError,
    UsageError,
    WriteError,
)
from .history import Gauge, History, Profile, SiColumns
from .laws import StrengthLaw
from .library import Material, Model, export_materials, flow_curves, import_materials, material, materials, model, models, new, schema
from .progress import Progress
from .record import Record, Records, Result
from .reproduction import Reproduction, reproduce
from .results import Comparison, Convergence, Limits, RunResult, Validation
from .samples import Sample
from .spread import Uncertainty, uncertainty
from .sweeps import Drawing, SweepResult, merge, plot, sweep

__all__ = [
    "Benchmark",
    "Calibration",
    "Case",
    "CaseError",
    "ClusterError",
    "Comparison",
    "Convergence",
    "Drawing",
    "Gauge",
    "History",
    "LibraryError",
    "Limits",
    "Material",
    "MaterialError",
    "Model",
    "NotApplicableError",
    "NumericalError",
    "PercussError",
    "Profile",
    "Progress",
    "ReadError",
    "Record",
    "Records",
    "Reproduction",
    "ResistanceLaw",
    "Result",
    "RunResult",
    "Sample",
    "SiColumns",
    "StrengthLaw",
    "SweepResult",
    "Uncertainty",
    "UsageError",
    "Validation",
    "WriteError",
    "__version__",
    "benchmark",
    "calibrate",
    "compare",
    "converge",
    "export",
    "export_materials",
    "flow_curves",
    "import_materials",
    "limit",
    "load",
    "material",
    "materials",
    "merge",
    "model",
    "models",
    "new",
    "plot",
    "reproduce",
    "run",
    "schema",
    "sweep",
    "uncertainty",
    "validate",
]

#: Former names, with the names of today.
_RENAMED = {"judge": "benchmark"}


def __getattr__(name: str) -> NoReturn:
    if name in _RENAMED:
        raise AttributeError(f"`percuss.{name}` is now `percuss.{_RENAMED[name]}`")
    raise AttributeError(f"module `percuss` has no attribute `{name}`")
