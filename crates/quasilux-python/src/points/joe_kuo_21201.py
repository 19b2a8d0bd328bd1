"""Writes joe_kuo_21201.txt beside it: python3 joe_kuo_21201.py (made with scipy 1.17.1).

SciPy ships the whole table of Joe and Kuo in its own format; the first rows must be those of
quasilux-sampling/data/joe_kuo_1024.txt, which were taken from the source.
"""

from pathlib import Path

import numpy as np
import scipy.stats

HERE = Path(__file__).parent
DATA = HERE.parents[2] / "quasilux-sampling" / "data"
HEAD = """\
Direction numbers of the Sobol' sequence, dimensions 2 to 21201 (dimension 1 is the radical inverse
in base 2).
The rows of new-joe-kuo-6.21201, https://web.maths.unsw.edu.au/~fkuo/sobol/
S. Joe and F. Y. Kuo, "Constructing Sobol sequences with better two-dimensional projections",
SIAM J. Sci. Comput. 30, 2635-2654 (2008).
Columns: dimension d (from 1), degree s and inner coefficients a of the primitive polynomial, m_1 ..
m_s. Taken from scipy's _sobol_direction_numbers.npz by joe_kuo_21201.py.
"""


def main() -> None:
    """Write the table, and fail where its first rows differ from those of the repository."""
    with np.load(Path(scipy.stats.__file__).parent / "_sobol_direction_numbers.npz") as numbers:
        polynomials, initial = numbers["poly"].tolist(), numbers["vinit"].tolist()
    rows = []
    for dimension in range(2, len(polynomials) + 1):
        # Bits s .. 0: 1, a_1 .. a_(s-1), 1.
        polynomial = polynomials[dimension - 1]
        degree = polynomial.bit_length() - 1
        inner = (polynomial >> 1) - (1 << (degree - 1))
        row = [dimension, degree, inner, *initial[dimension - 1][:degree]]
        rows.append(" ".join(map(str, row)))
    known = (DATA / "joe_kuo_1024.txt").read_text().splitlines()
    known = [line for line in known if not line.startswith("#")]
    if rows[: len(known)] != known:
        raise SystemExit("the first rows are not those of joe_kuo_1024.txt")
    licence = (DATA / "joe_kuo.LICENSE").read_text().partition("\n\n")[2]
    lines = [f"# {line}".rstrip() for line in (HEAD + "\n" + licence).splitlines()]
    (HERE / "joe_kuo_21201.txt").write_text("\n".join(lines + rows) + "\n")


if __name__ == "__main__":
    main()
