"""Studies in which people compare pairs of pictures: answers, their files, strengths.

>>> import sunwidget.study
>>> sunwidget.study.bradley_terry(sunwidget.study.read_csv("anna.csv", "bert.csv"))
"""

from sunwidget.errors import StudyError
from sunwidget.study.answers import Answer, read_csv, write_csv
from sunwidget.study.bradley_terry import BradleyTerry, bradley_terry, by_rater

__all__ = [
    "Answer",
    "BradleyTerry",
    "StudyError",
    "bradley_terry",
    "by_rater",
    "read_csv",
    "write_csv",
]
