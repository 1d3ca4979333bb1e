"""Models, materials, schema of case files, and the starter case."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path as FilePath
from typing import Any

from .command_line import CaseLike, Path, answer, execute, formats, several
from .record import Record, Records


class Material(Record):
    """Record of a material: the values of ``percuss materials --json``.

    Attributes
    ----------
    id, name, family, state, trust, note : str
        Names, trust grade and note.
    sources : list of str
        Keys of the bibliography.
    strength : Record
        The strength law and its constants, as in a case file.
    bar_wave_speed_m_s, bar_impedance_kg_m2_s : float
        Speed of elastic waves in a bar [m/s] and its impedance per area [kg/(m2 s)].
    """

    id: str
    name: str
    density: str
    strength: Record
    trust: str
    sources: list[str]
    bar_wave_speed_m_s: float
    bar_impedance_kg_m2_s: float

    def _shown(self) -> list[tuple[str, str]]:
        (law, constants), *_ = self._data["strength"].items()
        rows = [*super()._shown(), ("strength", law.replace("_", " "))]
        rows += [(f"strength.{name}", str(value)) for name, value in constants.items()]
        return [*rows, ("sources", ", ".join(self.sources))]


class Model(Record):
    """Description and range of validity of a model: the values of ``percuss models --json``.

    Attributes
    ----------
    name, summary : str
        Name and description.
    validity : Record
        Range of validity: ``projectile``, ``targets``, ``noses``, ``projectile_materials``, ``target_materials``, ``ranges``, ``notes``.
    options : list of str
        Keys of its table in a case.
    page : str
        Page with its equations, sources and checks, in the folder of the project.
    """

    name: str
    summary: str
    validity: Record
    options: list[str]
    page: str

    def _shown(self) -> list[tuple[str, str]]:
        validity = self._data["validity"]
        names = ["projectile", "targets", "noses", "projectile_materials", "target_materials", "predicts"]
        rows = [(name.replace("_", " "), ", ".join(validity[name]).replace("_", " ")) for name in names]
        rows += [("note", note) for note in validity["notes"]]
        return [*super()._shown(), *rows, ("options", ", ".join(self.options))]


def materials(
    search: str | None = None,
    *,
    group: str | None = None,
    family: str | None = None,
    hardness: str | tuple[float, float] | None = None,
    case: CaseLike | None = None,
    file: Path | None = None,
) -> Records[Material]:
    """Lists the materials of the library.

    Parameters
    ----------
    search : str, optional
        Words to search for in id, family, group, name, aliases and state, such as ``"aluminium"``; all materials when not given.
    group : str, optional
        Only materials of a group, such as ``"steel"``.
    family : str, optional
        Only the alternative records of one material.
    hardness : str or tuple of float, optional
        Only materials with a Brinell hardness in this range [kgf/mm2], such as ``(350, 500)`` or ``"350..500"``.
    case : Case or path, optional
        Case whose materials are included, and those of the files that it names.
    file : path, optional
        File whose materials are included; each is checked.

    Examples
    --------
    >>> "copper-woodward" in [material.id for material in percuss.materials()]
    True
    >>> [material.id for material in percuss.materials("ti-6al-4v")]
    ['ti-6al-4v-meyer', 'ti-6al-4v-static', 'ti-6al-4v-steinberg']
    >>> [material.id for material in percuss.materials(group="steel", hardness=(360, 370))]
    ['rha-class-1-plate']
    """
    words = [] if search is None else [search]
    ends = hardness if hardness is None or isinstance(hardness, str) else "{}..{}".format(*hardness)
    records = answer("materials", *words, group=group, family=family, hardness=ends, case=case, file=file)
    return Records(map(Material, records), "id", "family", "group", "name", "state", "density", "trust", "sources")


def _names(names: tuple[str | Sequence[str], ...]) -> list[str]:
    """Names that are given one by one, or as a list."""
    return [name for given in names for name in several(given)]


def flow_curves(
    *names: str | Sequence[str],
    rate: str | Sequence[str] | None = None,
    temperature: str | None = None,
    case: CaseLike | None = None,
    file: Path | None = None,
    out: Path | None = None,
    figures: str | Sequence[str] | None = None,
    figure_width: str | None = None,
) -> Records[Record]:
    """Computes the flow curves of materials: stress against plastic strain at constant strain rates and one temperature.

    Parameters
    ----------
    names : str or sequence of str
        Ids, families or aliases.
    rate : str or sequence of str, optional
        Plastic strain rates with their units; ``"0.001 1/s"`` and ``"1000 1/s"`` when not given.
    temperature : str, optional
        Temperature with its unit; the room temperature of each record when not given.
    case, file : optional
        As in :func:`materials`.
    out : path, optional
        Folder for the curves and their figure; made if it does not exist.
    figures : str or sequence of str, optional
        Formats of the figures in ``out``: ``svg``, ``png`` and ``pdf``, or ``"none"``; SVG and PNG when not given.
    figure_width : str, optional
        Width of the figures in print, 60 mm to 182 mm; ``"88 mm"`` fits a column of a journal. 182 mm when not given.

    Returns
    -------
    Records of ``material``, ``strain_rate_per_s``, ``temperature_k``, ``plastic_strain`` and ``flow_stress_mpa``, one a curve.

    Raises
    ------
    MaterialError
        When a name is unknown or stands for several materials.

    Examples
    --------
    >>> slow, fast = percuss.flow_curves("ofhc")
    >>> round(slow.flow_stress_mpa[0])
    90
    """
    curves = answer("materials compare", *_names(names), rate=rate, temperature=temperature, case=case, file=file, out=out, figures=formats(figures), figure_width=figure_width)
    return Records(map(Record, curves), "material", "strain_rate_per_s", "temperature_k")


def export_materials(
    *names: str | Sequence[str],
    format: str | None = None,
    units: str | None = None,
    case: CaseLike | None = None,
    file: Path | None = None,
    out: Path | None = None,
) -> str:
    """Returns records of materials as text for a file of materials or a deck of LS-DYNA.

    Parameters
    ----------
    names : str or sequence of str
        Ids, families or aliases.
    format : str, optional
        ``"toml"``, records as in a case file, ``"json"``, ``"csv"``, a row for each material, or ``"ls-dyna"``, cards of a deck; TOML when not
        given.
    units : str, optional
        Unit system of a deck: length, mass and time, such as ``"mm-kg-ms"``.
    case, file : optional
        As in :func:`materials`.
    out : path, optional
        File for the text.

    Raises
    ------
    MaterialError
        When a name is unknown or stands for several materials.
    UsageError
        When a deck has no units, or a material has no place in its cards.

    Examples
    --------
    >>> print(percuss.export_materials("4340-johnson-cook", format="ls-dyna", units="mm-kg-ms").splitlines()[2])
    *MAT_JOHNSON_COOK_TITLE
    """
    found = answer("materials export", *_names(names), format=format, units=units, case=case, file=file, out=out)
    return str(found["text"])


def import_materials(deck: Path, *, units: str | None = None, out: Path | None = None) -> Record:
    """Reads materials from a deck of LS-DYNA, JSON or a table.

    Parameters
    ----------
    deck : path
        Deck with ``*MAT_JOHNSON_COOK``, ``*MAT_SIMPLIFIED_JOHNSON_COOK`` and ``*EOS_GRUNEISEN``, or a file that ends with ``.json`` or
        ``.csv``, as :func:`export_materials` writes it.
    units : str, optional
        Unit system of a deck: length, mass and time, such as ``"mm-kg-ms"``.
    out : path, optional
        File for the records as TOML, which ``material_files`` of a case can name.

    Returns
    -------
    Record of ``records``, the materials by their ids with the keys and units of a case file, and ``warnings``: what was left out or
    taken otherwise.

    Raises
    ------
    ReadError
        When the deck cannot be read.
    CaseError
        When a value is outside its range or the deck is not understood; it names file and line.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> deck = pathlib.Path(tempfile.mkdtemp(), "steel.k")
    >>> text = percuss.export_materials("4340-johnson-cook", format="ls-dyna", units="mm-kg-ms", out=deck)
    >>> found = percuss.import_materials(deck, units="mm-kg-ms")
    >>> [record.density for record in (found.records[id] for id in found.records)]
    ['7830 kg/m3']
    """
    return Record(answer("materials import", deck, units=units, out=out))


def material(name: str, *, case: CaseLike | None = None, file: Path | None = None) -> Material:
    """Returns all constants of a material, by its id, its family or an alias.

    Parameters
    ----------
    name : str
        Id, family or alias, such as ``"rha"``.
    case, file : optional
        As in :func:`materials`.

    Raises
    ------
    MaterialError
        When the name is unknown or stands for several materials.

    Examples
    --------
    >>> percuss.material("copper").id
    'copper-woodward'
    """
    return Material(answer("materials show", name, case=case, file=file))


def models() -> Records[Model]:
    """Lists the models with their ranges of validity.

    Examples
    --------
    >>> [model.name for model in percuss.models()][:3]
    ['chain', 'fdm', 'axi']
    """
    return Records(map(Model, answer("models")), "name", "summary", "page")


def model(name: str) -> Model:
    """Returns the range of validity of a model and its options in a case.

    Parameters
    ----------
    name : str
        Name of the model.

    Raises
    ------
    UsageError
        When the name is unknown.

    Examples
    --------
    >>> percuss.model("taylor").validity.predicts
    ['projectile_final_length_mm']
    """
    return Model(answer("models", name))


def schema() -> dict[str, Any]:
    """The JSON Schema (draft 2020-12) of case files: every key with its description, allowed units and allowed values.

    Examples
    --------
    >>> percuss.schema()["properties"]["projectile"]["description"]
    'What strikes.'
    """
    found: dict[str, Any] = answer("schema")
    return found


def new(name: Path, *, template: str | None = None, force: bool = False) -> FilePath:
    """Writes a starter case: a valid case with every option of a case file explained and commented out.

    Parameters
    ----------
    name : path
        Folder of the case, made if it does not exist; its name is the case's.
    template : str, optional
        ``"starter"`` or ``"brittle-plate"``, a glass plate for the model ``particles``; the starter case when not given.
    force : bool
        Whether to overwrite a case that exists.

    Returns
    -------
    path
        The case file.

    Raises
    ------
    WriteError
        When the case exists already, or cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> file = percuss.new(tempfile.mkdtemp() + "/my-case")
    >>> percuss.load(file).name
    'my-case'
    """
    (file,) = execute("new", name, template=template, force=force).files()
    return FilePath(file)
