"""Two groups of shapes: statistics, relabellings, points, stability (docs/method.md, "Chance").

Shapes are compared in coordinates of the space that they span; the program's relabellings are made again from its
seed, or all of them are taken where these are few.
"""
import itertools
import math

import numpy as np

import streams
from shapes import procrustes_analysis

SMALLEST = 1e-9
SAME = 1e-11
NAMES = ["means", "varianceAOutsideB", "varianceBOutsideA", "distanceAToB", "distanceBToA", "totalVariances", "principalAngles"]


def centred(columns):
    return columns - columns.mean(axis=1, keepdims=True)


def modes_of(deviations, most):
    """Unit modes (columns) and squares of all singular values."""
    left, values, _ = np.linalg.svd(deviations, full_matrices=False)
    kept = min(most, int((values**2 > SMALLEST * values[0] ** 2).sum()))
    return left[:, :kept], values**2


def filled(values, count):
    return np.concatenate([values[:count], np.zeros(max(count - len(values), 0))])


def compare(a, b, offset, counts, modes, points, curves=False):
    """Seven statistics of deviations a and b (columns) whose means lie `offset` apart, and seven curves."""
    both = [a, b]
    totals = [(one**2).sum() for one in both]
    found = [modes_of(one, modes) for one in both]
    explained = [found[1 - side][0].T @ both[side] for side in (0, 1)]
    rest = [max(totals[side] - (explained[side] ** 2).sum(), 0.0) for side in (0, 1)]
    shares = [rest[side] / totals[side] for side in (0, 1)]
    distances = []
    for side in (0, 1):
        away = offset - found[1 - side][0] @ (found[1 - side][0].T @ offset)
        distances.append(math.sqrt((rest[side] / counts[side] + away @ away) / points))
    cosines = np.linalg.svd(found[0][0].T @ found[1][0], compute_uv=False)
    angles = np.arccos(np.clip(cosines, 0, 1))
    variances = [total / (count - 1) for total, count in zip(totals, counts)]
    statistics = [np.linalg.norm(offset) / math.sqrt(points), *shares, *distances, abs(math.log(variances[0] / variances[1])),
                  (angles**2).sum()]
    if not curves:
        return statistics, None
    shared = [filled(np.minimum(np.cumsum((part**2).sum(axis=1)) / total, 1), modes) for part, total in zip(explained, totals)]
    for side in (0, 1):
        if len(explained[side]) < modes:
            shared[side][len(explained[side]):] = shared[side][len(explained[side]) - 1]
    deviations = [filled(np.sqrt(one[1] / (count - 1)), modes) for one, count in zip(found, counts)]
    exclusive = []
    for side in (0, 1):
        outside = both[side] - found[1 - side][0] @ explained[side]
        values = np.linalg.svd(outside, compute_uv=False)
        exclusive.append(filled(values / math.sqrt((counts[side] - 1) * points), modes))
    return statistics, np.concatenate([*shared, filled(angles, modes), *deviations, *exclusive])


def contrasts(columns):
    count, root = columns.shape[1], math.sqrt(columns.shape[1])
    return columns[:, :-1] - ((root * columns.mean(axis=1) - columns[:, -1]) / (root - 1))[:, None]


def subsets(total, chosen, most, seed, side):
    """Relabellings: sorted places of A, and whether they are all there are."""
    count = math.comb(total, chosen)
    if count <= most:
        every = np.array(list(itertools.combinations(range(total), chosen)))
        order = streams.uniforms(seed, streams.PERMUTATION, side, [0], count)
        return every[streams.shuffled(order, count, count)[0]], True
    chances = streams.uniforms(seed, streams.PERMUTATION, side, range(1, most + 1), chosen)
    return np.sort(streams.shuffled(chances, total, chosen)[:, :chosen], axis=1), False


def as_large(values, observed):
    return values >= observed - SAME * abs(observed)


def p_values(values, observed, everything):
    times = as_large(values, observed).sum(axis=0)
    return np.maximum(times, 1) / len(values) if everything else (1 + times) / (1 + len(values))


def holm(p):
    order = np.argsort(p, kind="stable")
    adjusted = np.empty(len(p))
    adjusted[order] = np.maximum.accumulate(np.minimum((len(p) - np.arange(len(p))) * np.asarray(p)[order], 1))
    return adjusted


def chance(values):
    values = np.asarray(values, float)
    deviation = values.std(ddof=1) if len(values) > 1 else 0.0
    return [values.mean(), deviation, *np.quantile(values, [0.05, 0.95])]


def histogram(values):
    """(from, to, counts) of at most 24 intervals; of multiples of a step each holds equally many of them."""
    values = np.sort(values)
    low, high = values[0], values[-1]
    if low == high:
        return low, high, [len(values)]
    gaps = np.diff(values)
    gaps = gaps[gaps > 1e-9 * (high - low)]
    step = gaps.min()
    start, end, intervals = low, high, 24
    if (np.abs(gaps / step - np.round(gaps / step)) < 1e-6).all():
        possible = round((high - low) / step) + 1
        together = math.ceil(possible / 24)
        intervals = math.ceil(possible / together)
        start = low - step / 2
        end = start + intervals * together * step
    places = np.minimum(((values - start) / (end - start) * intervals).astype(int), intervals - 1)
    return start, end, np.bincount(places, minlength=intervals).tolist()


class Groups:
    def __init__(self, a, b, dimension, alignment):
        self.counts = [a.shape[1], b.shape[1]]
        shapes = np.concatenate([a, b], axis=1)
        if alignment != "none":
            shapes = procrustes_analysis(shapes, dimension, alignment == "similarity")
        self.x = centred(shapes)
        self.dimension, self.points, self.total = dimension, len(shapes) // dimension, sum(self.counts)
        left, values, _ = np.linalg.svd(self.x, full_matrices=False)
        self.variances = values**2
        rank = int((self.variances > SMALLEST * self.variances[0]).sum())
        self.directions = left[:, :rank]
        self.y = self.directions.T @ self.x
        self.leading = self.y[:100]
        self.places = [np.arange(self.counts[0]), np.arange(self.counts[0], self.total)]
        near = np.linalg.norm(self.y[:, : self.counts[0], None] - self.y[:, None, self.counts[0]:], axis=0)
        own = np.linalg.norm(self.y, axis=0)
        least = np.minimum(own[: self.counts[0], None], own[None, self.counts[0]:])
        self.shared = int((near <= 1e-6 * least).any(axis=1).sum())

    def modes_to_compare(self, most):
        held = np.cumsum(self.variances) / self.variances.sum()
        of_share = int(np.argmax(held >= 0.95)) + 1
        return max(1, min(of_share, most or 10**9, min(self.counts) - 2, len(self.leading) - 1))

    def labelled(self, columns, a, b):
        one, other = columns[:, a], columns[:, b]
        return centred(one), centred(other), one.mean(axis=1) - other.mean(axis=1)

    def lengths(self, coordinates):
        """Mean length at the points of residuals in coordinates (any x n)."""
        shapes = self.directions @ coordinates
        return np.linalg.norm(shapes.T.reshape(coordinates.shape[1], -1, self.dimension), axis=2).mean(axis=1)

    # ----------------------------------------------------------- left-out shapes

    def residuals_within(self, group, modes):
        """Of each shape of a group to the model of its others, in coordinates."""
        columns = self.y[:, group]
        count = len(group)
        left, values, right = np.linalg.svd(centred(columns), full_matrices=False)
        rank = min(int((values**2 > SMALLEST * values[0] ** 2).sum()), count - 1)
        if modes is not None and modes < min(rank, count - 2):
            # The scatter of the others, one matrix a shape; in the dimensions of the group.
            scores = left[:, :rank].T @ centred(columns)
            ratio = count / (count - 1)
            scatters = np.diag(values[:rank] ** 2) - ratio * scores.T[:, :, None] * scores.T[:, None, :]
            bases = np.linalg.eigh(scatters)[1][:, :, -modes:]
            away = ratio * scores.T[:, :, None]
            rest = away - bases @ (np.swapaxes(bases, 1, 2) @ away)
            return left[:, :rank] @ rest[:, :, 0].T
        # With all modes: what of a shape is at right angles to all differences of the others (none where they span it).
        explained = (right[:rank] ** 2).sum(axis=0)
        inverse = right[:rank] / values[:rank, None]
        residuals = left[:, :rank] @ (inverse / (inverse**2).sum(axis=0))
        return np.where(1 - 1 / count - explained > 1e-6, 0.0, residuals)

    def residuals_across(self, group, others, modes):
        columns = self.y[:, others]
        basis, _ = modes_of(centred(columns), min(modes or 10**9, len(others) - 1))
        away = self.y[:, group] - columns.mean(axis=1, keepdims=True)
        return away - basis @ (basis.T @ away)

    def nearer(self, a, b, modes, by_points):
        least = 1e-9 * math.sqrt((self.y**2).sum() / (self.points * self.total))
        shares, errors = [], []
        for group, others in ((a, b), (b, a)):
            own, other = self.residuals_within(group, modes), self.residuals_across(group, others, modes)
            if by_points:
                own, other = self.lengths(own), self.lengths(other)
            else:
                own, other = [np.linalg.norm(one, axis=0) / math.sqrt(self.points) for one in (own, other)]
            shares.append(float(np.where(np.abs(own - other) <= least, 0.5, own < other).mean()))
            errors.append(own)
        return shares, errors

    def told_apart_relabellings(self):
        size = min(max(self.counts), len(self.y))
        return min(max(4_000_000_000 // size**3, 19), 199)

    # ------------------------------------------------------------------- points

    def heights(self, chosen):
        """h of every point for rows of places called A (points x rows)."""
        points = self.x.reshape(self.points, self.dimension, self.total)
        scatter = points @ np.swapaxes(points, 1, 2)
        trace = np.trace(scatter, axis1=1, axis2=2)
        moving = trace > 0
        scatter = scatter + (1e-3 * trace / self.dimension)[:, None, None] * np.eye(self.dimension)
        scatter[~moving] = np.eye(self.dimension)
        inverse = np.linalg.inv(scatter) * (self.total / (self.counts[0] * self.counts[1]))
        labels = np.zeros((self.total, len(chosen)))
        labels[np.asarray(chosen).T, np.arange(len(chosen))] = 1
        sums = (self.x @ labels).reshape(self.points, self.dimension, -1)
        return np.einsum("pin,pij,pjn->pn", sums, inverse, sums, optimize=True) * moving[:, None]

    # ---------------------------------------------------------------- stability

    def stability(self, side, seed):
        group, count = self.places[side], self.counts[side]
        half = count // 2
        most = max(min(half - 1, len(self.y)), 1)
        whole, _ = modes_of(centred(self.leading[:, group]), most)
        chances = streams.uniforms(seed, streams.SUBSAMPLE, side, range(200), 2 * half)
        order = streams.shuffled(chances, count, 2 * half)
        sums = np.zeros((2, most))
        for places in order:
            parts = [np.sort(places[:half]), np.sort(places[half : 2 * half])]
            one, other = [modes_of(centred(self.leading[:, group[part]]), most)[0] for part in parts]
            for row, against in enumerate((other, whole)):
                squares = (one.T @ against) ** 2
                table = np.zeros((most, most))
                table[: squares.shape[0], : squares.shape[1]] = squares
                sums[row] += np.cumsum(np.cumsum(table, axis=0), axis=1).diagonal() / np.arange(1, most + 1)
        overlap, with_whole = sums / 200
        dimensions = len(self.y) if len(self.y) + 1 < self.total else len(self.x)
        k = np.arange(1, most + 1)
        gained = k * (overlap - 0.5 * (1 + k / dimensions))
        best, suggested = 0.0, 1
        for number, gain in zip(k, gained):
            if gain > best + 1e-9:
                best, suggested = gain, int(number)
        return overlap, with_whole, dimensions, suggested


def check(case, prefix, groups, seed, permutations, most_modes, sigma, independent=None):
    """Compares every number of an evidence report. `independent`: a generator for relabellings of NumPy's own."""
    at = f"{prefix}." if prefix else ""
    na, nb = groups.counts
    case.same(f"{at}shapes.a", na)
    case.same(f"{at}shapes.b", nb)
    case.same(f"{at}sharedShapes", groups.shared)
    modes = groups.modes_to_compare(most_modes)
    case.same(f"{at}modes", modes)
    points, length = groups.points, groups.points
    most = max(permutations, 1)
    chosen, everything = subsets(groups.total, na, most, seed, 0)
    case.same(f"{at}permutations", len(chosen))
    all_places = np.arange(groups.total)

    # Left-out shapes.
    size = math.sqrt((groups.y**2).sum() / (points * groups.total))
    shares, errors = groups.nearer(*groups.places, most_modes, True)
    for name, share, error in zip("ab", shares, errors):
        mean = float(error.mean())
        case.equal(f"{at}leftOut.{name}.mean", mean, scale=1e-6 * size)
        case.equal(f"{at}leftOut.{name}.standardDeviation", float(error.std(ddof=1)), scale=1e-6 * size)
        if f"{at}leftOut.{name}.beyondSigma" in case:
            case.equal(f"{at}leftOut.{name}.beyondSigma", float(-np.expm1(-0.5 * (error / sigma) ** 2).mean()))
        case.equal(f"{at}toldApart.{name}.share", share)
    count = min(groups.told_apart_relabellings(), len(chosen))
    by_chance = np.array([groups.nearer(a, np.setdiff1d(all_places, a), most_modes, False)[0] for a in chosen[:count]])
    for name, values in zip("ab", by_chance.T):
        _chance(case, f"{at}toldApart.{name}.chance", values)

    # Statistics and curves.
    observed, curves = compare(*groups.labelled(groups.leading, *groups.places), (na, nb), modes, points, True)
    relabelled, curves_by_chance = [], []
    for a in chosen:
        found = compare(*groups.labelled(groups.leading, a, np.setdiff1d(all_places, a)), (na, nb), modes, length, True)
        relabelled.append(found[0])
        curves_by_chance.append(found[1])
    relabelled, curves_by_chance = np.array(relabelled), np.array(curves_by_chance)
    _hypothesis(case, f"{at}onePopulation", NAMES, observed, relabelled, everything)
    rows = np.concatenate([contrasts(groups.leading[:, place]) for place in groups.places], axis=1)
    offset = groups.labelled(groups.leading, *groups.places)[2]
    chosen_rows, every_row = subsets(groups.total - 2, na - 1, most, seed, 1)
    second = np.array([
        compare(rows[:, a], rows[:, np.setdiff1d(np.arange(rows.shape[1]), a)], offset, (na, nb), modes, points)[0][1:]
        for a in chosen_rows])
    _hypothesis(case, f"{at}oneCovariance", NAMES[1:], observed[1:], second, every_row)
    names = ["sharedVariance.a", "sharedVariance.b", "principalAnglesDegrees", "standardDeviations.a", "standardDeviations.b",
             "exclusiveModes.a", "exclusiveModes.b"]
    for place, name in enumerate(names):
        part = slice(place * modes, (place + 1) * modes)
        factor = 180 / math.pi if name == "principalAnglesDegrees" else 1.0
        rows_of = curves_by_chance[:, part] * factor
        case.equal(f"{at}bands.{name}.observed", curves[part] * factor)
        case.equal(f"{at}bands.{name}.mean", rows_of.mean(axis=0))
        for quantile, share in (("p05", 0.05), ("p95", 0.95)):
            case.equal(f"{at}bands.{name}.{quantile}", np.quantile(rows_of, share, axis=0))

    # The same p from relabellings that NumPy draws.
    if independent is not None:
        fresh = []
        for _ in range(len(chosen)):
            a = np.sort(independent.permutation(groups.total)[:na])
            fresh.append(compare(*groups.labelled(groups.leading, a, np.setdiff1d(all_places, a)), (na, nb), modes, points)[0])
        p = p_values(np.array(fresh), np.array(observed), False)
        error = np.sqrt(2 * np.maximum(p * (1 - p), 1 / len(fresh)) / len(fresh))
        for place in range(len(NAMES)):
            case.near(f"{at}onePopulation.statistics.{place}.p", p[place], error[place], law="independent relabellings", also=False)

    # Equal numbers of shapes.
    if f"{at}matched" in case:
        least = min(na, nb)
        case.same(f"{at}matched.shapes", least)
        larger = 0 if na > nb else 1
        chances = streams.uniforms(seed, streams.SUBSAMPLE, 2, range(50), least)
        parts = np.sort(streams.shuffled(chances, max(na, nb), least)[:, :least], axis=1)
        sums = np.zeros(2)
        for part in parts:
            both = list(groups.places)
            both[larger] = both[larger][part]
            sums += compare(*groups.labelled(groups.leading, *both), (least, least), modes, points)[0][1:3]
        case.equal(f"{at}matched.varianceAOutsideB", sums[0] / 50)
        case.equal(f"{at}matched.varianceBOutsideA", sums[1] / 50)

    # Points.
    heights = groups.heights(groups.places[0][None])[:, 0]
    largest, times = np.zeros(0), np.zeros(points)
    for part in np.array_split(chosen, max(len(chosen) // 100, 1)):
        found = groups.heights(part)
        largest = np.concatenate([largest, found.max(axis=0)])
        times += as_large(found, heights[:, None]).sum(axis=1)
    family = np.array([p_values(largest[:, None], height, everything)[0] for height in heights])
    own = np.maximum(times, 1) / len(chosen) if everything else (1 + times) / (1 + len(chosen))
    case.equal(f"{at}vertices.p", family)
    case.equal(f"{at}vertices.differ", (family <= 0.05).mean())
    ascending = np.sort(own)
    called = np.flatnonzero(ascending <= 0.05 * np.arange(1, points + 1) / points)
    case.equal(f"{at}vertices.falseDiscovery", (called[-1] + 1) / points if len(called) else 0.0)

    for side, name in enumerate("ab"):
        overlap, with_whole, dimensions, suggested = groups.stability(side, seed)
        case.equal(f"{at}stability.{name}.overlap", overlap)
        case.equal(f"{at}stability.{name}.withWhole", with_whole)
        case.same(f"{at}stability.{name}.dimensions", dimensions)
        case.same(f"{at}stability.{name}.suggestedModes", suggested)


def _chance(case, path, values):
    for name, value in zip(("mean", "standardDeviation", "p05", "p95"), chance(values)):
        case.equal(f"{path}.{name}", value, scale=1e-6 * max(np.abs(values).max(), 1e-300))
    start, end, counts = histogram(values)
    size = max(abs(start), abs(end))
    case.equal(f"{path}.histogram.from", start, scale=size)
    case.equal(f"{path}.histogram.to", end, scale=size)
    case.same(f"{path}.histogram.counts", counts)


def _hypothesis(case, path, names, observed, relabelled, everything):
    case.same(f"{path}.permutations", len(relabelled))
    p = p_values(relabelled, np.array(observed), everything)
    adjusted = holm(p)
    for place, name in enumerate(names):
        row = f"{path}.statistics.{place}"
        case.same(f"{row}.name", name)
        case.equal(f"{row}.observed", observed[place])
        _chance(case, f"{row}.chance", relabelled[:, place])
        case.equal(f"{row}.p", p[place])
        case.equal(f"{row}.pError", 0.0 if everything else math.sqrt(p[place] * (1 - p[place]) / len(relabelled)))
        case.equal(f"{row}.pAdjusted", adjusted[place])
