"""The populations and models of the comparison, and the commands that are run on them."""
import dataclasses
import json
import pathlib
import subprocess

import numpy as np

import comparison
import evaluations
import groups
import shapes

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
HEADS = ROOT / "demos/heads"
WINGS = ROOT / "demos/wings"
FIXTURES = ROOT / "tests/fixtures"
STARS = [(5, 40, 20), (5, 20, 20), (10, 40, 20), (10, 20, 20), (20, 60, 30), (40, 80, 50)]


class Runner:
    def __init__(self, program, folder, table):
        self.program, self.folder, self.table, self.count = program, folder, table, 0

    def run(self, *arguments):
        words = [str(word) for word in arguments]
        done = subprocess.run([self.program, *words], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"shapevenn {' '.join(words)}: {done.stderr}")
        return done.stdout

    def json(self, *arguments):
        return json.loads(self.run(*arguments, "--json"))

    def signs(self, source, model):
        """Of the program's modes, beside those of `model`."""
        self.count += 1
        path = self.folder / f"model-{self.count}.npz"
        self.run("convert", source, path)
        with np.load(path) as given:
            basis = given["basis"][:, : model.modes.shape[1]]
        return np.where((basis * model.modes).sum(axis=0) < 0, -1.0, 1.0)

    def compare(self, name, sources, models, *options, as_opened=None, **more):
        """`as_opened`: the models as the files give them, where the comparison moves or cuts them."""
        self.count += 1
        folder = self.folder / f"run-{self.count}"
        report = self.json("compare", *sources, "--out", folder, *options)
        case = self.table.case(name, report)
        opened = as_opened or models
        signs = [self.signs(source, model)[: len(models[side].deviations)]
                 for side, (source, model) in enumerate(zip(sources, opened))]
        with np.load(folder / "draws.npz") as stored:
            comparison.check(case, models, stored, signs, **more)
        return case

    def in_words(self, name, sources, models, *options, **more):
        """The same, and the lines that are printed."""
        case = self.compare(name, sources, models, *options, **more)
        evaluations.words(case, self.run("compare", *sources, *options), case.report)


def specimens(path, number, start=0):
    """Some specimens of a TPS file as a TPS file."""
    blocks = path.read_text().split("LM=")[1:]
    return "".join(f"LM={block}" for block in blocks[start : start + number])


def all_of(runner, whole):
    """(name, function) of every case; `whole`: also those that take minutes."""
    heads = {name: shapes.read_heads(HEADS / f"heads-{name}.npz") for name in ("male", "female", "identity", "expression")}
    wings = shapes.wings(WINGS)
    demos = ["demo:wings-aedes", "demo:wings-culex"]
    files = [WINGS / "wings-aedes.tps", WINGS / "wings-culex.tps"]
    specimens_of = [shapes.read_tps(path)[1] for path in files]
    opened = [shapes.population(columns, 2) for columns in specimens_of]

    def of_heads(one, other, *options):
        name = f"heads {one}, {other}"
        sources = [HEADS / f"heads-{which}.npz" for which in (one, other)]
        return name, lambda: runner.in_words(name, sources, [heads[one], heads[other]], *options)

    def of_demos(name, sources, models, *options, **more):
        return name, lambda: runner.compare(name, sources, models, *options, **more)

    if whole:
        for pair in (("male", "female"), ("identity", "expression"), ("male", "identity"), ("female", "expression")):
            yield of_heads(*pair)
    else:
        sources = [HEADS / "heads-male.npz", HEADS / "heads-female.npz"]
        yield of_demos("heads male, female", sources, [heads["male"], heads["female"]], "--permutations", "19")

    # Wings: the population of the page, the two files by themselves, and every option that changes a number.
    yield "wings", lambda: runner.in_words("wings", demos, wings, independent=np.random.default_rng(1))
    yield "wings, files", lambda: runner.in_words("wings, files", files, opened)
    few = ["--permutations", "0"]
    motion = shapes.motion_onto(opened[0].mean, opened[1].mean, 2)
    yield of_demos("wings, aligned", files, [opened[0], shapes.moved(opened[1], motion)], "--align", "rigid", *few,
                   as_opened=opened)
    scaled = shapes.motion_onto(opened[0].mean, opened[1].mean, 2, scale=True)
    yield of_demos("wings, aligned with size", files, [opened[0], shapes.moved(opened[1], scaled)], "--align", "similarity", *few,
                   as_opened=opened)
    six = [model.first(6) for model in wings]
    cut = sum(model.total for model in wings) - sum(model.total for model in six)
    yield of_demos("wings, 6 modes", demos, six, "--modes", "6", "--permutations", "99", as_opened=wings, cut_variance=cut)
    kept = [int(np.argmax(np.cumsum(model.deviations**2) >= 0.9 * model.total * (1 - 1e-12))) + 1 for model in wings]
    most = [model.first(count) for model, count in zip(wings, kept)]
    cut_of_share = sum(model.total for model in wings) - sum(model.total for model in most)
    yield of_demos("wings, 90 % of the variance", demos, most, "--variance", "0.9", *few, as_opened=wings,
                   cut_variance=cut_of_share)
    yield of_demos("wings, large sigma", demos, wings, "--sigma", "0.02", *few)
    for definition in ("distance", "relative", "outside"):
        yield of_demos(f"wings, {definition}", demos, wings, "--difference", definition, *few)
    yield of_demos("wings, threshold", demos, wings, "--difference", "distance", "--difference-threshold", "0.005", *few)
    yield of_demos("wings, idempotent, of A", demos, wings, "--plausibility", "idempotent", "--pooling", "a", "--seed", "7", *few)
    yield of_demos("wings, hmc", demos, wings, "--sampler", "hmc", *few)
    for fit in ("rms", "reweighted", "laplace"):
        yield of_demos(f"wings, {fit} fit", demos, six, "--fit", fit, "--modes", "6", *few, as_opened=wings, cut_variance=cut)

    for row, setting in enumerate(STARS, 1):
        yield of_demos(f"stars {row}", [f"demo:stars-{row}-a", f"demo:stars-{row}-b"], shapes.stars(setting))
    yield of_demos("planes", ["demo:planes-a", "demo:planes-b"], shapes.planes())
    third = shapes.stars(STARS[2])
    yield of_demos("stars, noise", ["demo:stars-3-a", "demo:stars-3-b"], third, "--noise", "0.05")
    on_mean = [third[0], dataclasses.replace(third[1], mean=third[0].mean)]
    yield of_demos("stars, B on the mean of A", ["demo:stars-3-a", "demo:stars-3-b"], on_mean, "--rebase", "b", as_opened=third)
    larger = [shapes.stars(STARS[1])[0], shapes.rescaled(shapes.stars(STARS[1])[1], 10.0)]
    yield of_demos("stars, B in cm", ["demo:stars-2-a", "demo:stars-2-b"], larger, "--unit-a", "mm", "--unit-b", "cm",
                   "--convert-units", as_opened=shapes.stars(STARS[1]))
    packed = FIXTURES / "training/packed.npz"
    plain = FIXTURES / "plain.npz"
    yield of_demos("fixtures", [plain, packed], [shapes.read_plain(plain), shapes.read_packed(packed)], *few)

    def evidence_of_few():
        """So few that all relabellings are taken."""
        paths = []
        for path, start in zip(files, (3, 5)):
            paths.append(runner.folder / f"few-{path.name}")
            paths[-1].write_text(specimens(path, 5, start))
        models = [shapes.population(shapes.read_tps(path)[1], 2) for path in paths]
        case = runner.table.case("evidence of 5 and 5 wings, all relabellings", runner.json("evidence", *paths))
        groups.check(case, "", comparison.groups_of(models), 1, 999, None, None)
        case.same("onePopulation.exhaustive", True)
        case.finish({})

    def evidence_of_all():
        models = [shapes.population(columns, 2, scale=True) for columns in specimens_of]
        case = runner.table.case("evidence of wings, one size", runner.json("evidence", *files, "--scale", "--seed", "3",
                                                                            "--permutations", "199"))
        groups.check(case, "", comparison.groups_of(models), 3, 199, None, None)
        evaluations_of = runner.run("evidence", *files, "--scale", "--seed", "3", "--permutations", "199").splitlines()
        for line in evaluations.evidence_in_words(case.report, "units"):
            case.table.add(case.name, f"in words: {line.strip()[:60]}", 0, 0, 0.0 if line in evaluations_of else np.inf, 0.0,
                           "lines in words")
        case.finish({})

    yield "evidence, all relabellings", evidence_of_few
    yield "evidence, one size", evidence_of_all

    def evaluated(name, source, model, given, columns, training, scale=False, placement="mean"):
        def run():
            options = ["--training"] * training + ["--scale"] * scale
            options += [] if training else ["--align", {"given": "none"}.get(placement, placement)]
            case = runner.table.case(f"evaluate {name}", runner.json("evaluate", source, given, *options))
            evaluations.evaluate(case, model, runner.signs(source, model), columns, training, scale, placement)
        return f"evaluate {name}", run

    yield evaluated("each left out", files[1], opened[1], files[1], specimens_of[1], True)
    yield evaluated("in parts", files[0], opened[0], files[0], specimens_of[0], True)
    yield evaluated("by test shapes", files[0], opened[0], files[1], specimens_of[1], False)
    yield evaluated("along with the fit", files[1], opened[1], files[0], specimens_of[0], False, placement="fit")
    yield evaluated("as they are given", files[1], opened[1], files[0], specimens_of[0], False, placement="given")
    yield evaluated("of one size", demos[0], wings[0], files[1], specimens_of[1], False, True)

    def matrix():
        sources = [f"demo:stars-{row}-a" for row in (1, 3, 6)]
        models = [shapes.stars(STARS[row])[0] for row in (0, 2, 5)]
        evaluations.matrix(runner.table.case("matrix of stars", runner.json("matrix", *sources)), models)
        case = runner.table.case("matrix of wings", runner.json("matrix", *demos, "--sigma", "0.003"))
        evaluations.matrix(case, wings, 0.003, evidence_excused="as in the comparison of the wings")
        if whole:
            names = list(heads)
            case = runner.table.case("matrix of heads", runner.json("matrix", *[HEADS / f"heads-{name}.npz" for name in names]))
            evaluations.matrix(case, [heads[name] for name in names], evidence_excused="as in comparisons of heads")

    yield "matrix", matrix

    def info():
        sources = [*HEADS.glob("*.npz"), *files, plain, packed, "demo:planes-b", "demo:stars-4-b"]
        models = [shapes.read_heads(path) for path in HEADS.glob("*.npz")] + opened
        models += [shapes.read_plain(plain), shapes.read_packed(packed), shapes.planes()[1], shapes.stars(STARS[3])[1]]
        evaluations.info(runner.table.case("info", runner.json("info", *sources)), models)

    yield "info", info

    def inspect():
        case = runner.table.case("inspect", runner.json("inspect", *files))
        evaluations.inspect(case, opened)

    yield "inspect", inspect

    def sweep():
        sigmas = [word for sigma in evaluations.SWEPT for word in ("--sigma", str(sigma))]
        evaluations.sweep(runner.table.case("sweep", runner.json("sweep", *demos, *sigmas)), wings)

    yield "sweep", sweep
