"""Write the packaged mosquito wings: landmarks of two genera from PyPI `ktch`.

Usage: python demos/make_wings.py [--cache DIR] [--out DIR]

Writes wings-aedes.tps, wings-culex.tps and PROVENANCE.md. Needs Python 3.11 alone;
pip fetches the wheel once. The numbers are written as the package has them.
"""

import argparse
import csv
import hashlib
import io
import math
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

PACKAGE = "ktch"
VERSION = "0.11.1"
WHEEL = f"{PACKAGE}-{VERSION}-py3-none-any.whl"
SHA256 = "be2190d9f5c302e06d61a3de492f9a867760787bd5780fa20e8efe4c4ebe597a"

FOLDER = "ktch/datasets/data/landmark_mosquito_wings/"
COORDINATES = FOLDER + "data_landmark_mosquito_wings.csv"
GENERA_OF_SPECIMENS = FOLDER + "meta_landmark_mosquito_wings.csv"
LANDMARKS = 18

CODES = {"aedes": "AE", "culex": "CX"}  # code of the genus in the package
COUNTS = {"aedes": 57, "culex": 25}
PLACES = 4  # digits behind the point


def fetch_wheel(cache):
    """Return the path of the checked wheel, downloading it into `cache` if needed."""
    path = Path(cache) / WHEEL
    if not path.exists():
        subprocess.run([sys.executable, "-m", "pip", "download", "--no-deps",
                        "--only-binary=:all:", f"{PACKAGE}=={VERSION}", "-d", str(cache)],
                       check=True)
    found = hashlib.sha256(path.read_bytes()).hexdigest()
    if found != SHA256:
        raise SystemExit(f"{WHEEL}: sha256 is {found}, expected {SHA256}")
    return path


def rows_of(wheel, member):
    """The rows of a table as dictionaries."""
    return list(csv.DictReader(io.StringIO(wheel.read(member).decode("utf-8"))))


def read_wings(wheel):
    """Return, by genus, a list of (specimen number, 18 landmarks as pairs of numbers)."""
    genus_of = {row["specimen_id"]: row["genus"] for row in rows_of(wheel, GENERA_OF_SPECIMENS)}
    landmarks = {}
    for row in rows_of(wheel, COORDINATES):
        wing = landmarks.setdefault(row["specimen_id"], [])
        if int(row["coord_id"]) != len(wing):
            raise SystemExit(f"specimen {row['specimen_id']}: its landmarks are not in order")
        wing.append((float(row["x"]), float(row["y"])))
    groups = {}
    for name, code in CODES.items():
        group = [(int(number), landmarks[number]) for number, of in genus_of.items() if of == code]
        if len(group) != COUNTS[name] or any(len(wing) != LANDMARKS for _, wing in group):
            raise SystemExit(f"{code}: {COUNTS[name]} specimens of {LANDMARKS} landmarks were "
                             f"expected, found {len(group)} specimens")
        groups[name] = group
    return groups


def tps(group, code):
    """A group of wings as a TPS file."""
    lines = []
    for number, wing in group:
        lines.append(f"LM={LANDMARKS}")
        lines += [f"{x:.{PLACES}f} {y:.{PLACES}f}" for x, y in wing]
        lines.append(f"ID={code}-{number}")
    return "\n".join(lines) + "\n"


def furthest_from(group, measure, expected):
    """Largest distance of `measure` of a wing from `expected`."""
    return max(abs(measure(wing) - expected) for _, wing in group)


def centroid_size(wing):
    """Square root of the sum of squared distances of the landmarks from their centroid."""
    centre = [sum(axis) / len(wing) for axis in zip(*wing)]
    return math.sqrt(sum((x - c) ** 2 for point in wing for x, c in zip(point, centre)))


def off_centre(wing):
    """Distance of the centroid from the origin."""
    return math.hypot(*(sum(axis) / len(wing) for axis in zip(*wing)))


def provenance(groups, files):
    """The text of PROVENANCE.md."""
    rows = "\n".join(
        f"| `wings-{name}.tps` | {CODES[name]}, specimens {group[0][0]} to {group[-1][0]} "
        f"| {len(group)} | {len(files[name]):,} | `{hashlib.sha256(files[name]).hexdigest()}` |"
        for name, group in groups.items())
    both = [wing for group in groups.values() for wing in group]
    size, centre = furthest_from(both, centroid_size, 1), furthest_from(both, off_centre, 0)
    return f"""# Packaged wings: where they come from

Landmarks of mosquito wings, measured by Rohlf and Slice, of the genera Aedes and Culex.

The two files are made by `demos/make_wings.py`, which also wrote this page. Run: `python demos/make_wings.py`.

| | |
|---|---|
| data | Rohlf, F. J. & Slice, D. (1990). Extensions of the Procrustes method for the optimal superimposition of landmarks. *Systematic Zoology* 39, 40–59. https://doi.org/10.2307/2992207 |
| package | PyPI `{PACKAGE}` {VERSION}, `{WHEEL}`, by Koji Noshita, who names SB Morphometrics (https://www.sbmorphometrics.org/data/RohlfSlice1990Mosq.nts) as its origin |
| sha256 of the wheel | `{SHA256}` |
| members used | `{COORDINATES}`, `{GENERA_OF_SPECIMENS}` |
| licence of these members | Apache-2.0, that of the package ([text](../../LICENSE-APACHE)); the package has no NOTICE |
| licence of the files made here | Apache-2.0, like the data; changed as described below |

## What was done

* Of the 127 specimens the {COUNTS["aedes"]} of the genus with the code AE (Aedes) and the {COUNTS["culex"]} with CX (Culex) were taken: the two largest groups. The package has codes only; the names are ours.
* The numbers are those of the package, all four digits; only their layout changed. `ID` is the code and the specimen's number in the package, from 0.
* The coordinates have no unit. The package has the wings centred (to {centre:.0e}) and in unit centroid size (to {size:.0e}), so size is not in the data; it has not turned them onto one another.
* The demo models `wings-aedes` and `wings-culex` are made when they are opened: all {len(both)} wings are aligned together by generalised Procrustes analysis with rotation, shift and scale, and each genus gets a model by principal components (divisor n − 1).

What a group varies in is how the specimens of a genus differ, of whatever species they are; no species is given.

## Files

TPS, {LANDMARKS} landmarks a specimen, x and y.

| file | rows of the package | specimens | bytes | sha256 |
|---|---|---|---|---|
{rows}
"""


def main():
    """Fetch, select, write."""
    here = Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cache", type=Path, help="where the wheel is kept",
                        default=Path(tempfile.gettempdir()) / "shapevenn-ktch")
    parser.add_argument("--out", type=Path, help="where the files go", default=here / "wings")
    options = parser.parse_args()
    options.cache.mkdir(parents=True, exist_ok=True)
    options.out.mkdir(parents=True, exist_ok=True)

    with zipfile.ZipFile(fetch_wheel(options.cache)) as wheel:
        groups = read_wings(wheel)
    files = {name: tps(group, CODES[name]).encode("ascii") for name, group in groups.items()}
    for name, file in files.items():
        (options.out / f"wings-{name}.tps").write_bytes(file)
    text = provenance(groups, files)
    (options.out / "PROVENANCE.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
