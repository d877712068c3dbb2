"""What ``bench/bench.py`` measures: one module a group of rows, listed in ``groups.py``.

``rows.py`` holds the goals and what a row is, ``timing.py`` how a time is taken.
"""
