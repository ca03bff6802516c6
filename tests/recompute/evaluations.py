"""Compares the reports of `evaluate`, `evidence`, `matrix`, `info` and `sweep`, and the lines in words."""
import math

import numpy as np

import comparison
import groups as evidence
import streams
from pairs import (A, B, Joint, Side, components, effective_dimensions, fit_rms, grassmann, norm_moments, at_points, _slope, pooled)
from shapes import model_of_shapes, motion_onto, moved_onto, procrustes_analysis


def counts_of(most):
    if most <= 20:
        return list(range(1, most + 1))
    shares = np.arange(20) / 19
    values = 1 + (most - 1) * shares * np.sqrt(shares)
    return sorted({int(math.floor(value + 0.5)) for value in values})


def of_projections(model, columns, counts):
    """Mean length at the points of what the first k modes miss (shapes x counts)."""
    away = columns - model.mean[:, None]
    along = model.modes.T @ away
    found = []
    for count in counts:
        rest = away - model.modes[:, :count] @ along[:count]
        found.append(np.linalg.norm(rest.T.reshape(columns.shape[1], -1, model.dimension), axis=2).mean(axis=1))
    return np.array(found).T


def along_the_fit(model, columns, counts, scale):
    """Distances along with the fit of the first k modes (shapes x counts), and the shapes as they lie with all of them."""
    dimension = model.dimension
    starts = [columns, moved_onto(model.mean, columns, dimension, scale)]

    def projected(placed, modes):
        away = placed - model.mean[:, None]
        return model.mean[:, None] + modes @ (modes.T @ away)

    found = []
    for count in counts:
        modes = model.modes[:, :count]
        ends = []
        for placed in starts:
            square = np.full(columns.shape[1], np.inf)
            for _ in range(5000):
                target = projected(placed, modes)
                nearer = np.hstack([moved_onto(target[:, i], columns[:, i:i + 1], dimension, scale)
                                    for i in range(columns.shape[1])])
                now = ((nearer - projected(nearer, modes)) ** 2).sum(axis=0)
                placed, before, square = nearer, square, now
                if np.all(before - now <= 1e-15 * (model.size ** 2) * model.points):
                    break
            ends.append((square, placed))
        nearer = ends[0][0] <= ends[1][0]
        placed = np.where(nearer, ends[0][1], ends[1][1])
        rest = placed - projected(placed, modes)
        found.append(np.linalg.norm(rest.T.reshape(columns.shape[1], -1, dimension), axis=2).mean(axis=1))
    return np.array(found).T, placed


def evaluate(case, model, signs, columns, training, scale, placement):
    """Generalization and specificity, by test shapes or by leaving training shapes out."""
    dimension, count = model.dimension, columns.shape[1]
    case.same("placement", placement)
    if placement == "mean":
        columns = moved_onto(model.mean, columns, dimension, scale)
    folds = 0 if not training else count if count <= 50 else 10
    most = len(model.deviations)
    if training:
        most = min(most, count - -(-count // folds) - 1)
    counts = counts_of(most)
    case.same("shapes", count)
    case.same("folds", folds)
    case.same("method", "test" if not training else "leave-one-out" if folds == count else "folds")
    case.same("modes", counts)
    if training:
        everything = procrustes_analysis(columns, dimension, scale)
        general = np.zeros((count, len(counts)))
        for fold in range(folds):
            out = np.arange(count) % folds == fold
            others = procrustes_analysis(everything[:, ~out], dimension, scale)
            of_others = model_of_shapes(dimension, others, "rigid")
            general[out] = of_projections(of_others, moved_onto(of_others.mean, everything[:, out], dimension, scale), counts)
    elif placement == "fit":
        general, columns = along_the_fit(model, columns, counts, scale)
    else:
        general = of_projections(model, columns, counts)
    numbers, _ = streams.normals(1, streams.SPECIFICITY, 0, range(1000), len(model.deviations))
    numbers = numbers * signs * model.deviations
    known = columns.T.reshape(count, -1, dimension)
    specific = np.zeros((1000, len(counts)))
    for place, of in enumerate(counts):
        drawn = (model.mean[:, None] + model.modes[:, :of] @ numbers[:, :of].T).T.reshape(1000, -1, dimension)
        for part in np.array_split(np.arange(1000), 20):
            distances = np.linalg.norm(drawn[part, None] - known[None], axis=3).mean(axis=2)
            specific[part, place] = distances.min(axis=1)
    for name, rows in (("generalization", general), ("specificity", specific)):
        case.equal(name, rows.mean(axis=0))
        case.equal(f"{name}Error", rows.std(axis=0, ddof=1) / math.sqrt(len(rows)))
    case.finish({})


def matrix(case, models, given=None, evidence_excused=None):
    """Every pair of models."""
    excused = {}
    for place, cell in enumerate(case.report["relations"]):
        at = f"relations.{place}."
        one, other = models[cell["a"]], models[cell["b"]]
        case.same(f"{at}a", cell["a"])
        case.same(f"{at}b", cell["b"])
        case.same(f"{at}points", one.points)
        pair = [one, other]
        sides = [Side(one, other), Side(other, one)]
        sigma = comparison.sigma_of(case, pair, sides, given=given)[0]
        comparison.overlap(case, at, pair, sides, Joint(pair), sigma)
        if cell["evidence"] and not evidence_excused:
            evidence.check(case, f"{at}evidence", comparison.groups_of(pair), 1, 999, comparison.modes_cut_to(pair), None)
    if evidence_excused:
        excused["relations.*.evidence.*"] = evidence_excused
    case.finish(excused)


def info(case, models):
    for place, model in enumerate(models):
        comparison.describe(case, str(place), model)
    case.finish({})


def inspect(case, models):
    """How far the means are apart, and would be after a motion; the size of B over that of A."""
    dimension = models[A].dimension
    target = models[A].mean.reshape(-1, dimension)
    points = models[B].mean.reshape(-1, dimension)

    def apart(motion):
        factor, turn, shift = motion
        return np.linalg.norm(factor * points @ turn.T + shift - target, axis=1).mean()

    still = (1.0, np.eye(dimension), np.zeros(dimension))
    motions = [motion_onto(models[A].mean, models[B].mean, dimension, scale) for scale in (False, True)]
    for name, motion in (("before", still), ("now", still), ("rigid", motions[0]), ("similarity", motions[1])):
        case.equal(f"meanDistance.{name}", apart(motion))
    image = models[B].mean * np.tile([-1.0] + [1.0] * (dimension - 1), models[B].points)
    factor, turn, shift = motion_onto(models[A].mean, image, dimension, False)
    mirrored = image.reshape(-1, dimension) @ turn.T + shift - target
    case.equal("meanDistance.mirrored", np.linalg.norm(mirrored, axis=1).mean())
    case.equal("scale", models[B].size / models[A].size)
    for name, model in zip("ab", models):
        case.same(f"points.{name}", model.points)
    case.same("compared", models[A].points)
    case.finish({})


def sweep(case, models):
    """By the fits of previews: from the rms fit, two variational steps; of few points, so that all are taken."""
    sides = [Side(models[A], models[B]), Side(models[B], models[A])]
    joint = Joint(models)
    most = min(len(model.deviations) for model in models)
    union = pooled([joint.prior(A), joint.prior(B)])
    spaces = [(joint.means[A], joint.modes[A]), (joint.means[B], joint.modes[B]), (union[0], components(union[1])[0])]
    for place, point in enumerate(case.report):
        sigma = point["sigma"]
        fits = []
        for side in sides:
            mean, precision = fit_rms(side, sigma)
            for _ in range(2):
                slope, after = _slope(side, sigma, mean, norm_moments(*at_points(side, (mean, precision))))
                mean, precision = mean - np.linalg.solve(after, slope), after
            fits.append((mean, precision))
        nearest = [side.distances(fit[0][None])[0] for side, fit in zip(sides, fits)]
        held = [effective_dimensions(side, fit) for side, fit in zip(sides, fits)]
        both = pooled([joint.lift(side, (fit[0], np.linalg.inv(fit[1]))) for side, fit in enumerate(fits)])
        modes = components(both[1], most)[0]
        at = f"{place}."
        case.equal(f"{at}sigma", SWEPT[place])
        case.equal(f"{at}distance", np.mean([math.hypot(near, sigma * math.sqrt(q)) for near, q in zip(nearest, held)]))
        case.equal(f"{at}nearest", np.mean(nearest), scale=1e-6 * max(nearest))
        case.equal(f"{at}effectiveDimensions", np.mean(held), scale=1e-2)
        case.equal(f"{at}meanNorm", np.mean([np.linalg.norm(fit[0]) for fit in fits]))
        case.equal(f"{at}vertexSd", math.sqrt(np.trace(both[1]) / models[A].points))
        for name, space in zip(("toA", "toB", "toUnion"), spaces):
            case.equal(f"{at}grassmann.{name}", grassmann(joint.space(both[0], modes), joint.space(*space), False), scale=0.1)
    case.finish({})


SWEPT = [0.001, 0.002, 0.004]


# --------------------------------------------------------------- lines in words


def plain(value):
    """A length as the command line writes it: four decimals, below 1 four digits, below 1e-5 as a power of ten."""
    size = abs(value)
    if size == 0:
        return "0"
    if size >= 1:
        return f"{value:.4f}"
    for place, least in enumerate((0.1, 0.01, 1e-3, 1e-4, 1e-5)):
        if size >= least:
            return f"{value:.{place + 4}f}"
    mantissa, power = f"{value:.3e}".split("e")
    return f"{mantissa}e{int(power)}"


def words(case, text, found):
    """Lines of `compare` in words, made of the numbers of `found`, a report whose numbers were recomputed."""
    unit = found["models"]["a"]["unit"]
    lines = [f"{name}  {model['name']} ({model['modes']} modes)" for name, model in (("A", found["models"]["a"]),
                                                                                   ("B", found["models"]["b"]))]
    for this, other, way in (("A", "B", "aToB"), ("B", "A", "bToA")):
        one = found["reach"][way]
        quantiles, parts = one["quantiles"], one["meanSquare"]
        lines.append(f"{this} to {other}  {plain(one['mean'])} ± {plain(one['standardError'])} {unit} (median {plain(quantiles['p50'])}, "
                     f"5 to 95 % {plain(quantiles['p05'])} to {plain(quantiles['p95'])}), {100 * one['relative']:.0f} % of the distance "
                     f"from the mean of {this};")
        shares = [100 * parts[name] / parts["total"] if parts["total"] else 0.0 for name in ("offset", "offsetClosed", "exclusive")]
        lines.append(f"        of the mean square {shares[0]:.1f} % are an offset of the means that no shape closes, {shares[1]:.1f} % an "
                     f"offset that shapes close, {shares[2]:.1f} % variance that {other} lacks.")
    between = found["overlap"]
    lines.append(f"B can make {100 * between['varianceOfAInB']:.1f} % of A's variance; A can make {100 * between['varianceOfBInA']:.1f} % "
                 "of B's.")
    kl = between["kullbackLeibler"]
    lines.append(f"Bhattacharyya {between['bhattacharyya']:.2f}, KL(A‖B) {kl['aFromB']:.2f}, KL(B‖A) {kl['bFromA']:.2f} nats, with noise of "
                 f"{plain(between['bhattacharyyaNoise'])} {unit}.")
    most = [sum(share < 0.9 for share in found["compactness"][name]) + 1 for name in ("a", "b", "intersection")]
    lines.append(f"90 % of the variance lie in {most[0]} modes of A, {most[1]} of B, {most[2]} of A∩B.")
    both = found["intersection"]
    kept = f" with {100 * both['varianceKept']:.1f} % of its variance" if both["varianceKept"] < 0.995 else ""
    lines.append(f"A∩B  {both['modes']} mode{'' if both['modes'] == 1 else 's'}{kept}; its shapes lie {plain(both['meanDistance']['mean'])} ± {plain(both['meanDistance']['sd'])} "
                 f"{unit} from both models.")
    for name, field in (("A\\B", "aWithoutB"), ("B\\A", "bWithoutA")):
        part = found["differences"][field]
        lines.append(f"{name}  {100 * part['probability']:.2f} ± {100 * part['standardError']:.2f} % of the shapes, "
                     f"{plain(part['meanDistance']['mean'])} {unit} away on average.")
        if part.get("linearSplit"):
            split = part["linearSplit"]
            lines.append(f"     by linear splitting instead: its mean {plain(split['meanToMean'])} {unit} away, {split['varianceRatio']:.2f} "
                         f"times the variance, {100 * split['negativeShare']:.1f} % of it negative.")
    angle = both["grassmann"]
    lines.append(f"d_G  to A {angle['toA']:.4f}, to B {angle['toB']:.4f}, to the union {angle['toUnion']:.4f}")
    if found.get("evidence"):
        lines += evidence_in_words(found["evidence"], unit)
    shown = text.splitlines()
    for line in lines:
        count = 0.0 if line in shown else math.inf
        case.table.numbers += sum(any(letter.isdigit() for letter in word) for word in line.split())
        case.table.add(case.name, f"in words: {line.strip()[:60]}", 0, 0, count, 0.0, "lines in words")


def evidence_in_words(found, unit):
    lines = []
    means = found["onePopulation"]["statistics"][0]
    lines.append(f"The means are {plain(means['observed'])} {unit} apart in root mean square; those of two random groups "
                 f"{plain(means['chance']['mean'])} ± {plain(means['chance']['standardDeviation'])} {unit}.")
    for name, side in (("A", "a"), ("B", "b")):
        left = found["leftOut"][side]
        lines.append(f"A shape of {name} lies {plain(left['mean'])} ± {plain(left['standardDeviation'])} {unit} from the model of the others "
                     f"of {name}. Stable modes of {name}: {found['stability'][side]['suggestedModes']}.")
    lines.append(f"The means differ at {100 * found['vertices']['differ']:.0f} % of the points (family-wise p ≤ 0.05), at "
                 f"{100 * found['vertices']['falseDiscovery']:.0f} % if one in twenty of these may be false.")
    for hypothesis in ("onePopulation", "oneCovariance"):
        for one in found[hypothesis]["statistics"]:
            lines.append(f"    {one['name']:18} {plain(one['observed']):>10}  {plain(one['chance']['mean']):>8} ± "
                         f"{plain(one['chance']['standardDeviation']):>8}  {one['p']:.4f} ± {one['pError']:.4f}  {one['pAdjusted']:.4f}")
    return lines
