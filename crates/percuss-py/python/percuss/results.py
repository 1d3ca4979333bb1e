"""Results of commands, with the names of the JSON output."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from . import _percuss, fields, plots
from .history import History
from .record import Record, Result, digits, in_words, shown, symbol, table_html, written
from .values import ResultValues

if TYPE_CHECKING:
    from matplotlib.axes import Axes


#: Numbers of a run that come first.
MAIN = ("depth_of_penetration_mm", "residual_velocity_m_s", "ballistic_limit_m_s", "projectile_final_length_mm")


class RunResult(ResultValues, Result):
    """The result of a run: the values of ``percuss run --json`` and the histories.

    A number that the model does not give is ``None``. The table has one row; ``history.to_pandas()`` gives the histories.

    Attributes
    ----------
    case, percuss_version : str
        Name of the case and version of the program.
    axisymmetric : Record or None
        Axisymmetric answer, if ``reference`` asked for it: ``quantity``, ``value``, ``uncertainty``, ``order``, ``outcome``, ``meshes``, and the
        ``reason`` where there is none.
    seeds : Record or None
        Means and spread over packings of particles, if ``seeds`` asked for them: the ``seeds``, and ``numbers`` with ``name``, ``mean``,
        ``standard_deviation``, ``smallest``, ``largest`` and ``values``.
    {fields}
    """

    case: str
    percuss_version: str
    axisymmetric: Record | None
    seeds: Record | None

    _native: _percuss.RunResult

    def __init__(self, native: _percuss.RunResult, response: _percuss.Response | None = None) -> None:
        self._native = native
        self._files = () if response is None else written(response)

    def __getattr__(self, name: str) -> Any:
        if name == "_data":
            # Read on first access: many runs need only one number or their history.
            whole = json.loads(self._native.json())
            (result,) = whole.pop("results")
            self._data = whole | result
            return self._data
        if name == "history":
            raise AttributeError(f"the run by model `{self.model}` has no history")
        return super().__getattr__(name)

    @property
    def history(self) -> History:
        """Histories of the run.

        Raises
        ------
        AttributeError
            When the run has none: a formula, or ``history=False``.
        """
        if self._native.samples() is None:
            raise AttributeError("no history")
        return History(self._native)

    def _rows(self) -> list[dict[str, Any]]:
        return [self._data]

    def plot(self, what: str = "depth_mm", ax: Axes | None = None, **style: Any) -> Axes:
        """Draws a column of the history versus time [us].

        Parameters
        ----------
        what : str
            Name of the column, such as ``depth_mm``, ``tip_velocity_m_s`` or ``contact_force_kn``.
        ax : matplotlib axes, optional
            Axes of the figure; new axes when not given.
        **style
            Arguments of ``Axes.plot``.
        """
        return plots.history(self, what, ax, **style)

    def plot_stress(self, ax: Axes | None = None) -> Axes:
        """Draws the axial stress [MPa] versus position [mm] and time [us]."""
        return plots.stress(self, ax)

    def _answer(self) -> list[list[str]]:
        """Label and words of the axisymmetric answer, if there is one."""
        answer = self.axisymmetric
        if answer is None:
            return []
        if answer.value is None:
            return [["no axisymmetric answer", answer.reason]]
        return [["axisymmetric", f"{in_words(answer.quantity, answer.value, uncertainty=answer.uncertainty)} ({len(answer.meshes)} meshes)"]]

    def _headline(self) -> list[str]:
        words = [self.outcome.replace("_", " ")]
        words += [f"{label} {value}" for label, value in self._answer()]
        words += [in_words(name, self._data[name]) for name in MAIN if self._data[name] is not None][:2]
        warned = len(self.warnings)
        return [*words, f"case {self.case}, model {self.model}", *([f"{warned} warning{'s' * (warned > 1)}"] if warned else [])]

    def _details_html(self) -> str:
        rows = self._answer() + [[name, value] for name, value in self._shown()]
        if self.expected_error is not None:
            error = self.expected_error
            ends = f"10th-90th percentile {100 * error.low:+.0f} % to {100 * error.high:+.0f} %, from {error.cases} similar benchmark cases"
            rows.append(["estimated model error of the depth", f"median {100 * error.median:+.0f} %, {ends}"])
        rows += [["warning", warning] for warning in self.warnings]
        return table_html(["", ""], rows, f"{self.case}, model {self.model}")


# Each value of the JSON output is an attribute.
fields.add_values(RunResult, _percuss.result_fields())


class Comparison(Result):
    """Results of all models on a case: the values of ``percuss compare --json``. One row per velocity and model.

    Attributes
    ----------
    regime, recommended : list of Record
        Regime and recommended models, one entry per velocity.
    quantities : list of str
        Names of the relevant quantities, the main one first.
    experiments : list of Record
        Measured values.
    results : list of Record
        One entry per velocity and model, with the names of :class:`RunResult`; ``reason`` is that of a missing result.
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
        """Draws the main quantity: by model at one velocity, versus velocity at many."""
        return plots.comparison(self, ax)

    def _headline(self) -> list[str]:
        words = []
        for at in self.recommended:
            speed = f" at {at.impact_velocity_m_s:g} m/s" if len(self.recommended) > 1 else ""
            for choice in at.models[:1]:
                words.append(f"recommended{speed}: {choice.model}{self._value(choice.model, at.impact_velocity_m_s)}")
        return [*(words[:3] or ["no model is recommended"]), f"case {self.case}, {len(self.results)} results"]

    def _value(self, model: str, speed: float) -> str:
        """Main quantity of a model in words, where it gives one."""
        given = (r for r in self.results if r.model == model and r.impact_velocity_m_s == speed)
        record = next(given, None)
        name = self.quantities[0] if self.quantities else None
        value = None if record is None or name is None else record._data.get(name)
        return "" if name is None or value is None else f", {in_words(name, value)}"

    def _details_html(self) -> str:
        quantities = self.quantities
        chosen = {choice.model for at in self.recommended for choice in at.models}
        # Results come before missing results.
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
        Lowest and highest impact velocity of the search [m/s].
    rear_face : Record or None
        ``condition`` of the rear face (``free``, ``fixed`` or ``non-reflecting``), and whether it is ``assumed`` because the case gives
        none.
    recommended : list of Record
        Recommended ``model`` and the reason (``because``); may be empty. ``note`` has remarks.
    range : Record or None
        ``lowest_m_s`` and ``highest_m_s`` of the ``models`` that predict a limit.
    axisymmetric : Record or None
        ``ballistic_limit_m_s`` by ``axi`` in the limit of fine meshes, its ``uncertainty_m_s`` and the ``meshes``.
    experiments : list of Record
        Measured values.
    results : list of Record
        One entry per model: ``ballistic_limit_m_s``, its ``expected_error`` from published limits of the same kind, ``bracket``, ``curve``
        of residual velocities and the ``fit`` to it. A model with the outcome ``input`` takes ``input_limit`` and predicts no
        limit.
    v50 : Record or None
        V50 of test results, when a file was given: ``estimates``, one entry per ``method`` with ``v50_m_s`` and the ends of
        its interval, ``low_m_s`` and ``high_m_s`` [m/s].
    tests : list of Record or None
        These tests: ``impact_velocity_m_s`` [m/s] and ``perforated``.
    """

    case: str
    percuss_version: str
    searched_m_s: list[float]
    rear_face: Record | None
    recommended: list[Record]
    note: str | None
    range: Record | None
    axisymmetric: Record | None
    experiments: list[Record]
    results: list[Record]
    v50: Record | None
    tests: list[Record] | None

    def _rows(self) -> list[dict[str, Any]]:
        return list(self._data.get("results", []))

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws residual versus impact velocity for every model with a limit; dashed where the limit is an input."""
        return plots.limits(self, ax)

    def plot_v50(self, ax: Axes | None = None) -> Axes:
        """Draws the tests, the maximum-likelihood probability of perforation, and V50 with its interval."""
        return plots.v50(self, ax)

    def _headline(self) -> list[str]:
        words = []
        if "results" in self:
            chosen = [choice.model for choice in self.recommended]
            given = [r for r in self.results if r.ballistic_limit_m_s is not None and r.outcome != "input"]
            best = [r for r in given if r.model in chosen] or given
            words += [f"{in_words('ballistic_limit_m_s', r.ballistic_limit_m_s)} by {r.model}" for r in best[:2]] or ["no model predicts a limit"]
            words.append(f"case {self.case}")
        if self.v50 is not None:
            known = [e for e in self.v50.estimates if e.v50_m_s is not None]
            words += [f"V50 {digits(e.v50_m_s)} m/s by {e.method.replace('_', ' ')}" for e in known[:1]]
            words.append(f"{self.v50.tests} tests")
        return words

    def _details_html(self) -> str:
        text = ""
        if "results" in self:
            chosen = {choice.model for choice in self.recommended}
            rows = [
                [r.model + (" ★" if r.model in chosen else ""), r.outcome.replace("_", " "), shown(r.ballistic_limit_m_s), r.reason or ""]
                for r in self.results
            ]
            face = self.rear_face
            assumed = f", assumed rear face: {face.condition}" if face is not None and face.assumed else ""
            text += table_html(["model", "outcome", "ballistic_limit_m_s", "reason"], rows, f"{self.case}{assumed}")
        if self.v50 is not None:
            names = ["method", "v50_m_s", "low_m_s", "high_m_s", "standard_deviation_m_s", "reason"]
            rows = [[shown(estimate[name]).replace("_", " ") for name in names] for estimate in self.v50.estimates]
            caption = f"V50 of {self.v50.tests} tests, {self.v50.perforated} complete penetrations"
            text += table_html(names, rows, caption)
        return text


class Convergence(Result):
    """Mesh convergence of a case: the values of ``percuss converge --json``. One row per mesh.

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
        """Draws a quantity, the first when not named, versus the number of elements."""
        return plots.convergence(self, quantity, ax)

    def _rows(self) -> list[dict[str, Any]]:
        rows: list[dict[str, Any]] = []
        for i, mesh in enumerate(self._data["meshes"]):
            values = {f"{q['name']} [{q['unit']}]": q["values"][i] for q in self._data["quantities"]}
            rows.append(mesh | values)
        return rows

    def _headline(self) -> list[str]:
        (first, *_) = self.quantities
        kind = shown(first.status._data.get("kind")).replace("_", " ")
        return [f"{first.name.replace('_', ' ')} {digits(first.values[-1])} {symbol(first.unit)} on the finest mesh", kind, f"{len(self.meshes)} meshes"]

    def _details_html(self) -> str:
        rows = self._rows()
        text = table_html(list(rows[0]), [[shown(value) for value in row.values()] for row in rows])
        names = ["kind", "order", "richardson", "index"]
        statuses = [[q.name, *(shown(q.status._data.get(name)) for name in names)] for q in self.quantities]
        return text + table_html(["quantity", "status", "order", "extrapolated", "grid-convergence index"], statuses)


class Validation(Result):
    """Models compared with published tests: the values of ``percuss validate --json``. One row per prediction.

    Attributes
    ----------
    data, models : list of str
        Sources of the tests, and the models.
    tests : int
        Number of tests.
    statistics, coverage, predictions : list of Record
        Errors by group, number of tests per model, and every prediction with its measured value.
    """

    percuss_version: str
    data: list[str]
    models: list[str]
    tests: int
    statistics: list[Record]
    coverage: list[Record]
    predictions: list[Record]

    def _rows(self) -> list[dict[str, Any]]:
        return list(self._data["predictions"])

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws predicted versus measured values of the counted predictions."""
        return plots.validation(self, ax)

    def _headline(self) -> list[str]:
        whole = [group for group in self.statistics if group.grouping == "all"]
        best = min(whole, key=lambda group: group.median_absolute, default=None)
        words = [f"{self.tests} tests, {len(self.models)} models"]
        if best is not None:
            words.append(f"least median error {100 * best.median_absolute:.0f} % by {best.model} on {best.kind.replace('_', ' ')}")
        return words

    def _details_html(self) -> str:
        errors = ["bias", "rms", "median_absolute", "worst"]
        rows = [
            [group.model, group.kind.replace("_", " "), str(group.count), *(f"{100 * group[error]:.1f}" for error in errors)]
            for group in self.statistics
            if group.grouping == "all"
        ]
        head = ["model", "kind", "tests", *(f"{error.replace('_', ' ')} [%]" for error in errors)]
        return table_html(head, rows, f"{self.tests} tests: {', '.join(self.data)}")
