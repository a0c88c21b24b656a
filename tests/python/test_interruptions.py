# SPDX-License-Identifier: GPL-3.0-or-later
"""Long verbs leave Python's lock to others, tell how far they are, and stop for Ctrl-C and for what progress raises."""
import os
import signal
import threading
import time
import unittest

from support import InFolder, house_with_station

import standpoint

# Some seconds of work on any machine, since nothing is written before it is stopped.
LONG = {"instrument": "leica-rtc360", "set": {"resolution": "3mm", "images": "off"}, "output": "long.e57"}


class Interruptions(InFolder):
    def setUp(self):
        super().setUp()
        house_with_station()

    def files(self):
        return sorted(os.listdir("."))

    def test_control_c_is_a_keyboard_interrupt_and_leaves_nothing(self):
        before = self.files()
        threading.Timer(0.7, os.kill, (os.getpid(), signal.SIGINT)).start()
        since = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            standpoint.scan("house", **LONG)
        self.assertLess(time.monotonic() - since, 20)
        self.assertEqual(self.files(), before)
        self.assertTrue(standpoint.station("house")["stations"])  # and the next verb runs

    def test_what_progress_raises_stops_the_verb_and_comes_through(self):
        class Enough(Exception):
            pass

        told = []

        def stop(fraction, stage):
            told.append((fraction, stage))
            if len(told) == 3:
                raise Enough(stage)

        before = self.files()
        with self.assertRaises(Enough):
            standpoint.scan("house", progress=stop, **LONG)
        self.assertEqual(len(told), 3)
        self.assertEqual(self.files(), before)

    def test_progress_is_told_from_the_calling_thread_and_ends_at_one(self):
        told = []
        answer = standpoint.optimize("house", budget=2000, allow_loss=True,
                                     progress=lambda *said: told.append((said, threading.get_ident())))
        self.assertTrue(answer)
        self.assertEqual({thread for _, thread in told}, {threading.get_ident()})
        fractions = [fraction for (fraction, _), _ in told]
        self.assertEqual(fractions[-1], 1.0)
        self.assertTrue(all(0 <= fraction <= 1 for fraction in fractions))

    def test_other_threads_of_python_run_meanwhile(self):
        ticks = []
        ended = threading.Event()

        def tick():
            while not ended.wait(0.005):
                ticks.append(time.monotonic())

        other = threading.Thread(target=tick)
        other.start()
        calls = []

        def stop(*said):
            calls.append(said)
            if len(calls) == 5:
                raise StopIteration

        try:
            with self.assertRaises(StopIteration):
                standpoint.scan("house", progress=stop, **LONG)
        finally:
            ended.set()
            other.join()
        self.assertGreater(len(ticks), 10)

    def test_a_bar_is_drawn_where_it_is_asked_for(self):
        import contextlib
        import io

        with contextlib.redirect_stderr(io.StringIO()) as said:
            standpoint.optimize("house", budget=2000, allow_loss=True, progress=True)
        self.assertIn("100%", said.getvalue())
        with contextlib.redirect_stderr(io.StringIO()) as said:
            standpoint.optimize("house", budget=2000, allow_loss=True)
        self.assertEqual(said.getvalue(), "")


if __name__ == "__main__":
    unittest.main()
