"""While a machine is computed, Python's threads go on, other machines are computed beside it, and Ctrl-C ends it. Nothing is
timed here: one thing happens because another one has."""

import os
import signal
import subprocess
import sys
import threading
import unittest

import kurbel

PRESS = os.path.join(os.environ["KURBEL_SCENES"], "crank_press.toml")
ENDLESS = {"run.budget": "100 s"}  # a run that nobody ends says so, rather than never return


def threads():
    return len(os.listdir("/proc/self/task"))


class Threads(unittest.TestCase):
    def ends_a_run(self, act):
        """Starts a run without end in this thread. Another one acts once it is at work, and then interrupts it: that it
        ends at all proves that all of `act` has happened meanwhile."""
        before = threads()
        seen, over = [], threading.Event()

        def meanwhile():
            while threads() < before + 2:  # this one, and the one that computes
                if over.is_set():
                    return
            try:
                seen.append(act())
            finally:
                if not over.is_set():
                    signal.raise_signal(signal.SIGINT)
        worker = threading.Thread(target=meanwhile)
        worker.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                run = kurbel.run(PRESS, set=ENDLESS, until=1e5, no_error=True, page=False)
                over.set()
                self.fail(f"nobody interrupted it: {run.diagnosis}")
        finally:
            over.set()
            worker.join()
        self.assertEqual(len(seen), 1)
        return seen[0]

    def test_python_counts_on_while_a_machine_is_computed(self):
        def count():
            ticks = 0
            while ticks < 1_000_000:
                ticks += 1
            return ticks
        self.assertEqual(self.ends_a_run(count), 1_000_000)

    def test_two_runs_overlap(self):
        beside = self.ends_a_run(lambda: kurbel.run(PRESS, until=0.5, no_error=True, page=False))
        self.assertTrue(beside.complete)
        alone = kurbel.run(PRESS, until=0.5, no_error=True, page=False)
        for name, figure in alone.figures.items():
            self.assertEqual(beside.figures[name].value, figure.value, name)

    def test_a_motion_is_for_one_thread_at_a_time(self):
        motion, other, refused = kurbel.motion(PRESS), kurbel.motion(PRESS), []
        motion.go_to(0.1)
        kept = motion.state
        uses = {"go_to": lambda: motion.go_to(0.2), "restore": lambda: motion.restore(kept),
                "state_from": lambda: motion.state_from(kept.text), "[]": lambda: motion["torque.main_coupling"],
                **{name: (lambda name=name: getattr(motion, name)) for name in
                   ("time", "state", "values", "names", "units", "state_names")}}

        def meanwhile():
            while threads() < before + 2:
                pass
            for name, use in uses.items():
                try:
                    use()
                except RuntimeError as why:
                    if str(why) == "this Motion is in use by another thread":
                        refused.append(name)
            refused.append(repr(motion))
            other.go_to(0.1)  # another one is free
            signal.raise_signal(signal.SIGINT)
        before = threads()
        worker = threading.Thread(target=meanwhile)
        worker.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                motion.go_to(1e5)
        finally:
            worker.join()
        self.assertEqual(refused, [*uses, "<Motion in use by another thread>"])
        self.assertTrue(motion.state == kept == other.state)
        with self.assertRaises(KeyError):
            motion["nothing"]
        motion.go_to(0.2)  # after a fault, too, it is free


class CtrlC(unittest.TestCase):
    def ended(self, lines):
        """What a program prints that is sent SIGINT once its computing thread is there."""
        program = ("import os, signal, threading, kurbel\n"
                   "before = len(os.listdir('/proc/self/task'))\n"
                   "def told():\n  print('on', flush=True)\n"
                   "def watch():\n"
                   "  while len(os.listdir('/proc/self/task')) < before + 2: pass\n"
                   "  told()\n"
                   f"press = kurbel.machine({PRESS!r}, set={ENDLESS!r})\n" + lines)
        child = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
        self.assertEqual(child.stdout.readline(), "on\n")
        child.send_signal(signal.SIGINT)
        out = child.communicate(timeout=250)[0]
        self.assertEqual(child.returncode, 0)
        return out

    def test_ends_a_run(self):
        self.assertEqual(self.ended("threading.Thread(target=watch).start()\n"
                                    "try:\n  print(kurbel.run(press, until=1e5, no_error=True).diagnosis)\n"
                                    "except KeyboardInterrupt:\n  print('ended')\n"), "ended\n")

    def test_ends_a_motion_where_it_stood(self):
        self.assertEqual(self.ended("motion = kurbel.motion(press)\nmotion.go_to(0.1)\nkept = motion.state\n"
                                    "threading.Thread(target=watch).start()\n"
                                    "try:\n  motion.go_to(1e5)\n"
                                    "except KeyboardInterrupt:\n  print('ended')\n"
                                    "print(motion.state == kept)\n"
                                    "motion.go_to(0.2)\nother = kurbel.motion(press)\nother.restore(kept)\n"
                                    "other.go_to(0.2)\nprint(motion.state == other.state)\n"), "ended\nTrue\nTrue\n")


if __name__ == "__main__":
    unittest.main()
