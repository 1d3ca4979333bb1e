#!/usr/bin/env python3
"""Packs a program for a release: with licences, manual pages, completions and cases.

    packaging/archive.py PROGRAM TARGET FOLDER

writes FOLDER/percuss-VERSION-TARGET.tar.gz, or .zip for Windows, and a file with its SHA-256 beside it. The same files give the same bytes.
"""

import gzip
import hashlib
import pathlib
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TEXTS = ["README.md", "CHANGELOG.md", "CITATION.cff", "LICENSE-APACHE", "LICENSE-MIT"]
SHELLS = {"bash": "percuss.bash", "fish": "percuss.fish", "powershell": "percuss.ps1", "zsh": "_percuss"}
# The first moment that a zip file can hold.
MOMENT = (1980, 1, 1, 0, 0, 0)


def fill(folder: pathlib.Path, program: pathlib.Path, target: str) -> None:
    """Puts into a folder what an archive has."""
    shutil.copy(program, folder / program.name)
    for name in TEXTS:
        shutil.copy(ROOT / name, folder / name)
    shutil.copytree(ROOT / "cases", folder / "cases")
    licences = [sys.executable, ROOT / ".ci" / "dependencies", "--licences", folder / "LICENSES-THIRD-PARTY.txt", target]
    subprocess.run(licences, check=True, stdout=subprocess.DEVNULL)
    completions = folder / "completions"
    completions.mkdir()
    for shell, name in SHELLS.items():
        with open(completions / name, "wb") as file:
            subprocess.run([program, "completions", shell], check=True, stdout=file)
    subprocess.run([program, "man", "--out", folder / "man"], check=True, stdout=subprocess.DEVNULL)


def members(folder: pathlib.Path) -> list[pathlib.Path]:
    """Files of a folder in a fixed order."""
    return sorted(path for path in folder.rglob("*") if path.is_file())


def is_program(path: pathlib.Path) -> bool:
    return path.name in ("percuss", "percuss.exe")


def tar(folder: pathlib.Path, archive: pathlib.Path) -> None:
    with open(archive, "wb") as raw, gzip.GzipFile(filename="", fileobj=raw, mode="wb", mtime=0) as packed:
        with tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as out:
            for path in members(folder):
                entry = tarfile.TarInfo(path.relative_to(folder.parent).as_posix())
                entry.size = path.stat().st_size
                entry.mode = 0o755 if is_program(path) else 0o644
                with open(path, "rb") as file:
                    out.addfile(entry, file)


def zip_(folder: pathlib.Path, archive: pathlib.Path) -> None:
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as out:
        for path in members(folder):
            entry = zipfile.ZipInfo(path.relative_to(folder.parent).as_posix(), MOMENT)
            entry.external_attr = (0o755 if is_program(path) else 0o644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            out.writestr(entry, path.read_bytes())


def main() -> None:
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    program, target, out = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2], pathlib.Path(sys.argv[3]).resolve()
    if not is_program(program) or not program.is_file():
        sys.exit(f"{program}: no program of this name is there: build it with `cargo build --profile dist`")
    version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.split()[1]
    name = f"percuss-{version}-{target}"
    out.mkdir(parents=True, exist_ok=True)
    is_windows = "windows" in target
    archive = out / (name + (".zip" if is_windows else ".tar.gz"))
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work) / name
        folder.mkdir()
        fill(folder, program, target)
        (zip_ if is_windows else tar)(folder, archive)
    digest = hashlib.sha256(archive.read_bytes()).hexdigest()
    archive.with_name(archive.name + ".sha256").write_bytes(f"{digest}  {archive.name}\n".encode())
    print(f"{archive} ({archive.stat().st_size / 1e6:.1f} MB)")


if __name__ == "__main__":
    main()
