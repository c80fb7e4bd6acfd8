"""What pictures of curves share: matplotlib, colours, files."""

import pathlib
from typing import Any

from pseudorigid.errors import WrongInput, needs

with needs("python3-matplotlib"):
    import matplotlib
    import matplotlib.pyplot as plt  # noqa: F401  (of the modules that draw)

# Okabe and Ito's colours: distinct with every kind of colour vision.
BLUE, ORANGE, GREEN, SKY, YELLOW, BLACK, GREY = "#0072B2", "#D55E00", "#009E73", "#56B4E9", "#E69F00", "#000000", "#777777"


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
