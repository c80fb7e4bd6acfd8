"""Entries of random loads of the ball: rigid planes, viscoelastic branches and companions in orbit."""
import math


def put_planes(rng, entries, radius, rate, modulus, Q):
    """One to three planes near the body, now and then through it, towards which it flies. Some of them are rough or move."""
    axes = [float(a) for a in entries.get("Body/Semi-axes", "1, 1, 1").split(",")]
    normals, points = [], []
    for _ in range(rng.randint(1, 3)):
        n = rng.choice(((0, 0, 1), (0, 0, -1), (1, 0, 0), tuple(rng.gauss(0, 1) for _ in range(3))))
        length = math.sqrt(sum(x * x for x in n))
        reach = math.sqrt(sum((axes[k] * sum(Q[i][k] * n[i] for i in range(3)))**2 for k in range(3))) / length
        distance = radius * reach * rng.choice((0.99, 1.0001, 1.05, 1.2))
        normals.append(n)
        points.append([-distance * x / length for x in n])
    entries.update({
        "Loads/Plane normals": "; ".join(", ".join(map(repr, n)) for n in normals),
        "Loads/Plane points": "; ".join(", ".join(map(repr, p)) for p in points),
        "Initial state/Center velocity": ", ".join(repr(-0.5 * radius * rate * x) for x in normals[0])})
    if rng.random() < 0.5:
        entries["Loads/Plane stiffness"] = repr(modulus / radius * 10 ** rng.uniform(0, 4))
    if rng.random() < 0.3:
        entries["Loads/Plane damping"] = repr(10 ** rng.uniform(-2, 1) / (radius * rate))
    if rng.random() < 0.4:
        entries["Loads/Plane friction"] = repr(10 ** rng.uniform(-2, 0.5))
        if rng.random() < 0.5:
            entries["Loads/Plane slip speed"] = repr(radius * rate * 10 ** rng.uniform(-7, 0))
    if rng.random() < 0.4:
        n_numbers = len(normals) + (rng.random() < 0.05)
        entries["Loads/Plane speeds"] = ", ".join(repr(radius * rate * rng.uniform(-0.3, 0.3)) for _ in range(n_numbers))
    if rng.random() < 0.3:
        entries["Loads/Plane amplitudes"] = ", ".join(repr(radius * rng.uniform(-0.1, 0.1)) for _ in normals)
        entries["Loads/Plane frequency"] = repr(rate * 10 ** rng.uniform(-1, 1.5))


def put_branches(rng, entries, rate, modulus):
    """Up to four viscoelastic branches, now and then five or with a time too few; soft or stiff, slow or fast."""
    n = rng.choices((1, 2, 4, 5), (10, 6, 3, 1))[0]
    entries["Material/Branch moduli"] = ", ".join(repr(modulus * 10 ** rng.uniform(-3, 2)) for _ in range(n))
    entries["Material/Branch times"] = ", ".join(repr(10 ** rng.uniform(-6, 6) / rate) for _ in range(n - (rng.random() < 0.05)))
    entries["Material/Branches relaxed"] = rng.choice(("true", "false"))


def put_companions(rng, entries, radius, rate, density):
    """One or two companions, far away or near, on bound orbits, flybys or towards the body; loads that they exclude are removed."""
    for path in ("Material/Drag", "Loads/Tidal matrix"):
        entries.pop(path, None)
    n = rng.randint(1, 2)
    positions = [[radius * 10 ** rng.uniform(0.4, 2) * rng.choice((-1, 1)) * rng.uniform(0.3, 1) for _ in range(3)] for _ in range(n)]
    masses = [density * radius**3 * 10 ** rng.uniform(-3, 5) for _ in range(n)]
    if rng.random() < 0.3:
        entries["Companions/Full potential"] = "true"
    entries["Companions/Masses"] = "; ".join(map(repr, masses))
    if rng.random() < 0.4:
        return put_elements(rng, entries, radius, n)
    entries["Companions/Positions"] = "; ".join(", ".join(map(repr, p)) for p in positions)
    if rng.random() < 0.5:
        speed = radius * rate * 10 ** rng.uniform(-1, 1)
        entries["Companions/Velocities"] = "; ".join(", ".join(repr(rng.gauss(0, speed)) for _ in range(3)) for _ in range(n))


def put_elements(rng, entries, radius, n):
    """Ellipses up to the eccentricity 0.99, and hyperbolas; the first companion may start within the body, which is refused."""
    eccentricities = [rng.choice((0, rng.uniform(0, 0.99), 0.99, rng.uniform(1.01, 5))) for _ in range(n)]
    axes = [radius * 10 ** rng.uniform(0.4, 2.5) * (1 if e < 1 else -1) for e in eccentricities]
    entries["Companions/Semi-major axes"] = "; ".join(map(repr, axes))
    entries["Companions/Eccentricities"] = "; ".join(map(repr, eccentricities))
    for name in ("Inclinations", "Ascending nodes", "Arguments of pericentre", "Mean anomalies"):
        if rng.random() < 0.6:
            entries[f"Companions/{name}"] = "; ".join(repr(rng.uniform(-4, 4)) for _ in range(n))
