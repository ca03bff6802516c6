"""Compares every number of the report of `shapevenn compare` with one that NumPy found."""
import math

import numpy as np
from scipy.stats import chi2

import draws as random_part
import groups as evidence
from pairs import (A, B, Joint, Meeting, ROUNDING, Side, bhattacharyya, components, effective_dimensions, expected_distance,
                   fit_laplace, fit_reweighted, fit_rms, fit_variational, grassmann, kullback_leibler, left_out, mean_length,
                   mean_square, noise, plausible_radius, point_deviations, pooled, principal_angles, rounding, scale, spread,
                   tolerance, without_distance)
from table import SINGLE, STORED

EXCUSED = {
    "schema": "version of the layout",
    "settings.*": "a setting, as given or by default",
    "seconds.*": "seconds",
    "answer.*.value": "repeats another field; compared with it below",
    "intersection.sides.*.evaluations": "count of work",
    "intersection.diagnostics.evaluations": "count of work",
    "intersection.*.paretoK": "of weights that are all the same but for rounding",
    "intersection.*.autocorrelation": "of no draws",
}
NAMES = ("a", "b")
WAYS = ("aToB", "bToA")
DIFFERENCES = ("aWithoutB", "bWithoutA")


def modes_cut_to(models):
    """How many modes models have that were cut, fewer than their shapes make."""
    kept = [len(model.deviations) for model in models
            if model.shapes is not None and len(model.deviations) < model.shapes.shape[1] - 1]
    return min(kept, default=None)


def check(case, models, stored, signs, *, cut_variance=0.0, independent=None):
    """`stored`: the arrays of draws.npz; `signs`: those of the program's modes, as `convert` writes them."""
    report = case.report
    settings = report["settings"]
    share = 0.5 if settings["plausibility"] == "idempotent" else 1.0
    seed = int(settings["seed"])
    sides = [Side(models[A], models[B], share), Side(models[B], models[A], share)]
    for side, of in zip(sides, signs):
        side.signs = of
    joint = Joint(models)
    dimension, points = models[A].dimension, models[A].points
    tiny = rounding(models)

    for name, model in zip(NAMES, models):
        describe(case, f"models.{name}", model)

    # Shares, angles, divergences.
    sigma, recommended, source, meeting, tolerances, known = sigma_of(case, models, sides, cut_variance)
    case.equal("settings.sigma", sigma)
    case.same("sigmaSource", source)
    overlap(case, "overlap.", models, sides, joint, sigma)
    for name, model in zip(NAMES, models):
        case.equal(f"compactness.{name}", np.cumsum(model.deviations**2) / model.total)

    # Reach.
    problem = Meeting(models)
    found_reach = []
    for side, (way, of) in enumerate(zip(WAYS, sides)):
        own = math.sqrt(models[side].total / points)
        least = math.inf if of.is_contained(tiny) else 1e-9 * own
        distances, further = random_part.reach(of, models, problem, side, seed, least)
        found_reach.append(distances)
        error = distances.std(ddof=1) / math.sqrt(len(distances))
        case.equal(f"reach.{way}.mean", distances.mean(), SINGLE)
        case.equal(f"reach.{way}.standardError", error, 1e-5)
        for name, level in (("p05", 0.05), ("p50", 0.5), ("p95", 0.95)):
            case.equal(f"reach.{way}.quantiles.{name}", np.quantile(distances, level), SINGLE)
            case.equal(f"reach.{way}.quantileErrors.{name}", random_part.quantile_error(distances, level), 1e-3)
        parts = mean_square(of, least)
        for name, part in zip(("total", "offset", "offsetClosed", "exclusive"), parts):
            case.equal(f"reach.{way}.meanSquare.{name}", part, scale=1e-6 * parts[0])
        case.equal(f"reach.{way}.relative", math.sqrt(parts[0]) / own)
        case.equal(f"reach.{way}.plausible.mean", distances.mean() + further.mean(), SINGLE)
        of_both = math.hypot(error, further.std(ddof=1) / math.sqrt(len(further)))
        case.equal(f"reach.{way}.plausible.standardError", of_both, 1e-5)
        if independent is not None and math.isfinite(least):
            fresh = of.distances(independent.normal(size=(4096, of.q)))
            both = math.hypot(error, fresh.std(ddof=1) / 64)
            case.near(f"reach.{way}.mean", fresh.mean(), max(both, 1e-7 * fresh.mean()), law="independent draws", also=False)
    if "reach.meeting" in case:
        case.equal("reach.meeting", meeting, MEETING, law="least distance, by another solver to rest")
    curve(case, found_reach)

    # The Gaussian fits and what is made of them.
    inference = report["intersection"]["inference"]
    pooling = settings["pooling"]
    used = [A, B] if pooling == "both" else [A if pooling == "a" else B]
    fits, totals, sides_groups = [], [], []
    for side, name in enumerate(NAMES):
        said = inference[name]
        rms = fit_rms(sides[side], sigma)
        variational = fit_variational(sides[side], sigma) if said["fit"] in ("variational", "laplace") else None
        fit = {"variational": lambda: variational, "rms": lambda: rms, "reweighted": lambda: fit_reweighted(sides[side], sigma),
               "laplace": lambda: fit_laplace(sides[side], sigma, variational)}[said["fit"]]()
        fits.append(fit)
        weighted = random_part.Weighted(sides[side], side, seed, sigma, fit, settings["weighted"])
        sides_groups.append(weighted)
        closed = fit[0], np.linalg.inv(fit[1])
        if said["moments"] == "draws":
            drawn = stored[f"intersection_{name}"].astype(float)
            rows = drawn.reshape(-1, drawn.shape[2]) * signs[side]
            moments = rows.mean(axis=0), np.atleast_2d(np.cov(rows.T))
            by_chain = [chain * signs[side] for chain in drawn]
            weighted.groups = [(rows.mean(axis=0), np.atleast_2d(np.cov(rows.T))) for rows in by_chain]
        else:
            moments = closed if said["moments"] == "closed-form" else weighted.total
            expected = "closed-form" if weighted.is_within_error else "weighted"
            if settings["sampler"] != "variational" and abs(weighted.margin - 1) > 1e-3:
                case.same(f"intersection.inference.{name}.moments", expected)
        totals.append(moments)
        exported(case, stored, name, moments, signs[side])
    both = pooled([joint.lift(side, totals[side]) for side in used])
    most = min(len(model.deviations) for model in models)
    modes, variances = components(both[1], most)
    of_moments = 1e-5 if any(inference[NAMES[side]]["moments"] == "draws" for side in used) else EXACT_OF_FIT
    case.same("intersection.modes", len(variances))
    case.equal("intersection.standardDeviations", np.sqrt(variances), of_moments)
    case.equal("intersection.totalVariance", variances.sum(), of_moments)
    case.equal("intersection.varianceKept", variances.sum() / np.trace(both[1]), of_moments)
    case.equal("compactness.intersection", np.cumsum(variances) / variances.sum(), of_moments)
    _spread(case, "intersection.vertexSd", joint.deviations(modes * np.sqrt(variances)), of_moments)
    union = pooled([joint.prior(A), joint.prior(B)])
    spaces = [(joint.means[A], joint.modes[A]), (joint.means[B], joint.modes[B]), (union[0], components(union[1])[0])]
    for whole, field in ((False, "grassmann"), (True, "grassmannAffine")):
        for name, space in zip(("toA", "toB", "toUnion"), spaces):
            angle = grassmann(joint.space(both[0], modes), joint.space(*space), whole)
            case.equal(f"intersection.{field}.{name}", angle, GRASSMANN, scale=0.1)

    if report["intersection"].get("accuracy"):
        _, values, variance, turns = random_part.accuracy(
            joint, [(side, totals[side]) for side in used], [sides_groups[side].groups for side in used], pooled, components)
        shown = min(most, len(values))
        turn = np.minimum(np.sqrt(turns[:shown].sum(axis=1)), math.pi / 2)
        at = "intersection.accuracy"
        case.equal(f"{at}.covariance", math.sqrt(variance.sum()) / np.linalg.norm(both[1]), OF_NOISE, scale=BLUR)
        case.equal(f"{at}.standardDeviations", np.sqrt(variance.diagonal()[:shown]) / (2 * np.sqrt(values[:shown])), OF_NOISE,
                   scale=BLUR * math.sqrt(values[0]))
        case.equal(f"{at}.modeTurns", turn, OF_NOISE, scale=BLUR)
        reached = [math.sqrt(turns[:k, k:].sum()) for k in range(1, shown + 1)]
        case.equal(f"{at}.grassmann", np.minimum(reached, math.pi / 2 * math.sqrt(shown)), OF_NOISE, scale=BLUR)
        trusted = np.flatnonzero(turn >= 0.2)
        case.same(f"{at}.modesTrusted", int(trusted[0]) if len(trusted) else shown)
    if report["intersection"].get("disagreement"):
        disagreement(case, joint, totals, both, of_moments)

    at = "intersection.tolerance"
    case.equal(f"{at}.recommended", recommended)
    case.equal(f"{at}.relative", sigma / scale(models))
    case.equal(f"{at}.nearest", tolerances[1], scale=1e-6 * tolerances[2])
    case.equal(f"{at}.farthest", tolerances[2])
    if tolerances[2]:
        fine = np.mean([expected_distance(side, without_distance(side), nodes=400) for side in sides])
        case.table.add(case.name, f"{at}.farthest (finer quadrature)", case.shown(f"{at}.farthest"), fine,
                       abs(case.shown(f"{at}.farthest") / fine - 1), 1e-4, "quadrature of 400 nodes")
    predicted = [math.hypot(side.distances(fit[0][None])[0], sigma * math.sqrt(effective_dimensions(side, fit)))
                 for side, fit in zip(sides, fits)]
    case.equal(f"{at}.predicted", np.mean(predicted), of_moments)
    case.equal(f"{at}.effectiveDimensions", np.mean([effective_dimensions(side, fit) for side, fit in zip(sides, fits)]), 1e-5,
               scale=1e-3)
    if f"{at}.meeting" in case:
        case.equal(f"{at}.meeting", meeting, MEETING, law="least distance, by another solver to rest")
    if f"{at}.noise" in case:
        case.equal(f"{at}.noise", known)

    chains(case, stored, joint, sides, signs, pooling, sides_groups, sigma, fits)
    differences(case, stored, models, sides, joint, sigma, seed, tiny, (both[0], (modes * variances) @ modes.T))

    if report.get("evidence"):
        evidence.check(case, "evidence", groups_of(models), seed, settings["permutations"], modes_cut_to(models), sigma,
                       independent)
    answers(case)
    case.finish(EXCUSED)


def groups_of(models):
    """The shapes of both models, aligned all together unless one of them is not aligned."""
    alignments = {model.alignment for model in models}
    together = "none" if "none" in alignments else "rigid" if "rigid" in alignments else "similarity"
    return evidence.Groups(models[A].shapes, models[B].shapes, models[A].dimension, together)


# The least distance is sought until a round changes it by less than 1e-4.
MEETING = 1e-3
EXACT_OF_FIT = 1e-6
GRASSMANN = 1e-6
# Spreads of groups of draws: first order in the rounding of single precision over the noise itself.
OF_NOISE = 1e-2
BLUR = 1e-4


def describe(case, at, model):
    at = f"{at}." if at else ""
    case.same(f"{at}points", model.points)
    case.same(f"{at}dimension", model.dimension)
    case.same(f"{at}modes", len(model.deviations))
    case.same(f"{at}cells", model.cells)
    case.equal(f"{at}totalVariance", model.total)
    case.equal(f"{at}standardDeviations", model.deviations)
    case.equal(f"{at}size", model.size)
    _spread(case, f"{at}vertexSd", point_deviations(model.scaled, model.dimension))
    if f"{at}orthogonality" in case:
        case.equal(f"{at}orthogonality", model.orthogonality, scale=1e-3)
        case.same(f"{at}droppedModes", model.dropped)
    if f"{at}shapes" in case:
        case.same(f"{at}shapes.count", model.shapes.shape[1])
        case.same(f"{at}shapes.role", model.role)


def _spread(case, path, values, bound=1e-6):
    for name, value in zip(("min", "mean", "max"), spread(values)):
        case.equal(f"{path}.{name}", value, bound, scale=1e-3 * values.max())


def overlap(case, at, models, sides, joint, sigma):
    """The same numbers in the report of a comparison and in a cell of a matrix."""
    angles = np.degrees(principal_angles(models[A].modes, models[B].modes))
    whole = not at.startswith("relations")
    # Directions of B at less than 1e-9 to A count as directions of A.
    case.equal(f"{at}{'principalAnglesDegrees' if whole else 'anglesDegrees'}", angles, scale=0.1)
    for name, side, model in (("varianceOfAInB", sides[A], models[A]), ("varianceOfBInA", sides[B], models[B])):
        case.equal(f"{at}{name}", 1 - np.trace(side.gram) / model.total)
    priors = [joint.prior(A), joint.prior(B)]
    if f"{at}bhattacharyya" in case:
        case.equal(f"{at}bhattacharyya", bhattacharyya(*priors, sigma))
    case.equal(f"{at}{'bhattacharyyaNoise' if whole else 'noise'}", sigma)
    case.equal(f"{at}meanToMean", mean_length(models[A].mean - models[B].mean, models[A].dimension), scale=1e-9 * models[A].size)
    if whole:
        case.equal(f"{at}kullbackLeibler.aFromB", kullback_leibler(*priors, sigma))
        case.equal(f"{at}kullbackLeibler.bFromA", kullback_leibler(*priors[::-1], sigma))
    else:
        spaces = [joint.space(joint.means[side], joint.modes[side]) for side in (A, B)]
        case.equal(f"{at}grassmann", grassmann(*spaces, False), scale=0.1)
        case.equal(f"{at}grassmannAffine", grassmann(*spaces, True), scale=0.1)


def sigma_of(case, models, sides, cut_variance=0.0, given=None):
    """(sigma in use, recommended, source, meeting, range of distances, noise)."""
    errors = []
    for model in models:
        if model.role == "training":
            made = model.shapes.shape[1] - 1
            kept = len(model.deviations)
            errors.append(left_out(model.shapes, model.dimension, kept if kept < made else None).mean())
        elif model.role == "test":
            away = model.shapes - model.mean[:, None]
            rest = away - model.modes @ (model.modes.T @ away)
            errors.append(np.mean([mean_length(one, model.dimension) for one in rest.T]))
    errors = [error for error in errors if error > ROUNDING * scale(models)]
    settings = case.report.get("settings", {}) if isinstance(case.report, dict) else {}
    known = settings.get("noise") or noise(models, cut_variance)
    tolerances = tolerance(sides, models)
    radii = [plausible_radius(len(model.deviations)) for model in models]
    for model, radius in zip(models, radii):
        exact = math.sqrt(chi2.ppf(0.99, len(model.deviations)))
        case.table.add(case.name, f"radius of plausible shapes, {len(model.deviations)} modes", radius, exact,
                       abs(radius / exact - 1), 1e-2, "approximations that the program documents")
    meeting, gap = Meeting(models).least(radii)
    if meeting <= max(ROUNDING * scale(models), rounding(models)):
        meeting = None
    else:
        case.table.add(case.name, "reach.meeting (gap of duality)", meeting, meeting * (1 - gap), gap, 1e-3, "bound from below")
    shown = settings.get("sigma")
    if errors:
        recommended, source = float(np.mean(errors)), "left-out"
    elif known:
        recommended, source = known, "noise"
    elif meeting and meeting > tolerances[0] and tolerances[2] > 0:
        recommended, source = meeting, "meeting"
    else:
        recommended, source = tolerances[0], "budget"
    sigma = recommended
    if given is not None or settings.get("sigmaRecommended") is False:
        sigma, source = (given if given is not None else shown), "given"
    elif source == "meeting":
        # Shown with the accuracy of its solver; what follows from it is compared at the value in use.
        shown = case.report["intersection"]["tolerance"]["recommended"] if settings else recommended
        case.table.add(case.name, "sigma from the meeting", shown, recommended, abs(shown / recommended - 1), MEETING,
                       "least distance, by another solver to rest")
        sigma = recommended = shown
    return sigma, recommended, source, meeting, tolerances, known


def curve(case, distances):
    medians = [np.quantile(of, 0.5) for of in distances if np.quantile(of, 0.5) > 0]
    if not medians:
        return
    sigma = 0.1 * min(medians) * (100 * max(medians) / min(medians)) ** (np.arange(41) / 40)
    case.equal("reach.curve.sigma", sigma, SINGLE)
    for name, of in zip(DIFFERENCES, distances):
        shares = -np.expm1(-0.5 * (of[:, None] / sigma) ** 2).mean(axis=0)
        case.equal(f"reach.curve.{name}", shares, 1e-5)


def exported(case, stored, name, moments, signs):
    """The moments of the coefficients as they are stored, in single precision."""
    for part, found in (("mean", moments[0] * signs), ("covariance", moments[1] * np.outer(signs, signs))):
        shown = stored[f"intersection_{name}_{part}"].astype(float)
        scale_of = max(np.abs(shown).max(), 1.0)
        off = np.abs(shown - found).max() / scale_of
        case.table.numbers += shown.size
        case.table.add(case.name, f"draws.npz intersection_{name}_{part}", shown, found, float(off), 2e-6, "computed")


def disagreement(case, joint, totals, both, bound):
    at = "intersection.disagreement"
    first, second = [joint.lift(side, totals[side]) for side in (A, B)]
    apart = first[0] - second[0]
    size = scale(joint.models)
    case.equal(f"{at}.meanToMean", mean_length(joint.basis @ apart, joint.dimension), bound, scale=1e-6 * size)
    case.equal(f"{at}.covariance", np.linalg.norm(first[1] - second[1]) / np.linalg.norm(both[1]), bound)
    case.equal(f"{at}.betweenShare", apart @ apart / 4 / np.trace(both[1]), bound, scale=1e-6)
    parts = [components(one[1]) for one in (first, second)]
    for name, one, part in zip(NAMES, (first, second), parts):
        case.equal(f"{at}.totalVariance.{name}", np.trace(one[1]), bound)
        case.equal(f"{at}.standardDeviations.{name}", np.sqrt(part[1]), bound)
    fewest = min(len(part[1]) for part in parts)
    found = [grassmann(joint.space(first[0], parts[0][0][:, :k]), joint.space(second[0], parts[1][0][:, :k]), False)
             for k in (1, 3, 5, 10) if k <= fewest]
    case.equal(f"{at}.grassmann", found, GRASSMANN, scale=0.1)


def chains(case, stored, joint, sides, signs, pooling, weighted, sigma, fits):
    """Diagnostics of the stored draws, and whether their distances are theirs."""
    worst = []
    for side, name in enumerate(NAMES):
        of_side = stored[f"intersection_{name}"].astype(float)
        distances = stored[f"intersection_{name}_distance"].astype(float)
        found = sides[side].distances(of_side.reshape(-1, of_side.shape[2]) * signs[side]).reshape(distances.shape)
        off = np.abs(found - distances).max() / max(distances.max(), 1e-9 * scale(joint.models))
        case.table.numbers += distances.size
        case.table.add(case.name, f"draws.npz intersection_{name}_distance", distances, found, float(off), STORED, "stored draws")
        rows = np.array([random_part.diagnostics(of_side[:, :, mode]) for mode in range(of_side.shape[2])])
        at = f"intersection.coefficients.{name}"
        fields = ("rHat", "essBulk", "essTail", "mcseMean", "mcseSd", "autocorrelation")
        for field, column in zip(fields, rows.T):
            case.equal(f"{at}.{field}", column, DIAGNOSTIC, scale=0.1 if field == "autocorrelation" else None, law="stored draws")
        most = [rows[:, 0].max(), rows[:, 1].min(), rows[:, 2].min(), rows[:, 3].max(), rows[:, 4].max(), rows[:, 5].max()]
        worst.append(most)
        _diagnostics(case, f"intersection.sides.{name}", most, distances.size)
        at = f"intersection.sides.{name}"
        if case.report["intersection"]["inference"][name]["sampler"] == "independence":
            again = random_part.Independent(sides[side], side, int(case.shown("settings.seed")), sigma, fits[side],
                                            without_distance(sides[side]), case.report["settings"])
            for part, made, shown in (("", again.draws, of_side), ("_distance", again.distances, distances)):
                least = 1.0 if not part else max(distances.max(), 1e-9 * scale(joint.models))
                off = float(np.abs(made - shown).max() / least)
                case.table.add(case.name, f"draws.npz intersection_{name}{part} (chains run again)", shown, made, off, STORED,
                               "stored draws")
            case.equal(f"{at}.acceptance", again.acceptance)
            case.equal(f"{at}.importanceEss", again.effective, 1e-4)
            if f"{at}.paretoK" in case and not again.is_even:
                case.equal(f"{at}.paretoK", again.k, 1e-2, scale=0.1)
            continue
        moved = (np.abs(np.diff(of_side, axis=1)).max(axis=2) > 0).mean()
        case.near(f"{at}.acceptance", moved, max(8 / distances.size, 1e-9), times=3)
        if f"{at}.importanceEss" in case:
            share = weighted[side].effective / len(weighted[side].log_weights)
            case.equal(f"{at}.importanceEss", weighted[side].effective, 1e-4)
            if f"{at}.paretoK" in case and share < 1 - 1e-6:
                case.equal(f"{at}.paretoK", weighted[side].k, 1e-2, scale=0.1)
    used = [A, B] if pooling == "both" else [A if pooling == "a" else B]
    folded = [function([worst[side][place] for side in used]) for place, function in enumerate((max, min, min, max, max, max))]
    at = "intersection.diagnostics"
    _diagnostics(case, at, folded, sum(stored[f"intersection_{NAMES[side]}_distance"].size for side in used))
    case.equal(f"{at}.acceptance", min(case.shown(f"intersection.sides.{NAMES[side]}.acceptance") for side in used))
    of = [case.report["intersection"]["sides"][NAMES[side]].get("paretoK") for side in used]
    if f"{at}.paretoK" in case and f"intersection.sides.{NAMES[used[0]]}.paretoK" in case.seen:
        case.equal(f"{at}.paretoK", max(k for k in of if k is not None), 0.0)
    if f"{at}.importanceEss" in case:
        of = [case.shown(f"intersection.sides.{NAMES[side]}.importanceEss") for side in used]
        case.equal(f"{at}.importanceEss", min(of), 0.0)
    everything = np.concatenate([stored[f"intersection_{NAMES[side]}_distance"].astype(float).ravel() for side in used])
    case.equal("intersection.meanDistance.mean", everything.mean(), STORED, law="stored draws")
    case.equal("intersection.meanDistance.sd", everything.std(ddof=1), 1e-4, law="stored draws")
    # And by weighted draws of the fit, which NumPy makes.
    means, variances = [], []
    for side in used:
        rng = np.random.default_rng(7 + side)
        lower = np.linalg.cholesky(fits[side][1])
        z = rng.normal(size=(4000, sides[side].q))
        points = fits[side][0] + np.linalg.solve(lower.T, z.T).T
        distances = sides[side].distances(points)
        logs = -0.5 * ((distances / sigma) ** 2 + sides[side].plausibility(points)) + 0.5 * (z**2).sum(axis=1)
        weights = np.exp(logs - logs.max())
        weights /= weights.sum()
        mean = weights @ distances
        means.append(mean)
        variances.append((weights**2 * (distances - mean) ** 2).sum())
    error = math.sqrt(sum(variances)) / len(used)
    count = sum(stored[f"intersection_{NAMES[side]}_distance"].size for side in used)
    error = math.hypot(error, everything.std() / math.sqrt(0.25 * count))
    reliable = all(weighted[side].k is None or weighted[side].k < 0.7 for side in used)
    if reliable:
        case.near("intersection.meanDistance.mean", np.mean(means), max(error, 1e-6 * np.mean(means)), law="independent draws",
                  also=False)


DIAGNOSTIC = 1e-4


def _diagnostics(case, at, values, count):
    fields = ("rHatMax", "essBulkMin", "essTailMin", "mcseMean", "mcseSd", "autocorrelation")
    for field, value in zip(fields, values):
        case.equal(f"{at}.{field}", value, DIAGNOSTIC, scale=0.1 if field == "autocorrelation" else None, law="stored draws")
    case.same(f"{at}.draws", count)


def differences(case, stored, models, sides, joint, sigma, seed, tiny, both):
    settings = case.report["settings"]
    definition = settings["difference"]
    for side, name in enumerate(DIFFERENCES):
        at = f"differences.{name}"
        of, model = sides[side], models[side]
        # From inner products: to 1e-8 of the largest (src/measure/exclusive.rs).
        values = np.linalg.svd(of.r, compute_uv=False) / math.sqrt(of.points)
        case.equal(f"{at}.exclusive.residualSd", values, scale=max(values[0], 1e-6 * math.sqrt(model.total / of.points)))
        case.equal(f"{at}.exclusive.unexplained", np.trace(of.gram) / model.total, scale=1e-6)
        level = sigma if definition == "soft" else settings["differenceThreshold"]
        if definition != "outside" and of.is_contained(tiny):
            for field in ("probability", "standardError", "overlapWithPrior", "overlapStandardError", "meanDistance.mean",
                          "meanDistance.sd", "vertexSd.min", "vertexSd.mean", "vertexSd.max", "diagnostics.acceptance"):
                case.equal(f"{at}.{field}", 0.0)
            for field in ("essBulkMin", "essTailMin", "evaluations", "draws"):
                case.same(f"{at}.diagnostics.{field}", 0)
            # A quantile of distances that are all nothing.
            case.equal(f"{at}.threshold", level or 0.0, scale=None if level else 1e-6 * (1 if definition == "relative" else
                                                                                        scale(models)))
            continue
        found = random_part.Differences(of, side, seed, definition, level, settings["differenceQuantile"],
                                        settings["differenceDraws"])
        case.same(f"{at}.envelope", found.envelope)
        # Where the other model makes all shapes, what is left of their distances is rounding.
        nothing = {"relative": 1.0}.get(definition, scale(models)) * 1e-6 if of.is_contained(tiny) else None
        case.equal(f"{at}.threshold", found.level, SINGLE, scale=nothing)
        if found.envelope == "tilted":
            tilted(case, at, of, found.level, definition, stored, name, joint, models, side, both)
            continue
        if case.shown(f"{at}.diagnostics.draws") == 0:
            continue
        case.equal(f"{at}.probability", found.probability, 1e-5)
        # From sums of squares of numbers near 1: below 1e-6 it loses its digits.
        case.equal(f"{at}.standardError", found.error, 1e-4, scale=1e-6)
        case.equal(f"{at}.overlapWithPrior", found.overlap, 1e-5)
        case.equal(f"{at}.overlapStandardError", found.overlap_error, 1e-3, scale=1e-6)
        case.equal(f"{at}.diagnostics.acceptance", found.acceptance)
        count = len(found.draws)
        for field in ("draws", "essBulkMin", "essTailMin"):
            case.same(f"{at}.diagnostics.{field}", count)
        case.same(f"{at}.diagnostics.evaluations", found.proposals)
        of_draws(case, at, found.draws, found.distances, joint, models, side, found.probability, both)


def of_draws(case, at, rows, distances, joint, models, side, probability, both, bound=1e-6):
    nothing = 1e-6 * scale(models)
    case.equal(f"{at}.meanDistance.mean", distances.mean(), max(SINGLE, bound), scale=nothing)
    case.equal(f"{at}.meanDistance.sd", distances.std(ddof=1), 1e-4, scale=nothing)
    mean, covariance = rows.mean(axis=0), np.atleast_2d(np.cov(rows.T))
    values, vectors = np.linalg.eigh(covariance)
    factor = models[side].scaled @ (vectors * np.sqrt(np.maximum(values, 0)))
    _spread(case, f"{at}.vertexSd", point_deviations(factor, joint.dimension), bound)
    if f"{at}.linearSplit" not in case:
        return
    weight = 1 - probability
    drawn = joint.lift(side, (mean, covariance))
    prior = joint.prior(side)
    rest = (prior[0] - weight * both[0]) / (1 - weight)
    apart = both[0] - rest
    split = (prior[1] - weight * both[1]) / (1 - weight) - weight * np.outer(apart, apart)
    values, vectors = np.linalg.eigh(split)
    at = f"{at}.linearSplit"
    case.equal(f"{at}.weight", weight, 1e-5, scale=0.1)
    case.equal(f"{at}.meanToMean", mean_length(joint.basis @ (rest - drawn[0]), joint.dimension), SPLIT)
    case.equal(f"{at}.negativeShare", -values[values < 0].sum() / np.abs(values).sum(), SPLIT, scale=1e-3)
    positive = vectors[:, values > 0] * np.sqrt(values[values > 0])
    _spread(case, f"{at}.vertexSd", joint.deviations(positive), SPLIT)
    case.equal(f"{at}.varianceRatio", values[values > 0].sum() / np.trace(drawn[1]), SPLIT)


SPLIT = 1e-5


def tilted(case, at, of, level, definition, stored, name, joint, models, side, both):
    """Draws from another envelope: checked by NumPy's own draws, and what is made of them from the stored ones."""
    rng = np.random.default_rng(11 + side)
    points = rng.normal(size=(200_000, of.q))
    distances = of.distances(points)
    score = np.linalg.norm(points @ of.p.T + of.a0, axis=1) if definition == "outside" else distances
    share = -np.expm1(-0.5 * (score / level) ** 2) if definition == "soft" else (score >= level) * 1.0
    error = math.hypot(share.std() / math.sqrt(len(share)), case.shown(f"{at}.standardError"))
    case.near(f"{at}.probability", share.mean(), error)
    count = case.shown(f"{at}.diagnostics.draws")
    case.seen.add(f"{at}.standardError")
    weights = share / share.sum()
    mean = weights @ distances
    spread_of = math.sqrt(weights @ (distances - mean) ** 2)
    error = max(math.hypot(spread_of / math.sqrt(count), spread_of / 200), 1e-9 * scale(models))
    case.near(f"{at}.meanDistance.mean", mean, error, also=False)
    overlap = np.minimum(share / share.mean(), 1).mean()
    case.near(f"{at}.overlapWithPrior", overlap, math.hypot(case.shown(f"{at}.overlapStandardError"), 2e-3))
    for field in ("standardError", "overlapStandardError", "diagnostics.acceptance", "diagnostics.evaluations"):
        case.table.unchecked.setdefault((f"differences.*.{field}", "of the tilted envelope, whose proposals no output holds"),
                                        set()).add(case.name)
        case.seen.add(f"{at}.{field}")
    for field in ("draws", "essBulkMin", "essTailMin"):
        case.same(f"{at}.diagnostics.{field}", count)
    key = "a_without_b" if side == A else "b_without_a"
    rows = stored[key].astype(float) * of.signs
    of_draws(case, at, rows, of.distances(rows), joint, models, side, case.shown(f"{at}.probability"), both, bound=STORED)


def answers(case):
    """Numbers of sentences are those of the fields that they name."""
    for place, sentence in enumerate(case.report.get("answer", [])):
        for part, value in enumerate(sentence["parts"]):
            if isinstance(value, dict) and "metric" in value:
                path = f"answer.{place}.parts.{part}.value"
                case.equal(path, case.shown(value["metric"]), 0.0)
                if value["metric"] not in case.seen:
                    case.same(f"{path} names a field that was not recomputed", None)
