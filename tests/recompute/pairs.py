"""Two models in closed form: residuals, shares, angles, divergences, Grassmann distances, sigma, Gaussian fits.

Formulas: docs/method.md. Everything is formed in the space of the points; nothing is taken from the program.
"""
import math

import numpy as np

A, B = 0, 1
ROUNDING = 1e-6  # share of the size below which left-out errors and meetings are nothing
# Mean length over root mean square of isotropic vectors, in three digits: sqrt(pi)/2 and sqrt(8/(3 pi)).
NOISE_RATIO = {2: np.sqrt(np.pi) / 2, 3: np.sqrt(8 / (3 * np.pi))}


class Side:
    """What the shapes of one model leave outside the other: r(a) = r0 + R a, and the coefficients a' = a0 + P a."""

    def __init__(self, own, other, share=1.0):
        self.own, self.other, self.share = own, other, share
        apart = own.mean - other.mean
        self.r0 = apart - other.modes @ (other.modes.T @ apart)
        self.r = own.scaled - other.modes @ (other.modes.T @ own.scaled)
        self.a0 = (other.modes.T @ apart) / other.deviations
        self.p = (other.modes.T @ own.scaled) / other.deviations[:, None]
        self.dimension, self.points, self.q = own.dimension, own.points, len(own.deviations)
        self.gram, self.shift, self.constant = self.r.T @ self.r, self.r.T @ self.r0, float(self.r0 @ self.r0)
        self.precision = share * (np.eye(self.q) + self.p.T @ self.p)
        self.linear = share * (self.p.T @ self.a0)
        self.by_point = self.r.reshape(self.points, self.dimension, self.q)

    def lengths(self, coefficients):
        """Lengths of the residuals at the points (any x n) of rows of coefficients."""
        residuals = coefficients @ self.r.T + self.r0
        return np.linalg.norm(residuals.reshape(len(residuals), self.points, self.dimension), axis=2)

    def distances(self, coefficients):
        return np.concatenate([self.lengths(rows).mean(axis=1) for rows in np.array_split(coefficients, -(-len(coefficients) // 256))])

    def gradients(self, coefficients):
        """Distances and their gradients (any x q)."""
        values, slopes = [], []
        for rows in np.array_split(coefficients, -(-len(coefficients) // 128)):
            residuals = (rows @ self.r.T + self.r0).reshape(len(rows), self.points, self.dimension)
            lengths = np.linalg.norm(residuals, axis=2)
            values.append(lengths.mean(axis=1))
            units = residuals / np.maximum(lengths, 1e-18)[:, :, None]
            slopes.append(units.reshape(len(rows), -1) @ self.r / self.points)
        return np.concatenate(values), np.concatenate(slopes)

    def plausibility(self, coefficients):
        projected = coefficients @ self.p.T + self.a0
        return self.share * ((coefficients**2).sum(axis=1) + (projected**2).sum(axis=1))

    def is_contained(self, rounding):
        return max(np.abs(self.r).max(), np.abs(self.r0).max()) <= rounding


def scale(models):
    return max(models[A].size, math.sqrt(models[A].total / models[A].points))


def rounding(models):
    """Below this a length is nothing; files in single precision are not among the cases."""
    return 1e-9 * scale(models)


def spread(values):
    return [float(values.min()), float(values.mean()), float(values.max())]


def point_deviations(columns, dimension):
    """Standard deviation of every point, of the covariance columns columns^T."""
    return np.sqrt((columns**2).sum(axis=1).reshape(-1, dimension).sum(axis=1))


def mean_length(vector, dimension):
    return float(np.linalg.norm(vector.reshape(-1, dimension), axis=1).mean())


def principal_angles(one, other):
    """Radians between the column spaces of orthonormal bases, small ones from their sines."""
    wide, narrow = (one, other) if one.shape[1] >= other.shape[1] else (other, one)
    across = wide.T @ narrow
    cosines = np.linalg.svd(across, compute_uv=False)
    sines = np.sort(np.linalg.svd(narrow - wide @ across, compute_uv=False))
    sines = np.concatenate([np.zeros(narrow.shape[1] - len(sines)), sines]) if len(sines) < narrow.shape[1] else sines
    return np.where(cosines**2 > 0.5, np.arcsin(np.clip(sines, 0, 1)), np.arccos(np.clip(cosines, 0, 1)))


def grassmann(one, other, whole):
    """Affine Grassmann distance of (point, basis); not whole: bases cut, displacement of unit length (the paper's)."""
    count = None if whole else min(one[1].shape[1], other[1].shape[1])
    size = max(np.linalg.norm(one[0]), np.linalg.norm(other[0]))

    def embedded(point, basis):
        basis = basis[:, :count]
        away = point - basis @ (basis.T @ point)
        # A space through the origin has no displacement: what is left of it is rounding.
        if np.linalg.norm(away) <= 1e-12 * size:
            away = np.zeros_like(away)
        elif not whole:
            away = away / np.linalg.norm(away)
        last = 1 / math.sqrt(1 + away @ away)
        top = np.concatenate([basis, (away * last)[:, None]], axis=1)
        bottom = np.zeros((1, top.shape[1]))
        bottom[0, -1] = last
        return np.concatenate([top, bottom])

    return float(np.linalg.norm(principal_angles(embedded(*one), embedded(*other))))


class Joint:
    """An orthonormal basis of all shapes of both models about the mean of A, and what is said of Gaussians in it."""

    def __init__(self, models):
        self.models = models
        columns = np.concatenate([models[A].modes, models[B].modes, (models[B].mean - models[A].mean)[:, None]], axis=1)
        lengths = np.linalg.norm(columns, axis=0)
        columns = columns[:, lengths > 0] / lengths[lengths > 0]
        left, values, _ = np.linalg.svd(columns, full_matrices=False)
        self.basis = left[:, values > 1e-9 * values[0]]
        self.dimension = models[A].dimension
        self.means = [self.basis.T @ (model.mean - models[A].mean) for model in models]
        self.scaled = [self.basis.T @ model.scaled for model in models]
        self.modes = [self.basis.T @ model.modes for model in models]
        inside = self.basis.T @ models[A].mean
        self.away = (inside, float(np.linalg.norm(models[A].mean - self.basis @ inside)))

    def prior(self, side):
        return self.means[side], self.scaled[side] @ self.scaled[side].T

    def lift(self, side, moments):
        return self.means[side] + self.scaled[side] @ moments[0], self.scaled[side] @ moments[1] @ self.scaled[side].T

    def space(self, mean, modes):
        """For Grassmann distances: about the origin of the coordinates of the files."""
        return (np.append(self.away[0] + mean, self.away[1]), np.concatenate([modes, np.zeros((1, modes.shape[1]))]))

    def deviations(self, columns):
        return point_deviations(self.basis @ columns, self.dimension)


def pooled(moments):
    """Of the equal mixture."""
    if len(moments) == 1:
        return moments[0]
    (m1, c1), (m2, c2) = moments
    apart = (m1 - m2) / 2
    return (m1 + m2) / 2, (c1 + c2) / 2 + np.outer(apart, apart)


def components(covariance, most=None):
    """Eigenvectors and variances, largest first, without rounding."""
    values, vectors = np.linalg.eigh(covariance)
    values, vectors = values[::-1], vectors[:, ::-1]
    kept = int((values > 1e-10 * values[0]).sum())
    kept = kept if most is None else min(kept, most)
    return vectors[:, :kept], values[:kept]


def bhattacharyya(one, other, noise):
    size = len(one[0])
    noisy = [c + noise**2 * np.eye(size) for _, c in (one, other)]
    middle = (noisy[0] + noisy[1]) / 2
    apart = one[0] - other[0]
    logs = [np.linalg.slogdet(c)[1] for c in (middle, *noisy)]
    return float(apart @ np.linalg.solve(middle, apart) / 8 + (logs[0] - (logs[1] + logs[2]) / 2) / 2)


def kullback_leibler(one, other, noise):
    size = len(one[0])
    first, second = [c + noise**2 * np.eye(size) for _, c in (one, other)]
    apart = one[0] - other[0]
    trace = np.trace(np.linalg.solve(second, first))
    logs = np.linalg.slogdet(second)[1] - np.linalg.slogdet(first)[1]
    return float((trace + apart @ np.linalg.solve(second, apart) - size + logs) / 2)


# ------------------------------------------------------------------------ reach


def mean_square(side, rounding_of):
    """Parts of the mean square of the distance at the points: total, offset, offset closed, exclusive."""
    values, vectors = np.linalg.eigh(side.gram)
    along = vectors.T @ side.shift
    kept = values > 1e-9 * values.max()
    closed = min(max(float((along[kept] ** 2 / values[kept]).sum()), 0.0), side.constant)
    parts = [max(part, 0.0) / side.points for part in (side.constant - closed, closed, float(np.trace(side.gram)))]
    parts = [part if part > rounding_of**2 else 0.0 for part in parts]
    return [sum(parts), *parts]


def quantile_error(ascending, share):
    deviation = math.sqrt(share * (1 - share) / len(ascending))
    low, high = np.quantile(ascending, [max(share - deviation, 0), min(share + deviation, 1)])
    return float(high - low) / 2


def plausible_radius(q):
    """Wilson & Hilferty's approximation of the root of the 99 % quantile of chi squared."""
    share = 2 / (9 * q)
    return math.sqrt(q * (1 - share + 2.326347874040841 * math.sqrt(share)) ** 3)


def within_ball(nearest, variances, radius):
    """The b of length `radius` with the least sum of variances (b - nearest)^2."""
    low, high = 0.0, variances.max() * np.linalg.norm(nearest) / radius
    for _ in range(200):
        middle = (low + high) / 2
        found = nearest * variances / (variances + middle)
        low, high = (middle, high) if np.linalg.norm(found) > radius else (low, middle)
    return nearest * variances / (variances + (low + high) / 2)


class Meeting:
    """Least distance of plausible shapes, at every k-th point where there are more than 512."""

    def __init__(self, models):
        self.models = models
        dimension, points = models[A].dimension, models[A].points
        stride = -(-points // 512)
        rows = (np.arange(0, points, stride)[:, None] * dimension + np.arange(dimension)).ravel()
        self.offset = (models[A].mean - models[B].mean)[rows].reshape(-1, dimension)
        self.operator = np.concatenate([models[A].scaled[rows], -models[B].scaled[rows]], axis=1).reshape(
            len(self.offset), dimension, -1)
        self.split = len(models[A].deviations)

    def lengths(self, coefficients):
        return np.linalg.norm(self.offset + self.operator @ coefficients, axis=1)

    def least(self, radii):
        """(distance, how much lower the least one could be, relative): reweighted least squares about smoothed lengths.

        With lengths smoothed to sqrt(|r|^2 + e^2), e falling, the reweighting converges; u_v = r_v/sqrt(|r_v|^2 + e^2) has a length
        of one at most, so that the least of mean u_v.(offset + H c) over both balls is a bound from below: the gap of duality.
        """
        flat = self.operator.reshape(-1, self.operator.shape[2])
        parts = [slice(0, self.split), slice(self.split, None)]
        count, dimension = self.offset.shape
        smooth = np.linalg.norm(self.offset, axis=1).mean()
        weights = np.ones(count)
        best, bound = math.inf, -math.inf
        for _ in range(3000):
            heavy = flat * np.repeat(weights, dimension)[:, None]
            coefficients = self._in_balls(heavy.T @ flat, -heavy.T @ self.offset.ravel(), parts, radii)
            residuals = self.offset + self.operator @ coefficients
            lengths = np.linalg.norm(residuals, axis=1)
            best = min(best, float(lengths.mean()))
            smoothed = np.sqrt(lengths**2 + smooth**2)
            units = residuals / smoothed[:, None]
            slope = np.einsum("vi,viq->q", units, self.operator) / count
            below = (units * self.offset).sum() / count - sum(
                radius * np.linalg.norm(slope[part]) for part, radius in zip(parts, radii))
            bound = max(bound, below)
            if best - bound <= 1e-4 * best or best <= 1e-9 * np.abs(self.offset).max():
                break
            # How far the smoothed problem is from its own solution, beside what the smoothing costs.
            cost = smooth * np.sqrt(np.maximum(1 - (units**2).sum(axis=1), 0)).mean()
            if smoothed.mean() - (below + cost) <= 0.2 * cost:
                smooth *= 0.3
            weights = 1 / np.sqrt(lengths**2 + smooth**2)
            weights /= weights.mean()
        return best, (best - bound) / best if best > 0 else 0.0

    @staticmethod
    def _in_balls(gram, shift, parts, radii):
        floor = 1e-13 * np.trace(gram) / len(gram)

        def solved(multipliers):
            matrix = gram + np.diag(np.concatenate([np.full(gram[part, part].shape[0], m) for part, m in zip(parts, multipliers)])
                                    + floor)
            factor = np.linalg.cholesky(matrix)
            return np.linalg.solve(factor.T, np.linalg.solve(factor, shift)), factor

        multipliers = [0.0, 0.0]
        for _ in range(100):
            found, factor = solved(multipliers)
            moved = False
            for ball, (part, radius) in enumerate(zip(parts, radii)):
                norm = np.linalg.norm(found[part])
                excess = norm / radius - 1
                if abs(excess) <= 1e-11 or (excess < 0 and multipliers[ball] == 0):
                    continue
                within = np.zeros(len(found))
                within[part] = found[part]
                bend = np.linalg.norm(np.linalg.solve(factor, within)) ** 2
                after = max(multipliers[ball] + excess * norm**2 / bend, 0.0)
                moved = moved or after != multipliers[ball]
                multipliers[ball] = after
            if not moved:
                break
        return found


# ------------------------------------------------------------------------- fits


def rule(count):
    """Nodes u and weights of the rule for expected norms: Gauss-Legendre in theta, u = tan theta."""
    x, weights = np.polynomial.legendre.leggauss(count)
    theta = (x + 1) * math.pi / 4
    return np.tan(theta), weights * math.pi / 4 / np.cos(theta) ** 2


def norm_moments(means, covariances, nodes=24):
    """E|r|, E r/|r| and the expected second derivative, of Gaussian vectors (n x d, n x d x d)."""
    square = (means**2).sum(axis=1) + np.trace(covariances, axis1=1, axis2=2)
    moving = square > 0
    size = np.sqrt(np.where(moving, square, 1.0))
    m, c = means / size[:, None], covariances / (size**2)[:, None, None]
    d = means.shape[1]
    norm, direction, curvature = np.zeros(len(m)), np.zeros_like(m), np.zeros_like(c)
    for u, weight in zip(*rule(nodes)):
        matrix = np.eye(d) + 2 * u * u * c
        inverse = np.linalg.inv(matrix)
        sm = (inverse @ m[:, :, None])[:, :, 0]
        phi = np.exp(-u * u * (m * sm).sum(axis=1)) / np.sqrt(np.linalg.det(matrix))
        norm += weight * (1 - phi) / u**2
        direction += (weight * phi)[:, None] * sm
        curvature += (weight * phi)[:, None, None] * (inverse - 2 * u * u * sm[:, :, None] * sm[:, None, :])
    root = 2 / math.sqrt(math.pi)
    return (np.where(moving, norm * root / 2 * size, 0.0), np.where(moving[:, None], direction * root, 0.0),
            np.where(moving[:, None, None], curvature * root / size[:, None, None], 0.0))


def at_points(side, gaussian):
    """Mean and covariance of the residual at every point under N(mean, precision^-1)."""
    mean, precision = gaussian
    lower = np.linalg.cholesky(precision)
    half = np.linalg.solve(lower, side.r.T).T.reshape(side.points, side.dimension, -1)
    means = (side.r0 + side.r @ mean).reshape(side.points, side.dimension)
    return means, half @ np.swapaxes(half, 1, 2)


def expected_distance(side, gaussian, nodes=24):
    return float(norm_moments(*at_points(side, gaussian), nodes)[0].mean())


def fit_rms(side, sigma):
    weight = 1 / (side.points * sigma**2)
    precision = side.precision + weight * side.gram
    return -np.linalg.solve(precision, side.linear + weight * side.shift), precision


def without_distance(side):
    return -np.linalg.solve(side.precision, side.linear), side.precision


def _slope(side, sigma, point, moments):
    norm, direction, curvature = moments
    distance = norm.mean()
    gradient = direction.ravel() @ side.r / side.points
    rows = side.by_point
    bent = (curvature @ rows).reshape(-1, side.q)
    bending = side.r.T @ bent / side.points
    hessian = side.precision + (distance * bending + np.outer(gradient, gradient)) / sigma**2
    return side.precision @ point + side.linear + gradient * distance / sigma**2, (hessian + hessian.T) / 2


def fit_variational(side, sigma):
    """Until a step is below 0.02 in whitened length; at most twelve."""
    mean, precision = fit_rms(side, sigma)
    for _ in range(12):
        slope, after = _slope(side, sigma, mean, norm_moments(*at_points(side, (mean, precision))))
        step = np.linalg.solve(after, slope)
        lower = np.linalg.cholesky(precision)
        moved = np.abs(lower.T @ step).max()
        change = abs(np.linalg.slogdet(after)[1] - np.linalg.slogdet(precision)[1]) / 2 / side.q
        mean, precision = mean - step, after
        if max(moved, change) < 0.02:
            break
    return mean, precision


def fit_reweighted(side, sigma):
    fit = fit_rms(side, sigma)
    for _ in range(6):
        means, covariances = at_points(side, fit)
        roots = np.sqrt((means**2).sum(axis=1) + np.trace(covariances, axis1=1, axis2=2))
        total = roots.sum()
        weights = np.where(roots > 1e-12 * total, total / np.maximum(roots, 1e-300), 0.0) / (side.points * sigma) ** 2
        heavy = side.r * np.repeat(weights, side.dimension)[:, None]
        precision = side.precision + heavy.T @ side.r
        fit = -np.linalg.solve(precision, side.linear + heavy.T @ side.r0), precision
    return fit


def fit_laplace(side, sigma, start):
    point = start[0]
    for _ in range(100):
        residuals = (side.r0 + side.r @ point).reshape(side.points, side.dimension)
        norms = np.linalg.norm(residuals, axis=1)
        units = residuals / norms[:, None]
        curvature = (np.eye(side.dimension) - units[:, :, None] * units[:, None, :]) / norms[:, None, None]
        slope, hessian = _slope(side, sigma, point, (norms, units, curvature))
        step = np.linalg.solve(hessian, slope)
        if step @ slope <= 1e-14:
            break

        def energy(at):
            return 0.5 * ((side.distances(at[None])[0] / sigma) ** 2 + side.plausibility(at[None])[0])

        share = 1.0
        while share > 1e-9 and energy(point - share * step) > energy(point) - 1e-4 * share * (step @ slope):
            share /= 2
        point = point - share * step
    return point, hessian


def effective_dimensions(side, gaussian):
    return max(side.q - float(np.trace(np.linalg.solve(gaussian[1], side.precision))), 0.0)


# ------------------------------------------------------------------------ sigma


def tolerance(sides, models):
    """The sigma that uses up a quarter of the range of expected distances: (sigma, nearest, farthest)."""
    if all(side.is_contained(rounding(models)) for side in sides):
        return 1e-3 * scale(models), 0.0, 0.0
    farthest = [expected_distance(side, without_distance(side)) for side in sides]

    def rms(side, sigma):
        mean, precision = fit_rms(side, sigma) if math.isfinite(sigma) else without_distance(side)
        square = side.constant + 2 * side.shift @ mean + mean @ side.gram @ mean + np.trace(np.linalg.solve(precision, side.gram))
        return math.sqrt(max(square / side.points, 0.0))

    ratios = [far / rms(side, math.inf) if rms(side, math.inf) > 0 else 1.0 for side, far in zip(sides, farthest)]

    def distance(sigma):
        return float(np.mean([ratio * rms(side, sigma) for side, ratio in zip(sides, ratios)]))

    far = float(np.mean(farthest))
    low, high = 1e-4 * far, 1e2 * far
    near = distance(low)
    if far - near <= 1e-3 * far:
        return 0.1 * far, near, far
    for _ in range(60):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if distance(middle) < near + 0.25 * (far - near) else (low, middle)
    return math.sqrt(low * high), near, far


def noise(models, cut_variance=0.0):
    """How far true members lie from their own model, by the variance that files state or that was cut off."""
    stated = [model.noise_variance for model in models if model.noise_variance > 0]
    square = cut_variance / (2 * models[A].points) + (np.mean(stated) if stated else 0.0) * models[A].dimension
    return NOISE_RATIO[models[A].dimension] * math.sqrt(square) if square > 0 else None


def left_out(shapes, dimension, modes=None):
    """Mean length at the points of what the model of all other shapes misses of each shape."""
    errors = []
    for index in range(shapes.shape[1]):
        others = np.delete(shapes, index, axis=1)
        mean = others.mean(axis=1)
        left, values, _ = np.linalg.svd(others - mean[:, None], full_matrices=False)
        kept = int((values**2 > 1e-9 * values[0] ** 2).sum())
        basis = left[:, : kept if modes is None else min(modes, kept)]
        away = shapes[:, index] - mean
        rest = away - basis @ (basis.T @ away)
        # Of a shape in the space of the others nothing is left but rounding.
        errors.append(0.0 if np.linalg.norm(rest) <= 1e-6 * np.linalg.norm(away) else mean_length(rest, dimension))
    return np.array(errors)
