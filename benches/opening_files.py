"""Files of the size that the field's largest have, for `npm run bench -- --opening`.

    python benches/opening_files.py FOLDER

Written as their own software writes them: bfm-2019.h5 with h5py (53,149 points; 199 shape, 199 colour
and 100 expression modes; single precision, contiguous), flame.pkl with pickle (5,023 points, 400
modes, double precision). Numbers are random: only their size counts.
"""

import pathlib
import pickle
import sys

import h5py
import numpy as np

folder = pathlib.Path(sys.argv[1])
random = np.random.default_rng(1)


def sphere(points):
    """Points spread evenly over a sphere, and triangles that join neighbours."""
    turn = np.arange(points) * np.pi * (3 - 5**0.5)
    height = 1 - 2 * (np.arange(points) + 0.5) / points
    round_ = np.sqrt(1 - height**2)
    where = np.column_stack([round_ * np.cos(turn), round_ * np.sin(turn), height])
    index = np.arange(points - 34)
    triangles = np.concatenate([np.column_stack([index, index + 13, index + 34]),
                                np.column_stack([index, index + 34, index + 21])])
    return where, triangles


def columns(rows, modes):
    """Random unit columns: nearly orthogonal, which is all that their size needs."""
    basis = random.standard_normal((rows, modes), dtype=np.float32)
    return basis / np.linalg.norm(basis, axis=0)


def bfm(path, points=53_149):
    where, triangles = sphere(points)
    with h5py.File(path, "w") as out:
        for name, modes, mean in [("shape", 199, 100 * where), ("color", 199, np.full((points, 3), 0.5)),
                                  ("expression", 100, np.zeros((points, 3)))]:
            group = out.create_group(name)
            group["version/majorVersion"], group["version/minorVersion"] = 0, 9
            group["model/mean"] = mean.astype(np.float32).ravel()
            group["model/pcaBasis"] = columns(3 * points, modes)
            group["model/pcaVariance"] = (1e5 * 0.9 ** np.arange(modes)).astype(np.float32)
            group["model/noiseVariance"] = np.float32(0)
            group["representer/points"] = where.T.astype(np.float32)
            group["representer/cells"] = triangles.T.astype(np.int32)
            group["representer"].attrs["name"] = {"shape": "gravis::MeshShapeRepresenter",
                                                  "color": "gravis::MeshColorRepresenter",
                                                  "expression": "gravis::MeshExpressionRepresenter"}[name]
            group["representer"].attrs["datasetType"] = "POLYGON_MESH"
            if name == "shape":
                group["representer/length-unit"] = 0.001


def flame(path, points=5_023, modes=400):
    where, triangles = sphere(points)
    basis = random.standard_normal((points, 3, modes)) * 1e-3 * 0.97 ** np.arange(modes)
    model = {"v_template": 0.1 * where, "f": triangles.astype(np.uint32), "shapedirs": basis,
             "posedirs": np.zeros((points, 3, 36)), "weights": np.zeros((points, 5))}
    with open(path, "wb") as out:
        pickle.dump(model, out, protocol=2)


bfm(folder / "bfm-2019.h5")
flame(folder / "flame.pkl")
