"""What pictures of curves share: matplotlib, colours, files."""

import itertools
import pathlib
from typing import Any

from pseudorigid.errors import WrongInput, needs

with needs("python3-matplotlib"):
    import matplotlib
    import matplotlib.pyplot as plt  # noqa: F401  (of the modules that draw)

# Okabe and Ito's colours: distinct with every kind of colour vision.
BLUE, ORANGE, GREEN, SKY, YELLOW, BLACK, GREY = "#0072B2", "#D55E00", "#009E73", "#56B4E9", "#E69F00", "#000000", "#777777"
# Of the models: one colour and one stroke everywhere.
STYLES = {"continuum": {"color": BLUE, "linestyle": "-"}, "reduced": {"color": ORANGE, "linestyle": "--"},
          "polynomial": {"color": GREEN, "linestyle": "-."}}
FURTHER = [{"color": SKY, "linestyle": (0, (5, 1, 1, 1, 1, 1))}, {"color": BLACK, "linestyle": ":"}, {"color": YELLOW, "linestyle": (0, (3, 1))}]


def styles(models: list[str]) -> dict[str, dict[str, Any]]:
    """Of each model of a run; "polynomial-1" is the pseudo-rigid body, and other bodies of a ladder have further colours."""
    further = itertools.cycle(FURTHER)
    known = {**STYLES, "polynomial-1": STYLES["reduced"]}
    return {model: known.get(model) or next(further) for model in models}


def save(figure: Any, output: pathlib.Path, **options: Any) -> None:
    """The same picture is the same file: an .svg has no date and no random names."""
    metadata = {"Date": None} if output.suffix == ".svg" else None
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        with matplotlib.rc_context({"svg.hashsalt": "pseudorigid"}):
            figure.savefig(output, metadata=metadata, **options)
    except (OSError, ValueError) as error:
        raise WrongInput(f"--output: {error}") from error
    plt.close(figure)
