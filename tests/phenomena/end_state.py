"""The grains of a run's final.csv."""
import csv
import math


def grains_of(run):
    with open(run.folder / "final.csv", newline="") as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def share_of(run, holds, among=lambda grain: True):
    """Of the grains among which one looks: the share of those for which it holds."""
    grains = [grain for grain in grains_of(run) if among(grain)]
    return sum(map(holds, grains)) / len(grains) if grains else math.nan


def mean_of(run, column, among=lambda grain: True):
    values = [grain[column] for grain in grains_of(run) if among(grain)]
    return sum(values) / len(values) if values else math.nan
