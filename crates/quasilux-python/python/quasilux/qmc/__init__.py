"""Quasi-Monte Carlo points with the names and the calls of `scipy.stats.qmc`.

``from quasilux import qmc`` in place of ``from scipy.stats import qmc`` is the one change that code
written for SciPy needs. Every public name of `scipy.stats.qmc` is here, and three sequences more:

================================  ============================================================
`Sobol`, `Halton`                 sequences that SciPy has as well
`Faure4`, `Hammersley`            a (0, 4)-sequence in base 4, and Halton behind equal steps
`Independent`                     pseudo-random points by index
`LatinHypercube`, `PoissonDisk`   designs that need numpy's random numbers alone
`MultivariateNormalQMC`           normal vectors, `MultinomialQMC` counts
`discrepancy`, ..                 measures of evenness; `scale` to other bounds
`QMCEngine`                       the base class of all engines and of your own
================================  ============================================================

What equals SciPy bit for bit: `Sobol` without scrambling (any `bits`, in its Gray code order) and
`LatinHypercube` without optimization from the same `rng`. `Halton` without scrambling is within
1e-15. What differs: scrambled points of Sobol' have random triangular matrices and a digital shift
as SciPy's, but other ones (and Owen's nested uniform scrambling by ``randomization="owen"``);
Halton's have Owen's scrambling, where SciPy has one permutation for each digit. Points are as even,
equal ones come of equal `rng`, but the numbers are other ones.

All points are made in compiled code without the global lock, by index: `fast_forward` is free, and
no state but a counter is kept. Where `scipy.stats` has been imported, engines count as SciPy's own,
so that `scipy.integrate.qmc_quad` takes them. SciPy is imported only by ``optimization="lloyd"``
and by distances of `geometric_discrepancy` that numpy does not have.

Examples
--------
>>> from quasilux import qmc
>>> qmc.Sobol(d=2, scramble=False).random_base2(m=2)
array([[0.  , 0.  ],
       [0.5 , 0.5 ],
       [0.75, 0.25],
       [0.25, 0.75]])
"""

from __future__ import annotations

from quasilux.qmc._discrepancy import discrepancy, update_discrepancy
from quasilux.qmc._distances import geometric_discrepancy
from quasilux.qmc._distributions import MultinomialQMC, MultivariateNormalQMC
from quasilux.qmc._engine import QMCEngine
from quasilux.qmc._latin_hypercube import LatinHypercube
from quasilux.qmc._poisson_disk import PoissonDisk
from quasilux.qmc._scale import scale
from quasilux.qmc._sequences import Faure4, Halton, Hammersley, Independent, Sobol

__all__ = [
    "Faure4",
    "Halton",
    "Hammersley",
    "Independent",
    "LatinHypercube",
    "MultinomialQMC",
    "MultivariateNormalQMC",
    "PoissonDisk",
    "QMCEngine",
    "Sobol",
    "discrepancy",
    "geometric_discrepancy",
    "scale",
    "update_discrepancy",
]
