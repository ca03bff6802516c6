"""Shapes and models, read and made by NumPy alone: files, Procrustes analysis, principal components.

A model is its mean (d n), unit modes (d n x q, columns), standard deviations and what is known with it. Shapes are
columns.
"""
import dataclasses
import math
import pathlib
import zipfile

import numpy as np

SMALLEST_DEVIATION = 1e-6  # of the largest: modes below are dropped


@dataclasses.dataclass
class Model:
    dimension: int
    mean: np.ndarray
    modes: np.ndarray
    deviations: np.ndarray
    unit: str = "units"
    shapes: np.ndarray = None
    alignment: str = "none"
    role: str = None  # training, within-modes, test
    noise_variance: float = 0.0
    cells: int = 0
    orthogonality: float = 0.0
    dropped: int = 0

    @property
    def scaled(self):
        return self.modes * self.deviations

    @property
    def points(self):
        return len(self.mean) // self.dimension

    @property
    def total(self):
        return float((self.deviations**2).sum())

    @property
    def size(self):
        points = self.mean.reshape(-1, self.dimension)
        return math.sqrt(((points - points.mean(axis=0)) ** 2).sum() / len(points))

    def first(self, modes):
        return dataclasses.replace(self, modes=self.modes[:, :modes], deviations=self.deviations[:modes])


def model_of_columns(dimension, mean, columns, **more):
    """The model with covariance `columns columns^T`, which need not be orthogonal."""
    left, values, _ = np.linalg.svd(columns, full_matrices=False)
    kept = int((values >= SMALLEST_DEVIATION * values[0]).sum())
    lengths = np.linalg.norm(columns, axis=0)
    used = columns[:, lengths > 0] / lengths[lengths > 0]
    cosines = np.abs(used.T @ used - np.eye(used.shape[1]))
    return Model(dimension, mean, left[:, :kept], values[:kept], dropped=columns.shape[1] - kept,
                 orthogonality=float(cosines.max(initial=0.0)), **more)


def model_of_shapes(dimension, shapes, alignment, **more):
    """Principal components of shapes in one frame, divisor N - 1."""
    mean = shapes.mean(axis=1)
    count = shapes.shape[1]
    left, values, _ = np.linalg.svd((shapes - mean[:, None]) / math.sqrt(count - 1), full_matrices=False)
    left, values = left[:, : count - 1], values[: count - 1]
    kept = int((values >= SMALLEST_DEVIATION * values[0]).sum())
    return Model(dimension, mean, left[:, :kept], values[:kept], shapes=shapes, alignment=alignment, role="training", **more)


# ------------------------------------------------------------------- Procrustes


def _centred(shapes, dimension):
    points = shapes.T.reshape(shapes.shape[1], -1, dimension)
    centres = points.mean(axis=1, keepdims=True)
    return points - centres, centres


def moved_onto(target, shapes, dimension, scale=False):
    """Every shape turned and shifted (and scaled) onto the target, without reflection."""
    goal, centre = _centred(target[:, None], dimension)
    points, _ = _centred(shapes, dimension)
    products = np.einsum("vi,svj->sij", goal[0], points)
    left, values, right = np.linalg.svd(products)
    signs = np.ones_like(values)
    signs[:, -1] = np.sign(np.linalg.det(left) * np.linalg.det(right))
    turns = np.einsum("sik,sk,skj->sij", left, signs, right)
    moved = np.einsum("sij,svj->svi", turns, points)
    if scale:
        moved *= ((values * signs).sum(axis=1) / (points**2).sum(axis=(1, 2)))[:, None, None]
    return (moved + centre).reshape(shapes.shape[1], -1).T


def motion_onto(target, mean, dimension, scale=False):
    """(factor, rotation, shift) that bring one mean onto the other."""
    goal, centre = target.reshape(-1, dimension), target.reshape(-1, dimension).mean(axis=0)
    points = mean.reshape(-1, dimension)
    middle = points.mean(axis=0)
    left, values, right = np.linalg.svd((goal - centre).T @ (points - middle))
    signs = np.ones(dimension)
    signs[-1] = np.sign(np.linalg.det(left) * np.linalg.det(right))
    turn = (left * signs) @ right
    factor = (values * signs).sum() / ((points - middle) ** 2).sum() if scale else 1.0
    return factor, turn, centre - factor * turn @ middle


def moved(model, motion):
    """A model in another frame, with its shapes."""
    factor, turn, shift = motion
    dimension = model.dimension

    def turned(columns):
        return np.einsum("ij,pjn->pin", turn, columns.reshape(-1, dimension, columns.shape[1])).reshape(columns.shape)

    together = np.tile(shift, model.points)
    shapes = None if model.shapes is None else factor * turned(model.shapes) + together[:, None]
    return dataclasses.replace(model, mean=factor * turned(model.mean[:, None])[:, 0] + together, modes=turned(model.modes),
                               deviations=factor * model.deviations, shapes=shapes,
                               noise_variance=factor**2 * model.noise_variance)


def rescaled(model, factor):
    """A model in another unit."""
    return dataclasses.replace(model, mean=factor * model.mean, deviations=factor * model.deviations)


def centroid_sizes(shapes, dimension):
    return np.sqrt((_centred(shapes, dimension)[0] ** 2).sum(axis=(1, 2)))


def procrustes_analysis(shapes, dimension, scale=False):
    """All shapes moved onto their common mean, which starts as the first; where sizes change it ends with their mean size."""
    size = centroid_sizes(shapes, dimension).mean()

    def resized(mean):
        if not scale:
            return mean
        points, centre = _centred(mean[:, None], dimension)
        return (points[0] * (size / np.linalg.norm(points)) + centre[0]).ravel()

    mean = resized(shapes[:, 0])
    for _ in range(500):
        shapes = moved_onto(mean, shapes, dimension, scale)
        after = resized(shapes.mean(axis=1))
        change = np.linalg.norm(after - mean)
        mean = after
        if change <= 1e-12 * size:
            break
    if scale:
        middle = shapes.mean(axis=1)[:, None]
        points, centre = _centred(middle, dimension)
        factor, centre = size / np.linalg.norm(points), np.tile(centre[0, 0], shapes.shape[0] // dimension)[:, None]
        shapes = centre + factor * (shapes - centre)
    return shapes


def motions(mean, dimension):
    """Orthonormal directions of translations and small rotations of points."""
    points = mean.reshape(-1, dimension)
    points = points - points.mean(axis=0)
    directions = [np.tile(axis, (len(points), 1)) for axis in np.eye(dimension)]
    for one in range(dimension):
        for other in range(one + 1, dimension):
            turn = np.zeros_like(points)
            turn[:, one], turn[:, other] = -points[:, other], points[:, one]
            directions.append(turn)
    columns = np.array([direction.ravel() for direction in directions]).T
    left, values, _ = np.linalg.svd(columns, full_matrices=False)
    return left[:, values > 1e-9 * values[0]]


# ------------------------------------------------------------------------ files


def read_tps(path):
    """Specimens of a TPS file of landmarks alone, with SCALE: (dimension, columns)."""
    specimens, scales, dimension = [], [], 2
    for line in pathlib.Path(path).read_text().splitlines():
        key, _, value = line.partition("=")
        if key.upper() in ("LM", "LM3"):
            dimension = 3 if key.upper() == "LM3" else 2
            specimens.append([])
            scales.append(1.0)
        elif key.upper() == "SCALE":
            scales[-1] = float(value)
        elif "=" not in line and line.strip():
            specimens[-1].extend(float(word) for word in line.split())
    return dimension, np.array([np.array(one) * scale for one, scale in zip(specimens, scales)]).T


def population(shapes, dimension, scale=False, **more):
    """The model that opening a set of shapes makes."""
    aligned = procrustes_analysis(shapes, dimension, scale)
    return model_of_shapes(dimension, aligned, "similarity" if scale else "rigid", **more)


def _with_coefficients(model, shapes):
    """Training shapes from a file of a model. They count as aligned where no mode moves or turns the whole."""
    count = shapes.shape[1]
    along = motions(model.mean, model.dimension).T @ model.scaled
    aligned = (along**2).sum() <= 1e-3 * model.total
    role = "training" if len(model.deviations) + 1 >= count else "within-modes"
    return dataclasses.replace(model, shapes=shapes, alignment="rigid" if aligned else "none", role=role)


def read_packed(path):
    """A model in whole numbers, as the packaged heads (demos/heads/PROVENANCE.md, "Format")."""
    given = np.load(path)
    mean = given["mean"].astype(float).ravel()
    columns = (given["basis"].astype(float) * given["basis_scale"].astype(float)[:, None]).T
    stated = float(given["noise_variance"]) if "noise_variance" in given else 0.0
    model = model_of_columns(3, mean, columns, unit=str(given["unit"]), cells=len(given["faces"]), noise_variance=stated)
    lengths = given["training_coefficients"].astype(float) * given["training_scale"].astype(float)[:, None]
    units = columns / np.linalg.norm(columns, axis=0)
    return _with_coefficients(model, mean[:, None] + units @ lengths)


read_heads = read_packed


def read_plain(path):
    """A NumPy archive with mean (n x d), basis (d n x q) and variances, eigenvalues or nothing."""
    given = np.load(path, allow_pickle=False)
    mean = given["mean"].astype(float)
    basis = given["basis"].astype(float)
    dimension = mean.shape[1]
    variances = next((given[name].astype(float) for name in ("eigenvalues", "variances") if name in given), None)
    columns = basis if variances is None else basis * np.sqrt(variances)
    return model_of_columns(dimension, mean.ravel(), columns, cells=len(given["faces"]) if "faces" in given else 0,
                            unit=str(given["unit"]) if "unit" in given else "units")


def read_zip_of_points(path):
    """Shapes from an archive of text files with a point a line."""
    shapes = []
    with zipfile.ZipFile(path) as archive:
        for name in sorted(archive.namelist()):
            rows = [line.replace(",", " ").split() for line in archive.read(name).decode().splitlines()]
            shapes.append([float(word) for row in rows if row for word in row])
    return np.array(shapes).T


# ------------------------------------------------------------------------ demos


def stars(row):
    """The pair of a setting (a, b, c) of table 1, one tip swept at a time in steps of 1 degree."""
    a, b, c = row

    def star(tip, degrees):
        points = []
        for number in range(5):
            angle = math.pi / 2 + 2 * math.pi / 5 * number
            turned = angle + (math.radians(degrees) if number == tip else 0.0)
            points += [10 * math.cos(turned), 10 * math.sin(turned)]
            points += [3 * math.cos(angle + math.pi / 5), 3 * math.sin(angle + math.pi / 5)]
        return points

    def swept(sweeps):
        shapes = np.array([star(tip, degrees) for tip, low, high in sweeps for degrees in range(low, high + 1)]).T
        count = shapes.shape[1]
        mean = shapes.mean(axis=1)
        return model_of_columns(2, mean, (shapes - mean[:, None]) / math.sqrt(count - 1), cells=10)

    return swept([(0, -a, b), (2, -a, b)]), swept([(0, -c, a), (3, -c, a)])


def planes():
    """Two ellipses in planes at 50 degrees."""
    tilt = math.radians(50)
    second = np.array([[0.0, 1.2 * math.cos(tilt), 1.2 * math.sin(tilt)], [1.0, 0.0, 0.0]]).T
    return (model_of_columns(3, np.zeros(3), np.array([[1.5, 0.0, 0.0], [0.0, 1.0, 0.0]]).T),
            model_of_columns(3, np.array([0.4, 0.0, 0.0]), second))


def wings(folder):
    """Both genera in one frame and size."""
    groups = [read_tps(pathlib.Path(folder) / f"wings-{genus}.tps")[1] for genus in ("aedes", "culex")]
    count = groups[0].shape[1]
    together = procrustes_analysis(np.concatenate(groups, axis=1), 2, scale=True)
    return [model_of_shapes(2, part, "similarity") for part in (together[:, :count], together[:, count:])]
