"""A sweep on Dask's worker processes, one of which dies in the middle of a row: nothing is lost, and the rows are the
same."""

import os
import signal
import tempfile
import unittest

import kurbel

PRESS = os.path.join(os.environ["KURBEL_SCENES"], "crank_press.toml")


def dying(once, row, *asked):
    """A row whose worker is killed at it; whoever computes it next finds the file and lives."""
    try:
        os.close(os.open(once, os.O_CREAT | os.O_EXCL))
    except FileExistsError:
        return row(*asked)
    os.kill(os.getpid(), signal.SIGKILL)


class Killing:
    """A client whose thirtieth row kills the worker that takes it, and with it the rows that it has done and keeps."""

    def __init__(self, client, once):
        self.client, self.once, self.rows = client, once, 0

    def submit(self, row, *asked, **how):
        self.rows += 1
        if self.rows == 30:
            return self.client.submit(dying, self.once, row, *asked, **how)
        return self.client.submit(row, *asked, **how)

    def gather(self, futures):
        return self.client.gather(futures)


class Cluster(unittest.TestCase):
    def test_a_killed_worker_loses_no_row(self):
        try:
            from distributed import Client, LocalCluster
        except ImportError:
            self.skipTest("no distributed (python3-distributed)")
        asked = dict(design="grid:60", figures=["peak_torque.main_coupling", "delta"], no_error=True, until=0.2)
        vary = ["main_coupling.stiffness=500..1500 kN*m/rad"]
        with tempfile.TemporaryDirectory() as folder, \
             LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None,
                          silence_logs=50) as cluster, Client(cluster) as client:
            before = set(client.run(os.getpid).values())
            once = os.path.join(folder, "killed")
            there = kurbel.sweep(PRESS, vary, executor=Killing(client, once), **asked)
            self.assertTrue(os.path.exists(once))
            self.assertEqual(len(before - set(client.run(os.getpid).values())), 1)  # one of them is no more
        here = kurbel.sweep(PRESS, vary, **asked)
        self.assertEqual(len(there), 60)
        self.assertEqual(there.failures, {})
        self.assertEqual(there.figures, here.figures)


if __name__ == "__main__":
    unittest.main()
