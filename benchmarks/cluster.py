"""Draw on a cluster of two workers on this machine, kill one in the middle, and hold the lines against one process's.

python benchmarks/cluster.py [NUMBER]
"""

import os
import signal
import sys
import time
from itertools import islice

from distributed import LocalCluster

from rldrill.generation.lots import lots
from rldrill.generation.records import Extra
from rldrill.generation.running import Here, cluster, drawn

if __name__ == "__main__":
    number = int(sys.argv[1]) if sys.argv[1:] else 2000
    every = lots(("return", "td-zero"), None, number, 4)
    start = time.perf_counter()
    alone = [line for _, lines in drawn(every, (Extra.ANSWERS,), Here()) for line in lines]
    print(f"one process: {number} problems in {time.perf_counter() - start:.1f} s")
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as local,
        cluster(local.scheduler_address) as executor,
    ):
        start = time.perf_counter()
        lines = (line for _, lines in drawn(every, (Extra.ANSWERS,), executor, 64) for line in lines)
        first = list(islice(lines, number // 10))
        victim = next(iter(local.workers.values())).pid
        os.kill(victim, signal.SIGKILL)
        print(f"killed worker {victim} after {len(first)} problems")
        rest = list(lines)
        print(f"cluster: {number} problems in {time.perf_counter() - start:.1f} s")
    same = [*first, *rest] == alone
    print("the same lines" if same else "OTHER LINES")
    sys.exit(not same)
