"""Rates at which a hopper empties, and the constants of Beverloo, Leniger & van de Velde 1961, Chem. Eng. Sci. 15, 260."""
import math

K = 1.4  # grain diameters at the edge of an orifice, together, through which nothing flows
GRAVITY = 9.81


def slope(points):
    """Of the line of least squares through (x, y)."""
    mean_x = sum(x for x, _ in points) / len(points)
    mean_y = sum(y for _, y in points) / len(points)
    return sum((x - mean_x) * (y - mean_y) for x, y in points) / sum((x - mean_x) ** 2 for x, _ in points)


def change(run, column, after, until):
    """Of a column over time, from the first to the last row between two times."""
    rows = [row for row in run.rows if after <= row["time"] <= until]
    return (rows[-1][column] - rows[0][column]) / (rows[-1]["time"] - rows[0]["time"])


def rate_kept(run):
    """Rate while 65 to 80 % of the outflow leaves, over that while 5 to 20 % does."""
    rows = [(row["time"], row["outflow"]) for row in run.rows]

    def when(share):
        return next(time for time, mass in rows if mass >= share * rows[-1][1])

    return (when(0.2) - when(0.05)) / (when(0.8) - when(0.65))


def constant_of_hole(rate, orifice, diameter, density):
    """C of W = C rho_b sqrt(g) (D - 1.4 d)^2.5."""
    return rate / (density * math.sqrt(GRAVITY) * (orifice - K * diameter) ** 2.5)


def rate_of_slot(constant, density, depth, slot, diameter):
    """W = C rho_b sqrt(g) L (B - 1.4 d)^1.5, with the exponent of a slot."""
    return constant * density * math.sqrt(GRAVITY) * depth * (slot - K * diameter) ** 1.5
