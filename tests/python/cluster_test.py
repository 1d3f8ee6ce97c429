"""A sweep on Dask's worker processes, one of which is killed on its way: nothing is lost, and the rows are the same."""

import os
import signal
import threading
import unittest

import kurbel

PRESS = os.path.join(os.environ["KURBEL_SCENES"], "crank_press.toml")


class Cluster(unittest.TestCase):
    def test_a_killed_worker_loses_no_row(self):
        try:
            from distributed import Client, LocalCluster
        except ImportError:
            self.skipTest("no distributed (python3-distributed)")
        asked = dict(design="grid:60", figures=["peak_torque.main_coupling", "delta"], errors=False, until=1.0)
        vary = ["main_coupling.stiffness=500..1500 kN*m/rad"]
        with LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None,
                          silence_logs=50) as cluster, Client(cluster) as client:
            victim = sorted(client.run(os.getpid).values())[0]
            killer = threading.Timer(0.4, os.kill, (victim, signal.SIGKILL))
            killer.start()
            there = kurbel.sweep(PRESS, vary, executor=client, **asked)
            self.assertFalse(killer.is_alive())  # it died on the way, not behind it
        here = kurbel.sweep(PRESS, vary, **asked)
        self.assertEqual(len(there), 60)
        self.assertEqual(there.failures, {})
        self.assertEqual(there.figures, here.figures)


if __name__ == "__main__":
    unittest.main()
