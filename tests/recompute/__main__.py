"""Recomputes with NumPy every number that Shapevenn shows of packaged and test populations.

    python tests/recompute target/release/shapevenn [--every] [--only WORD] [--whole]

docs/recomputed.md says what is compared how closely. Ends with 1 where a number is off, and where a report has a number that
this script does not know. `--every` prints all rows, not only those that are off; `--whole` takes the packaged heads with all
relabellings, which takes minutes.
"""
import argparse
import os
import pathlib
import sys
import tempfile
import time

# Matrices are small: threads of the linear algebra would wait for one another.
for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")
sys.path.insert(0, str(pathlib.Path(__file__).parent))

import cases  # noqa: E402
from table import Table  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--every", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--whole", action="store_true")
    options = parser.parse_args()
    table = Table()
    with tempfile.TemporaryDirectory() as folder:
        runner = cases.Runner(options.program.resolve(), pathlib.Path(folder), table)
        for name, run in cases.all_of(runner, options.whole):
            if options.only in name:
                start = time.monotonic()
                run()
                print(f"{name}: {time.monotonic() - start:.1f} s", file=sys.stderr)
    print(table.text(options.every))
    sys.exit(1 if table.wrong else 0)


if __name__ == "__main__":
    main()
