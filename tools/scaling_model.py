"""A model of the time of a step on many cores (docs/parallel.md), from counts of docs/benchmarks/data/scaling.csv."""

import math

from benchmark_data import read_rows

LATENCY = 1.5e-6  # s, of a message between nodes; a network for clusters (InfiniBand HDR) has 1 … 2 µs
BANDWIDTH = 1e9  # bytes/s of one core, where the cores of a node share its network
NEIGHBOURS = 14  # of a part among many, mean: a cube has 26, a part of a space-filling curve fewer that matter


class ScalingModel:
    """t(n, p) = a n/p + e N (latency + bytes/bandwidth) + R 2 latency log₂ p, N = min(p − 1, 14).

    a: seconds of a step for each unknown on one core; e: exchanges with each neighbour; bytes of a message: b (n/p)^⅔/N,
    of all messages together b (n/p)^⅔ (surface of a part); R: reductions, all in a step.
    """

    def __init__(self, rows):
        alone = [r for r in rows if r["ranks"] == 1]
        several = [r for r in rows if r["ranks"] > 1]
        largest = max(alone, key=lambda r: r["unknowns"])
        self.a = largest["seconds"] / largest["unknowns"]
        n = max(r["unknowns"] for r in several)
        of_largest = [r for r in several if r["unknowns"] == n]
        self.e = mean(r["messages"] / neighbours(r["ranks"]) for r in of_largest)
        self.b = mean(r["bytes"] / (r["unknowns"] / r["ranks"]) ** (2 / 3) for r in of_largest)
        self.R = max(r["reductions"] for r in of_largest)

    def counts(self, n, p):
        """(messages, bytes, reductions) of a rank in a step."""
        return self.e * neighbours(p), self.b * (n / p) ** (2 / 3), self.R

    def seconds(self, n, p):
        messages, size, reductions = self.counts(n, p) if p > 1 else (0, 0, 0)
        return (self.a * n / p + messages * LATENCY + size / BANDWIDTH
                + reductions * 2 * LATENCY * math.log2(p))


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def neighbours(p):
    return min(p - 1, NEIGHBOURS)


def scaling_rows(data):
    return [{name: float(value) for name, value in row.items()} for row in read_rows(data, "scaling.csv")]


def scaling_model(data):
    """None without measurements on several ranks."""
    rows = scaling_rows(data)
    return ScalingModel(rows) if any(r["ranks"] > 1 for r in rows) and any(r["ranks"] == 1 for r in rows) else None
