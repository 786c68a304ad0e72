"""The grains of a run's final.csv."""
import math

from runs import numbers


def grains_of(run):
    return numbers(run.folder / "final.csv")


def share_of(run, holds, among=lambda grain: True):
    """Of the grains among which one looks: the share of those for which it holds."""
    grains = [grain for grain in grains_of(run) if among(grain)]
    return sum(map(holds, grains)) / len(grains) if grains else math.nan


def mean_of(run, column, among=lambda grain: True):
    values = [grain[column] for grain in grains_of(run) if among(grain)]
    return sum(values) / len(values) if values else math.nan
