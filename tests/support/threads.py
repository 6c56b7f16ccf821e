"""One thread of linear algebra for each worker of pytest and each process that it starts: import it before numpy.

OpenBLAS' threads wait for work by spinning: for small matrices, with a worker of pytest on each core, they double the
CPU time. What stands for another machine (`support.elsewhere`) has another number.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
