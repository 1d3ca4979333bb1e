"""What commands find out, as small classes with the names of the program's JSON."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from . import _percuss, fields, plots
from .history import History
from .record import Record, Result, shown, table_html, written
from .values import ResultValues

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class RunResult(ResultValues, Result):
    """The result of a run: the values of ``percuss run --json`` and the histories.

    A number that the model does not give is ``None``. The table has one row; ``history.to_pandas()`` gives the histories.

    Attributes
    ----------
    case, percuss_version : str
        Name of the case and version of the program.
    {fields}
    """

    case: str
    percuss_version: str

    _native: _percuss.RunResult

    def __init__(self, native: _percuss.RunResult, answer: _percuss.Answer | None = None) -> None:
        self._native = native
        self._files = () if answer is None else written(answer)

    def __getattr__(self, name: str) -> Any:
        if name == "_data":
            # Read when it is first asked for: many runs are asked for one number or for their history only.
            whole = json.loads(self._native.json())
            (result,) = whole.pop("results")
            self._data = whole | result
            return self._data
        return super().__getattr__(name)

    @property
    def history(self) -> History:
        """Histories of the run.

        Raises
        ------
        AttributeError
            When the run kept none: a formula, or ``history=False``.
        """
        if self._native.samples() is None:
            raise ValueError(f"the run by model `{self.model}` kept no history")
        return History(self._native)

    def _rows(self) -> list[dict[str, Any]]:
        return [self._data]

    def plot(self, what: str = "depth_mm", ax: Axes | None = None, **style: Any) -> Axes:
        """Draws a column of the history against time [us].

        Parameters
        ----------
        what : str
            Name of the column, such as ``depth_mm``, ``tip_velocity_m_s`` or ``contact_force_kn``.
        ax : matplotlib axes, optional
            Where to draw; new axes when not given.
        **style
            What ``Axes.plot`` takes.
        """
        return plots.history(self, what, ax, **style)

    def plot_stress(self, ax: Axes | None = None) -> Axes:
        """Draws the axial stress [MPa] over position [mm] and time [us]."""
        return plots.stress(self, ax)

    def _repr_html_(self) -> str:
        rows = [[name, value] for name, value in self._shown()]
        if self.expected_error is not None:
            error = self.expected_error
            ends = f"{100 * error.low:+.0f} % to {100 * error.high:+.0f} % for eight of ten of {error.cases} benchmark cases like this one"
            rows.append(["expected error of the depth", f"median {100 * error.median:+.0f} %, {ends}"])
        rows += [["warning", warning] for warning in self.warnings]
        return table_html(["", ""], rows, f"{self.case}, model {self.model}")


# Each value of the program's JSON is an attribute.
fields.add_values(RunResult, _percuss.result_fields())


class Comparison(Result):
    """What every model says of a case: the values of ``percuss compare --json``. A row a speed and model.

    Attributes
    ----------
    regime, recommended : list of Record
        The regime and the models to rely on, an entry a speed.
    quantities : list of str
        Names of the quantities that tell most of the case, the leading one first.
    experiments : list of Record
        What was measured.
    results : list of Record
        An entry a speed and model, with the names of :class:`RunResult`; ``reason`` says why a model gives no result.
    """

    case: str
    percuss_version: str
    regime: list[Record]
    recommended: list[Record]
    quantities: list[str]
    experiments: list[Record]
    results: list[Record]

    def _rows(self) -> list[dict[str, Any]]:
        return list(self._data["results"])

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the leading quantity: by model at one speed, against the speed at many."""
        return plots.comparison(self, ax)

    def _repr_html_(self) -> str:
        quantities = self.quantities
        chosen = {choice.model for at in self.recommended for choice in at.models}
        # What a model says comes before why others say nothing.
        results = sorted(self.results, key=lambda r: r.reason is not None)
        rows = [
            [f"{r.model} ★" if r.model in chosen else r.model, shown(r.impact_velocity_m_s), *(shown(r[q]) for q in quantities), r.outcome.replace("_", " "), r.reason or ""]
            for r in results
        ]
        return table_html(["model", "impact_velocity_m_s", *quantities, "outcome", "reason"], rows, f"{self.case} (★ recommended)")


class Limits(Result):
    """Ballistic limits: the values of ``percuss limit --json``. One row per model.

    Attributes
    ----------
    searched_m_s : list of float
        Lowest and highest impact speed of the search [m/s].
    rear_face : Record or None
        ``condition`` of the rear face (``free``, ``fixed`` or ``non-reflecting``), and whether it is ``assumed`` because the case gives
        none.
    recommended : list of Record
        The ``model`` to rely on, and ``because`` of what; may be empty. ``note`` says what to know of it.
    range : Record or None
        ``lowest_m_s`` and ``highest_m_s`` of the ``models`` that predict a limit.
    experiments : list of Record
        What was measured.
    results : list of Record
        One entry per model: ``ballistic_limit_m_s``, its ``expected_error`` from published limits of the same kind, ``bracket``, ``curve``
        of residual velocities and the ``fit`` to it. A model with the outcome ``input`` starts from ``input_limit`` and predicts no
        limit.
    v50 : Record or None
        V50 of shots that scatter, when a file of them was given: ``estimates``, an entry a ``method`` with ``v50_m_s`` and the ends of
        its interval, ``low_m_s`` and ``high_m_s`` [m/s].
    shots : list of Record or None
        Those shots: ``impact_velocity_m_s`` [m/s] and whether they ``perforated``.
    """

    case: str
    percuss_version: str
    searched_m_s: list[float]
    rear_face: Record | None
    recommended: list[Record]
    note: str | None
    range: Record | None
    experiments: list[Record]
    results: list[Record]
    v50: Record | None
    shots: list[Record] | None

    def _rows(self) -> list[dict[str, Any]]:
        return list(self._data.get("results", []))

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws residual velocity against impact velocity for every model that found a limit; dashed above a limit that is an input."""
        return plots.limits(self, ax)

    def plot_v50(self, ax: Axes | None = None) -> Axes:
        """Draws the shots, the likeliest chances of going through, and V50 with its interval."""
        return plots.v50(self, ax)

    def _repr_html_(self) -> str:
        text = ""
        if "results" in self:
            chosen = {choice.model for choice in self.recommended}
            rows = [
                [r.model + (" ★" if r.model in chosen else ""), r.outcome.replace("_", " "), shown(r.ballistic_limit_m_s), r.reason or ""]
                for r in self.results
            ]
            face = self.rear_face
            assumed = f", rear face taken as {face.condition}" if face is not None and face.assumed else ""
            text += table_html(["model", "outcome", "ballistic_limit_m_s", "reason"], rows, f"{self.case}{assumed}")
        if self.v50 is not None:
            names = ["method", "v50_m_s", "low_m_s", "high_m_s", "standard_deviation_m_s", "reason"]
            rows = [[shown(estimate[name]).replace("_", " ") for name in names] for estimate in self.v50.estimates]
            caption = f"V50 of {self.v50.tests} tests, {self.v50.perforated} complete penetrations"
            text += table_html(names, rows, caption)
        return text


class Convergence(Result):
    """A case on finer and finer meshes: the values of ``percuss converge --json``. A row a mesh.

    Attributes
    ----------
    meshes : list of Record
        ``projectile_elements``, ``target_elements`` and ``steps``, from coarse to fine.
    quantities : list of Record
        ``name``, ``unit``, ``values`` on every mesh and the ``status`` of the finest three.
    """

    meshes: list[Record]
    quantities: list[Record]

    def plot(self, quantity: str | None = None, ax: Axes | None = None) -> Axes:
        """Draws a quantity, the first when not named, against the number of elements."""
        return plots.convergence(self, quantity, ax)

    def _rows(self) -> list[dict[str, Any]]:
        rows: list[dict[str, Any]] = []
        for i, mesh in enumerate(self._data["meshes"]):
            values = {f"{q['name']} [{q['unit']}]": q["values"][i] for q in self._data["quantities"]}
            rows.append(mesh | values)
        return rows

    def _repr_html_(self) -> str:
        rows = self._rows()
        text = table_html(list(rows[0]), [[shown(value) for value in row.values()] for row in rows])
        names = ["kind", "order", "richardson", "index"]
        statuses = [[q.name, *(shown(q.status._data.get(name)) for name in names)] for q in self.quantities]
        return text + table_html(["quantity", "status", "order", "extrapolated", "grid-convergence index"], statuses)


class Validation(Result):
    """Models against published shots: the values of ``percuss validate --json``. A row a prediction.

    Attributes
    ----------
    data, models : list of str
        What the shots come from, and the models.
    shots : int
        Number of shots.
    statistics, coverage, predictions : list of Record
        Errors by group, how many shots each model could be tested on, and every prediction beside its measurement.
    """

    percuss_version: str
    data: list[str]
    models: list[str]
    shots: int
    statistics: list[Record]
    coverage: list[Record]
    predictions: list[Record]

    def _rows(self) -> list[dict[str, Any]]:
        return list(self._data["predictions"])

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws predicted against measured values of the counted predictions."""
        return plots.validation(self, ax)

    def _repr_html_(self) -> str:
        errors = ["bias", "rms", "median_absolute", "worst"]
        rows = [
            [group.model, group.kind.replace("_", " "), str(group.count), *(f"{100 * group[error]:.1f}" for error in errors)]
            for group in self.statistics
            if group.grouping == "all"
        ]
        head = ["model", "kind", "shots", *(f"{error.replace('_', ' ')} [%]" for error in errors)]
        return table_html(head, rows, f"{self.shots} tests: {', '.join(self.data)}")
