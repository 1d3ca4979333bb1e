"""Commands of the program as functions, one function per command with the same options."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from numbers import Real
from typing import Any, TypeAlias

from . import _percuss
from .command_line import CaseLike, Path, Speed, answer, execute, formats, several, speeds, with_unit
from .case import Case, native
from .errors import UsageError
from .laws import StrengthLaw
from .progress import Progress, watching
from .results import Comparison, Convergence, Limits, RunResult, Validation

#: Pressure on the crater floor [Pa] from its depth [m] and the speed at which it advances [m/s].
ResistanceLaw: TypeAlias = Callable[[float, float], float]


def run(
    case: CaseLike,
    model: str | None = None,
    *,
    reference: str | None = None,
    mesh_tolerance: str | None = None,
    history: bool = True,
    out: Path | None = None,
    figures: str | Sequence[str] | None = None,
    figure_width: str | None = None,
    field: str | None = None,
    fields: bool = False,
    animation: bool = False,
    dump: bool = False,
    frames: int | None = None,
    checkpoint: float | str | None = None,
    resume: bool = False,
    seeds: int | None = None,
    units: str | None = None,
    progress: Progress | bool | None = None,
    projectile_law: StrengthLaw | None = None,
    target_law: StrengthLaw | None = None,
    resistance_law: ResistanceLaw | None = None,
) -> RunResult:
    """Runs a case by a model.

    Parameters
    ----------
    case : Case or path
        The case, or its file.
    model : str, optional
        Name of the model; :func:`percuss.models` lists them. When not given, it is ``chain``; where that does not apply, it is the model
        that :func:`compare` recommends, or ``axi`` where no quick model applies, and ``result.model_choice`` says why.
    reference : str, optional
        Meshes of the axisymmetric answer: ``"standard"``, 3, 4 and 6 cells along the projectile's radius, or ``"fine"``, 6, 8 and 12.
        Then ``result.axisymmetric`` has the ``value`` in the limit of fine meshes of the main ``quantity``, its ``uncertainty`` by the
        mesh alone, the observed ``order``, and the ``meshes``; where there is none, the ``reason``. When not given, there is no
        answer, as with ``percuss run --fast``. For model ``chain`` or no model.
    mesh_tolerance : str, optional
        Largest error by the mesh, such as ``"1%"`` (0.01 to 50 percent), of the main number of a one-dimensional model. The coarsest mesh
        within it is chosen, from half to eight times the elements of the case. ``result.details`` has the mesh and its estimated error.
        Without ``out`` there is no history then.
    history : bool
        Whether to keep time histories; with ``out`` they are kept.
    out : path, optional
        Folder for a copy of the case, the result, the histories and the figures, as ``percuss run --out`` writes them; made if it does
        not exist. A model of two dimensions, which ``axi`` is, adds its fields at the end for ParaView (``field.vtp``) and a picture of
        one of them (``field.png``). ``result.files`` lists the files.
    figures : str or sequence of str, optional
        Formats of the figures in ``out``: ``svg``, ``png`` and ``pdf``, or ``"none"``; SVG and PNG when not given.
    figure_width : str, optional
        Width of the figures in print, 60 mm to 182 mm; ``"88 mm"`` fits a column of a journal. 182 mm when not given.
    field : str, optional
        Field that the pictures show: ``plastic-strain`` (when not given), ``temperature``, ``von-mises-stress``, ``pressure``, ``speed``,
        ``density`` or ``damage``.
    fields : bool
        Whether to write the fields of a model of two dimensions over time, as a series for ParaView (``fields.pvd``).
    animation : bool
        Whether to write an animation of one field (``animation.gif``) and its pictures (``frames/``).
    dump : bool
        Whether to write the fields over time in LAMMPS' format of dumps, for OVITO (``dump/``).
    frames : int, optional
        Most frames of ``fields``, ``animation`` and ``dump``, 2 to 1000; 64 when not given.
    checkpoint : float or str, optional
        How often a numerical model leaves a checkpoint in ``out`` [s], or a text such as ``"5 min"``; 60 s when not given.
        Ctrl-C leaves one as well.
    resume : bool
        Whether to continue from the checkpoint in ``out``; without one there, the run starts at the beginning.
    seeds : int, optional
        Packings of model ``particles`` to run, 2 to 1000: the seed of the case and the next ones. ``result.seeds`` then has mean, standard
        deviation and range of every result number.
    units : str, optional
        Unit system of the tables in ``out``: ``"SI"``, ``"mm-ms-kN"``, ``"cm-g-us"``, ``"in-lb-s"`` or another one of decks. Names of columns
        say so; attributes of the result keep the units of their names.
    progress : callable or bool, optional
        Called with the progress, 0 to 1, and a short text; ``True`` and ``False`` show a bar or none. When not given, a bar of tqdm
        is shown after a second, in a notebook or terminal with tqdm.
    projectile_law, target_law : callable, optional
        A strength law in Python that replaces that of the material: flow stress [Pa] from plastic strain, strain rate [1/s] and
        temperature [K]. Slow: the solver calls it for every flowing element and step, three times for the slopes, so a run takes
        hundreds of times as long. An exception in it ends the run.
    resistance_law : callable, optional
        A law in Python that replaces the target resistance: pressure on the crater floor [Pa], inertia of the
        target included, from the floor's depth [m] and the speed at which it advances [m/s]. For model ``chain`` with the target
        resistance model ``expanding-cavity``, for thick targets of one metal. Slow: the solver calls it once or twice a step.

    Returns
    -------
    RunResult
        The same numbers, to the last bit, as ``percuss run --json`` prints.

    Raises
    ------
    NotApplicableError
        When the model does not apply to the case; :func:`compare` lists the models that apply.
    NumericalError
        When the solution fails or its balances do not close.

    Examples
    --------
    >>> result = percuss.run("cases/paper-table1/scenario.toml")
    >>> result.outcome, round(result.depth_of_penetration_mm, 4)
    ('rebounded', 0.208)
    >>> answer = percuss.run("cases/paper-table1/scenario.toml", reference="standard").axisymmetric
    >>> answer.quantity, len(answer.meshes), answer.value > answer.uncertainty > 0
    ('depth_of_penetration_mm', 3, True)
    """
    laws = (projectile_law, target_law, resistance_law)
    if reference not in (None, "standard", "fine"):
        raise UsageError(f"`reference` is {reference!r}; allowed: None, 'standard' or 'fine'")
    if reference is not None and model not in (None, "chain"):
        raise UsageError(f"`reference` has no effect with model `{model}`: leave one of both out, or give model `chain`")
    if reference is not None and any(law is not None for law in laws):
        raise UsageError("`reference` needs laws of the library: leave it out, or add the law to the library")
    written: dict[str, Any] = {"field": field, "fields": fields, "animation": animation, "dump": dump, "frames": frames, "resume": resume, "seeds": seeds, "units": units}
    written["figures"] = formats(figures)
    written["figure_width"] = figure_width
    if mesh_tolerance is not None and any(law is not None for law in laws):
        raise UsageError("`mesh_tolerance` needs laws of the library: leave it out, or add the law to the library")
    written["mesh_tolerance"] = mesh_tolerance
    if out is not None or checkpoint is not None or any(value not in (None, False) for value in written.values()):
        if any(law is not None for law in laws):
            raise UsageError("files can be written only for runs with laws of the library: leave out `out`, or add the law to the library")
        every = f"{float(checkpoint)!r} s" if isinstance(checkpoint, Real) else checkpoint
        response = execute(
            "run", of=case, model=model, out=out, reference=reference, fast=reference is None, checkpoint=every, progress=progress, **written
        )
        run_output = response.run()
        assert run_output is not None
        return RunResult(run_output, response)
    native_case = case._native if isinstance(case, Case) else native(case)
    if progress is False or callable(progress):
        on_progress = progress or None
        return RunResult(_percuss.run(native_case, model, history, on_progress, *laws, reference))
    with watching(progress) as bar:
        return RunResult(_percuss.run(native_case, model, history, bar, *laws, reference))


def compare(
    case: CaseLike,
    *,
    velocity: Speed | Iterable[float] | None = None,
    model: str | Sequence[str] | None = None,
    reference: str | None = None,
    fast: bool = False,
    out: Path | None = None,
    figures: str | Sequence[str] | None = None,
    figure_width: str | None = None,
    units: str | None = None,
    progress: Progress | bool | None = None,
) -> Comparison:
    """Runs every model on a case and compares their results.

    Parameters
    ----------
    case : Case or path
        The case, or its file.
    velocity : float, iterable of float or str, optional
        Impact velocities [m/s], or a value of ``--velocity`` such as ``"200..1500:27"`` or ``"experiments"``; that of the case when
        not given.
    model : str or sequence of str, optional
        Models to compare; all quick ones, and ``axi`` on several meshes, when not given.
    reference : str, optional
        Meshes of ``axi``, ``"standard"`` or ``"fine"``; standard at one velocity within 60 s of processor time when not given.
    fast : bool
        Whether to leave ``axi`` out.
    out : path, optional
        Folder for a copy of the case, the numbers and the figure, as ``percuss compare --out`` writes them; made if it does not exist.
    figures : str or sequence of str, optional
        Formats of the figures in ``out``: ``svg``, ``png`` and ``pdf``, or ``"none"``; SVG and PNG when not given.
    figure_width : str, optional
        Width of the figures in print, 60 mm to 182 mm; ``"88 mm"`` fits a column of a journal. 182 mm when not given.
    units : str, optional
        Unit system of the tables in ``out``, as in :func:`run`.
    progress : callable or bool, optional
        As in :func:`run`.

    Examples
    --------
    >>> comparison = percuss.compare("cases/paper-table1/scenario.toml", velocity=[200, 230])
    >>> [choice.model for choice in comparison.recommended[0].models]
    ['chain']
    """
    found = execute(
        "compare",
        of=case,
        velocity=speeds(velocity),
        model=several(model),
        reference=reference,
        fast=fast,
        out=out,
        figures=formats(figures),
        figure_width=figure_width,
        units=units,
        progress=progress,
    )
    return Comparison(found)


def limit(
    case: CaseLike | None = None,
    *,
    velocity: str | tuple[float, float] | None = None,
    tolerance: Speed | None = None,
    points: int | None = None,
    model: str | Sequence[str] | None = None,
    reference: str | None = None,
    fast: bool = False,
    tests: Path | None = None,
    span: Speed | None = None,
    out: Path | None = None,
    figures: str | Sequence[str] | None = None,
    figure_width: str | None = None,
    progress: Progress | bool | None = None,
) -> Limits:
    """Finds the ballistic limit of a case with all applicable models, or V50 from test results.

    Parameters
    ----------
    case : Case or path, optional
        The case, or its file; optional when ``tests`` is given.
    velocity : tuple of float or str, optional
        Lowest and highest impact velocity to search [m/s]; 0 to 2000 m/s when not given.
    tolerance : float or str, optional
        Largest bracket between partial and complete penetration [m/s], or a percentage such as ``"0.2 %"``; 0.1 m/s when not given.
    points : int, optional
        Residual velocities to compute above the limit; 12 when not given.
    model : str or sequence of str, optional
        Models to search with; all except those that may take minutes when not given.
    reference : str, optional
        ``"standard"`` or ``"fine"``: meshes of the limit by ``axi``, whatever they cost; ``"standard"``, within 60 s of processor time,
        when neither this nor ``model`` is given. ``axisymmetric`` has the limit of fine meshes.
    fast : bool
        Leave the axisymmetric limit out.
    tests : path, optional
        CSV file of tests with the columns ``impact_velocity_m_s`` and ``perforated``.
    span : float or str, optional
        Largest span of the velocities that V50 is the mean of [m/s].
    out : path, optional
        Folder for a copy of the case, the numbers and the figures, as ``percuss limit --out`` writes them; made if it does not exist.
    figures : str or sequence of str, optional
        Formats of the figures in ``out``: ``svg``, ``png`` and ``pdf``, or ``"none"``; SVG and PNG when not given.
    figure_width : str, optional
        Width of the figures in print, 60 mm to 182 mm; ``"88 mm"`` fits a column of a journal. 182 mm when not given.
    progress : callable or bool, optional
        As in :func:`run`.

    Examples
    --------
    >>> limits = percuss.limit("cases/weldox-460e-12mm-blunt/scenario.toml", model="plugging", points=0)
    >>> limits.results[0].outcome
    'found'
    """
    if isinstance(velocity, tuple):
        velocity = "..".join(repr(float(end)) for end in velocity)
    found = execute(
        "limit",
        of=case,
        velocity=velocity,
        tolerance=with_unit(tolerance),
        points=points,
        model=several(model),
        reference=reference,
        fast=fast,
        tests=tests,
        span=with_unit(span),
        out=out,
        figures=formats(figures),
        figure_width=figure_width,
        progress=progress,
    )
    return Limits(found)


def converge(
    case: CaseLike,
    *,
    model: str | None = None,
    levels: int | None = None,
    out: Path | None = None,
    figures: str | Sequence[str] | None = None,
    figure_width: str | None = None,
    progress: Progress | bool | None = None,
) -> Convergence:
    """Refines the mesh of a case and assesses its convergence.

    Parameters
    ----------
    case : Case or path
        The case, or its file; its mesh is the coarsest one.
    model : str, optional
        Name of the model; ``chain`` when not given.
    levels : int, optional
        Number of meshes, 3 to 8, each twice as fine as the last; 4 when not given. Three meshes give one observed order, which does not confirm convergence.
    out : path, optional
        Folder for the study and its figures, as ``percuss converge --out`` writes them; made if it does not exist.
    figures : str or sequence of str, optional
        Formats of the figures in ``out``: ``svg``, ``png`` and ``pdf``, or ``"none"``; SVG and PNG when not given.
    figure_width : str, optional
        Width of the figures in print, 60 mm to 182 mm; ``"88 mm"`` fits a column of a journal. 182 mm when not given.
    progress : callable or bool, optional
        As in :func:`run`.

    Examples
    --------
    >>> study = percuss.converge("cases/taylor-copper-wilkins/scenario.toml", levels=3)
    >>> [mesh.projectile_elements for mesh in study.meshes]
    [40, 80, 160]
    """
    return Convergence(execute("converge", of=case, model=model, levels=levels, out=out, figures=formats(figures), figure_width=figure_width, progress=progress))


def export(case: CaseLike, *, to: str, out: Path) -> dict[str, Any]:
    """Writes the input of another code for a case, and returns what was written.

    Parameters
    ----------
    case : Case or path
        The case, or its file.
    to : str
        The code: ``"lammps"``, for bodies of bonded particles that do not break.
    out : path
        Folder for the input, as ``percuss export --out`` writes it; made if it does not exist.

    Raises
    ------
    NotApplicableError
        Where the model or the code cannot take the case.

    Examples
    --------
    >>> import tempfile
    >>> percuss.export("cases/lattice-strip-on-wall/scenario.toml", to="lammps", out=tempfile.mkdtemp())["bonds"]
    46382
    """
    found: dict[str, Any] = answer("export", of=case, to=to, out=out)
    return found


def validate(
    *,
    model: str | Sequence[str] | None = None,
    kind: str | Sequence[str] | None = None,
    data: Path | Sequence[Path] | None = None,
    materials: Path | Sequence[Path] | None = None,
    out: Path | None = None,
    figures: str | Sequence[str] | None = None,
    figure_width: str | None = None,
    progress: Progress | bool | None = None,
) -> Validation:
    """Compares all applicable models with published tests.

    Parameters
    ----------
    model : str or sequence of str, optional
        Models to validate; all except those that may take minutes when not given.
    kind : str or sequence of str, optional
        Kinds of tests; all when not given.
    data : path or sequence of paths, optional
        CSV files of tests; ``builtin`` selects those of the program.
    materials : path or sequence of paths, optional
        Files of materials for the tests, in addition to the library.
    out : path, optional
        Folder for the report with its figures, and the numbers, as ``percuss validate --out`` writes them; made if it does not exist.
    figures : str or sequence of str, optional
        Formats of the figures in ``out`` beside the PNG of the report: ``svg``, ``png`` and ``pdf``, or ``"none"``; SVG and PNG when not given.
    figure_width : str, optional
        Width of the figures in print, 60 mm to 182 mm; ``"88 mm"`` fits a column of a journal. 182 mm when not given.
    progress : callable or bool, optional
        As in :func:`run`.

    Examples
    --------
    >>> validation = percuss.validate(model="taylor", kind="taylor")
    >>> validation.models
    ['taylor']
    """
    found = execute(
        "validate",
        model=several(model),
        kind=several(kind),
        data=several(data),
        materials=several(materials),
        out=out,
        figures=formats(figures),
        figure_width=figure_width,
        progress=progress,
    )
    return Validation(found)
