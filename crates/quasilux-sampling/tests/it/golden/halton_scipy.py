"""Writes halton_scipy.txt beside it: python3 halton_scipy.py > halton_scipy.txt (made with scipy, version in the file)."""

import scipy
from scipy.stats import qmc

engine = qmc.Halton(d=20, scramble=False)
print(f"# scipy.stats.qmc.Halton(d=20, scramble=False) of scipy {scipy.__version__}, made by halton_scipy.py")
print("# point i: its 20 coordinates")
points = engine.random(4096)
for i in list(range(16)) + [100, 1000, 2047, 2048, 3000, 4095]:
    print(f"point {i}:", *(f"{x:.17g}" for x in points[i]))
