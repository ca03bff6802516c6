"""What rests on random numbers: reach, differences, weighted draws, diagnostics of chains.

The program's random numbers are made again (streams.py), so that these numbers too are compared digit by digit. `signs` are
those of the program's modes: the sign of a mode is a convention that random coefficients depend on.
"""
import math

import numpy as np
from scipy.special import ndtri

import streams
from pairs import A, B, plausible_radius, quantile_error, within_ball


def reach(side, models, meeting, which, seed, own_rounding):
    """Distances of 1,024 shapes, ascending, and how much further the nearest plausible shapes of 128 of them lie."""
    signs = side.signs
    numbers, _ = streams.normals(seed, streams.REACH, which, range(16), 64 * side.q)
    coefficients = numbers.reshape(-1, side.q) * signs
    distances = side.distances(coefficients)
    distances = np.where(distances < own_rounding, 0.0, distances)
    further = np.zeros(128)
    own, other = models[which], models[1 - which]
    variances = other.deviations**2
    radius = plausible_radius(len(other.deviations))
    for place, a in enumerate(coefficients[:128]):
        nearest = side.p @ a + side.a0
        if np.linalg.norm(nearest) > radius:
            plausible = within_ball(nearest, variances, radius)
            pairs = [(a, b) if which == A else (b, a) for b in (nearest, plausible)]
            near, far = [meeting.lengths(np.concatenate(pair)).mean() for pair in pairs]
            further[place] = max(far - near, 0.0)
    return np.sort(distances), further


def mean_and_error(values):
    return float(values.mean()), float(values.std(ddof=1) / math.sqrt(len(values)))


class Differences:
    """Rejection from the model's own shapes, in blocks of 256, until enough are accepted."""

    def __init__(self, side, which, seed, definition, level, share, wanted):
        variances = side.own.deviations**2 / side.points

        def scores(coefficients):
            distances = side.distances(coefficients)
            if definition == "relative":
                return distances / np.sqrt((coefficients**2) @ variances), distances
            if definition == "outside":
                return np.linalg.norm(coefficients @ side.p.T + side.a0, axis=1), distances
            return distances, distances

        if definition != "soft" and level is None:
            numbers, _ = streams.normals(seed, streams.QUANTILE, which, range(16), 256 * side.q)
            found = np.sort(scores(numbers.reshape(-1, side.q) * side.signs)[0])
            level = found[min(int(share * len(found)), len(found) - 1)]
        self.level = level
        if definition == "outside":
            bound = side.a0 @ side.a0 + np.trace(side.p.T @ side.p)
        else:
            bound = (side.constant + np.trace(side.gram)) / side.points
        mean = bound * (0.5 if definition == "soft" else 1.0) / level**2
        self.envelope = "tilted" if definition != "relative" and mean < 1 else "prior"
        accepted, kept, distances, block, count = [], [], [], 0, 0
        while self.envelope == "prior" and count < wanted and block * 256 < 100 * wanted:
            most = -(-(wanted - count) // 256)
            blocks = range(block, block + min(8, most))
            numbers, uniform = streams.normals(seed, streams.REJECTION, which, blocks, 256 * side.q, then=256)
            coefficients = numbers.reshape(-1, side.q) * side.signs
            score, distance = scores(coefficients)
            share_outside = -np.expm1(-0.5 * (score / level) ** 2) if definition == "soft" else (score >= level) * 1.0
            take = uniform.ravel() < share_outside
            accepted.append(share_outside)
            kept.append(coefficients[take])
            distances.append(distance[take])
            count += int(take.sum())
            block += len(blocks)
        if not accepted:
            return
        self.accepted = np.concatenate(accepted)
        self.draws, self.distances = np.concatenate(kept)[:wanted], np.concatenate(distances)[:wanted]
        self.proposals, self.acceptance = len(self.accepted), count / len(self.accepted)
        self.probability, self.error = self._mean(self.accepted)
        ratios = self.accepted / self.probability
        slope = ratios[ratios < 1].sum() / len(ratios)
        self.overlap, self.overlap_error = self._mean(np.minimum(ratios, 1) - slope * (ratios - 1))

    @staticmethod
    def _mean(values):
        return float(values.mean()), float(values.std(ddof=1) / math.sqrt(len(values)))


# ------------------------------------------------------------- weighted draws


def smoothed(log_weights):
    """Pareto-smoothed weights, their sum 1, and k (Vehtari et al. 2024; Zhang & Stephens 2009)."""
    logs = log_weights - log_weights.max()
    weights = np.exp(logs)
    count = len(logs)
    size = math.ceil(min(count / 5, 3 * math.sqrt(count)))
    order = np.argsort(logs, kind="stable")
    cut = max(logs[order[count - size - 1]], math.log(np.finfo(float).tiny))
    places = order[logs[order] > cut]
    k = None
    if len(places) >= 5:
        excesses = np.exp(logs[places]) - math.exp(cut)
        fitted = _pareto(excesses)
        if fitted:
            k, scale = fitted
            p = (np.arange(len(places)) + 0.5) / len(places)
            logs_of = -np.log1p(-p)
            stretched = logs_of if abs(k) < 1e-16 else np.expm1(k * logs_of) / k
            weights[places] = np.minimum(math.exp(cut) + scale * stretched, 1.0)
    return weights / weights.sum(), k


def _pareto(x):
    n = len(x)
    quartile = x[(n + 2) // 4 - 1]
    if not (quartile > 0 and x[-1] > quartile * (1 + 1e-12)):
        return None
    grid = 30 + math.floor(math.sqrt(n))
    b = (1 - np.sqrt(grid / (np.arange(1, grid + 1) - 0.5))) / (3 * quartile) + 1 / x[-1]
    k = np.log1p(-b[:, None] * x).mean(axis=1)
    likelihood = n * (np.log(-(b / k)) - k - 1)
    shares = 1 / np.exp(likelihood - likelihood[:, None]).sum(axis=1)
    b = (b * shares).sum()
    k = np.log1p(-b * x).mean()
    return (n * k + 5) / (n + 10), -k / b


class Weighted:
    """Moments of the intersection from weighted draws of a fit and their gradients (Stein's identity)."""

    def __init__(self, side, which, seed, sigma, fit, wanted):
        mean, precision = fit
        signs = side.signs
        wanted = -(-wanted // 1024) * 1024
        # In the program's signs, so that the triangular factor is the program's.
        self.transform = np.linalg.inv(np.linalg.cholesky(precision * np.outer(signs, signs))).T
        self.mean, self.signs = mean * signs, signs
        q, even = side.q, side.q + side.q % 2
        numbers, _ = streams.normals(seed, streams.IMPORTANCE, which, range(wanted // 64), 32 * even)
        first = numbers.reshape(-1, even)[:, :q]
        z = np.stack([first, -first], axis=1).reshape(-1, q)
        points = (self.mean + z @ self.transform.T) * signs
        distances, slopes = side.gradients(points)
        gradient = -(distances[:, None] / sigma**2) * slopes - (points @ side.precision + side.linear)
        self.log_weights = -0.5 * ((distances / sigma) ** 2 + side.plausibility(points)) + 0.5 * (z**2).sum(axis=1)
        slope = -(gradient * signs) @ self.transform - z
        weights, self.k = smoothed(self.log_weights)
        plain = np.exp(self.log_weights - self.log_weights.max())
        self.effective = plain.sum() ** 2 / (plain**2).sum()

        def moments(part):
            w = weights[part] / weights[part].sum()
            centre = -(slope[part].T @ w)
            product = slope[part].T @ ((z[part] - centre) * w[:, None])
            return centre, np.eye(q) - (product + product.T) / 2

        whole = moments(slice(None))
        length = wanted // 16
        groups = [moments(slice(group * length, (group + 1) * length)) for group in range(16)]

        def size(one, other):
            return ((one[0] - other[0]) ** 2).sum() + ((one[1] - other[1]) ** 2).sum()

        correction = size(whole, (np.zeros(q), np.eye(q)))
        noise = sum(size(group, whole) for group in groups) / (16 * 15)
        self.is_within_error = correction - noise < noise or math.sqrt(correction) < 1e-4
        self.margin = (correction - noise) / noise
        self.total, self.groups = self._placed(whole), [self._placed(group) for group in groups]

    def _placed(self, moments):
        mean = self.mean + self.transform @ moments[0]
        covariance = self.transform @ moments[1] @ self.transform.T
        return mean * self.signs, covariance * np.outer(self.signs, self.signs)


class Independent:
    """Independence Metropolis-Hastings: proposals of the fit, one in a hundred of a wider Gaussian, chain by chain."""

    def __init__(self, side, which, seed, sigma, fit, wide, settings):
        signs, q = side.signs, side.q
        chains, kept = settings["chains"], -(-settings["draws"] // settings["chains"])
        burn_in, thin = settings["burnIn"], settings["thin"]
        steps = burn_in + thin * kept
        gaussians = []
        for mean, precision in (fit, wide):
            lower = np.linalg.cholesky(precision * np.outer(signs, signs))
            gaussians.append((mean * signs, lower, np.linalg.inv(lower).T, np.log(np.diag(lower)).sum()))
        each = (steps + 1) * (2 + int(2.8 * -(-q // 2))) + 500
        buffers = streams.uniforms(seed, streams.CHAIN, which, range(chains), each)
        z, choose, decide = np.zeros((chains, steps + 1, q)), np.zeros((chains, steps + 1)), np.zeros((chains, steps + 1))
        for chain, numbers in enumerate(buffers):
            place = 0
            for step in range(steps + 1):
                choose[chain, step] = numbers[place]
                place += 1
                for first in range(0, q, 2):
                    while True:
                        x, y = 2 * numbers[place] - 1, 2 * numbers[place + 1] - 1
                        place += 2
                        square = x * x + y * y
                        if 0 < square < 1:
                            break
                    factor = math.sqrt(-2 * math.log(square) / square)
                    z[chain, step, first] = x * factor
                    if first + 1 < q:
                        z[chain, step, first + 1] = y * factor
                decide[chain, step] = numbers[place]
                place += 1
        rows, defensive = z.reshape(-1, q), choose.ravel() < 0.01
        points = np.where(defensive[:, None], *[g[0] + rows @ g[2].T for g in gaussians[::-1]])
        logs = [g[3] - 0.5 * (((points - g[0]) @ g[1]) ** 2).sum(axis=1) for g in gaussians]
        mixture = np.logaddexp(logs[0] + math.log(0.99), logs[1] + math.log(0.01))
        distances = side.distances(points * signs)
        target = -0.5 * ((distances / sigma) ** 2 + side.plausibility(points * signs))
        weights = (target - mixture).reshape(chains, steps + 1)
        points, distances = points.reshape(chains, steps + 1, q), distances.reshape(chains, steps + 1)
        state = np.zeros(chains, int)
        self.draws, self.distances = np.zeros((chains, kept, q)), np.zeros((chains, kept))
        accepted = 0
        every = np.arange(chains)
        for step in range(steps):
            take = np.log(decide[:, step + 1]) < weights[:, step + 1] - weights[every, state]
            state = np.where(take, step + 1, state)
            if step >= burn_in:
                accepted += int(take.sum())
                if (step - burn_in + 1) % thin == 0:
                    place = (step - burn_in + 1) // thin - 1
                    self.draws[:, place], self.distances[:, place] = points[every, state], distances[every, state]
        counted = weights[:, burn_in + 1:]
        self.acceptance = accepted / counted.size
        # Weights that differ by less are the same but for rounding.
        self.is_even = np.ptp(counted) < 1e-6
        plain = np.exp(counted - counted.max())
        self.effective = plain.sum() ** 2 / (plain**2).sum()
        self.k = smoothed(counted.T.ravel())[1]


def accuracy(joint, totals, groups, pooled_of, components):
    """Standard errors of the intersection model from groups of weighted draws."""
    pooled = pooled_of([joint.lift(side, total) for side, total in totals])
    vectors, values = components(pooled[1])
    vectors, values = vectors[:, :64], values[:64]
    most = len(values)
    variance = np.zeros((most, most))
    for index, (side, _) in enumerate(totals):
        turned = []
        for group in groups[index]:
            parts = [joint.lift(side, group)]
            parts += [joint.lift(*other) for place, other in enumerate(totals) if place != index]
            turned.append(vectors.T @ pooled_of(parts)[1] @ vectors)
        turned = np.array(turned)
        variance += ((turned - turned.mean(axis=0)) ** 2).sum(axis=0) / (len(turned) * (len(turned) - 1))
    gap = (values[:, None] - values) ** 2
    np.fill_diagonal(gap, np.inf)
    turns = variance / np.maximum(gap, np.finfo(float).tiny)
    return pooled, values, variance, turns


# ---------------------------------------------------------------- diagnostics


def _halves(chains):
    half = chains.shape[1] // 2
    return np.concatenate([chains[:, :half], chains[:, -half:]])


def _scores(values):
    order = np.argsort(values.ravel(), kind="stable")
    sorted_values = values.ravel()[order]
    _, first, counts = np.unique(sorted_values, return_index=True, return_counts=True)
    ranks = np.empty(values.size)
    ranks[order] = np.repeat(first + (counts + 1) / 2, counts)
    return ndtri((ranks - 0.375) / (values.size + 0.25)).reshape(values.shape)


def _r_hat(chains):
    draws = chains.shape[1]
    within = chains.var(axis=1, ddof=1).mean()
    between = draws * chains.mean(axis=1).var(ddof=1)
    return math.sqrt((between / within + draws - 1) / draws)


def _effective(chains):
    count, draws = chains.shape
    if np.ptp(chains) == 0:
        return float(chains.size)
    centred = chains - chains.mean(axis=1, keepdims=True)
    size = 1 << (2 * draws - 1).bit_length()
    spectrum = np.fft.rfft(centred, size)
    covariance = np.fft.irfft(spectrum * spectrum.conj(), size)[:, :draws].mean(axis=0) / draws
    within = covariance[0] * draws / (draws - 1)
    total = covariance[0] + chains.mean(axis=1).var(ddof=1)
    rho_of = 1 - (within - covariance) / total
    rho = np.zeros(draws)
    rho[0], rho[1] = 1.0, rho_of[1]
    even, odd, lag = 1.0, rho_of[1], 1
    while lag < draws - 3 and even + odd > 0:
        even, odd = rho_of[lag + 1], rho_of[lag + 2]
        if even + odd >= 0:
            rho[lag + 1], rho[lag + 2] = even, odd
        lag += 2
    last = lag - 2
    if even > 0:
        rho[last + 1] = even
    place = 1
    while place <= last - 2:
        if rho[place + 1] + rho[place + 2] > rho[place - 1] + rho[place]:
            rho[place + 1] = rho[place + 2] = (rho[place - 1] + rho[place]) / 2
        place += 2
    time = max(-1 + 2 * rho[: last + 1].sum() + rho[last + 1], 1 / math.log10(count * draws))
    return count * draws / time


def diagnostics(chains):
    """R-hat, bulk and tail effective sizes, errors of mean and standard deviation, correlation of neighbours (chains x draws)."""
    halves = _halves(chains)
    folded = np.abs(halves - np.median(halves))
    r_hat = max(_r_hat(_scores(halves)), _r_hat(_scores(folded)))
    bulk = _effective(_scores(halves))
    tails = [_effective(_halves((chains <= np.quantile(chains, share)) * 1.0)) for share in (0.05, 0.95)]
    deviation = chains.std(ddof=1)
    of_mean = deviation / math.sqrt(_effective(halves))
    squares = (chains - chains.mean()) ** 2
    of_variance = (squares**2).mean() - squares.mean() ** 2
    of_deviation = math.sqrt(of_variance / _effective(_halves(squares)) / squares.mean()) / 2
    centred = chains - chains.mean(axis=1, keepdims=True)
    neighbours = ((centred[:, 1:] * centred[:, :-1]).sum(axis=1) / (centred**2).sum(axis=1)).mean()
    return [r_hat, bulk, min(tails), of_mean, of_deviation, float(neighbours)]
